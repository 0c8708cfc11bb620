#!/usr/bin/env python3
"""Runs the blocks of a page from its top, as a reader would, in a folder where studies/ is that of the sources, and no
more: run_page.py PAGE FOLDER GAMUT LISTINGS.

    ```sh        is run by bash, where `gamut` is the program; it must succeed
    ```python    is executed; all such blocks of a page are one program
    ```cpp       is what CMake has compiled and compares: the next listing of this page in LISTINGS
    ```toml      and other files: the first line names the file, or one that the rest is added to, as a comment:
                 "# pendulum.toml", "# add to pendulum.toml", "<!-- arm.urdf -->"; a study is validated at once
    ```text      behind sh or python is what they print; a line "..." is any lines, "…" in a line is anything
    <!-- sh      and so on: the same, unseen by the reader, for what a block needs
    ```cmake     is configured by tests/package

Any other block is an error: no block goes unread.
"""

import contextlib
import io
import os
import pathlib
import re
import shutil
import subprocess
import sys

BLOCK = re.compile(r"^(?:```(\S*)(?: [^\n]*)?\n(.*?)^```$|<!-- (sh|python|toml)\n(.*?)^-->$)", re.MULTILINE | re.DOTALL)
NAMED = re.compile(r"^(?:#|//|<!--) (add to )?(\S+\.\w+)(?: -->)?\n")


class Wrong(Exception):
    """What is not as the page says."""


def blocks(text):
    """Line, language and text of each block of a page."""
    for found in BLOCK.finditer(text):
        line = text.count("\n", 0, found.start()) + 1
        yield line, found[1] if found[1] is not None else found[3], found[2] if found[2] is not None else found[4]


def is_as_shown(printed, shown):
    """Whether what was printed is what the page shows, lines by lines."""
    pattern = ""
    for line in shown.rstrip("\n").split("\n"):
        any_lines = line.strip() == "..."
        pattern += r"(?:.*\n)*?" if any_lines else ".*?".join(map(re.escape, line.rstrip().split("…"))) + r" *\n"
    return re.fullmatch(pattern, printed.rstrip("\n") + "\n") is not None


class Page:
    """A page that is being run."""

    def __init__(self, page, folder, gamut, listings):
        self.page, self.folder, self.listings = page, folder, listings
        self.names, self.listing, self.printed = {"__name__": "__main__"}, 0, None
        tools = folder.with_name(folder.name + ".bin")
        for made in (folder, tools):
            shutil.rmtree(made, ignore_errors=True)
            made.mkdir(parents=True)
        (tools / "gamut").symlink_to(gamut)
        os.environ["PATH"] = f"{tools}:{os.environ['PATH']}"
        (folder / "studies").symlink_to(pathlib.Path(__file__).resolve().parents[2] / "studies")
        os.chdir(folder)

    def _shell(self, text):
        done = subprocess.run(["bash", "-euo", "pipefail", "-c", text], text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL)  # fmt: skip
        if done.returncode != 0:
            raise Wrong(f"ended with {done.returncode}:\n{done.stdout}")
        return done.stdout

    def _python(self, text):
        with contextlib.redirect_stdout(io.StringIO()) as said:
            exec(compile(text, self.page.name, "exec"), self.names)
        return said.getvalue()

    def _compiled(self, text):
        self.listing += 1
        listing = self.listings / f"{self.page.stem}_listing_{self.listing}.cpp"
        if not listing.exists() or listing.read_text() != text:
            raise Wrong(f"is not what was compiled as {listing}")

    def _file(self, text):
        named = NAMED.match(text)
        if not named:
            raise Wrong("nothing runs it, and its first line names no file")
        with open(named[2], "a" if named[1] else "w") as file:
            file.write(("\n" if named[1] else "") + text[named.end() :])
        if named[2].endswith(".toml") and "[study]" in pathlib.Path(named[2]).read_text():
            self._shell(f"gamut validate {named[2]}")

    def run(self, language, text):
        """One block."""
        if language.startswith("{"):
            return
        if language == "text":
            if self.printed is None:
                raise Wrong("stands behind nothing that prints")
            if self.printed is not ... and not is_as_shown(self.printed, text):
                raise Wrong(f"is shown, but printed was:\n{self.printed}")
            self.printed = None
            return
        self.printed = None
        if language == "sh":
            self.printed = self._shell(text)
        elif language == "python":
            self.printed = self._python(text)
        elif language == "cpp" and not NAMED.match(text):
            self._compiled(text)
            self.printed = ...  # compared by a test of its own
        elif language == "cmake":
            pass
        else:
            self._file(text)


def main():
    page, folder, gamut, listings = map(pathlib.Path, sys.argv[1:])
    running = Page(page.resolve(), folder.resolve(), gamut.resolve(), listings.resolve())
    count = 0
    for line, language, text in blocks(running.page.read_text()):
        try:
            running.run(language, text)
        except Exception as error:
            sys.exit(f"{page}:{line}: ```{language} {error if isinstance(error, Wrong) else repr(error)}")
        count += not language.startswith("{")
    print(f"{count} blocks are as {page.name} says")


if __name__ == "__main__":
    main()
