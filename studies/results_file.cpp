// One group a part of Results; grids are time x output, stacks of grids level (or probability) x time x output.
// Optional parts are absent data sets; a part that was not computed is an absent group.
#include "studies/results_file.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <functional>

#include "studies/atomic_file.hpp"
#include "studies/detail/hdf5.hpp"

namespace gamut {
namespace {

constexpr const char* formatName = "Gamut results";
constexpr std::int64_t formatVersion = 1;

// ---- Writing --------------------------------------------------------------------------------------------------------

/// Grids with their scales and units.
class GridWriter {
 public:
  GridWriter(Hdf5Writer& group, const Results& results) : group_(&group), results_(&results) {
    for (const OutputInfo& output : results.outputs) units_.push_back(output.unit);
  }

  void grid(const std::string& name, const Grid& grid, const std::string& longName) {
    this->grid(name, grid, longName, units_);
  }

  void ratio(const std::string& name, const Grid& grid, const std::string& longName) {
    this->grid(name, grid, longName, {"1"});
  }

  void bounds(const std::string& name, const Bounds& bounds, const std::string& longName) {
    grid(name + "_lower", bounds.lower, longName + ", lower bound");
    grid(name + "_upper", bounds.upper, longName + ", upper bound");
  }

  /// `scale`: absolute path of the first dimension's scale.
  void stack(const std::string& name, const std::vector<const Grid*>& grids, const std::string& scale,
             const std::string& longName) {
    if (grids.empty()) return;
    const Grid& first = *grids.front();
    std::vector<double> values;
    values.reserve(grids.size() * first.data.size());
    for (const Grid* grid : grids) {
      if (grid->times != first.times || grid->outputs != first.outputs)
        throw std::logic_error(name + ": grids differ in shape");
      values.insert(values.end(), grid->data.begin(), grid->data.end());
    }
    group_->numbers(name, values.data(), {grids.size(), first.times, first.outputs}, longName, units_);
    group_->attachScales(name, {scale, "/time", "/output"});
  }

  void stack(const std::string& name, const std::vector<Bounds>& bounds, const std::string& scale,
             const std::string& longName) {
    std::vector<const Grid*> lower, upper;
    for (const Bounds& b : bounds) {
      lower.push_back(&b.lower);
      upper.push_back(&b.upper);
    }
    stack(name + "_lower", lower, scale, longName + ", lower bound");
    stack(name + "_upper", upper, scale, longName + ", upper bound");
  }

 private:
  void grid(const std::string& name, const Grid& grid, const std::string& longName,
            const std::vector<std::string>& units) {
    if (grid.empty()) return;
    if (grid.times != results_->time.size() || grid.outputs != results_->outputs.size())
      throw std::logic_error(name + ": the grid's shape is not times x outputs");
    group_->numbers(name, grid.data.data(), {grid.times, grid.outputs}, longName, units);
    group_->attachScales(name, {"/time", "/output"});
  }

  Hdf5Writer* group_;
  const Results* results_;
  std::vector<std::string> units_;
};

/// One column of a list of records.
template <class T, class Record>
std::vector<T> column(const std::vector<Record>& records, const std::function<T(const Record&)>& field) {
  std::vector<T> values;
  for (const Record& record : records) values.push_back(field(record));
  return values;
}

/// Columns of a list of records, one data set each.
template <class Record>
class ColumnWriter {
 public:
  ColumnWriter(Hdf5Writer& group, const std::vector<Record>& records) : group_(&group), records_(&records) {}
  void texts(const std::string& name, const std::function<std::string(const Record&)>& field,
             const std::string& longName) {
    group_->texts(name, column<std::string>(*records_, field), longName);
  }
  void numbers(const std::string& name, const std::function<double(const Record&)>& field, const std::string& longName,
               const std::string& unit) {
    const std::vector<double> values = column<double>(*records_, field);
    group_->numbers(name, values.data(), {values.size()}, longName, {unit});
  }
  void integers(const std::string& name, const std::function<std::int64_t(const Record&)>& field,
                const std::string& longName) {
    group_->integers(name, column<std::int64_t>(*records_, field), longName);
  }

