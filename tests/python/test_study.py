"""Studies in Python are study files: the same words, the same numbers, the same refusals."""

import copy
import json
import os
import pathlib
import pickle
import shutil
import subprocess
import sys
import tomllib

import numpy
import pytest

import gamut
from conftest import pendulum

EXAMPLES = pathlib.Path(os.environ["GAMUT_SOURCE_DIR"]) / "studies/examples"


def test_a_file_that_is_read_is_written_word_for_word():
    path = EXAMPLES / "double_pendulum/study.toml"
    assert gamut.Study(path).to_toml() == path.read_text()


def test_a_study_may_be_json(tmp_path):
    path = EXAMPLES / "double_pendulum/study.toml"
    text = gamut.Study(path).to_json()
    (tmp_path / "study.json").write_text(text)
    study = gamut.Study(tmp_path / "study.json")
    assert study.to_json() == text
    assert tomllib.loads(study.to_toml()) == tomllib.loads(path.read_text()) == json.loads(text)
    assert study.quantities() == gamut.Study(path).quantities()
    study.uncertain[0]["quantity"] = "shoulder.angel"
    (tmp_path / "study.json").write_text(study.to_json())
    with pytest.raises(gamut.StudyError) as wrong:
        gamut.Study(tmp_path / "study.json").validate()
    line = (tmp_path / "study.json").read_text().splitlines()[wrong.value.line - 1]
    assert line[wrong.value.column - 1 :].startswith('"shoulder.angel"')
    (tmp_path / "study.json").write_text('{"study": {"title": "a" "b"}}')
    with pytest.raises(gamut.StudyError, match="not valid JSON"):
        gamut.Study(tmp_path / "study.json")


@pytest.mark.parametrize("path", sorted(EXAMPLES.glob("*/*.toml")), ids=lambda path: f"{path.parent.name}-{path.stem}")
def test_what_is_written_says_what_was_read(path):
    data = tomllib.loads(path.read_text())
    assert tomllib.loads(gamut.toml.dumps(data)) == data


def test_a_study_that_was_changed_is_written_so():
    study = gamut.Study(EXAMPLES / "double_pendulum/study.toml")
    study.horizon = 1.0
    study.interval.tightness = 1.01
    study.uncertain[0]["interval"] = "± 2 %"
    again = gamut.Study.from_toml(study.to_toml())
    assert (again.horizon, again.interval.tightness, again.uncertain[0]["interval"]) == (1.0, 1.01, "± 2 %")
    assert again.validate() == []


def test_settings_know_what_they_are():
    assert "overestimation" in type(gamut.Study().interval).tightness.__doc__.lower()
    with pytest.raises(AttributeError, match="no setting 'tightnes'; expected one of: .*tightness"):
        gamut.Study().interval.tightnes = 1.01
    with pytest.raises(TypeError, match="no section 'uncertian'"):
        gamut.Study(uncertian=[])


def test_nothing_is_misspelt_in_silence():
    study = pendulum()
    with pytest.raises(AttributeError, match="no section 'horizn'; expected one of: .*horizon"):
        study.horizn = 3
    with pytest.raises(TypeError, match="uncertain: expected a list of dictionaries"):
        gamut.Study(uncertain={"name": "length"})
    with pytest.raises(TypeError, match="mechanism: expected a dictionary"):
        gamut.Study(mechanism=None)
    for wrong in ({"samples": -5}, {"samples": 1.5}, {"seed": -1}, {"jobs": 0}, {"time_limit": float("nan")},
                  {"time_limit": -1}, {"memory_limit": "1 GB"}, {"samples": 10**8}):
        with pytest.raises(ValueError, match=f"{next(iter(wrong))} = "):
            study.run(**wrong)


