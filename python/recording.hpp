// Python functions as programs.
#pragma once

#include <pybind11/pybind11.h>

#include "scalars/program/program.hpp"

namespace gamut::python {

/// f(t, x, p) of so many states and parameters, which returns a list of numbers, called twice.
Program recordedFrom(const pybind11::function& function, int states, int parameters);

}  // namespace gamut::python
