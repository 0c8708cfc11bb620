// Studies over many nominal values, and what was found of them.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <utility>
#include <variant>

#include "commands/kept_sweep.hpp"
#include "python/doors.hpp"
#include "reports/sweep_page.hpp"
#include "studies/sweeps/sweep.hpp"
#include "studies/sweeps/sweep_file.hpp"

namespace gamut::python {
namespace {

namespace py = pybind11;
using namespace py::literals;
using HeldSweep = std::shared_ptr<SweepResults>;

/// A range or a list in one text, or numbers with or without units.
using StatedAxis = std::pair<std::string, std::variant<std::string, std::vector<std::string>>>;

SweepPlan planOf(const std::string& text, const std::string& name, bool isGrid, const std::vector<StatedAxis>& axes) {
  if (axes.empty()) return sweepStatedIn(text, name);
  SweepPlan plan{isGrid, {}};
  for (const auto& [number, values] : axes) {
    if (const auto* stated = std::get_if<std::string>(&values))
      plan.axes.push_back(parseSweepAxis(number + "=" + *stated));
    else if (const auto& all = std::get<std::vector<std::string>>(values); isGrid)
      plan.axes.push_back(sweepAxis(number, all, false));
    else
      plan.axes.push_back(sweepColumn(number, all));
  }
  return plan;
}

/// The sweep, and whether an interrupt ended it.
py::tuple swept(const std::string& text, const std::string& name, bool isGrid, const std::vector<StatedAxis>& axes,
                const std::optional<std::string>& file, bool overwrite, std::optional<std::uint64_t> seed,
                std::optional<std::size_t> samples, std::optional<int> jobs, std::optional<double> timeLimit,
                std::optional<double> memoryLimit, const py::object& progress) {
  SweepOptions options;
  options.jobs = threads(jobs);
  options.seed = seed;
  options.samples = samples;
  options.timeLimit = timeLimit;
  options.memoryLimit = memoryLimit;
  auto found = std::make_shared<SweepResults>(plannedSweep(text, name, planOf(text, name, isGrid, axes), options));
  std::optional<KeptSweep> kept;
  if (file) {
    kept.emplace(*file, overwrite, *found);
    options.keep = [&](const SweepResults& there) { kept->keep(there); };
  }
  const bool wasInterrupted = interruptible(progress, [&](const Work& work) {
    options.progress = [&work](double fraction) { work.progress("sweep", fraction); };
    options.cancelled = work.cancelled;
    runSweep(*found, options);
  });
  if (kept && !kept->problem().empty()) throw WriteError(kept->problem());
  return py::make_tuple(found, wasInterrupted);
}

void saveSweep(const SweepResults& found, const std::string& path, bool overwrite) {
  OutputFile file(path, overwrite ? OutputFile::Existing::isReplaced : OutputFile::Existing::isKept);
  writeSweep(found, file);
}

void saveSweepReport(const SweepResults& found, const std::string& path, bool overwrite) {
  OutputFile(path, overwrite ? OutputFile::Existing::isReplaced : OutputFile::Existing::isKept)
      .write(renderSweep(found));
}

}  // namespace

void bindSweeps(py::module_& module) {
  py::class_<SweepResults, HeldSweep>(module, "Sweep")
      .def("fields", [](const HeldSweep& found) { return fieldsOf(describe(*found)); })
      .def("is_grid", [](const SweepResults& found) { return found.plan.isGrid; })
      .def("axes",
           [](const SweepResults& found) {
             py::list all;
             for (const SweepAxis& axis : found.plan.axes)
               all.append(py::make_tuple(axis.name, axis.toldUnit(), axis.values));
             return all;
           })
      .def("study_at",
           [](const SweepResults& found, std::size_t point) {
             if (point >= found.points.size()) throw py::index_error("the sweep has no such point");
             return py::make_tuple(studyTextAt(found, point), found.studyFile);
           })
      .def("page", [](const SweepResults& found) { return renderSweep(found); })
      .def("save", saveSweep, "path"_a, "overwrite"_a)
      .def("save_report", saveSweepReport, "path"_a, "overwrite"_a);
  module.def("sweep", swept, "text"_a, "name"_a, "grid"_a, "axes"_a, "file"_a, "overwrite"_a, "seed"_a, "samples"_a,
             "jobs"_a, "time_limit"_a, "memory_limit"_a, "progress"_a);
  module.def("open_sweep", [](const std::string& path) {
    const py::gil_scoped_release released;
    return std::make_shared<SweepResults>(readSweep(path));
  });
  module.def("is_sweep", isSweepFile, "path"_a);
}

}  // namespace gamut::python