def test_a_study_is_its_own():
    gravity = [0, 0, -9.81]
    given = {"gravity": gravity, "element": [{"type": "mass", "name": "m", "at": "inertial", "mass": 1.0}]}
    study = gamut.Study(mechanism=given, horizon=1.0, study={"title": "Own"})
    study.mechanism["gravity"][2] = -1
    assert gravity == [0, 0, -9.81] and (study.title, study.horizon) == ("Own", 1.0)
    for copied in (copy.copy(study), copy.deepcopy(study), pickle.loads(pickle.dumps(study))):
        copied.horizon = 7
        assert study.horizon == 1.0 and copied.mechanism == study.mechanism
    full = pendulum()
    full.validate()
    assert copy.deepcopy(full).to_toml() == full.to_toml()


def test_paths_stay_what_they_were(tmp_path, monkeypatch):
    monkeypatch.chdir(EXAMPLES / "robot_arm_moments")
    study = gamut.Study("study.toml")
    study.mechanism["urdf"] = pathlib.Path(study.mechanism["urdf"])
    monkeypatch.chdir(tmp_path)
    assert study.validate() == []


def test_errors_go_through_pickle():
    error = gamut.StudyError("a.toml:3:4", "is wrong", "right")
    again = pickle.loads(pickle.dumps(error))
    assert (str(again), again.file, again.line, again.column) == (str(error), "a.toml", 3, 4)


def test_numbers_of_numpy_are_numbers():
    study = pendulum(limits={"time": numpy.float64(60)})
    study.mechanism["element"][2]["mass"] = numpy.int64(3)
    study.mechanism["gravity"] = numpy.array([0, 0, -9.81])
    assert study.validate() == []


def test_what_no_file_holds_is_refused():
    study = pendulum()
    study.title = object()
    with pytest.raises(TypeError, match="study.title: a study holds no object"):
        study.to_toml()


def test_a_refusal_says_where():
    study = pendulum()
    study.output.append({"name": "speed", "quantity": "pivot.speed"})
    with pytest.raises(gamut.StudyError) as refused:
        study.validate()
    error = refused.value
    assert (error.file, study.to_toml().splitlines()[error.line - 1]) == ("study", 'quantity = "pivot.speed"')
    assert "pivot.speed" in error.problem and "pivot.rate" in error.expected
    with pytest.raises(gamut.StudyError) as refused:
        gamut.Study.from_toml("[study\n", "broken.toml")
    assert (refused.value.file, refused.value.line) == ("broken.toml", 1)
    with pytest.raises(gamut.StudyError, match="nowhere.toml"):
        gamut.Study("nowhere.toml")


def test_quantities_of_a_mechanism_alone():
    study = pendulum()
    del study.output[:], study.uncertain[:], study.requirement[:]
    found = study.quantities()
    assert found.uncertain["rod.length"] == ("rod.length", "m", 1.0)
    assert found.outputs["pivot.angle"].nominal == pytest.approx(numpy.pi / 3, abs=1e-15)
    assert "rod.length" in found._repr_html_()


def test_python_and_the_command_find_the_same_numbers(tmp_path, results):
    (tmp_path / "study.toml").write_text(pendulum().to_toml())
    ran = subprocess.run([os.environ["GAMUT"], "run", "study.toml", "--quiet", "-o", "own.h5", "--report", "own.html"],
                         cwd=tmp_path, capture_output=True, text=True, check=True)
    assert ran.stderr == ""
    command = gamut.open(tmp_path / "own.h5")
    noise = {"cpu", "memory", "date", "host", "memory_limit", "enclosure_memory_limit", "file"}
    differing = gamut._gamut.differences(results._held, command._held)
    assert {path.rsplit("/", 1)[-1] for path in differing} <= noise
    assert gamut.compare(results, command)["verdict"] == "agree"


def test_seeds_samples_and_jobs_are_those_of_the_run():
    study = pendulum()
    one = study.run(samples=16, seed=7, jobs=1, progress=False)
    other = study.run(samples=16, seed=7, jobs=2, progress=False)
    assert one.value("/stochastic/samples") == 16 and one.value("/study/seed") == 7
    assert numpy.array_equal(one["angle"].mean, other["angle"].mean)
    with pytest.raises(ValueError, match="jobs"):
        study.run(jobs=0)


