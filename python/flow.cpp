// The validated flow of a plain differential equation.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <memory>

#include "analyses/flow/derivatives.hpp"
#include "analyses/flow/flow.hpp"
#include "python/doors.hpp"
#include "python/recording.hpp"

namespace gamut::python {
namespace {

namespace py = pybind11;
using namespace py::literals;

/// [time][number][lower, upper]
template <class Row>
py::array_t<double> boundsOf(const Tube& tube, std::size_t numbers, Row row) {
  py::array_t<double> all({tube.reachedTimes(), numbers, std::size_t{2}});
  auto view = all.mutable_unchecked<3>();
  for (std::size_t i = 0; i < tube.reachedTimes(); ++i) {
    const std::vector<Interval>& values = row(i);
    for (std::size_t k = 0; k < numbers; ++k) {
      view(i, k, 0) = values[k].lower();
      view(i, k, 1) = values[k].upper();
    }
  }
  return all;
}

FlowOptions optionsOf(const py::kwargs& stated) {
  FlowOptions options;
  for (const auto& [key, value] : stated) {
    const auto name = key.cast<std::string>();
    if (name == "tightness")
      options.tightness = value.cast<double>();
    else if (name == "order")
      options.order = value.cast<int>();
    else if (name == "degree")
      options.degree = value.cast<int>();
    else if (name == "tolerance")
      options.tolerance = value.cast<double>();
    else if (name == "split")
      options.split = value.cast<bool>();
    else if (name == "max_pieces")
      options.maxPieces = value.cast<int>();
    else if (name == "budget")
      options.budget = value.cast<double>();
    else if (name == "jobs")
      options.jobs = value.cast<int>();
    else if (name == "varying") {
      for (const auto& each : value.cast<std::map<int, double>>()) options.varying.push_back({each.first, each.second});
    } else
      throw py::type_error(
          "a flow has no option '" + name +
          "'; expected tightness, order, degree, tolerance, split, max_pieces, budget, jobs or varying");
  }
  if (!stated.contains("jobs")) options.jobs = threads({});
  return options;
}

/// What a flow is made of, so that each enclosure has a watch of its own.
struct Equation {
  Program f, g;
  bool hasOutputs;
  FlowOptions options;

