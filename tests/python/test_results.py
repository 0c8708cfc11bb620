"""Results as labelled data: all that the file holds, and nothing else."""

import json

import numpy
import pytest

import gamut
from conftest import pendulum


def test_outputs_have_the_three_answers(results):
    angle = results["angle"]
    assert (angle.unit, len(angle.time), list(results)) == ("deg", 21, ["angle", "height"])
    assert numpy.all(angle.guaranteed.lower <= angle.sampled.lower)
    assert numpy.all(angle.sampled.upper <= angle.guaranteed.upper)
    assert numpy.all(angle.guaranteed_over.width[1:] >= angle.guaranteed.width[1:])
    assert numpy.all(angle.sampled.lower <= angle.mean) and numpy.all(angle.mean <= angle.sampled.upper)
    assert list(angle.possible) == sorted(angle.possible) and min(angle.possible) == 0
    assert numpy.all(angle.possible[1.0].width <= angle.possible[0.0].width)
    assert all(numpy.all(numpy.diff(row) >= 0) for row in numpy.array(list(angle.quantiles.values())).T)
    with pytest.raises(KeyError, match="no output is called 'angel'; expected one of 'angle', 'height'"):
        results["angel"]


def test_the_pendulum_swings(results):
    height = results["height"]
    assert height.guaranteed_over.lower.min() <= -1.05 and height.guaranteed.width.max() > 0.1
    assert results["angle"].guaranteed.lower.min() < -59 and 1 <= results.verdict.overestimation < 1.02


def test_the_verdict_and_requirements_are_told(results):
    assert results.verdict.word == "inside" and str(results.verdict) == results.verdict.sentence
    assert results.ended == "" and "inside" in repr(results)
    assert list(results.requirements["word"]) == ["met"]
    assert list(results.uncertain["lower"]) == [0.95]
    assert results.summary()["verdict"] == "inside"


def test_probabilities_and_sensitivities_are_rows(results):
    probabilities = results.probabilities
    assert (probabilities["lower"] <= probabilities["upper"]).all() and set(probabilities["output"]) >= {"angle", "height"}
    assert len(probabilities) == (~numpy.isnan(results.value("/distribution/value"))).sum()
    sensitivity = results.sensitivity
    assert set(sensitivity["quantity"]) == {"length"} and (sensitivity["first_lower"] <= sensitivity["first_upper"]).all()
    assert len(results.derivatives) == 0


def test_a_dataset_holds_every_array(results):
    data = results.to_xarray()
    at = data.interval_at.sel(output="angle")
    assert at.dims == ("time", "bound") and data.unit.sel(output="angle") == "deg"
    assert numpy.array_equal(at.sel(bound="lower"), results["angle"].guaranteed.lower)
    assert data.interval_at.attrs["units"] == "of the output" and data.time.attrs["units"] == "s"
    assert data.stochastic_quantiles.dims == ("probability", "time", "output")
    assert data.fuzzy_outer.dims == ("alpha", "time", "output", "bound")
    arrays = [f for f in results.fields.values() if f.dimensions and f.array() is not None and f.array().size]
    assert len(data.data_vars) + len(data.coords) == len(arrays) + 2  # bound, and unit besides


def test_what_is_proved_is_not_written_over(results):
    with pytest.raises(ValueError, match="read-only"):
        results["angle"].guaranteed.lower[0] = 0.0


def test_what_was_not_compared_is_said_so():
    study = pendulum()
    study.compare = ["interval"]
    assert study.run(progress=False).verdict.word == "uncompared"


def test_what_is_saved_is_what_is_read(results, tmp_path):
    results.save(tmp_path / "r.h5")
    again = gamut.open(tmp_path / "r.h5")
    assert gamut._gamut.differences(results._held, again._held) == []
    with pytest.raises(FileExistsError, match="overwrite=True"):
        results.save(tmp_path / "r.h5")
    with pytest.raises(OSError, match="none"):
        results.save(tmp_path / "none" / "r.h5")
    assert gamut.compare(results, tmp_path / "r.h5")["verdict"] == "agree"
    results.save(tmp_path / "r.h5", overwrite=True)
    results.report(tmp_path / "r.html")
    assert (tmp_path / "r.html").read_text().startswith("<!DOCTYPE html>")
    (tmp_path / "other.h5").write_bytes(b"no results")
    with pytest.raises(gamut.ResultsFileError, match="other.h5"):
        gamut.open(tmp_path / "other.h5")


def test_more_samples_and_one_again(results):
    more = results.extend(200, progress=False)
    assert more.value("/stochastic/samples") >= 200
    assert numpy.array_equal(more["angle"].guaranteed.lower, results["angle"].guaranteed.lower)
    kept = results.value("/stochastic/kept/motions")
    again = results.replay(int(results.value("/stochastic/kept/motion_number")[0]))
    assert numpy.array_equal(again.motion, kept[0]) and again.why == ""
    with pytest.raises(ValueError):
        results.replay(10**9)


def test_samples_of_polynomials_lie_within_what_is_guaranteed(results):
    samples = results.sample(1000, times=[2.0], outputs=["angle"], seed=3)
    assert samples.numbers.shape == samples.errors.shape == (1000, 1, 1) and samples.values.shape == (1000, 1)
    lower, upper = (bound[-1] for bound in results["angle"].guaranteed)
    assert numpy.all(samples.numbers + samples.errors >= lower) and numpy.all(samples.numbers - samples.errors <= upper)
    assert numpy.all(samples.errors < 1e-2 * (upper - lower))
    with pytest.raises(ValueError, match="no polynomials of an output 'angel'; expected 'angle', 'height'"):
        results.sample(1, outputs=["angel"])


def test_results_show_themselves(results):
    import matplotlib

    matplotlib.use("Agg")
    axes = results.plot("angle")
    assert axes.get_ylabel() == "angle [deg]"
    assert {text.get_text() for text in axes.get_legend().get_texts()} == {"guaranteed", "possible", "sampled", "mean"}
    shown = results._repr_html_()
    assert shown.startswith('<iframe srcdoc="&lt;!DOCTYPE html&gt;') and shown.count('"') == 4
    assert json.dumps(results.summary())
