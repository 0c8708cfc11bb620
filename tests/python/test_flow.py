"""Plain differential equations: recorded from Python, enclosed by the same flow."""

import copy
import math
import pickle
from decimal import Decimal, getcontext
from fractions import Fraction

import numpy
import pytest

import gamut

getcontext().prec = 50


def encloses(bounds, truth):
    """Exactly: doubles are decimals."""
    return Decimal(float(bounds[0])) <= truth <= Decimal(float(bounds[1]))


def test_a_pendulum_is_enclosed():
    flow = gamut.Flow(lambda t, x, p: [x[1], -p[0] * gamut.sin(x[0])], states=2, parameters=1,
                      outputs=lambda t, x, p: [0.5 * x[1] ** 2 - p[0] * gamut.cos(x[0])])
    tube = flow.enclose([1.0, 0.0, 9.81], 2.0, [1.0])
    assert (list(tube.times), tube.reached, tube.why) == ([0.0, 1.0, 2.0], 2.0, "")
    assert tube.states.shape == (3, 2, 2) and tube.outputs.shape == (3, 1, 2)
    energy = -9.81 * math.cos(1.0)
    assert abs(tube.outputs - energy).max() < 1e-9  # it is kept
    assert tube.at(1.0)[0].lower == tube.states[1, 0, 0]


def test_every_solution_of_a_box_is_inside():
    tube = gamut.Flow(lambda t, x, p: [-p[0] * x[0]], 1, 1).enclose([(1.0, 2.0), (0.5, 1.0)], 1.0)
    for start in (Decimal(1), Decimal("1.5"), Decimal(2)):
        for rate in (Decimal("0.5"), Decimal("0.75"), Decimal(1)):
            assert encloses(tube.states[-1, 0], start * (-rate).exp())
    lower, upper = tube.states[-1, 0]
    assert upper - lower < 1.02 * (2 * math.exp(-0.5) - math.exp(-1))


def test_derivatives_are_enclosed_with_the_motion():
    tube = gamut.Flow(lambda t, x, p: [-p[0] * x[0]], 1, 1).enclose([2.0, (0.5, 1.0)], 1.0, derivatives_by=[0, 1])
    assert tube.derivatives.shape == (2, 1, 2, 2) and tube.states.shape == (2, 1, 2)
    for rate in (Decimal("0.5"), Decimal("0.75"), Decimal(1)):
        assert encloses(tube.derivatives[-1, 0, 0], (-rate).exp())
        assert encloses(tube.derivatives[-1, 0, 1], -2 * (-rate).exp())
    assert tube.derivatives[-1].max() < 0.7 and gamut.Flow(lambda t, x, p: [x[0]], 1).enclose([1], 1).derivatives is None


def test_functions_of_numpy_are_recorded():
    ours = gamut.Program(lambda t, x, p: [gamut.sin(x[0]) * gamut.sqrt(x[1]), gamut.hypot(x[0], x[1])], 2)
    theirs = gamut.Program(lambda t, x, p: [numpy.sin(x[0]) * numpy.sqrt(x[1]), numpy.hypot(x[0], x[1])], 2)
    assert str(ours) == str(theirs)
    assert ours([0.3, 2.0]) == pytest.approx([math.sin(0.3) * math.sqrt(2), math.hypot(0.3, 2)], rel=1e-15)
    vector = gamut.Program(lambda t, x, p: list(numpy.array([[0, 1], [-1, 0]]) @ numpy.array(x, dtype=object)), 2)
    assert vector([2.0, 3.0]) == [3.0, -2.0]


def test_programs_have_derivatives():
    program = gamut.Program(lambda t, x, p: [x[0] ** 3 * p[0]], 1, 1).differentiated(with_parameters=True)
    assert program([2.0], [5.0]) == [40.0, 60.0, 8.0]
    x = program([gamut.Interval(2, 2.5)], [gamut.Interval(5)])[1]
    assert x.lower <= 60 and x.upper >= 15 * 2.5**2


@pytest.mark.parametrize("function", [
    lambda t, x, p: [-x[0] if x[0] > 0 else x[0]],
    lambda t, x, p: [max(x[0], 0.0)],
    lambda t, x, p: [x[0] * bool(x[0])],
    lambda t, x, p: [1.0 if x[0] == 0 else x[0]],
])
def test_a_branch_is_refused(function):
    with pytest.raises(TypeError, match=r"has no value yet.*gamut\.where"):
        gamut.Flow(function, 1)


def test_what_numpy_keeps_to_itself_is_refused_all_the_same():
    with pytest.raises(TypeError, match="has no value yet"):
        gamut.Flow(lambda t, x, p: [1.0 if (numpy.array(x) == 0) is True else 2.0, 0.0], 2)
    with pytest.raises(TypeError, match="has no value yet"):
        gamut.Program(lambda t, x, p: [float(numpy.array_equal(x, [0, 0]))], 2)


def test_numbers_are_enclosed_as_they_are_given():
    third, tenth, great = Fraction(1, 3), Decimal("0.1"), 2**53 + 1
    for number in (third, tenth, great, "0.1", numpy.float32(0.1), numpy.int64(7)):
        x = gamut.Interval(number)
        exact = Fraction(number.item() if isinstance(number, numpy.generic) else number)
        assert Fraction(x.lower) <= exact <= Fraction(x.upper)
    assert third not in gamut.Interval(1 / 3) and great not in gamut.Interval(float(2**53))
    assert third in gamut.Interval(third) and gamut.Interval(third).width < 1e-16
    product = gamut.Program(lambda t, x, p: [third * x[0], gamut.Interval("0.1") * x[0]], 1)([gamut.Interval(3)])
    assert 1 in product[0] and product[0].width > 0 and 3 * Decimal("0.1") in product[1]
    assert numpy.int64(2**53 + 1) not in gamut.Interval(2.0**53)
    chosen = gamut.Program(lambda t, x, p: [gamut.where(1.0, third, tenth) + 0 * x[0]], 1)([gamut.Interval(1)])
    assert third in chosen[0]
    tube = gamut.Flow(lambda t, x, p: [0 * x[0]], 1).enclose([("0.1", "0.1")], 1.0)
    assert Decimal("0.1") in tube.at(1.0)[0]
    with pytest.raises(TypeError, match="component 1 of the box: expected a number"):
        gamut.Flow(lambda t, x, p: [0, 0], 2).enclose([1, None], 1.0)


