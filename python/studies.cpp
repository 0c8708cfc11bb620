// Studies as text, machines made of them, and what is done with these.
#include <pybind11/stl.h>

#include <memory>
#include <optional>

#include "commands/files.hpp"
#include "python/doors.hpp"
#include "studies/known_quantities.hpp"
#include "studies/running/dead_point.hpp"
#include "studies/running/run.hpp"
#include "studies/running/tolerance.hpp"
#include "studies/schema.hpp"
#include "studies/version.hpp"

namespace gamut::python {
namespace {

namespace py = pybind11;
using namespace py::literals;

/// Ends a proof on the way; no std::exception, which the proof might take for its own.
struct Ended {};

/// The machine, and whether an interrupt came while its loops were proved to close: none then.
py::tuple read(const std::string& text, const std::string& name, const py::object& progress) {
  std::shared_ptr<Machine> machine;
  const bool wasInterrupted = interruptible(progress, [&](const Work& work) {
    try {
      machine = std::make_shared<Machine>(readStudyText(text, name), [&](const std::string& task, double fraction) {
        work.progress(task, fraction);
        if (*work.cancelled) throw Ended();
      });
    } catch (const Ended&) {
    }
  });
  return py::make_tuple(machine, wasInterrupted);
}

py::list listed(const std::vector<KnownQuantity>& quantities) {
  py::list all;
  for (const KnownQuantity& q : quantities) all.append(py::make_tuple(q.name, q.unit, q.nominal));
  return all;
}

py::tuple quantities(const std::string& text, const std::string& name) {
  const Mechanism mechanism = readMechanismText(text, name);
  return py::make_tuple(listed(numbersOf(mechanism)), listed(measurableOf(mechanism)));
}

/// The results, and whether an interrupt ended the run.
py::tuple run(const std::shared_ptr<Machine>& machine, std::optional<std::uint64_t> seed,
              std::optional<std::size_t> samples, std::optional<int> jobs, std::optional<double> timeLimit,
              std::optional<double> memoryLimit, const py::object& progress) {
  RunOptions options;
  options.jobs = threads(jobs);
  options.seed = seed;
  options.samples = samples;
  options.timeLimit = timeLimit;
  options.memoryLimit = memoryLimit;
  auto results = std::make_shared<Results>();
  const bool wasInterrupted = interruptible(progress, [&](const Work& work) {
    options.progress = work.progress;
    options.cancelled = work.cancelled;
    *results = gamut::run(*machine, options);
  });
  return py::make_tuple(results, wasInterrupted);
}

py::dict told(const AllowedDeviation& deviation) {
  return py::dict("name"_a = deviation.name, "factor"_a = deviation.factor,
                  "interval"_a = py::make_tuple(deviation.interval.lower(), deviation.interval.upper()),
                  "limited_by"_a = deviation.limit);
}

py::tuple tolerance(const std::shared_ptr<Machine>& machine, std::optional<int> jobs, std::optional<double> timeLimit,
                    const py::object& progress) {
  ToleranceOptions options;
  options.jobs = threads(jobs);
  options.budget = timeLimit.value_or(machine->study.limits.resolved().time);
  AllowedDeviations found;
  const bool wasInterrupted = interruptible(progress, [&](const Work& work) {
    options.progress = [&work](double fraction) { work.progress("tolerances", fraction); };
    options.cancelled = work.cancelled;
    found = findTolerances(*machine, options);
  });
  py::list alone;
  for (std::size_t q = 0; q < found.alone.size(); ++q) {
    alone.append(told(found.alone[q]));
    alone[q]["unit"] = machine->study.uncertain[q].unit;
  }
  return py::make_tuple(found.nominal, told(found.together), alone, wasInterrupted);
}

}  // namespace

void bindStudies(py::module_& module) {
  module.attr("__version__") = version();
  module.def("schema", [] { return studySchema(); });
  module.def("text_of", textOfStudy, "path"_a);
  module.def("read", read, "text"_a, "name"_a, "progress"_a);
  module.def("quantities", quantities, "text"_a, "name"_a);
  py::class_<Machine, std::shared_ptr<Machine>>(module, "Machine")
      .def("notes",
           [](const Machine& m) {
             const py::gil_scoped_release released;
             std::vector<std::string> notes = m.study.notes;
             if (std::string note = noteOfDeadPoint(m.study); !note.empty()) notes.push_back(std::move(note));
             return notes;
           })
      .def("run", run, "seed"_a, "samples"_a, "jobs"_a, "time_limit"_a, "memory_limit"_a, "progress"_a)
      .def("tolerance", tolerance, "jobs"_a, "time_limit"_a, "progress"_a);
}

}  // namespace gamut::python
