#!/usr/bin/env python3
"""Builds the site: runs the studies of the gallery, puts its sources together, then calls Doxygen and Sphinx.

Pages lie in docs/ and are copied, so that what is made of the program stands beside them: the gallery, the page of
commands, the notebook with what it shows. Links that leave docs/ are led to where the site has the same.
"""

import argparse
import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import sys

import commands
import doors
import gallery

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]


# ---- Reports --------------------------------------------------------------------------------------------------------


def _report(program, study, reports):
    """Runs a study unless its report is newer than study and program. Exit code 3, all kept that was proved, is well."""
    page = reports / f"{study.name}.html"
    newest = max(file.stat().st_mtime for file in [program, *study.iterdir()])
    if page.exists() and page.stat().st_mtime > newest:
        return
    results = reports.parent / "results" / f"{study.name}.h5"
    run = [program, "run", study / "study.toml", "--force", "--quiet", "--jobs", "1", "--output", results, "--report", page]
    done = subprocess.run(run, capture_output=True, text=True)
    if done.returncode not in (0, 3):
        sys.exit(f"{study.name} ended with {done.returncode}:\n{done.stdout}{done.stderr}")


def write_reports(program, studies, reports):
    """The reports of these studies, as many at a time as there are processors."""
    reports.mkdir(parents=True, exist_ok=True)
    (reports.parent / "results").mkdir(exist_ok=True)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for done in [pool.submit(_report, program, study, reports) for study in studies]:
            done.result()


# ---- Sources --------------------------------------------------------------------------------------------------------

ELSEWHERE = {
    "README.md": "index.md",
    "README.md#command-line": "reference/commands.md",
    "CONTRIBUTING.md": "contributing.md",
    "CHANGELOG.md": "changelog.md",
}


def _led(target, page):
    """Where on the site `target` is, a link of the page (both as paths, of the page below ROOT)."""
    path, _, anchor = target.partition("#")
    place = pathlib.Path(os.path.normpath(page.parent / path))
    if place.parts[0] == "docs":
        place = place.relative_to("docs").with_suffix(".md" if place.suffix == ".ipynb" else place.suffix)
    elif place.parts[:2] == ("studies", "examples"):
        place = pathlib.Path("gallery", *place.parts[2:3], "index.md")
    elif str(place) + target[len(path) :] in ELSEWHERE:
        place, anchor = pathlib.Path(ELSEWHERE[str(place) + target[len(path) :]]), ""
    else:
        sys.exit(f"{page}: the site has nothing for the link to {target}")
    start = page.relative_to("docs").parent if page.parts[0] == "docs" else pathlib.Path()
    return os.path.relpath(place, start) + (f"#{anchor}" if anchor else "")


def with_links_led(text, page):
    """The text of a page, a path below ROOT, with its links to files as they are on the site. Code stays as it is."""
    pieces = re.split(r"(^```.*?^```$|`[^`\n]*`)", text, flags=re.MULTILINE | re.DOTALL)
    link = re.compile(r"(?<=\]\()(?!https?:|#)([^()\s]+)(?=\))")
    for i in range(0, len(pieces), 2):
        pieces[i] = link.sub(lambda found: _led(found[1], page), pieces[i])
    return "".join(pieces)


def _notebook(path, to, is_run):
    """Puts a notebook as Markdown into the folder; where it is run, with what its cells show, and pictures beside it."""
    copy = to / path.name
    shutil.copy(path, copy)
    command = [sys.executable, "-m", "nbconvert", "--to", "markdown", copy, "--log-level", "ERROR"]
    environment = os.environ | {"PYDEVD_DISABLE_FILE_VALIDATION": "1"}
    subprocess.run(command + (["--execute"] if is_run else []), check=True, env=environment)
    for made in [copy, *to.glob("*.h5"), *to.glob("*.html")]:
        made.unlink()