  FlowOptions watched(const Work& work) const {
    FlowOptions own = options;
    own.progress = [&work](double fraction) { work.progress("enclosing", fraction); };
    own.cancelled = work.cancelled;
    return own;
  }
  Flow flow(const Work& work) const { return hasOutputs ? Flow(f, g, watched(work)) : Flow(f, watched(work)); }
  DerivativeFlow derivatives(const std::vector<int>& by, const Work& work) const {
    return hasOutputs ? DerivativeFlow(f, g, by, watched(work)) : DerivativeFlow(f, by, watched(work));
  }
};

Equation equation(const py::function& function, int states, int parameters, const py::object& outputs,
                  const py::kwargs& options) {
  Equation made{recordedFrom(function, states, parameters), Program(), !outputs.is_none(), optionsOf(options)};
  if (made.f.outputs() != states)
    throw std::invalid_argument("the function returns " + std::to_string(made.f.outputs()) + " rates of " +
                                std::to_string(states) + " states");
  if (made.hasOutputs) made.g = recordedFrom(outputs, states, parameters);
  const Work unwatched{[](const std::string&, double) {}, nullptr};
  made.flow(unwatched);  // says what makes no sense
  return made;
}

struct Enclosed {
  Tube tube;
  std::size_t states, outputs;
  std::vector<std::size_t> derivatives = {};  ///< where those of states lie behind the states: [state][component]
};

std::pair<Enclosed, bool> enclose(const Equation& equation, const Box& box, double horizon,
                                  const std::vector<double>& times, const std::vector<int>& by,
                                  const py::object& progress) {
  Enclosed result{{}, static_cast<std::size_t>(equation.f.states()), static_cast<std::size_t>(equation.g.outputs())};
  const bool wasInterrupted = interruptible(progress, [&](const Work& work) {
    if (by.empty()) {
      result.tube = equation.flow(work).enclose(box, horizon, times);
      return;
    }
    const DerivativeFlow flow = equation.derivatives(by, work);
    result.tube = flow.enclose(box, horizon, times);
    for (int i = 0; i < equation.f.states(); ++i)
      for (int k = 0; k < static_cast<int>(by.size()); ++k) result.derivatives.push_back(flow.derivative(i, k));
  });
  return {std::move(result), wasInterrupted};
}

/// [time][state][component][lower, upper]
py::object derivativesOf(const Enclosed& e) {
  if (e.derivatives.empty()) return py::none();
  std::vector<Interval> row(e.derivatives.size());
  const py::array_t<double> all = boundsOf(
      e.tube, row.size(), [&](std::size_t i) -> auto& {
        std::ranges::transform(e.derivatives, row.begin(), [&](std::size_t at) { return e.tube.states(i)[at]; });
        return row;
      });
  return all.attr("reshape")(e.tube.reachedTimes(), e.states, row.size() / e.states, 2);
}

}  // namespace

void bindFlow(py::module_& module) {
  py::class_<Equation>(module, "Equation")
      .def(py::init(&equation), "function"_a, "states"_a, "parameters"_a, "outputs"_a)
      .def_property_readonly("program", [](const Equation& e) { return e.f; })
      .def("enclose", enclose, "box"_a, "horizon"_a, "times"_a, "by"_a, "progress"_a);
  py::class_<Enclosed>(module, "Tube", "Enclosures of all solutions that start in a box.")
      .def_property_readonly(
          "times", [](const Enclosed& e) { return py::array(py::cast(e.tube.times())); },
          "Output times, rising, the start 0 first (s).")
      .def_property_readonly(
          "reached", [](const Enclosed& e) { return e.tube.reached(); }, "Proved up to here (s).")
      .def_property_readonly(
          "why", [](const Enclosed& e) { return e.tube.why(); },
          "Why it ended before the horizon; empty if it did not.")
      .def_property_readonly(
          "tightness", [](const Enclosed& e) { return e.tube.tightness(); },
          "Overestimation at the output times, measured: 1 is none.")
      .def_property_readonly(
          "pieces", [](const Enclosed& e) { return e.tube.pieces(); }, "Parts of the box that were followed.")
      .def_property_readonly(
          "steps", [](const Enclosed& e) { return e.tube.steps(); }, "Of all pieces.")
      .def_property_readonly(
          "cpu", [](const Enclosed& e) { return e.tube.cpuSeconds(); }, "CPU time, s.")
      .def_property_readonly(
          "states",
          [](const Enclosed& e) {
            return boundsOf(
                e.tube, e.states, [&](std::size_t i) -> auto& { return e.tube.states(i); });
          },
          "Bounds at the times that were reached: time x state x (lower, upper).")
      .def_property_readonly(
          "states_over",
          [](const Enclosed& e) {
            return boundsOf(
                e.tube, e.states, [&](std::size_t i) -> auto& { return e.tube.statesOver(i); });
          },
          "Likewise, over the whole interval since the time before.")
      .def_property_readonly(
          "outputs",
          [](const Enclosed& e) {
            return boundsOf(
                e.tube, e.outputs, [&](std::size_t i) -> auto& { return e.tube.outputs(i); });
          },
          "Bounds of the outputs: time x output x (lower, upper).")
      .def_property_readonly(
          "outputs_over",
          [](const Enclosed& e) {
            return boundsOf(
                e.tube, e.outputs, [&](std::size_t i) -> auto& { return e.tube.outputsOver(i); });
          },
          "Likewise, over the whole interval since the time before.")
      .def_property_readonly(
          "derivatives", derivativesOf,
          "Bounds of the states' derivatives by the components of the box that were asked for: time x "
          "state x component x (lower, upper); None without.")
      .def(
          "at", [](const Enclosed& e, double time) { return e.tube.at(time); }, "time"_a,
          "An interval for each state at an output time, or over the interval between two that holds the time (s).");
}

}  // namespace gamut::python
