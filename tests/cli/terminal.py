"""Every verb that shows much, in terminals of all widths. Prints what is wrong; exit 1 on any."""
import itertools
import json
import os
import re
import subprocess
import sys

import pseudo_terminal as pt

program, examples, folder = sys.argv[1:]
WIDTHS = (40, 60, 80, 120, 200)
UTF8 = {"TERM": "xterm-256color", "LANG": "C.UTF-8"}
ASCII = {"TERM": "xterm-256color", "LANG": "C"}
COLOURLESS = ({**UTF8, "NO_COLOR": "1"}, {**UTF8, "TERM": "dumb"})
EIGHTHS = " ▏▎▍▌▋▊▉█"
VERDICTS = "missing|ambiguous|unknown|adequate|insufficient"
wrong = []


def check(good, *what):
    if not good:
        wrong.append(" ".join(str(w) for w in what))


def servoid(*arguments):
    return subprocess.run([program, *arguments], cwd=folder, check=True, capture_output=True, text=True).stdout


def prepare():
    system1 = open(f"{examples}/system1.toml").read()
    open(f"{folder}/model.toml", "w").write(system1[: system1.index("[effects.coulomb")])
    system2 = open(f"{examples}/system2.toml").read()
    open(f"{folder}/bare.toml", "w").write(system2[: system2.index("[effects")])
    move = "trapezoid:stroke=6.28,velocity=50,cycles=4,torque_noise=1e-3"
    servoid("simulate", f"{examples}/system1.toml", "--seed", "7", "--out", "move.csv", "--experiment", move)
    servoid("simulate", f"{examples}/system1.toml", "--out", "one_way.csv", "--experiment",
            "constant_speed:velocity=20,duration=1,torque_noise=1e-3")
    servoid("simulate", f"{examples}/system2.toml", "--out", "many.csv", "--experiment",
            "trapezoid:stroke=12.56,velocity=50,cycles=24,torque_noise=1e-3")


CALLS = {
    "compare": ["compare", "model.toml", "move.csv"],
    "several": ["compare", "model.toml", "move.csv", "one_way.csv"],
    "diagnose": ["diagnose", "model.toml", "move.csv"],
    "ambiguous": ["diagnose", "model.toml", "one_way.csv"],
    "refine": ["refine", "model.toml", "move.csv", "--out", "better.toml"],
    "add": ["add", "coulomb", "model.toml", "move.csv"],
    "effect": ["effects", "stribeck"],
    "effects": ["effects"],
    "report": ["report", "model.toml", "move.csv", "--out", "page.html"],
    "mistake": ["diagnose", "model.toml", "nowhere/that/is/a/long/way/to/walk/before/it/ends.csv"],
}


def shown(name, columns, environment):
    text, code = pt.run([program, *CALLS[name]], columns, environment, folder)
    check(code == (3 if name == "mistake" else 0), name, columns, "exit", code, text[-300:])
    return text


def check_screen(name, columns, environment, text):
    where = (name, columns, environment)
    for line in pt.written_lines(text):
        check(pt.width(line) <= columns, *where, "too wide:", pt.width(line), repr(line))
    for line in pt.screen(text):
        check(" left" not in line, *where, "progress stays:", repr(line))
    coloured = environment in (UTF8, ASCII)
    check(coloured or "\x1b" not in text, *where, "an escape")
    check(not coloured or "\x1b[" in text or name in ("effects", "mistake"), *where, "no colour")
    check(environment is not ASCII or text.isascii(), *where, "not ASCII")
    if name in ("diagnose", "ambiguous", "refine", "report"):
        check(re.search(rf"^ ?({VERDICTS}) ", "\n".join(pt.screen(text)), re.M), *where, "no verdict")


def length(bar):
    """Of a bar, in eighths."""
    return sum(8 if c in "│|#" else max(0, EIGHTHS.find(c)) for c in bar.rstrip())


def check_ladder(columns, environment, text, least=2):
    rungs = [
        (float(m[1]), length(m[2]))
        for m in (re.match(r"(?:as it was|\+ \S+) +([\d.e-]+) %.*?  ([^ \d÷%].*)$", line) for line in pt.screen(text))
        if m
    ]
    check(len(rungs) >= least, columns, environment, "rungs:", rungs)
    for (above, long), (below, short) in itertools.pairwise(rungs):
        check(below < above and short < long, columns, environment, "no ladder:", rungs)


def commands(text):
    """Those that are printed to be pasted, as a shell reads them."""
    joined = "\n".join(pt.screen(text)).replace("\\\n", "")
    return [" ".join(line.split()) for line in joined.split("\n") if line.startswith("servoid ")]


def check_commands():
    for name in ("diagnose", "ambiguous"):
        wide = commands(shown(name, 200, UTF8))
        check(wide, name, "no command to go on with")
        for columns in (40, 60):
            narrow = commands(shown(name, columns, UTF8))
            check(narrow == wide, name, columns, "pasted:", narrow, "instead of", wide)
    add = commands(shown("diagnose", 40, UTF8))[0].split()
    servoid(*add[1:])
    check(os.path.exists(f"{folder}/{add[-1]}"), "not written:", add)


def check_live():
    text = shown("long", 80, UTF8)
    check(re.search(r"\d+ %  \d+ s left", text), "no progress with time left")
    first = text.index("as it was")
    check(text.find(" left", first) > first, "the ladder does not grow while it is climbed")
    check_screen("long", 80, UTF8, text)
    check_ladder(80, UTF8, text, 3)


def check_error_under_progress():
    text, code = pt.run([program, "report", "model.toml", "move.csv", "--out", "nowhere/page.html"],
                        80, UTF8, folder)
    check(code == 3, "exit", code)
    check("drawing the page" in text, "no phase named")
    last = [line for line in pt.screen(text) if line]
    check(len(last) == 1 and last[0].startswith("servoid: nowhere/page.html: "), "not cleared:", last)


def is_json(text):
    try:
        return isinstance(json.loads(text), dict)
    except json.JSONDecodeError:
        return False


def check_pipe():
    for name in ("compare", "diagnose", "refine"):
        command = [program, *CALLS[name]]
        piped = [
            subprocess.run(command, cwd=folder, capture_output=True, text=True, env={**os.environ, **extra})
            for extra in ({}, {**UTF8, "COLUMNS": "40"})
        ]
        check("\x1b" not in piped[0].stdout + piped[0].stderr, name, "an escape in a pipe")
        check(piped[0].stdout == piped[1].stdout, name, "a pipe has no width")
        check(piped[0].stderr == "", name, "progress in a pipe:", piped[0].stderr)
        text, _ = pt.run([*command, "--json"], 40, UTF8, folder)
        check(is_json(text), name, "not only JSON:", text[:100])
        text, _ = pt.run([*command, "--quiet"], 40, UTF8, folder)
        check(text == "", name, "not quiet:", text)


prepare()
for call, columns in itertools.product(CALLS, WIDTHS):
    if call not in ("compare", "diagnose", "refine") and columns not in (40, 80):
        continue
    for environment in (UTF8, ASCII):
        text = shown(call, columns, environment)
        check_screen(call, columns, environment, text)
        if call == "refine":
            check_ladder(columns, environment, text)
for call, environment in itertools.product(("compare", "diagnose", "refine", "mistake"), COLOURLESS):
    check_screen(call, 80, environment, shown(call, 80, environment))
CALLS["long"] = ["refine", "bare.toml", "many.csv"]
check_live()
check_commands()
check_error_under_progress()
check_pipe()
print("\n".join(wrong) or "every line fits")
sys.exit(bool(wrong))