def write_sources(options, reports, sources):
    """All that Sphinx reads, anew."""
    shutil.rmtree(sources, ignore_errors=True)
    for file in (ROOT / "docs").rglob("*"):
        to = sources / file.relative_to(ROOT / "docs")
        if file.suffix in (".md", ".png", ".svg"):
            to.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(file, to)
        elif file.suffix == ".ipynb":
            to.parent.mkdir(parents=True, exist_ok=True)
            _notebook(file, to.parent, not options.studies)
    for page in sources.rglob("*.md"):
        page.write_text(with_links_led(page.read_text(), pathlib.Path("docs") / page.relative_to(sources)))
    for name in ("CONTRIBUTING.md", "CHANGELOG.md"):
        (sources / ELSEWHERE[name]).write_text(with_links_led((ROOT / name).read_text(), pathlib.Path(name)))
    (sources / "reference" / "commands.md").write_text(commands.page(options.gamut))
    (sources / "reference" / "cpp.md").write_text(doors.page(ROOT, options.doors))
    gallery.write(ROOT / "studies/examples", (ROOT / "README.md").read_text(), reports, sources / "gallery")


# ---- Pages ----------------------------------------------------------------------------------------------------------

DOXYGEN = """
PROJECT_NAME = Gamut
INPUT = {inputs}
STRIP_FROM_PATH = {root}
OUTPUT_DIRECTORY = {output}
GENERATE_HTML = NO
GENERATE_LATEX = NO
GENERATE_XML = YES
XML_PROGRAMLISTING = NO
EXTRACT_ALL = YES
HIDE_UNDOC_MEMBERS = NO
INPUT_FILTER = "{filter}"
EXCLUDE_SYMBOLS = detail gamut::detail* std::* Eigen::* boost::*
HAVE_DOT = NO
QUIET = YES
WARN_IF_UNDOCUMENTED = NO
WARN_AS_ERROR = FAIL_ON_WARNINGS
"""


def write_pages(options, build, sources, reports):
    """Doxygen's XML of the headers for users, and the site."""
    doxygen = build / "doxygen"
    doxygen.mkdir(exist_ok=True)
    inputs = " ".join(str(ROOT / door) for door in options.doors)
    (build / "Doxyfile").write_text(DOXYGEN.format(inputs=inputs, root=ROOT, output=doxygen, filter=f"{sys.executable} {HERE / 'doors.py'}"))
    subprocess.run(["doxygen", build / "Doxyfile"], check=True)
    version = subprocess.run([options.gamut, "--version"], check=True, capture_output=True, text=True).stdout.split()[1]
    os.environ.update(GAMUT_VERSION=version, GAMUT_DOXYGEN=str(doxygen / "xml"), GAMUT_REPORTS=str(reports.parent / "extra"))
    extra = reports.parent / "extra"
    extra.mkdir(exist_ok=True)
    shutil.rmtree(extra / "reports", ignore_errors=True)
    shutil.copytree(reports, extra / "reports")
    sphinx = [sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-b", "html", "-c", HERE, "-d", build / "doctrees"]
    return subprocess.run([*sphinx, sources, options.output]).returncode


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--gamut", type=pathlib.Path, required=True, help="the program")
    parser.add_argument("--build", type=pathlib.Path, required=True, help="folder for what is made on the way")
    parser.add_argument("--output", type=pathlib.Path, required=True, help="folder of the site")
    parser.add_argument("--studies", nargs="*", help="only these studies are run, and notebooks are not")
    parser.add_argument("--doors", nargs="+", required=True, help="headers for users")
    options = parser.parse_args()

    reports, sources = options.build / "reports", options.build / "source"
    names = options.studies or list(gallery.lines_of((ROOT / "README.md").read_text()))
    write_reports(options.gamut, [ROOT / "studies/examples" / name for name in names], reports)
    write_sources(options, reports, sources)
    return write_pages(options, options.build, sources, reports)


if __name__ == "__main__":
    sys.exit(main())
