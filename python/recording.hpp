// What Python hands over: functions as programs, numbers as intervals.
#pragma once

#include <pybind11/pybind11.h>

#include "scalars/interval.hpp"
#include "scalars/program/program.hpp"

namespace gamut::python {

/// f(t, x, p) of so many states and parameters, which returns a list of numbers, called twice.
Program recordedFrom(const pybind11::function& function, int states, int parameters);

/// A float, an int, a fraction, a decimal, a number of NumPy's.
bool isNumber(const pybind11::handle& value);
/// The tightest interval that holds a number, a text that is one, or what lies between two of these. Throws TypeError.
Interval enclosing(const pybind11::handle& value);

}  // namespace gamut::python
