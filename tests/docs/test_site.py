"""The parts that the site is made of: drawings of reports, links, headers, the gallery's table."""

import os
import pathlib
import sys
import xml.dom.minidom

import pytest

ROOT = pathlib.Path(os.environ["GAMUT_SOURCE_DIR"])
sys.path.insert(0, str(ROOT / "docs/site"))

import build  # noqa: E402
import commands  # noqa: E402
import doors  # noqa: E402
import figures  # noqa: E402
import gallery  # noqa: E402

REPORT = """<style>:root { --ink: #123; } /* dark */ @media (x) { :root { --ink: #fff; } .drawing { fill: red; } }
p { margin: 0; } .drawing text, .other { fill: var(--ink); }</style>
<svg class="drawing machine" viewBox="0 0 72 46" role="img" aria-label="The machine"><path d="M0 0h1"/></svg>
<svg class="icon" viewBox="0 0 1 1"></svg>
<svg class="drawing" viewBox="0 0 7 4" aria-label="Plot of the spread around the middle of x"><text>x</text></svg>"""


def test_drawings_stand_alone_with_their_styles():
    machine, spread = figures.drawings(REPORT)
    assert (machine.kind, machine.label, spread.kind) == ("machine", "The machine", "spread")
    svg = xml.dom.minidom.parseString(machine.svg).documentElement
    assert (svg.getAttribute("width"), svg.getAttribute("height")) == ("72", "46")
    style = svg.getElementsByTagName("style")[0].firstChild.data
    assert style == ":root{--ink: #123;}\n.drawing text{fill: var(--ink);}"


def test_links_out_of_docs_are_led_to_what_the_site_has():
    page = pathlib.Path("docs/tutorials/linkage.md")
    led = build.with_links_led("[a](../study-file.md#limits) [b](../../studies/examples/four_bar) [c](../../README.md)", page)
    assert led == "[a](../study-file.md#limits) [b](../gallery/four_bar/index.md) [c](../index.md)"
    assert build.with_links_led("[n](pendulum.ipynb) [w](https://a.b/c)", page) == "[n](pendulum.md) [w](https://a.b/c)"
    code = "`[x](../../tests)` and\n```cpp\n[&](auto) {}\n```"
    assert build.with_links_led(code, page) == code
    assert build.with_links_led("[e](../../README.md#command-line)", page) == "[e](../reference/commands.md)"
    with pytest.raises(SystemExit, match="nothing for the link to ../../tests/docs"):
        build.with_links_led("[t](../../tests/docs)", page)


def test_every_shipped_study_is_in_the_gallery():
    lines = gallery.lines_of((ROOT / "README.md").read_text())
    assert sorted(lines) == sorted(study.parent.name for study in ROOT.glob("studies/examples/*/study.toml"))
    assert all(line[0] == line[0].upper() for line in lines.values())


def test_every_command_has_its_section():
    page = commands.page(os.environ["GAMUT"])
    assert page.count("\n## gamut ") >= 14
    assert "\n## gamut run\n" in page and "--time-limit" in page
    assert page.count("Exit codes:") == 1 and os.environ["GAMUT"] not in page


def test_a_header_opens_with_words_and_code():
    text = "// A set of reals, a < b.\n//\n//   Interval x(1, 2);\n//\n// Code ends.\n#pragma once\n// Not this.\n"
    assert doors._opening(text) == "A set of reals, a &lt; b.\n\n\n```cpp\n  Interval x(1, 2);\n```\n\nCode ends.\n"
