"""The page of commands, from what the program says of itself."""

import re
import subprocess


def _help(program, *command):
    said = subprocess.run([program, *command, "--help"], check=True, capture_output=True, text=True).stdout
    return said.replace(str(program), "gamut")


def page(program):
    """Markdown: exit codes, then a section for each command with what its --help prints."""
    whole = _help(program)
    names = re.findall(r"^  (\w+)  ", whole[whole.index("Subcommands:") : whole.index("Exit codes:")], re.MULTILINE)
    parts = [
        "# Command line\n",
        "What `gamut --help` and `gamut COMMAND --help` print.\n",
        f"```text\n{whole}```\n",
    ]
    for name in names:
        said = _help(program, name)
        said = said[: said.find("\nExit codes:")] if "\nExit codes:" in said else said.rstrip("\n")
        parts.append(f"## gamut {name}\n\n```text\n{said}\n```\n")
    return "\n".join(parts)
