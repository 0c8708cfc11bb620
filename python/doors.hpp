// The module `_gamut`: what the Python package stands on, a function for each part of it.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "studies/results/fields.hpp"

namespace gamut::python {

/// Exceptions of the library become those of gamut/errors.py.
void bindErrors();
void bindStudies(pybind11::module_& module);
void bindResults(pybind11::module_& module);
void bindSweeps(pybind11::module_& module);
void bindNumbers(pybind11::module_& module);
void bindFlow(pybind11::module_& module);

/// (path, unit, meaning, dimensions, value) of each field; of a list of records their values in a list.
pybind11::list fieldsOf(const std::vector<Group>& groups);

/// So many threads, as many as the machine has unless stated. Throws std::invalid_argument for none.
int threads(const std::optional<int>& jobs);

/// What long work looks at, and tells.
struct Work {
  std::function<void(const std::string& task, double fraction)> progress;
  const std::atomic<bool>* cancelled = nullptr;
};

/// Does long work in a thread of its own, without the interpreter's lock; on this one `progress`, a callable or None,
/// is told the task and the fraction done of it, ten times a second, and interrupts are looked for. True if there was
/// one, which the work was told of; it has ended in any case. What the work throws, and what `progress` throws, which
/// ends the work too, goes on from here.
bool interruptible(const pybind11::object& progress, const std::function<void(const Work&)>& work);

}  // namespace gamut::python
