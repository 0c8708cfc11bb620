#!/usr/bin/env python3
"""The page of the C++ library: for each header for users, what it opens with and what it declares.

As a program, `doors.py HEADER` prints the header as Doxygen is to read it: all that it declares is one group.
"""

import pathlib
import re
import sys


def _group(path):
    return re.sub(r"\W", "_", str(path))


def _opening(text):
    """The comment that a header opens with, as Markdown: lines that are indented are code."""
    opening = re.match(r"(?://.*\n)*", text)[0]
    lines = re.sub(r"^// ?", "", opening, flags=re.MULTILINE)
    code = re.compile(r"(?:^  .*\n)(?:^(?:  .*)?\n)*", re.MULTILINE)
    parts = re.split(code, lines)
    prose = [part.replace("<", "&lt;") for part in parts]
    blocks = [f"\n```{'cpp' if ');' in block else 'text'}\n{block.rstrip()}\n```\n\n" for block in code.findall(lines)]
    return prose[0] + "".join(block + part for block, part in zip(blocks, prose[1:], strict=True))


def page(root, doors):
    """Markdown: a section for each door, a path below the root."""
    parts = [
        "# C++\n",
        "The headers for programs outside. Link to `Gamut::gamut`, or to a room alone, such as `Gamut::scalars`; an\n"
        "installed header is included as `<gamut/PATH>`. All names are in the namespace `gamut`.\n",
    ]
    for door in doors:
        text = (root / door).read_text()
        name = str(door).removeprefix("include/gamut/")
        parts.append(f"## {name}\n\n{_opening(text)}\n")
        if re.search(r"namespace gamut \{", text):
            parts.append(f"```{{doxygengroup}} {_group(name)}\n:content-only:\n:members:\n```\n")
    return "\n".join(parts)


def main():
    path = pathlib.Path(sys.argv[1])
    root = pathlib.Path(__file__).resolve().parents[2]
    name = _group(path.resolve().relative_to(root))
    declared = re.compile(r"^(?:template <[^;{}]*>\n?\s*)?(?:class|struct) \w+;$", re.MULTILINE)  # elsewhere
    text = declared.sub("", path.read_text())
    text = re.sub(r"^namespace gamut \{$", r"\g<0> /** @addtogroup " + name + "\n@{ */", text, flags=re.MULTILINE)
    print(re.sub(r"^\}  // namespace gamut$", r"/** @} */ \g<0>", text, flags=re.MULTILINE))


if __name__ == "__main__":
    main()