 private:
  Hdf5Writer* group_;
  const std::vector<Record>* records_;
};

void writeScale(Hdf5Writer& group, const std::string& name, const std::vector<double>& values,
                const std::string& longName, const std::string& unit) {
  group.numbers(name, values.data(), {values.size()}, longName, {unit});
  group.makeScale(name, name);
}

void writeStudy(Hdf5Writer& root, const Results& results) {
  Hdf5Writer study(root.id(), "study");
  study.text("text", results.studyText, "study file, word for word");
  study.attribute("file", results.studyFile);
  study.attribute("title", results.title);
  study.attribute("analysis", results.analysis);
  study.attribute("seed", results.seed);
  study.attribute("horizon", results.horizon);
  study.attribute("horizon_units", std::string("s"));
  study.attribute("version", results.version);
  study.attribute("host", results.host);
  study.attribute("date", results.date);
  study.attribute("report_cpu", results.reportCpu);
  Hdf5Writer libraries(study.id(), "libraries");
  for (const auto& [name, version] : results.libraries) libraries.attribute(name, version);

  Hdf5Writer outputs(study.id(), "outputs");
  ColumnWriter<OutputInfo> output(outputs, results.outputs);
  output.texts(
      "name", [](const OutputInfo& o) { return o.name; }, "name of the output");
  output.texts(
      "quantity", [](const OutputInfo& o) { return o.quantity; }, "quantity of the mechanism");
  output.texts(
      "unit", [](const OutputInfo& o) { return o.unit; }, "SI unit");

  if (results.uncertain.empty()) return;
  Hdf5Writer uncertain(study.id(), "uncertain");
  ColumnWriter<UncertainInfo> quantity(uncertain, results.uncertain);
  using U = UncertainInfo;
  quantity.texts(
      "name", [](const U& u) { return u.name; }, "name of the uncertain quantity");
  quantity.texts(
      "quantity", [](const U& u) { return u.quantity; }, "quantity of the mechanism");
  quantity.texts(
      "unit", [](const U& u) { return u.unit; }, "SI unit");
  quantity.texts(
      "distribution", [](const U& u) { return u.distribution; }, "distribution, in words");
  quantity.texts(
      "membership", [](const U& u) { return u.membership; }, "membership function, in words");
  quantity.numbers(
      "lower", [](const U& u) { return u.lower; }, "lower bound of the interval", "SI");
  quantity.numbers(
      "nominal", [](const U& u) { return u.nominal; }, "nominal value", "SI");
  quantity.numbers(
      "upper", [](const U& u) { return u.upper; }, "upper bound of the interval", "SI");
}

void writeInterval(Hdf5Writer& root, const Results& results) {
  const IntervalResult& interval = results.interval;
  if (!interval.present) return;
  Hdf5Writer group(root.id(), "interval");
  group.attribute("long_name", std::string("what is guaranteed: enclosures of every output"));
  group.attribute("reached", interval.reached);
  group.attribute("why", interval.why);
  group.attribute("pieces", static_cast<std::int64_t>(interval.pieces));
  group.attribute("steps", interval.steps);
  group.attribute("cpu", interval.cpu);
  GridWriter grids(group, results);
  grids.bounds("at", interval.at, "enclosure at the output time");
  grids.bounds("over", interval.over, "enclosure over the whole interval from the output time before");
  grids.bounds("direct", interval.direct, "enclosure by plain interval arithmetic");
}

void writeStochastic(Hdf5Writer& root, const Results& results) {
  const StochasticResult& stochastic = results.stochastic;
  if (!stochastic.present) return;
  Hdf5Writer group(root.id(), "stochastic");
  group.attribute("long_name", std::string("what is probable: samples of every output"));
  group.attribute("plan", stochastic.plan);
  group.attribute("samples", stochastic.samples);
  group.attribute("corners", stochastic.corners);
  group.attribute("alpha_corners", stochastic.alphaCorners);
  group.attribute("integrated", stochastic.integrated);
  group.attribute("stopped", stochastic.stopped);
  group.attribute("relative_tolerance", stochastic.relativeTolerance);
  group.attribute("absolute_tolerance", stochastic.absoluteTolerance);
  group.attribute("pack_width", stochastic.packWidth);
  group.attribute("reached", stochastic.reached);
  group.attribute("why", stochastic.why);
  group.attribute("cpu", stochastic.cpu);
  GridWriter grids(group, results);
  grids.bounds("envelope", stochastic.envelope, "least and greatest sample");
  grids.grid("mean", stochastic.mean, "mean of the samples");
  grids.grid("deviation", stochastic.deviation, "standard deviation of the samples");
  grids.grid("error", stochastic.error, "measured error of the integration of samples");
  grids.grid("resolution", stochastic.resolution,
             "greatest distance of a quantile from that of the samples themselves");
  if (stochastic.probabilities.empty()) return;
  writeScale(group, "probability", stochastic.probabilities, "probability of the quantile", "1");
  std::vector<const Grid*> quantiles;
  for (const Grid& grid : stochastic.quantiles) quantiles.push_back(&grid);
  grids.stack("quantiles", quantiles, "/stochastic/probability", "quantiles of the samples");
}

void writeFuzzy(Hdf5Writer& root, const Results& results) {
  const FuzzyResult& fuzzy = results.fuzzy;
  if (!fuzzy.present) return;
  Hdf5Writer group(root.id(), "fuzzy");
  group.attribute("long_name", std::string("what is possible: alpha-cuts of every output"));
  group.attribute("reached", fuzzy.reached);
  group.attribute("why", fuzzy.why);
  group.attribute("cpu", fuzzy.cpu);
  if (fuzzy.alpha.empty()) return;
  writeScale(group, "alpha", fuzzy.alpha, "membership level of the alpha-cut", "1");
  GridWriter grids(group, results);
  grids.stack("outer", fuzzy.outer, "/fuzzy/alpha", "proved alpha-cut");
  grids.stack("inner", fuzzy.inner, "/fuzzy/alpha", "range of the samples of at least this membership");
}

void writeDisputed(Hdf5Writer& comparison, const std::vector<DisputedSample>& disputed) {
  if (disputed.empty()) return;
  Hdf5Writer group(comparison.id(), "disputed");
  ColumnWriter<DisputedSample> columns(group, disputed);
  using D = DisputedSample;
  const auto integer = [](std::size_t value) { return static_cast<std::int64_t>(value); };
  columns.integers(
      "number", [](const D& d) { return d.number; }, "number of the sample");
  columns.integers(
      "time", [&](const D& d) { return integer(d.time); }, "index of the output time");
  columns.integers(
      "output", [&](const D& d) { return integer(d.output); }, "index of the output");
  columns.integers(
      "outside", [](const D& d) { return std::int64_t{d.outside}; }, "1 if it stayed outside");
  columns.numbers(
      "value", [](const D& d) { return d.value; }, "value after the last integration", "SI");
  columns.numbers(
      "lower", [](const D& d) { return d.lower; }, "lower bound of the enclosure", "SI");
  columns.numbers(
      "upper", [](const D& d) { return d.upper; }, "upper bound of the enclosure", "SI");
  columns.numbers(
      "distance", [](const D& d) { return d.distance; }, "distance outside", "SI");
  columns.numbers(
      "error", [](const D& d) { return d.error; }, "measured error of the sample", "SI");
  columns.texts(
      "decided", [](const D& d) { return d.decided; }, "what decided");
}

void writeComparison(Hdf5Writer& root, const Results& results) {
  const ComparisonResult& comparison = results.comparison;
  if (!comparison.present) return;
  Hdf5Writer group(root.id(), "comparison");
  group.attribute("long_name", std::string("how the answers agree"));
  group.attribute("verdict", comparison.verdict);
  group.attribute("excursion", comparison.excursion);
  group.attribute("maximum", comparison.maximum);
  group.attribute("median", comparison.median);
  GridWriter grids(group, results);
  grids.ratio("overestimation", comparison.overestimation, "width of the enclosure over width of the envelope");
  grids.grid("excess", comparison.excess, "width of the enclosure minus width of the envelope");
  if (!comparison.maximumOf.empty()) {
    group.numbers("maximum_of", comparison.maximumOf.data(), {comparison.maximumOf.size()},
                  "greatest overestimation of each output", {"1"});
    group.attachScales("maximum_of", {"/output"});
  }
  writeDisputed(group, comparison.disputed);
}

void writeAll(const Results& results, const std::string& path) {
  const Hdf5Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose, "the file");
  Hdf5Writer root(file);
  root.attribute("format", std::string(formatName));
  root.attribute("format_version", formatVersion);
  root.attribute("title", results.title);
  writeScale(root, "time", results.time, "output time", "s");
  std::vector<std::string> names;
  for (const OutputInfo& output : results.outputs) names.push_back(output.name);
  root.texts("output", names, "output; units in /study/outputs/unit");
  root.makeScale("output", "output");
  writeStudy(root, results);
  writeInterval(root, results);
  writeStochastic(root, results);
  writeFuzzy(root, results);
  writeComparison(root, results);
  if (H5Fflush(file, H5F_SCOPE_GLOBAL) < 0) throw Hdf5Error("the file");
}

// ---- Reading --------------------------------------------------------------------------------------------------------

/// Grids of a group, checked against the file's times and outputs.
class GridReader {
 public:
  GridReader(const Hdf5Reader& group, const Results& results)
      : group_(&group), times_(results.time.size()), outputs_(results.outputs.size()) {}

