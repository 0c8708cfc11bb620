// Results as they describe themselves, and what is done with them.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>

#include "commands/comparison_json.hpp"
#include "commands/files.hpp"
#include "python/doors.hpp"
#include "reports/json.hpp"
#include "reports/report.hpp"
#include "reports/requirements.hpp"
#include "reports/summary.hpp"
#include "reports/verdict.hpp"
#include "studies/comparing/difference.hpp"
#include "studies/results/results_file.hpp"
#include "studies/running/extension.hpp"
#include "studies/running/replay.hpp"
#include "studies/running/surrogate_samples.hpp"

namespace gamut::python {
namespace {

namespace py = pybind11;
using namespace py::literals;
using Held = std::shared_ptr<Results>;

py::array_t<double> arrayOf(std::span<const double> numbers, const GridShape& shape) {
  py::array_t<double> array(std::vector<py::ssize_t>(shape.begin(), shape.end()));
  std::ranges::copy(numbers, array.mutable_data());
  array.attr("flags").attr("writeable") = false;  // what is proved stays so
  return array;
}

/// Numbers as an array of these dimensions, bounds as a pair of them; None where they are not there.
py::object valueOf(const Numbers& numbers, const GridShape& shape) {
  if (numbers.empty()) return py::none();
  py::list ends;
  std::vector<double> room;
  for (std::size_t end = 0; end < numbers.ends().size(); ++end) ends.append(arrayOf(numbers.all(end, room), shape));
  return ends.size() == 1 ? py::object(ends[0]) : py::tuple(ends);
}

py::object valueOf(const Field& field, const GridShape& shape) {
  return std::visit(Visitor{[&](const Numbers& n) { return valueOf(n, shape); },
                            [](const WholeText& t) -> py::object { return py::str(*t.text); },
                            [](const Choice& c) -> py::object { return py::str(c.word()); },
                            [](std::vector<std::int64_t>* v) -> py::object { return py::array(py::cast(*v)); },
                            [](const auto* one) -> py::object { return py::cast(*one); }},
                    field.value);
}

py::list requirementsOf(const Results& results) {
  py::list all;
  for (const RequirementWords& words : wordsOfRequirements(results))
    all.append(py::dict("name"_a = words.name, "demand"_a = words.demand, "word"_a = words.word,
                        "verdict"_a = words.verdict, "guaranteed"_a = words.guaranteed, "probable"_a = words.probable,
                        "possible"_a = words.possible, "estimated"_a = words.estimated));
  return all;
}

py::dict verdictOf(const Results& results) {
  const Verdict verdict = judge(results);
  return py::dict("word"_a = results.comparison.present ? wordOf(verdict.word) : std::string_view(),
                  "sentence"_a = verdict.sentence, "notes"_a = verdict.notes, "settled"_a = verdict.settled,
                  "overestimation"_a = verdict.overestimation, "reached"_a = verdict.reached);
}

void save(const Results& results, const std::string& path, bool overwrite) {
  OutputFile file(path, overwrite ? OutputFile::Existing::isReplaced : OutputFile::Existing::isKept);
  writeResults(results, file);
}

void saveReport(const Results& results, const std::string& path, bool overwrite) {
  OutputFile(path, overwrite ? OutputFile::Existing::isReplaced : OutputFile::Existing::isKept)
      .write(renderReport(results));
}

/// The results with more samples, of these as many as before came again otherwise, and whether an interrupt ended it.
py::tuple extended(const Held& results, const std::string& name, std::size_t samples, std::optional<int> jobs,
                   std::optional<double> timeLimit, std::optional<double> memoryLimit, const py::object& progress) {
  RunOptions options;
  options.jobs = threads(jobs);
  options.samples = samples;
  options.timeLimit = timeLimit;
  options.memoryLimit = memoryLimit;
  Extension extension;
  const bool wasInterrupted = interruptible(progress, [&](const Work& work) {
    options.progress = work.progress;
    options.cancelled = work.cancelled;
    extension = gamut::extend(Machine(studyOf(*results, name)), *results, options);
  });
  if (!extension.isMore) return py::make_tuple(py::none(), whyEnded(extension.results), wasInterrupted);
  return py::make_tuple(std::make_shared<Results>(std::move(extension.results)), extension.changed, wasInterrupted);
}

py::dict replayed(const Held& results, const std::string& name, std::size_t number) {
  ReplayedSample sample;
  {
    const py::gil_scoped_release released;
    sample = replay(Machine(studyOf(*results, name)), *results, number);
  }
  const Table& motion = sample.trajectory;
  return py::dict("values"_a = arrayOf(sample.values, {sample.values.size()}),
                  "motion"_a = arrayOf(motion.data, {motion.times, motion.outputs}), "reached"_a = sample.reached,
                  "why"_a = sample.why, "decided"_a = sample.decided);
}

py::dict sampled(const Held& results, const std::string& name, std::uint64_t samples, const std::string& plan,
                 std::uint64_t seed, const std::vector<double>& times, const std::vector<std::string>& outputs,
                 std::optional<int> jobs) {
  SampleTable table;
  {
    const py::gil_scoped_release released;
    table = sampleSurrogate(*results, studyOf(*results, name), {plan, samples, seed, times, outputs, threads(jobs)});
  }
  std::vector<std::string> names;
  for (const OutputInfo& output : table.outputs) names.push_back(output.name);
  const GridShape shape{table.samples(), table.times.size(), names.size()};
  return py::dict("values"_a = arrayOf(table.values, {table.samples(), table.quantities.size()}),
                  "times"_a = table.times, "outputs"_a = names, "numbers"_a = arrayOf(table.numbers, shape),
                  "errors"_a = arrayOf(table.errors, shape));
}

Held opened(const std::string& path) {
  const py::gil_scoped_release released;
  return std::make_shared<Results>(readResults(path));
}

std::string compared(const Held& first, const Held& second, const std::string& one, const std::string& other) {
  return comparisonJson(compareResults(*first, *second), *first, *second, {one, other});
}

}  // namespace

py::list fieldsOf(const std::vector<Group>& groups) {
  const Extents extents = extentsOf(groups);
  py::list all;
  for (const Group& group : groups) {
    if (group.size == 0) continue;
    std::vector<py::list> columns;
    for (std::size_t i = 0; i < group.size; ++i) {
      const std::vector<Field> fields = group.fields(i);
      columns.resize(fields.size());
      for (std::size_t f = 0; f < fields.size(); ++f)
        columns[f].append(valueOf(fields[f], shapeOf(fields[f].dimensions, extents)));
    }
    const std::vector<Field> fields = group.fields(0);
    for (std::size_t f = 0; f < fields.size(); ++f)
      all.append(py::make_tuple(pathOf(group, fields[f]), fields[f].unit, fields[f].meaning,
                                dimensionsOf(group, fields[f]),
                                group.isList() ? py::object(columns[f]) : py::object(columns[f][0])));
  }
  return all;
}

void bindResults(py::module_& module) {
  py::class_<Results, Held>(module, "Results")
      .def("fields", [](const Results& r) { return fieldsOf(describe(r)); })
      .def("requirements", requirementsOf)
      .def("verdict", verdictOf)
      .def("ended", whyEnded)
      .def("margins",
           [](const Results& r) {
             std::vector<bool> are;
             for (std::size_t i = 0; i < r.outputs.size(); ++i) are.push_back(isMargin(r, i));
             return are;
           })
      .def("json", [](const Results& r) { return jsonSummary(r, findVerdict(r)); })
      .def("text", textSummary)
      .def("page", [](const Results& r) { return renderReport(r); })
      .def("save", save, "path"_a, "overwrite"_a)
      .def("save_report", saveReport, "path"_a, "overwrite"_a)
      .def("extend", extended, "name"_a, "samples"_a, "jobs"_a, "time_limit"_a, "memory_limit"_a, "progress"_a)
      .def("replay", replayed, "name"_a, "number"_a)
      .def("sample", sampled, "name"_a, "samples"_a, "plan"_a, "seed"_a, "times"_a, "outputs"_a, "jobs"_a);
  module.def("open", opened, "path"_a);
  module.def("compare", compared, "first"_a, "second"_a, "one"_a, "other"_a);
  module.def("differences", [](const Held& one, const Held& other) { return differences(*one, *other); });
}

}  // namespace gamut::python
