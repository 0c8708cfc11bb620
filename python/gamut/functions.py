"""Functions of floats, NumPy's arrays, intervals and recorded numbers alike."""

import numpy

from . import _gamut

_ONE = ("sin cos tan arcsin arccos arctan sinh cosh tanh arcsinh arccosh arctanh exp exp2 expm1 log log2 log10 log1p "
        "sqrt cbrt square sign").split()
_TWO = "arctan2 hypot minimum maximum".split()
_OURS = (_gamut.Interval, _gamut.Recorded)


def _of_one(name):
    of_numpy = getattr(numpy, name)

    def function(x):
        if isinstance(x, _OURS):
            return getattr(x, name)()
        if isinstance(x, numpy.ndarray) and x.dtype == object:
            return numpy.frompyfunc(function, 1, 1)(x)
        return of_numpy(x)

    function.__doc__ = f"{name} of a float, an array, an Interval or a recorded number."
    return function


def _of_two(name):
    of_numpy = getattr(numpy, name)

    def function(x, y):
        if any(isinstance(each, numpy.ndarray) and each.dtype == object for each in (x, y)):
            return numpy.frompyfunc(function, 2, 1)(x, y)
        for kind in (_gamut.Recorded, _gamut.Interval):
            if isinstance(x, kind) or isinstance(y, kind):
                return getattr(x if isinstance(x, kind) else kind(x), name)(y)
        return of_numpy(*(each if isinstance(each, numpy.ndarray) else float(each) for each in (x, y)))

    function.__doc__ = f"{name} of floats, arrays, Intervals or recorded numbers."
    return function


for _name in _ONE + _TWO:
    globals()[_name] = (_of_one if _name in _ONE else _of_two)(_name)
    globals()[_name].__name__ = _name


def where(condition, above, below):
    """`above` where the number `condition` is above 0, `below` where it is below; where it is 0, their mean, and in a rate
    all that lies between. Of floats, arrays and recorded numbers."""
    if any(isinstance(each, _gamut.Recorded) for each in (condition, above, below)):
        return _gamut.where(condition, above, below)
    if any(isinstance(each, numpy.ndarray) and each.dtype == object for each in (condition, above, below)):
        return numpy.frompyfunc(where, 3, 1)(condition, above, below)
    if any(isinstance(each, numpy.ndarray) for each in (condition, above, below)):
        middle = numpy.where(condition == 0, 0.5 * numpy.asarray(above) + 0.5 * numpy.asarray(below), numpy.nan)
        return numpy.where(condition > 0, above, numpy.where(condition < 0, below, middle))
    if isinstance(condition, _gamut.Interval):
        if condition.lower > 0 or condition.upper < 0:
            return above if condition.lower > 0 else below
        ends = [_gamut.Interval(each) for each in (above, below)]
        return _gamut.Interval(min(each.lower for each in ends), max(each.upper for each in ends))
    if condition > 0 or condition < 0:
        return above if condition > 0 else below
    return above / 2 + below / 2 if condition == 0 else numpy.nan


__all__ = [*_ONE, *_TWO, "where"]