def test_powers_are_of_the_exponent_that_is_given():
    nearly_two = Fraction(2**60 + 1, 2**59)
    truth = Decimal(10) ** (Decimal(nearly_two.numerator) / nearly_two.denominator)
    recorded = gamut.Program(lambda t, x, p: [x[0] ** nearly_two, x[0] ** 2, x[0] ** 2000, x[0] ** -1025], 1)
    assert truth in gamut.Interval(10) ** nearly_two and truth in recorded([gamut.Interval(10)])[0]
    assert Decimal(10) ** Decimal("2.00000000000000000001") in gamut.Interval(10) ** Decimal("2.00000000000000000001")
    for base, exponent in ((-1, 1024), (Fraction(-101, 100), 1025), (Fraction(-9, 8), 2000), (-2, -1025)):
        assert Fraction(base) ** exponent in gamut.Interval(base) ** exponent
    exact = [Fraction(-9, 8) ** 2, Fraction(-9, 8) ** 2000, Fraction(-9, 8) ** -1025]
    found = recorded([gamut.Interval(-1.125)])[1:]
    assert all(number in interval for number, interval in zip(exact, found))


def test_functions_serve_floats_arrays_and_recorded_numbers():
    def rate(t, x, p):
        return [gamut.where(x[0] - 1, 2.0, -x[0]) + gamut.maximum(0.5, x[1]) + gamut.sign(x[1]), x[0]]

    program = gamut.Program(rate, 2)
    for x in ([2.0, 0.25], [0.5, -3.0], [1.0, 0.0]):
        assert program(x) == pytest.approx(rate(0.0, x, []))
    x = numpy.array([0.5, 2.0])
    assert list(gamut.where(x - 1, x, -x)) == [-0.5, 2.0] and gamut.where(0.0, 1.0, 2.0) == 1.5
    assert gamut.where(gamut.Interval(-1, 1), 2, 3) == gamut.Interval(2, 3) and gamut.where(1, third := Fraction(1, 3), 0) == third
    assert gamut.hypot(Fraction(3), 4.0) == 5.0
    each = gamut.Program(lambda t, x, p: gamut.maximum(numpy.array(x), 0.0), 2)
    assert each([-1.0, 2.0]) == [0.0, 2.0]


def test_math_is_refused_with_what_to_use():
    with pytest.raises(TypeError, match=r"gamut\.sin"):
        gamut.Flow(lambda t, x, p: [math.sin(x[0])], 1)


def test_where_and_maximum_take_the_place_of_branches():
    program = gamut.Program(lambda t, x, p: [gamut.where(x[0], x[0], -2 * x[0]), gamut.maximum(x[0], 0.0)], 1)
    assert program([3.0]) == [3.0, 3.0] and program([-3.0]) == [6.0, 0.0]


def test_what_makes_no_sense_is_refused():
    with pytest.raises(ValueError, match="returns 1 rates of 2 states"):
        gamut.Flow(lambda t, x, p: [x[0]], 2)
    with pytest.raises(TypeError, match="is to return a list of numbers"):
        gamut.Flow(lambda t, x, p: x[0], 1)
    with pytest.raises(TypeError, match="no option 'tightnes'"):
        gamut.Flow(lambda t, x, p: [x[0]], 1, tightnes=1.1)
    with pytest.raises(ValueError):
        gamut.Flow(lambda t, x, p: [x[0]], 1).enclose([1.0, 2.0], 1.0)
    with pytest.raises(ZeroDivisionError):
        gamut.Flow(lambda t, x, p: [1 / 0], 1)


def test_an_early_end_is_no_exception():
    tube = gamut.Flow(lambda t, x, p: [x[0] ** 2], 1).enclose([gamut.Interval(1, 1.1)], 2.0, [0.5])
    assert 0.5 < tube.reached < 1 and tube.why
    with pytest.raises(IndexError):
        tube.at(1.5)


def test_a_number_of_a_recording_is_no_use_behind_it():
    kept = []
    gamut.Program(lambda t, x, p: [kept.append(x[0]) or x[0]], 1)
    with pytest.raises(RuntimeError):
        kept[0] + 1.0


def test_intervals_enclose():
    assert 0.1 in gamut.Interval("0.1") and gamut.Interval("0.1").width > 0
    x = gamut.Interval(1, 2)
    assert tuple(x - x) == (-1.0, 1.0) and repr(x) == "Interval(1, 2)" and gamut.Interval(1.5) in x
    assert 1 + x == gamut.Interval(2, 3) and tuple(x**2) == (1.0, 4.0) and tuple(abs(-x)) == (1.0, 2.0)
    root = gamut.sqrt(gamut.Interval(2))
    assert Fraction(root.lower) ** 2 <= 2 <= Fraction(root.upper) ** 2 and gamut.sin(0.5) == numpy.sin(0.5)
    with pytest.raises(ValueError):
        gamut.Interval("one")
    assert x != None and x != "a" and f"{x:.2f}" == "[1.00, 2.00]"  # noqa: E711
    assert pickle.loads(pickle.dumps(x)) == x == copy.deepcopy(x)
