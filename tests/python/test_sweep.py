"""Sweeps: labelled by what is varied, the same as runs of the points alone."""

import os
import subprocess

import numpy
import pytest

import gamut
from conftest import pendulum


@pytest.fixture(scope="module")
def sweep():
    return pendulum().sweep({"rod.length": "0.8:1.2:3", "pivot.angle": ["50 deg", "1.1 rad"]}, progress=False, jobs=2)


def test_arrays_are_labelled_by_what_is_varied(sweep):
    data = sweep.to_xarray()
    assert data.guaranteed.dims == ("rod.length", "pivot.angle", "requirement")
    assert data.last_mean.dims == ("rod.length", "pivot.angle", "output")
    assert list(data["rod.length"].values) == [0.8, 1.0, 1.2] and data["pivot.angle"].attrs["units"] == "deg"
    assert (data.state == "done").all() and data.unit.sel(output="angle") == "deg"
    assert (data.least <= data.sampled_least).all() and (data.sampled_greatest <= data.greatest).all()
    assert list(data.guaranteed.sel(requirement="swing").values[:, 0]) == [1, 1, 1]
    assert list(data.guaranteed.sel(requirement="swing").values[:, 1]) == [2, 2, 2]  # 63 deg is above 61 deg


def test_a_point_is_a_run_of_its_study(sweep):
    study = sweep.study(2, 0)
    assert "1.2" in study.to_toml()
    results = study.run(progress=False)
    angle = results["angle"]
    assert sweep["angle"]["last_lower"][2, 0] == angle.guaranteed.lower[-1]
    assert sweep["angle"]["least"][2, 0] == angle.guaranteed_over.lower.min()
    assert sweep["swing"]["probability_lower"][2, 0] == results.value("/requirements/probability_lower")[0]


def test_it_is_the_sweep_of_the_command(sweep, tmp_path):
    (tmp_path / "s.toml").write_text(pendulum().to_toml())
    subprocess.run([os.environ["GAMUT"], "sweep", "s.toml", "--over", "rod.length=0.8:1.2:3", "--over",
                    "pivot.angle=50 deg, 1.1 rad", "--quiet"], cwd=tmp_path, check=True)  # fmt: skip
    other = gamut.open(tmp_path / "s.sweep.h5")
    assert isinstance(other, gamut.Sweep)
    for path, field in sweep.fields.items():
        if path.startswith(("/answers/", "/motion/", "/over/")):
            assert numpy.array_equal(field.value, other.value(path), equal_nan=True), path


def test_it_is_kept_and_gone_on_with(tmp_path):
    path, study = tmp_path / "s.h5", pendulum()
    first = study.sweep({"rod.length": [1.0, 1.1]}, file=path, progress=False)
    again = study.sweep({"rod.length": [1.0, 1.1]}, file=path, progress=False)
    assert list(again.points["cpu"]) == list(first.points["cpu"])  # nothing was run again
    with pytest.raises(FileExistsError, match="holds another sweep; expected another name, or overwrite=True"):
        study.sweep({"rod.length": [1.0]}, file=path, progress=False)
    assert study.sweep({"rod.length": [1.0]}, file=path, overwrite=True, progress=False).shape == (1,)
    again.report(tmp_path / "s.html")
    assert "</html>" in (tmp_path / "s.html").read_text() and "iframe" in again._repr_html_()
    again.save(tmp_path / "t.h5")
    assert gamut.open(tmp_path / "t.h5").shape == (2,)


def test_points_may_be_a_list():
    sweep = pendulum().sweep(points={"rod.length": [1.2, 0.8], "bob.mass": ["1 kg", "300 g"]}, progress=False)
    assert not sweep.is_grid and sweep.shape == (2,) and list(sweep.axes["rod.length"]) == [1.2, 0.8]
    assert list(sweep.axes["bob.mass"]) == [1, 0.3] and sweep.units["bob.mass"] == "kg"
    assert sweep.to_xarray().guaranteed.dims == ("point", "requirement")
    assert list(sweep.points["state"]) == ["done", "done"]


def test_a_study_may_state_it():
    sweep = pendulum(sweep=[{"quantity": "rod.length", "values": [1.0, "90 cm"]}]).sweep(progress=False)
    assert list(sweep.axes["rod.length"]) == [90, 100] and sweep.units == {"rod.length": "cm"}


def test_what_makes_no_sense_is_refused():
    study = pendulum()
    with pytest.raises(ValueError, match="unknown number 'rod.lenght'; expected 'rod.length'"):
        study.sweep({"rod.lenght": [1.0]}, progress=False)
    with pytest.raises(ValueError, match="nothing is swept"):
        study.sweep(progress=False)
    with pytest.raises(TypeError, match="both given"):
        study.sweep({"rod.length": [1]}, points={"rod.length": [1]}, progress=False)
    with pytest.raises(ValueError, match="samples"):
        study.sweep({"rod.length": [1]}, samples=0, progress=False)


def test_a_point_that_cannot_be_run_is_told():
    study = pendulum()
    study.uncertain[0]["interval"] = [0.9, 1.1]
    sweep = study.sweep({"rod.length": [1.0, 2.0]}, progress=False)
    assert list(sweep.states) == ["done", "refused"] and numpy.isnan(sweep["angle"]["least"][1])
    assert sweep.points["why"][1]


def test_an_interrupt_keeps_the_points_that_ended():
    def interrupt(task, fraction):
        raise KeyboardInterrupt

    study = pendulum()
    with pytest.raises(KeyboardInterrupt):
        study.sweep({"rod.length": numpy.linspace(0.5, 1.5, 50)}, progress=interrupt)
