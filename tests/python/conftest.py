"""A study that takes a second, built and run once."""

import pathlib
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent))

import gamut  # noqa: E402


def pendulum(**others):
    """A mathematical pendulum whose length is known to 5 %."""
    return gamut.Study(
        title="Pendulum",
        analysis="dynamics",
        horizon=2.0,
        output_step=0.1,
        mechanism={"gravity": [0, 0, -9.81], "element": [
            {"type": "revolute", "name": "pivot", "from": "inertial", "to": "rod", "axis": "x",
             "initial": {"angle": "60 deg"}},
            {"type": "link", "name": "rod", "from": "rod", "to": "tip", "vector": [0, 0, "-rod.length"],
             "parameters": {"length": 1.0}},
            {"type": "mass", "name": "bob", "at": "tip", "mass": 2.0},
        ]},
        uncertain=[{"name": "length", "quantity": "rod.length", "interval": "± 5 %"}],
        output=[{"name": "angle", "quantity": "pivot.angle", "unit": "deg"},
                {"name": "height", "quantity": "tip.position.z"}],
        requirement=[{"name": "swing", "always": "pivot.angle < 61 deg"}],
        stochastic={"samples": 64},
        **others,
    )  # fmt: skip


@pytest.fixture(scope="session")
def results():
    return pendulum().run(progress=False)
