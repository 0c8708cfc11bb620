// Each number that is kept of a point stands in one table, with what it is called and how it is found.
#include "studies/sweeps/sweep_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <numeric>
#include <optional>

#include "studies/results/extremes.hpp"

namespace gamut {
namespace {

constexpr double noNumber = std::numeric_limits<double>::quiet_NaN();
using RangeSource = MotionRange::Source;

template <auto Member>
double ofDemand(const Results& results, std::size_t i) {
  return static_cast<double>(results.requirements[i].*Member);
}

template <auto Member>
double ofEstimate(const Results& results, std::size_t i) {
  return results.requirements[i].estimate.*Member;
}

template <RangeSource From, auto Extreme>
double extremeOf(const Results& results, std::size_t i) {
  const std::optional<MotionRange> range = motionRange(results, i, From);
  return range ? ((*range).*Extreme).value : noNumber;
}

/// At the last output time, if it was reached.
double lastOf(const Table& table, const Results& results, std::size_t i) {
  return table.times == results.time.size() && table.times > 0 ? table(table.times - 1, i) : noNumber;
}

constexpr SweepColumn keptOfRequirements[] = {
    {"guaranteed", "", "0 open, 1 met (for all values), 2 violated (for all values), 3 partly (violated for some)",
     ofDemand<&RequirementResult::word>},
    {"met", "1", "part of the uncertain box for which it is proved to be met", ofDemand<&RequirementResult::met>},
    {"violated", "1", "part for which it is proved to be violated", ofDemand<&RequirementResult::violated>},
    {"factor", "1",
     "it is proved to be met where deviations from the nominal values are up to so many times those of the intervals",
     ofDemand<&RequirementResult::factor>},
    {"met_until", "s", "of what is always to be: it is met for every value up to this output time",
     ofDemand<&RequirementResult::metUntil>},
    {"probability_lower", "1", "proved lower bound of the probability that it is met",
     ofDemand<&RequirementResult::probabilityLower>},
    {"probability_upper", "1", "upper bound", ofDemand<&RequirementResult::probabilityUpper>},
    {"samples", "", "samples of the plan that arrived", ofDemand<&RequirementResult::samples>},
    {"violating", "", "of these, violate it at the output times", ofDemand<&RequirementResult::violating>},
    {"estimate_lower", "1",
     "where the proof ends before the window does: 95 % confidence of the probability that it is met, sampled",
     ofEstimate<&RequirementEstimate::lower>},
    {"estimate_upper", "1", "its upper end", ofEstimate<&RequirementEstimate::upper>},
    {"violation_possibility_lower", "1", "proved lower bound of the possibility that it is violated",
     ofDemand<&RequirementResult::violationLeast>},
    {"violation_possibility_upper", "1", "upper bound", ofDemand<&RequirementResult::violationMost>},
    {"worst_margin", "", "the least margin of all samples, in its unit", ofDemand<&RequirementResult::worstMargin>}};

constexpr SweepColumn keptOfOutputs[] = {
    {"least", unit::ofOutput, "it is never below this, as far as the enclosure came (see reached), proved",
     extremeOf<RangeSource::ofProof, &MotionRange::least>},
    {"greatest", unit::ofOutput, "nor above this", extremeOf<RangeSource::ofProof, &MotionRange::greatest>},
    {"sampled_least", unit::ofOutput, "the least of all samples at the output times",
     extremeOf<RangeSource::ofSamples, &MotionRange::least>},
    {"sampled_greatest", unit::ofOutput, "the greatest of them",
     extremeOf<RangeSource::ofSamples, &MotionRange::greatest>},
    {"last_lower", unit::ofOutput, "proved lower bound at the last output time",
     [](const Results& r, std::size_t i) { return lastOf(r.interval.at.lower, r, i); }},
    {"last_upper", unit::ofOutput, "upper bound",
     [](const Results& r, std::size_t i) { return lastOf(r.interval.at.upper, r, i); }},
    {"last_sampled_least", unit::ofOutput, "the least of all samples at the last output time",
     [](const Results& r, std::size_t i) { return lastOf(r.stochastic.envelope.lower, r, i); }},
    {"last_sampled_greatest", unit::ofOutput, "the greatest of them",
     [](const Results& r, std::size_t i) { return lastOf(r.stochastic.envelope.upper, r, i); }},
    {"last_mean", unit::ofOutput, "mean of the samples there",
     [](const Results& r, std::size_t i) { return lastOf(r.stochastic.mean, r, i); }},
    {"last_deviation", unit::ofOutput, "their standard deviation",
     [](const Results& r, std::size_t i) { return lastOf(r.stochastic.deviation, r, i); }}};

// ---- The file -------------------------------------------------------------------------------------------------------

std::vector<Field> fieldsOfSweptStudy(SweepResults& s) {
  return {
      {"text", WholeText{&s.studyText}, unit::none, "the study file, word for word"},
      {"urdf", WholeText{&s.robotText}, unit::none, "the robot's file that it names, word for word; else empty"},
      {"tables", WholeText{&s.tablesText}, unit::none,
       "the tables (CSV) that it names, word for word: a JSON object, texts by name; else empty"},
      {"file", &s.studyFile, unit::none, "name of the study file"},
      {"title", &s.title, unit::none, "of the study"},
      {"analysis", &s.analysis, unit::none, "\"dynamics\", \"inverse-dynamics\", \"kinematics\" or \"equilibria\""},
      {"grid", &s.plan.isGrid, unit::none, "1: all combinations of the values; 0: a list of points"},
      {"samples", &s.samples, unit::none, "in place of the study's number of samples; 0: the study's", allowed::count},
      {"seed", &s.seed, unit::none, "in place of the study's; -1: the study's", {-1, 9.3e18}},
      {"version", &s.version, unit::none, "of Gamut"},
      {"host", &s.host, unit::none, "machine on which it began"},
      {"date", &s.date, unit::none, "when it began, UTC"}};
}

std::vector<Field> fieldsOfSweptAxis(SweepAxis& a) {
  return {{"name", &a.name, unit::none, "the number that is varied"},
          {"unit", &a.unit, unit::none, "of its values; empty: none was stated, they are in the SI unit"},
          {"own_unit", &a.ownUnit, unit::none, "that SI unit; empty where there is none"}};
}

std::vector<Field> fieldsOfSweptPoint(SweepPoint& p) {
  return {{"number", &p.number, unit::none, "of the point: the last axis runs fastest", allowed::count},
          {"state", Choice::of(p.state), unit::none,
           "\"open\" (not run yet), \"done\", \"early\" (an analysis ended before its end), \"refused\" (it cannot be "
           "run) or \"failed\""},
          {"why", &p.why, unit::none, "why not all was found; empty if it was"},
          {"verdict", &p.verdict, unit::none,
           "whether all samples stay inside: \"inside\", \"outside\", \"unresolved\", \"incomplete\"; empty where "
           "nothing was compared"},
          {"reached", &p.reached, unit::second, "up to where all analyses came"},
          {"cpu", &p.cpu, unit::second, "CPU time", allowed::finite}};
}

std::vector<Field> fieldsOfSweptOutput(OutputInfo& o) {
  return {{"name", &o.name, unit::none, "of the output"},
          {"quantity", &o.quantity, unit::none, "quantity of the mechanism"},
          {"unit", &o.unit, unit::none, "its unit"}};
}

std::vector<Field> fieldsOfSweptDemand(SweepDemand& d) {
  return {{"name", &d.name, unit::none, "of the requirement"},
          {"statement", &d.statement, unit::none, "what is demanded"}};
}

constexpr std::string_view pointPath = "/over/point", ofDemands = "/requirements/name", ofAllOutputs = "/outputs/name";

/// Names that paths of files can have.
std::string pathOfAxis(const SweepAxis& axis, std::size_t number) {
  const bool fits =
      axis.name.find('/') == axis.name.npos && axis.name != "." && axis.name != ".." && (axis.name != "point");
  return "/over/" + (fits ? axis.name : fmt::format("axis {}", number + 1));
}

/// Kept where they are, unless the axes are others: fields refer to them.
void findPaths(SweepResults& sweep) {
  std::vector<std::string> paths;
  for (std::size_t a = 0; a < sweep.plan.axes.size(); ++a) paths.push_back(pathOfAxis(sweep.plan.axes[a], a));
  if (paths != sweep.paths) sweep.paths = std::move(paths);
}

std::vector<std::string_view> planDimensions(const SweepResults& sweep) {
  if (!sweep.plan.isGrid) return {pointPath};
  return {sweep.paths.begin(), sweep.paths.end()};
}

std::vector<Field> fieldsOfAxes(SweepResults& sweep) {
  findPaths(sweep);
  std::vector<Field> fields;
  if (!sweep.plan.isGrid) fields.push_back({"point", &sweep.places, unit::none, "number of the point", {pointPath}});
  for (std::size_t a = 0; a < sweep.plan.axes.size(); ++a) {
    SweepAxis& axis = sweep.plan.axes[a];
    const std::string_view path = sweep.paths[a];
    fields.push_back(
        {path.substr(path.rfind('/') + 1), &axis.values, axis.toldUnit(), "values that it takes",
         sweep.plan.isGrid ? std::vector<std::string_view>{path} : std::vector<std::string_view>{pointPath},
         allowed::finite});
  }
  return fields;
}

std::vector<Field> fieldsOfColumns(const SweepResults& sweep, std::span<const SweepColumn> columns,
                                   std::vector<Grid>& grids, std::string_view last) {
  std::vector<std::string_view> dimensions = planDimensions(sweep);
  dimensions.push_back(last);
  grids.resize(columns.size());
  std::vector<Field> fields;
  for (std::size_t c = 0; c < columns.size(); ++c)
    fields.push_back({columns[c].name, &grids[c], columns[c].unit, columns[c].meaning, dimensions});
  return fields;
}

Group recordOf(std::string_view path, std::string_view meaning, std::function<std::vector<Field>()> fields) {
  Group group{path, meaning, "", 1, [](std::size_t) {}, {}};
  group.fields = [fields = std::move(fields)](std::size_t) { return fields(); };
  return group;
}

}  // namespace

std::span<const SweepColumn> requirementColumns() { return keptOfRequirements; }
std::span<const SweepColumn> outputColumns() { return keptOfOutputs; }

std::size_t SweepResults::count(PointState state) const {
  return static_cast<std::size_t>(std::ranges::count(points, state, &SweepPoint::state));
}

void prepare(SweepResults& sweep) {
  const std::size_t count = sweep.plan.points();
  sweep.points.assign(count, {});
  for (std::size_t i = 0; i < count; ++i) sweep.points[i].number = static_cast<std::int64_t>(i);
  sweep.places.clear();
  GridShape shape;
  if (sweep.plan.isGrid) {
    for (const SweepAxis& axis : sweep.plan.axes) shape.push_back(axis.values.size());
  } else {
    shape.push_back(count);
    sweep.places.resize(count);
    std::iota(sweep.places.begin(), sweep.places.end(), 0);
  }
  const auto grids = [&](std::size_t columns, std::size_t last) {
    GridShape whole = shape;
    whole.push_back(last);
    return std::vector<Grid>(columns, Grid(whole));
  };
  sweep.ofRequirements = grids(std::size(keptOfRequirements), sweep.requirements.size());
  sweep.ofOutputs = grids(std::size(keptOfOutputs), sweep.outputs.size());
  findPaths(sweep);
}

void put(SweepResults& sweep, const SweepPoint& found, std::span<const double> numbers) {
  const auto at = static_cast<std::size_t>(found.number);
  sweep.points.at(at) = found;
  std::size_t next = 0;
  const auto fill = [&](std::vector<Grid>& grids, std::size_t extent) {
    for (Grid& grid : grids)
      for (std::size_t i = 0; i < extent; ++i)
        grid.data[at * extent + i] = numbers.empty() ? noNumber : numbers[next++];
  };
  fill(sweep.ofRequirements, sweep.requirements.size());
  fill(sweep.ofOutputs, sweep.outputs.size());
}

std::vector<double> numbersOf(const Results& results, std::size_t outputs) {
  std::vector<double> numbers;
  for (const SweepColumn& column : keptOfRequirements)
    for (std::size_t i = 0; i < results.requirements.size(); ++i) numbers.push_back(column.of(results, i));
  for (const SweepColumn& column : keptOfOutputs)
    for (std::size_t i = 0; i < outputs; ++i) numbers.push_back(column.of(results, i));
  return numbers;
}

bool asksTheSame(const SweepResults& one, const SweepResults& other) {
  const auto isSameAxis = [](const SweepAxis& a, const SweepAxis& b) {
    return a.name == b.name && a.unit == b.unit && std::ranges::equal(a.values, b.values, [](double x, double y) {
             return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
           });
  };
  return one.studyText == other.studyText && one.robotText == other.robotText && one.tablesText == other.tablesText &&
         one.seed == other.seed && one.samples == other.samples && one.version == other.version &&
         one.plan.isGrid == other.plan.isGrid && std::ranges::equal(one.plan.axes, other.plan.axes, isSameAxis);
}

std::vector<Group> describe(SweepResults& s) {
  std::vector<Group> groups{
      groupOf("/study", "what was asked, and where the numbers come from", s, fieldsOfSweptStudy)};
  groups.push_back(listOf("/axes", "what is varied", "/axes/name", s.plan.axes, fieldsOfSweptAxis));
  groups.push_back(recordOf("/over", "the values that it takes", [&s] { return fieldsOfAxes(s); }));
  groups.push_back(listOf("/points", "how each point ended", "/points/number", s.points, fieldsOfSweptPoint));
  groups.push_back(
      listOf("/requirements", "what the motion is to keep", ofDemands, s.requirements, fieldsOfSweptDemand));
  groups.push_back(listOf("/outputs", "what was to be looked at", ofAllOutputs, s.outputs, fieldsOfSweptOutput));
  groups.push_back(recordOf("/answers", "what was found of requirements",
                            [&s] { return fieldsOfColumns(s, keptOfRequirements, s.ofRequirements, ofDemands); }));
  groups.push_back(recordOf("/motion", "what was found of outputs",
                            [&s] { return fieldsOfColumns(s, keptOfOutputs, s.ofOutputs, ofAllOutputs); }));
  return groups;
}

std::string guideToSweepFile() {
  SweepResults sweep;
  sweep.plan.axes = {{"AXIS", "its own", {0.0}}};
  sweep.requirements.resize(1);
  sweep.outputs.resize(1);
  prepare(sweep);
  std::string rows;
  for (const Group& group : describe(sweep))
    for (const Field& field : group.fields(0)) {
      std::string dimensions;
      for (const std::string_view each : dimensionsOf(group, field))
        if (const std::string path = pathOf(group, field); each != path)
          dimensions += fmt::format("{}`{}`", dimensions.empty() ? "" : " x ", each);
      rows += fmt::format("| `{}` | {} | {} | {} |\n", pathOf(group, field), field.meaning, field.unit, dimensions);
    }
  return rows;
}

}  // namespace gamut
