// One group a part of Results; grids are time x output, stacks of grids level (or probability) x time x output.
// Optional parts are absent data sets; a part that was not computed is an absent group.
#include "studies/results_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>

#include "studies/atomic_file.hpp"
#include "studies/detail/apart.hpp"
#include "studies/detail/hdf5.hpp"
#include "studies/detail/results_parts.hpp"
#include "studies/detail/seal.hpp"
#include "studies/printable.hpp"
#include "studies/readable.hpp"

namespace gamut {
namespace {

// ---- Writing --------------------------------------------------------------------------------------------------------

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
  study.attribute("cpu", results.cpu);
  study.attribute("memory", results.memory);
  study.attribute("time_limit", results.limits.time);
  study.attribute("memory_limit", results.limits.memory);
  study.attribute("enclosure_time_limit", results.limits.enclosureTime);
  study.attribute("enclosure_memory_limit", results.limits.enclosureMemory);
  study.attribute("sample_time_limit", results.limits.sampleTime);
  Hdf5Writer libraries(study.id(), "libraries");
  for (const auto& [name, version] : results.libraries) libraries.attribute(name, version);

  Hdf5Writer outputs(study.id(), "outputs");
  ColumnWriter<OutputInfo> output(outputs, results.outputs, "/output");
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
  const std::string units = jointUnit(column<std::string, U>(results.uncertain, [](const U& u) { return u.unit; }));
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
      "lower", [](const U& u) { return u.lower; }, "lower bound of the interval", units);
  quantity.numbers(
      "nominal", [](const U& u) { return u.nominal; }, "nominal value", units);
  quantity.numbers(
      "upper", [](const U& u) { return u.upper; }, "upper bound of the interval", units);
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

void writeDisputed(Hdf5Writer& comparison, const Results& results) {
  const std::vector<DisputedSample>& disputed = results.comparison.disputed;
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
      "value", [](const D& d) { return d.value; }, "value after the last integration, in the unit of its output", "");
  columns.numbers(
      "lower", [](const D& d) { return d.lower; }, "lower bound of the enclosure, in the unit of its output", "");
  columns.numbers(
      "upper", [](const D& d) { return d.upper; }, "upper bound of the enclosure, in the unit of its output", "");
  columns.numbers(
      "distance", [](const D& d) { return d.distance; }, "distance outside, in the unit of its output", "");
  columns.numbers(
      "error", [](const D& d) { return d.error; }, "measured error of the sample, in the unit of its output", "");
  columns.texts(
      "decided", [](const D& d) { return d.decided; }, "what decided");
  columns.integers(
      "level", [](const D& d) { return std::int64_t{d.level}; }, "index of the alpha-cut, -1 for the enclosure");
  std::vector<double> farthest;
  for (const D& d : disputed) {
    if (d.farthest.size() != results.outputs.size()) throw std::logic_error("farthest: not one distance an output");
    farthest.insert(farthest.end(), d.farthest.begin(), d.farthest.end());
  }
  const std::string units =
      jointUnit(column<std::string, OutputInfo>(results.outputs, [](const OutputInfo& o) { return o.unit; }));
  group.numbers("farthest", farthest.data(), {disputed.size(), results.outputs.size()}, "greatest distance outside",
                units);
  group.attachScales("farthest", {"/comparison/disputed/number", "/output"});
}

void writeComparison(Hdf5Writer& root, const Results& results) {
  const ComparisonResult& comparison = results.comparison;
  if (!comparison.present) return;
  Hdf5Writer group(root.id(), "comparison");
  group.attribute("long_name", std::string("how the answers agree"));
  group.attribute("verdict", comparison.verdict);
  group.attribute("why", comparison.why);
  group.attribute("excursion", comparison.excursion);
  group.attribute("maximum", comparison.maximum);
  group.attribute("median", comparison.median);
  GridWriter grids(group, results);
  grids.ratio("overestimation", comparison.overestimation, "width of the enclosure over width of the envelope");
  grids.grid("excess", comparison.excess, "width of the enclosure minus width of the envelope");
  if (!comparison.maximumOf.empty()) {
    group.numbers("maximum_of", comparison.maximumOf.data(), {comparison.maximumOf.size()},
                  "greatest overestimation of each output", "1");
    group.attachScales("maximum_of", {"/output"});
  }
  writeDisputed(group, results);
}

