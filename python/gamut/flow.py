"""The validated flow of a plain differential equation x' = f(t, x, p)."""

from . import _gamut
from .errors import Interrupted
from .progress import told


def _component(number, value):
    try:
        return _gamut.Interval(value)
    except (TypeError, ValueError) as error:
        raise type(error)(f"component {number} of the box: {error}") from None


class Flow:
    """Encloses every solution of x' = f(t, x, p) for all initial values and parameters in a box.

    `function(t, x, p)` returns the rate of each state; `outputs(t, x, p)`, if given, what else is looked at. Both are
    recorded: called with numbers that write down what is done with them, so they cannot branch on values
    (gamut.where does). A Python float is the double that it is; `Interval("0.1")` is the decimal. Options: `tightness`
    (overestimation aimed at, 1.02), `order`, `degree`, `tolerance`, `split`, `max_pieces`, `budget` (s of counted
    work), `jobs` (threads), `varying` ({parameter: bound of its rate}: it varies in time within its interval).
    """

    def __init__(self, function, states, parameters=0, outputs=None, **options):
        self._equation = _gamut.Equation(function, states, parameters, outputs, **options)

    @property
    def program(self):
        """The recorded right-hand side."""
        return self._equation.program

    def enclose(self, box, horizon, times=(), *, derivatives_by=(), progress=False):
        """A Tube: bounds at `times` (s, rising) and the horizon. `box`: initial values, then parameters; numbers,
        Intervals or pairs of bounds. `derivatives_by`: numbers of components of the box, by which derivatives of the
        states are enclosed too (Tube.derivatives). An enclosure that ends early is no exception: Tube.why says so."""
        show, wipe = told(progress)
        box = [_component(i, each) for i, each in enumerate(box)]
        try:
            tube, was_interrupted = self._equation.enclose(box, horizon, list(times), list(derivatives_by), show)
        finally:
            wipe()
        if was_interrupted:
            raise Interrupted(tube)
        return tube
