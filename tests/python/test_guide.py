"""The lines of the guide, in its order."""

import os
import pathlib
import re


def test_the_lines_of_the_guide_run():
    guide = (pathlib.Path(os.environ["GAMUT_SOURCE_DIR"]) / "docs/python.md").read_text()
    blocks = re.findall(r"```python\n(.*?)```", guide, re.DOTALL)
    assert len(blocks) >= 7
    names = {}
    for block in blocks:
        exec(compile(block, "docs/python.md", "exec"), names)
    assert names["results"].verdict.word == "inside"
    assert names["tube"].reached == 2.0