  Grid grid(const std::string& name) const {
    if (!group_->has(name)) return {};
    Hdf5Shape shape;
    Grid grid(times_, outputs_);
    grid.data = group_->numbers(name, shape);
    if (shape != Hdf5Shape{times_, outputs_}) throw Hdf5Error(name);
    return grid;
  }

  Bounds bounds(const std::string& name) const {
    Bounds bounds;
    bounds.lower = grid(name + "_lower");
    bounds.upper = grid(name + "_upper");
    if (bounds.lower.empty() != bounds.upper.empty()) throw Hdf5Error(name);
    return bounds;
  }

  std::vector<Grid> stack(const std::string& name, std::size_t levels) const {
    if (!group_->has(name)) return {};
    Hdf5Shape shape;
    const std::vector<double> values = group_->numbers(name, shape);
    if (shape != Hdf5Shape{levels, times_, outputs_}) throw Hdf5Error(name);
    std::vector<Grid> grids(levels, Grid(times_, outputs_));
    const auto size = static_cast<std::ptrdiff_t>(times_ * outputs_);
    for (std::size_t i = 0; i < levels; ++i) {
      const auto begin = values.begin() + static_cast<std::ptrdiff_t>(i) * size;
      grids[i].data.assign(begin, begin + size);
    }
    return grids;
  }

