#!/usr/bin/env python3
"""Words that neither the dictionary of British English (aspell) nor the list knows: words.py LIST FILE...

Looked at are words of small letters in prose: no code, no links, no names.
"""

import json
import pathlib
import re
import subprocess
import sys

NO_PROSE = re.compile(r"^```.*?^```$|^(?: {4}|\t)[^\n]*$|<!--.*?-->|`[^`\n]*`|\]\([^)]*\)|https?://\S+|<[^>\n]*>", re.MULTILINE | re.DOTALL)


def prose(file):
    """What a reader reads of a page, of the words between a notebook's cells, or of what a study begins with."""
    text = file.read_text()
    if file.suffix == ".toml":
        text = re.sub(r"^# ?", "", re.match(r"(?:#.*\n)*", text)[0], flags=re.MULTILINE)
    if file.suffix == ".ipynb":
        cells = json.loads(text)["cells"]
        text = "\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown")
    return NO_PROSE.sub(" ", text)


def words(text):
    return set(re.findall(r"(?<![\w.'’/_-])[a-z]{3,}(?![\w'’/_]|\.\w)", text))


def main():
    known = pathlib.Path(sys.argv[1]).read_text().split()
    if known != sorted(set(known)):
        sys.exit(f"{sys.argv[1]} is not sorted, or names a word twice")
    places = {}
    for file in map(pathlib.Path, sys.argv[2:]):
        for word in words(prose(file)) - set(known):
            places.setdefault(word, []).append(f"{file.parent.name}/{file.name}")
    asked = ["aspell", "list", "--lang=en_GB", "--encoding=utf-8"]
    unknown = subprocess.run(asked, input="\n".join(places), text=True, capture_output=True, check=True).stdout.split()
    for word in sorted(unknown):
        print(f"{', '.join(places[word])}: {word}")
    if unknown:
        sys.exit(f"{len(unknown)} unknown words: mistyped, or new to {sys.argv[1]}?")
    print("all words are known")


if __name__ == "__main__":
    main()
