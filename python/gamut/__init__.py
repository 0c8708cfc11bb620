"""Gamut: guaranteed, probable and possible motion of uncertain mechanisms.

    study = gamut.Study("arm.toml")
    results = study.run()
    results.verdict, results["tip height"].guaranteed, results.to_xarray()

    flow = gamut.Flow(lambda t, x, p: [x[1], -gamut.sin(x[0])], states=2)
    flow.enclose([gamut.Interval(0.9, 1.1), 0.0], horizon=10.0).at(10.0)
"""

from ._gamut import Interval, Program, Recorded, Tube, __version__
from .errors import Interrupted, NotComparable, ResultsFileError, StudyError
from .flow import Flow
from .functions import *  # noqa: F403
from .functions import __all__ as _functions
from .results import Bounds, Output, Results, Tolerances, Verdict, compare, open  # noqa: A004
from .study import Quantities, Quantity, Study
from .sweep import Sweep

__all__ = [
    "Bounds", "Flow", "Interrupted", "Interval", "NotComparable", "Output", "Program", "Quantities", "Quantity",
    "Recorded", "Results", "ResultsFileError", "Study", "StudyError", "Sweep", "Tolerances", "Tube", "Verdict", "compare", "open",
    *_functions,
]  # fmt: skip
