"""Drawings of a report as SVG files of their own: the report's styles go with them, on white."""

import re
from dataclasses import dataclass


@dataclass
class Drawing:
    """A drawing of a report: its `kind` is one of those below or "plot", `label` says what it shows."""

    kind: str
    label: str
    svg: str


_KINDS = {"The machine": "machine", "Plot of the spread": "spread", "Map of": "map"}  # by how their labels begin
_DRAWING = re.compile(r'<svg class="(drawing[^"]*)" viewBox="([^"]*)"([^>]*)>(.*?)</svg>', re.DOTALL)
_MEDIA = re.compile(r"@media[^{]*\{(?:[^{}]*\{[^{}]*\})*[^{}]*\}")


def _styles(report):
    """The rules for drawings and the colours that they name, without those of dark screens."""
    text = "\n".join(re.findall(r"<style>(.*?)</style>", report, re.DOTALL))
    text = _MEDIA.sub("", re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL))
    kept = []
    for selectors, rules in re.findall(r"([^{}]+)\{([^{}]*)\}", text):
        wanted = [s.strip() for s in selectors.split(",") if re.match(r":root$|\.drawing\b|\.machine\b", s.strip())]
        if wanted:
            kept.append(f"{','.join(wanted)}{{{' '.join(rules.split())}}}")
    return "\n".join(kept).replace("<", r"\3c ")


def drawings(report):
    """All that are drawn in the text of a report, in its order."""
    styles = _styles(report)
    found = []
    for classes, box, others, body in _DRAWING.findall(report):
        label = re.search(r'aria-label="([^"]*)"|$', others)[1] or ""
        width, height = box.split()[2:]
        svg = (
            f'<svg xmlns="http://www.w3.org/2000/svg" class="{classes}" viewBox="{box}" width="{width}" height="{height}" '
            f'font-family="system-ui, sans-serif">\n<style>{styles}</style>\n'
            f'<rect width="{width}" height="{height}" fill="#ffffff"/>{body}</svg>\n'
        )
        kind = next((kind for words, kind in _KINDS.items() if label.startswith(words)), "plot")
        found.append(Drawing(kind, label, svg))
    return found