  std::vector<Bounds> boundsStack(const std::string& name, std::size_t levels) const {
    std::vector<Grid> lower = stack(name + "_lower", levels), upper = stack(name + "_upper", levels);
    if (lower.size() != upper.size()) throw Hdf5Error(name);
    std::vector<Bounds> result(lower.size());
    for (std::size_t i = 0; i < lower.size(); ++i) {
      result[i].lower = std::move(lower[i]);
      result[i].upper = std::move(upper[i]);
    }
    return result;
  }

 private:
  const Hdf5Reader* group_;
  std::size_t times_, outputs_;
};

/// A list of numbers; with `size` other than npos, of that length.
std::vector<double> readList(const Hdf5Reader& group, const std::string& name, std::size_t size = std::string::npos) {
  Hdf5Shape shape;
  std::vector<double> values = group.numbers(name, shape);
  if (shape.size() != 1 || (size != std::string::npos && shape[0] != size)) throw Hdf5Error(name);
  return values;
}

std::vector<std::string> readTexts(const Hdf5Reader& group, const std::string& name, std::size_t size) {
  std::vector<std::string> values = group.texts(name);
  if (values.size() != size) throw Hdf5Error(name);
  return values;
}

std::vector<std::int64_t> readIntegers(const Hdf5Reader& group, const std::string& name, std::size_t size) {
  std::vector<std::int64_t> values = group.integers(name);
  if (values.size() != size) throw Hdf5Error(name);
  return values;
}

void readOutputs(const Hdf5Reader& study, Results& results) {
  const Hdf5Reader group(study.id(), "outputs");
  const std::vector<std::string> names = group.texts("name");
  const auto quantities = readTexts(group, "quantity", names.size()), units = readTexts(group, "unit", names.size());
  for (std::size_t i = 0; i < names.size(); ++i) results.outputs.push_back({names[i], quantities[i], units[i]});
  if (results.outputs.empty() || results.time.empty()) throw Hdf5Error("outputs");
}

void readUncertain(const Hdf5Reader& study, Results& results) {
  if (!study.has("uncertain")) return;
  const Hdf5Reader group(study.id(), "uncertain");
  const std::vector<std::string> names = group.texts("name");
  const std::size_t n = names.size();
  const auto quantities = readTexts(group, "quantity", n), units = readTexts(group, "unit", n);
  const auto distributions = readTexts(group, "distribution", n), memberships = readTexts(group, "membership", n);
  const auto lower = readList(group, "lower", n), nominal = readList(group, "nominal", n),
             upper = readList(group, "upper", n);
  for (std::size_t i = 0; i < n; ++i) {
    results.uncertain.push_back(
        {names[i], quantities[i], units[i], lower[i], nominal[i], upper[i], distributions[i], memberships[i]});
  }
}

void readStudyPart(const Hdf5Reader& root, Results& results) {
  const Hdf5Reader study(root.id(), "study");
  results.studyText = study.textData("text");
  results.studyFile = study.text("file");
  results.title = study.text("title");
  results.analysis = study.text("analysis");
  results.seed = study.natural("seed");
  results.horizon = study.number("horizon");
  results.version = study.text("version");
  results.host = study.text("host");
  results.date = study.text("date");
  results.reportCpu = study.number("report_cpu");
  const Hdf5Reader libraries(study.id(), "libraries");
  for (const std::string& name : libraries.attributeNames()) results.libraries[name] = libraries.text(name);
  readOutputs(study, results);
  readUncertain(study, results);
}

void readInterval(const Hdf5Reader& root, Results& results) {
  if (!root.has("interval")) return;
  const Hdf5Reader group(root.id(), "interval");
  IntervalResult& interval = results.interval;
  interval.present = true;
  interval.reached = group.number("reached");
  interval.why = group.text("why");
  interval.pieces = static_cast<int>(group.integer("pieces"));
  interval.steps = group.integer("steps");
  interval.cpu = group.number("cpu");
  const GridReader grids(group, results);
  interval.at = grids.bounds("at");
  interval.over = grids.bounds("over");
  interval.direct = grids.bounds("direct");
}

void readStochastic(const Hdf5Reader& root, Results& results) {
  if (!root.has("stochastic")) return;
  const Hdf5Reader group(root.id(), "stochastic");
  StochasticResult& stochastic = results.stochastic;
  stochastic.present = true;
  stochastic.plan = group.text("plan");
  stochastic.samples = group.integer("samples");
  stochastic.corners = group.integer("corners");
  if (group.hasAttribute("alpha_corners")) stochastic.alphaCorners = group.integer("alpha_corners");
  stochastic.integrated = stochastic.planned();
  if (group.hasAttribute("integrated")) {  // older files do not tell
    stochastic.integrated = group.integer("integrated");
    stochastic.stopped = group.text("stopped");
  }
  stochastic.relativeTolerance = group.number("relative_tolerance");
  stochastic.absoluteTolerance = group.number("absolute_tolerance");
  // Older files have none: their samples were integrated one by one.
  if (group.hasAttribute("pack_width")) stochastic.packWidth = group.integer("pack_width");
  stochastic.reached = group.number("reached");
  stochastic.why = group.text("why");
  stochastic.cpu = group.number("cpu");
  const GridReader grids(group, results);
  stochastic.envelope = grids.bounds("envelope");
  stochastic.mean = grids.grid("mean");
  stochastic.deviation = grids.grid("deviation");
  stochastic.error = grids.grid("error");
  stochastic.resolution = grids.grid("resolution");
  if (!group.has("probability")) return;
  stochastic.probabilities = readList(group, "probability");
  stochastic.quantiles = grids.stack("quantiles", stochastic.probabilities.size());
}

void readFuzzy(const Hdf5Reader& root, Results& results) {
  if (!root.has("fuzzy")) return;
  const Hdf5Reader group(root.id(), "fuzzy");
  FuzzyResult& fuzzy = results.fuzzy;
  fuzzy.present = true;
  fuzzy.reached = group.number("reached");
  fuzzy.why = group.text("why");
  fuzzy.cpu = group.number("cpu");
  if (!group.has("alpha")) return;
  fuzzy.alpha = readList(group, "alpha");
  const GridReader grids(group, results);
  fuzzy.outer = grids.boundsStack("outer", fuzzy.alpha.size());
  fuzzy.inner = grids.boundsStack("inner", fuzzy.alpha.size());
}

void readDisputed(const Hdf5Reader& comparison, Results& results) {
  if (!comparison.has("disputed")) return;
  const Hdf5Reader group(comparison.id(), "disputed");
  const std::vector<std::int64_t> numbers = group.integers("number");
  const std::size_t n = numbers.size();
  const auto times = readIntegers(group, "time", n), outputs = readIntegers(group, "output", n);
  const auto outside = readIntegers(group, "outside", n);
  const auto value = readList(group, "value", n), lower = readList(group, "lower", n),
             upper = readList(group, "upper", n);
  const auto distance = readList(group, "distance", n), error = readList(group, "error", n);
  const auto decided = readTexts(group, "decided", n);
  for (std::size_t i = 0; i < n; ++i) {
    DisputedSample sample{numbers[i],
                          static_cast<std::size_t>(times[i]),
                          static_cast<std::size_t>(outputs[i]),
                          value[i],
                          lower[i],
                          upper[i],
                          distance[i],
                          error[i],
                          decided[i],
                          outside[i] != 0};
    if (sample.time >= results.time.size() || sample.output >= results.outputs.size()) throw Hdf5Error("disputed");
    results.comparison.disputed.push_back(std::move(sample));
  }
}

void readComparison(const Hdf5Reader& root, Results& results) {
  if (!root.has("comparison")) return;
  const Hdf5Reader group(root.id(), "comparison");
  ComparisonResult& comparison = results.comparison;
  comparison.present = true;
  comparison.verdict = group.text("verdict");
  comparison.excursion = group.number("excursion");
  comparison.maximum = group.number("maximum");
  comparison.median = group.number("median");
  const GridReader grids(group, results);
  comparison.overestimation = grids.grid("overestimation");
  comparison.excess = grids.grid("excess");
  if (group.has("maximum_of")) comparison.maximumOf = readList(group, "maximum_of", results.outputs.size());
  readDisputed(group, results);
}

Results readAll(hid_t file) {
  const Hdf5Reader root(file, "/");
  Results results;
  results.time = readList(root, "time");
  readStudyPart(root, results);
  readInterval(root, results);
  readStochastic(root, results);
  readFuzzy(root, results);
  readComparison(root, results);
  return results;
}

/// Throws unless the file says that it is ours, in a layout that we know.
void checkFormat(hid_t file, const std::string& path) {
  const std::string expected = "a results file written by gamut run";
  std::int64_t version = 0;
  try {
    const Hdf5Reader root(file, "/");
    if (root.text("format") != formatName) throw Hdf5Error("format");
    version = root.integer("format_version");
  } catch (const Hdf5Error&) {
    throw ResultsFileError(fmt::format("{}: an HDF5 file, but not of Gamut results; expected {}", path, expected));
  }
  if (version != formatVersion)
    throw ResultsFileError(fmt::format("{}: written in layout {}; expected layout {}", path, version, formatVersion));
}

}  // namespace

void writeResults(const Results& results, const std::string& path) {
  const Hdf5Silence silence;
  replaceFile(path, [&](const std::string& temporary) {
    try {
      writeAll(results, temporary);
    } catch (const Hdf5Error& error) {
      throw WriteError(fmt::format("{}: cannot be written; HDF5 failed at {}", path, error.what()));
    }
  });
}

Results readResults(const std::string& path) {
  const Hdf5Silence silence;
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw ResultsFileError(path + ": cannot be read; expected a results file written by gamut run");
  try {
    const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "the file");
    checkFormat(file, path);
    return readAll(file);
  } catch (const Hdf5Error& damaged) {
    throw ResultsFileError(
        fmt::format("{}: not a Gamut results file, or damaged ({} cannot be read); expected a results "
                    "file written by gamut run",
                    path, damaged.what()));
  }
}

}  // namespace gamut