void writeAll(hid_t file, const Results& results) {
  Hdf5Writer root(file);
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
}

// ---- Reading --------------------------------------------------------------------------------------------------------

void readOutputs(const Hdf5Reader& study, Results& results) {
  const Hdf5Reader group(study, "outputs");
  const std::vector<std::string> names = group.texts("name");
  const auto quantities = readTexts(group, "quantity", names.size()), units = readTexts(group, "unit", names.size());
  for (std::size_t i = 0; i < names.size(); ++i) results.outputs.push_back({names[i], quantities[i], units[i]});
  if (results.outputs.empty() || results.time.empty()) throw Hdf5Error("outputs");
}

void readUncertain(const Hdf5Reader& study, Results& results) {
  if (!study.has("uncertain")) return;
  const Hdf5Reader group(study, "uncertain");
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
  const Hdf5Reader study(root, "study");
  results.studyText = study.wholeText("text");
  results.studyFile = study.text("file");
  results.title = study.text("title");
  results.analysis = study.text("analysis");
  results.seed = study.natural("seed");
  results.horizon = study.number("horizon");
  results.version = study.text("version");
  results.host = study.text("host");
  results.date = study.text("date");
  results.reportCpu = study.number("report_cpu");
  results.cpu = study.number("cpu");
  results.memory = study.number("memory");
  results.limits = {study.number("time_limit"), study.number("memory_limit"), study.number("enclosure_time_limit"),
                    study.number("enclosure_memory_limit"), study.number("sample_time_limit")};
  const Hdf5Reader libraries(study, "libraries");
  for (const std::string& name : libraries.attributeNames()) results.libraries[printable(name)] = libraries.text(name);
  readOutputs(study, results);
  readUncertain(study, results);
}

void readInterval(const Hdf5Reader& root, Results& results) {
  if (!root.has("interval")) return;
  const Hdf5Reader group(root, "interval");
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
  const Hdf5Reader group(root, "stochastic");
  StochasticResult& stochastic = results.stochastic;
  stochastic.present = true;
  stochastic.plan = group.text("plan");
  stochastic.samples = group.integer("samples");
  stochastic.corners = group.integer("corners");
  stochastic.alphaCorners = group.integer("alpha_corners");
  stochastic.integrated = group.integer("integrated");
  stochastic.stopped = group.text("stopped");
  stochastic.relativeTolerance = group.number("relative_tolerance");
  stochastic.absoluteTolerance = group.number("absolute_tolerance");
  stochastic.packWidth = group.integer("pack_width");
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
  const Hdf5Reader group(root, "fuzzy");
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
  const Hdf5Reader group(comparison, "disputed");
  const std::vector<std::int64_t> numbers = group.integers("number");
  const std::size_t n = numbers.size();
  const auto times = readIntegers(group, "time", n), outputs = readIntegers(group, "output", n);
  const auto outside = readIntegers(group, "outside", n);
  const auto value = readList(group, "value", n), lower = readList(group, "lower", n),
             upper = readList(group, "upper", n);
  const auto distance = readList(group, "distance", n), error = readList(group, "error", n);
  const auto decided = readTexts(group, "decided", n);
  const std::size_t outputCount = results.outputs.size();
  const auto level = readIntegers(group, "level", n);
  Hdf5Shape shape;
  const std::vector<double> farthest = group.numbers("farthest", shape);
  if (shape != Hdf5Shape{n, outputCount}) throw Hdf5Error("farthest");
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
                          outside[i] != 0,
                          static_cast<int>(level[i]),
                          {}};
    const auto begin = farthest.begin() + static_cast<std::ptrdiff_t>(i * outputCount);
    sample.farthest.assign(begin, begin + static_cast<std::ptrdiff_t>(outputCount));
    if (sample.time >= results.time.size() || sample.output >= results.outputs.size()) throw Hdf5Error("disputed");
    if (level[i] < -1 || level[i] >= static_cast<std::int64_t>(results.fuzzy.alpha.size())) throw Hdf5Error("level");
    results.comparison.disputed.push_back(std::move(sample));
  }
}

