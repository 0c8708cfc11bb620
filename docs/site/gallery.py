"""The gallery: a page for each shipped study, with what it teaches, its pictures and its report."""

import re
import shutil
import tomllib

from figures import drawings

KINDS = ("machine", "plot", "spread", "map")  # of the drawings that are shown, in this order


def _taught(text):
    """The comment that a study begins with, as paragraphs, and the number of its lines."""
    lines = []
    for line in text.splitlines():
        if not line.startswith("#"):
            break
        lines.append(line.lstrip("#").strip())
    words = "\n".join(lines).replace("<", "&lt;")
    return words, len(lines)


def _sentence(line):
    return line if line.endswith("?") else line + "."


def _pictures(report, folder):
    """Writes a report's machine and its first plot, spread and map into the folder; their names and what they show."""
    kept = {}
    for drawing in drawings(report):
        kept.setdefault(drawing.kind, drawing)
    for kind, drawing in kept.items():
        (folder / f"{kind}.svg").write_text(drawing.svg)
    return [(f"{kind}.svg", re.sub(r"[\[\]]", "", kept[kind].label)) for kind in KINDS if kind in kept]


def _page(study, line, reports, folder):
    """Writes the page of one study; the picture that stands for it, or None where it has not been run."""
    text = (study / "study.toml").read_text()
    taught, skipped = _taught(text)
    shutil.copytree(study, folder, dirs_exist_ok=True)
    parts = [f"# {tomllib.loads(text)['study']['title']}\n", f"{_sentence(line)}\n", f"{taught}\n"]
    report = reports / f"{study.name}.html"
    pictures = _pictures(report.read_text(), folder) if report.exists() else []
    if report.exists():
        parts.append(f'<p><a href="../../reports/{study.name}.html">The report of this study</a>, as a run writes it.</p>\n')
    parts += [f"![{label}]({name})\n\n*{label}.*\n" for name, label in pictures]
    parts.append(f"```{{literalinclude}} study.toml\n:language: toml\n:lines: {skipped + 1}-\n```\n")
    others = sorted(file.name for file in study.iterdir() if file.name != "study.toml")
    parts += [f"Beside it: {{download}}`{name} <{name}>`\n" for name in others]
    (folder / "index.md").write_text("\n".join(parts))
    return pictures[0][0] if pictures else None


def lines_of(readme):
    """What the table of examples says of each study, by its name, in the table's order."""
    rows = re.findall(r"^\| \[(\w+)\]\(studies/examples/\w+\) \| (.*?) \|$", readme, re.MULTILINE)
    return {name: line[0].upper() + line[1:] for name, line in rows}


def write(examples, readme, reports, folder):
    """Writes the gallery into the folder: its first page, and one for each study."""
    lines = lines_of(readme)
    entries, names = [], []
    for name, line in lines.items():
        picture = _page(examples / name, line, reports, folder / name)
        image = f"```{{image}} {name}/{picture}\n:width: 60%\n:alt: {name}\n```\n\n" if picture else ""
        entries.append(f"## [{name}]({name}/index.md)\n\n{_sentence(line)}\n\n{image}")
        names.append(f"{name}/index")
    first = (folder.parent / "gallery.md").read_text()
    toctree = "```{toctree}\n:hidden:\n\n" + "\n".join(names) + "\n```\n"
    (folder / "index.md").write_text(first + "\n" + toctree + "\n" + "\n".join(entries))
    (folder.parent / "gallery.md").unlink()
