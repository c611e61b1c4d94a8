#!/usr/bin/env python3
"""The contrasts of palette.css: 4.5 for text, 3 for lines and marks (WCAG 2.1 AA)."""

import re
import sys

import assemble

TEXT = {
    "paper": "ink muted accent residual refined good warn bad idle",
    "panel": "ink muted accent residual",
    "accent": "on-accent",
    "residual": "on-accent",
    "line": "ink",
    "heat+": "ink",
    "heat-": "ink",
}
LINES = {"paper": "measured recorded model residual refined accent ink"}


def themes():
    blocks = re.findall(r"(:root[^{]*)\{([^}]*)\}", (assemble.PAGE / "palette.css").read_text())
    for name, block in blocks:
        yield name.strip(), dict(re.findall(r"--([\w-]+):\s*(#[0-9a-f]{6})\b", block))


def luminance(colour):
    parts = [int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    parts = [p / 12.92 if p <= 0.03928 else ((p + 0.055) / 1.055) ** 2.4 for p in parts]
    return 0.2126 * parts[0] + 0.7152 * parts[1] + 0.0722 * parts[2]


def contrast(one, other):
    dark, light = sorted((luminance(one), luminance(other)))
    return (light + 0.05) / (dark + 0.05)


def heat(palette, tone):
    """The strongest cell of the correlation table: 50 % of the tone on paper."""
    mix = lambda i: round(
        0.5 * int(palette[tone][i : i + 2], 16) + 0.5 * int(palette["paper"][i : i + 2], 16)
    )
    return "#" + "".join(f"{mix(i):02x}" for i in (1, 3, 5))


def weak(pairs, least, palette, theme):
    for ground, names in pairs.items():
        for name in names.split():
            found = contrast(palette[name], palette[ground])
            if found < least:
                yield f"{theme}: {name} on {ground}: {found:.2f}, expected at least {least}"


found = list(themes())
for _, palette in found:
    palette.update({"heat+": heat(palette, "accent"), "heat-": heat(palette, "residual")})
assert len(found) == 2, f"expected a light and a dark palette: {[name for name, _ in found]}"
faults = [
    f
    for theme, palette in found
    for pairs, least in ((TEXT, 4.5), (LINES, 3.0))
    for f in weak(pairs, least, palette, theme)
]
print("\n".join(faults) or "figure: all contrasts are at least 4.5 for text and 3 for lines")
sys.exit(bool(faults))
