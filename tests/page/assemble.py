#!/usr/bin/env python3
"""assemble.py STORY.json|--studio OUT.html: the page as the program puts it together."""

import json
import pathlib
import sys

PAGE = pathlib.Path(__file__).resolve().parents[2] / "host_sim/page"
DYGRAPHS = pathlib.Path("/usr/share/javascript/dygraphs")


def parts(ending):
    names = (PAGE / "parts.txt").read_text().split()
    return "\n".join((PAGE / n).read_text() for n in names if n.endswith(ending))


def escaped(mode):
    text = json.dumps(mode, ensure_ascii=False, separators=(",", ":"))
    for char in "<>&\u2028\u2029":
        text = text.replace(char, "\\u%04x" % ord(char))
    return text


def assemble(mode):
    page = (PAGE / "page.html").read_text()
    for place, text in (
        ("@STYLE@", parts(".css")),
        ("@DYGRAPHS_CSS@", (DYGRAPHS / "dygraph.min.css").read_text()),
        ("@DYGRAPHS_JS@", (DYGRAPHS / "dygraph.min.js").read_text()),
        ("@SCRIPTS@", parts(".js")),
        ("@MODE_JSON@", escaped(mode)),
    ):
        page = page.replace(place, text)
    return page


if __name__ == "__main__":
    source, out = sys.argv[1:]
    mode = (
        {"mode": "studio"}
        if source == "--studio"
        else {"mode": "report", "story": json.loads(pathlib.Path(source).read_text())}
    )
    pathlib.Path(out).write_text(assemble(mode))