void readComparison(const Hdf5Reader& root, Results& results) {
  if (!root.has("comparison")) return;
  const Hdf5Reader group(root, "comparison");
  ComparisonResult& comparison = results.comparison;
  comparison.present = true;
  comparison.verdict = group.text("verdict");
  comparison.why = group.text("why");
  comparison.excursion = group.number("excursion");
  comparison.maximum = group.number("maximum");
  comparison.median = group.number("median");
  const GridReader grids(group, results);
  comparison.overestimation = grids.grid("overestimation");
  comparison.excess = grids.grid("excess");
  if (group.has("maximum_of")) comparison.maximumOf = readList(group, "maximum_of", results.outputs.size());
  readDisputed(group, results);
}

Results readAll(const Hdf5Reader& root) {
  Results results;
  results.time = readList(root, "time");
  readStudyPart(root, results);
  readInterval(root, results);
  readStochastic(root, results);
  readFuzzy(root, results);
  readComparison(root, results);
  return results;
}

/// Counts and times that no run gives would lead those astray who compute with them.
void checkSense(const Results& results) {
  const auto require = [](bool isSensible, const char* what) {
    if (!isSensible) throw Hdf5Error(what);
  };
  const auto isCount = [](std::int64_t n) { return n >= 0 && n < (std::int64_t{1} << 53); };
  for (std::size_t i = 0; i < results.time.size(); ++i)
    require(std::isfinite(results.time[i]) && (i == 0 || results.time[i - 1] < results.time[i]), "time");
  require(std::isfinite(results.horizon), "horizon");
  require(isCount(results.interval.steps), "steps");
  require(isCount(results.stochastic.samples), "samples");
  require(isCount(results.stochastic.corners), "corners");
  require(isCount(results.stochastic.alphaCorners), "alpha_corners");
  require(isCount(results.stochastic.integrated), "integrated");
  for (const DisputedSample& sample : results.comparison.disputed) {
    require(isCount(sample.number), "number");
    requireBounds(sample.lower, sample.upper, "disputed");
  }
  for (const UncertainInfo& uncertain : results.uncertain) requireBounds(uncertain.lower, uncertain.upper, "uncertain");
  for (const double alpha : results.fuzzy.alpha) require(alpha >= 0 && alpha <= 1, "alpha");
  for (const double probability : results.stochastic.probabilities)
    require(probability >= 0 && probability <= 1, "probability");
}

/// Reads a file's content in a child process: a file with a right seal is what some program wrote, not what gamut run
/// wrote, and HDF5 crashes or hangs at some. The child may need the content's size once more as it is and unpacked,
/// 1100 times as large at most, and reads 5 MB/s at least. Throws Hdf5Error.
Results readApart(const std::string& content) {
  const auto read = [&] {
    Hdf5Transcript transcript;
    try {
      readAll(Hdf5Reader(content, transcript));
    } catch (const Hdf5Error&) {  // the transcript ends with it
    }
    return transcript.bytes();
  };
  std::optional<std::string> transcript = resultApart(read, (std::size_t{512} << 20) + 2200 * content.size(),
                                                      static_cast<unsigned>(10 + content.size() / 5000000));
  if (!transcript) throw Hdf5Error("the file");
  Hdf5Transcript told(*std::move(transcript));
  Results results = readAll(Hdf5Reader(told));
  checkSense(results);
  return results;
}

}  // namespace

void writeResults(const Results& results, OutputFile& file) {
  const Hdf5Silence silence;
  std::string content;
  try {
    content = hdf5InMemory(sealSize, [&](hid_t whole) { writeAll(whole, results); });
    seal(content);
  } catch (const Hdf5Error& error) {
    throw WriteError(fmt::format("{}: cannot be written; HDF5 failed at {}", file.path(), error.what()));
  }
  file.write(content);
}

void writeResults(const Results& results, const std::string& path) {
  OutputFile file(path, OutputFile::Existing::isReplaced);
  writeResults(results, file);
}

Results readResults(const std::string& path) {
  const Hdf5Silence silence;  // the child's too
  if (const std::string fault = whyUnreadable(path); !fault.empty())
    throw ResultsFileError(fmt::format("{}: {}; expected a results file written by gamut run", path, fault));
  std::ifstream file(path, std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  try {
    checkSeal(content);
  } catch (const SealError& refused) {
    throw ResultsFileError(fmt::format("{}: {}", path, refused.what()));
  }
  try {
    return readApart(content);
  } catch (const Hdf5Error& damaged) {
    throw ResultsFileError(
        fmt::format("{}: damaged: {} cannot be read; expected the file as gamut run wrote it", path, damaged.what()));
  }
}

}  // namespace gamut