def test_progress_is_told_and_may_end_the_run():
    told = []
    study = gamut.Study(EXAMPLES / "double_pendulum/study.toml")

    def note(task, fraction):
        told.append((task, fraction))
        if len(told) == 3:
            raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        study.run(samples=100000, progress=note)
    assert len(told) == 3 and all(task and 0 <= fraction <= 1 for task, fraction in told)


def test_an_interrupt_keeps_what_was_found_wherever_it_comes():
    study = gamut.Study(EXAMPLES / "double_pendulum/study.toml")

    def note(task, fraction):
        raise KeyboardInterrupt

    with pytest.raises(gamut.Interrupted) as interrupt:
        study.run(samples=1000000, progress=note)
    assert interrupt.value.results.ended == "the run was interrupted"


def test_an_interrupt_keeps_what_was_found(tmp_path):
    program = (
        "import gamut, sys\n"
        f"study = gamut.Study({str(EXAMPLES / 'double_pendulum/study.toml')!r})\n"
        "try:\n"
        "    study.run(samples=1000000, progress=lambda task, fraction: print(task, flush=True))\n"
        "except KeyboardInterrupt as interrupt:\n"
        "    print('ended:', interrupt.results.ended, flush=True)\n"
        "    interrupt.results.save('part.h5')\n"
    )
    import signal
    import sys

    process = subprocess.Popen([sys.executable, "-c", program], cwd=tmp_path, stdout=subprocess.PIPE, text=True)
    process.stdout.readline()
    process.send_signal(signal.SIGINT)
    said = process.communicate(timeout=120)[0]
    assert process.returncode == 0 and "ended: the run was interrupted" in said
    assert gamut.open(tmp_path / "part.h5").ended == "the run was interrupted"


@pytest.mark.skipif(shutil.which("mpirun") is None, reason="there is no mpirun")
def test_scripts_under_mpirun_share_nothing_and_write_once(tmp_path):
    (tmp_path / "s.toml").write_text(pendulum().to_toml())
    (tmp_path / "script.py").write_text("""if True:
        import os, gamut
        rank = os.environ["OMPI_COMM_WORLD_RANK"]
        study = gamut.Study.from_toml(open("s.toml").read())
        results = study.run(progress=False, jobs=1)
        over = {"rod.length": [1.0, 1.1]}
        both = {"results": lambda: results.save("r.h5"),
                "sweep": lambda: study.sweep(over, file="s.h5", progress=False)}
        for name, write in both.items():
            try:
                write()
                said = "wrote"
            except OSError:
                said = "refused"
            open(name + rank, "w").write(said)
    """)
    subprocess.run(["mpirun", "--oversubscribe", "-n", "2", sys.executable, "script.py"], cwd=tmp_path, check=True,
                   timeout=300, env=os.environ | {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"})  # fmt: skip
    said = {name: sorted((tmp_path / f"{name}{rank}").read_text() for rank in (0, 1)) for name in ("results", "sweep")}
    assert said["results"] == ["refused", "wrote"]
    assert "wrote" in said["sweep"]  # the second is refused, or finds the points that the first one has kept
    assert (gamut.open(tmp_path / "s.h5").points["state"] == "done").all()


def test_tolerances_that_a_requirement_allows():
    found = pendulum().tolerance(progress=False)
    assert found.nominal == "" and found.together["factor"] >= 1
    assert [each["name"] for each in found.alone] == ["length"]


def test_the_schema_is_that_of_the_command():
    said = subprocess.run([os.environ["GAMUT"], "schema"], capture_output=True, text=True, check=True).stdout
    assert json.loads(said)["properties"].keys() == {
        name for name in dir(gamut.Study) if isinstance(getattr(gamut.Study, name), property)
    } - set(json.loads(said)["properties"]["study"]["properties"]) | {"study", "sweep"}  # sweep is a method
