// By branch and prune over the region; stability by the motion near to each position (mechanics/rest_stability.hpp).
#include "studies/analyses/equilibria.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "analyses/flow/flow.hpp"
#include "analyses/roots/all_roots.hpp"
#include "mechanics/rest.hpp"
#include "mechanics/rest_equations.hpp"
#include "mechanics/rest_stability.hpp"
#include "scalars/evaluation/evaluate.hpp"
#include "studies/analyses/found_positions.hpp"
#include "studies/analysis.hpp"
#include "studies/coordinate_region.hpp"
#include "studies/running/context.hpp"
#include "studies/settings.hpp"
#include "studies/told.hpp"
#include "studies/words.hpp"

namespace gamut {
namespace {

std::vector<Field> fieldsOf(EquilibriaResult& e) {
  constexpr std::string_view position = "/equilibria/number", coordinate = "/equilibria/coordinate";
  return e.fieldsAnd(
      {{"coordinates", &e.coordinates, unit::none, "their names, with commas"},
       fresh({"told", &e.units, unit::none, "units in which people are told of them, with commas; empty: rad, m"}),
       {"complete", &e.isComplete, unit::none, "whether these are all in the region, for every value in the intervals"},
       {"open", &e.open, unit::one, "parts of the region in which there may be others", allowed::count},
       {"coordinate", &e.coordinate, unit::one, "their numbers, from 1", {coordinate}},
       {"number", &e.number, unit::one, "of the positions of rest, from 1", {position}},
       {"lower",
        &e.lower,
        unit::none,
        "proved bound of the coordinate at rest, for all values in the intervals, rad or m",
        {position, coordinate}},
       {"upper", &e.upper, unit::none, "upper bound", {position, coordinate}},
       {"stability",
        &e.stability,
        unit::one,
        "1 stable, -1 unstable, 0 not known; by the motion near to it, where forces of position have a potential",
        {position}}});
}

bool isWithin(const Box& a, const Box& b) {
  return std::ranges::equal(a, b, [](const Interval& x, const Interval& y) { return isSubset(x, y); });
}

/// Of the number that is widest beside its size; none where no number is wide.
std::optional<std::array<Box, 2>> halvesOf(const Box& box) {
  const auto share = [](const Interval& x) { return width(x) / magnitude(x); };  // NaN of a 0 without width
  std::size_t widest = box.size();
  for (std::size_t i = 0; i < box.size(); ++i)
    if (width(box[i]) > 0 && (widest == box.size() || share(box[i]) > share(box[widest]))) widest = i;
  if (widest == box.size()) return {};
  std::array<Box, 2> halves = {box, box};
  const double middle = midpoint(box[widest]);
  halves[0][widest] = Interval(box[widest].lower(), middle);
  halves[1][widest] = Interval(middle, box[widest].upper());
  return halves;
}

struct NearRoot {
  NearRest motion;
  Resistances resistances;
};

/// Near a root of the equations; nothing where forces have kinks there.
std::optional<NearRoot> nearRoot(const RestEquations& equations, const Box& root, const Box& parameters) {
  const auto at = [&](const Interval& off) -> std::optional<NearRoot> {
    const int n = equations.coordinates;
    Box x = root;
    for (int i = 0; i < n; ++i) x[i] += off;
    x.insert(x.end(), n, off);
    const std::vector<Interval> motion = evaluate<Interval>(equations.nearRest, x, parameters, Interval(0.0)),
                                resisting = evaluate<Interval>(equations.resisting, x, parameters, Interval(0.0));
    for (const auto* all : {&motion, &resisting})
      if (std::ranges::any_of(*all, [](const Interval& each) { return isEmpty(each); })) return {};  // no derivative
    return NearRoot{NearRest::of(n, motion), Resistances::of(n, equations.resistances, equations.masses, resisting)};
  };
  constexpr double aboutZero = 1e-100;
  const std::optional<NearRoot> near = at(Interval(0.0)), about = at(Interval(-aboutZero, aboutZero));
  const bool isSmooth =
      near && about && near->motion.isSmooth(about->motion) && near->resistances.isSmooth(about->resistances);
  return isSmooth ? near : std::nullopt;
}

/// Along the loops.
std::optional<NearRest> nearRest(const RestEquations& equations, const Box& root, const Box& parameters) {
  const std::optional<NearRoot> near = nearRoot(equations, root, parameters);
  return near ? near->motion.reduced() : std::nullopt;
}

RestStability stabilityAt(const RestEquations& equations, const Box& root, const Box& parameters, int negatives) {
  const std::optional<NearRoot> near = nearRoot(equations, root, parameters);
  if (!near || !near->resistances.areMassesPositive()) return RestStability::unknown;
  const RestStability its = stabilityOf(near->resistances, negatives);
  if (its != RestStability::unknown) return its;
  const std::optional<NearRest> reduced = near->motion.reduced();
  return reduced ? stabilityOf(*reduced, negatives) : RestStability::unknown;
}

/// The root of some of a part's parameters, if that is found soon.
std::optional<Box> rootAt(const RestEquations& equations, const RootPart& part, const Box& parameters,
                          std::size_t cells = 1000) {
  RootSearch search;
  search.mostCells = cells;
  const AllRoots there = allRoots(equations.roots, part.root, parameters, search);
  return there.families.size() == 1 ? std::optional(there.families.front().root) : std::nullopt;
}

/// Whether forces have a potential, as far as is seen at the ends of the parameters and at values between.
bool haveForcesAPotential(const RestEquations& equations, const RootBranch& family) {
  constexpr std::size_t values = 18;
  double share = 0.5;
  for (std::size_t number = 0; number < values; ++number) {
    const RootPart& part = family.parts[number * family.parts.size() / values];
    Box parameters;
    for (const Interval& each : part.parameters) {
      share = std::fmod(share + 0.6180339887498949, 1);  // of the golden section: no two values go together
      const double between = std::clamp(each.lower() + share * width(each), each.lower(), each.upper());
      parameters.emplace_back(number == 0 ? each.lower() : number + 1 == values ? each.upper() : between);
    }
    const std::optional<Box> root = rootAt(equations, part, parameters);
    const std::optional<NearRest> near = root ? nearRest(equations, *root, parameters) : std::nullopt;
    if (near && !near->hasPotential()) return false;
  }
  return true;
}

/// How many eigenvalues of K are negative at one value of the parameters, which is so at all: K is regular where a
/// position is proved for them. Nothing where forces have no potential.
std::optional<int> negativesOf(const RestEquations& equations, const RootBranch& family) {
  const RootPart& part = family.parts.front();
  Box middle;
  for (const Interval& each : part.parameters) middle.emplace_back(midpoint(each));
  const std::optional<Box> root = rootAt(equations, part, middle, 200000);
  if (!root) return {};
  const std::optional<NearRest> near = nearRest(equations, *root, middle);
  if (!near || negativeEigenvalues(near->mass, near->n) != 0) return {};  // where a joint moves no mass
  if (!near->hasPotential() || !haveForcesAPotential(equations, family)) return {};
  return negativeEigenvalues(near->stiffness, near->n);
}

/// Of a position that is proved, for all parameters: their box is halved until it is known of each part, or too many
/// are tried.
RestStability stabilityOf(const RestEquations& equations, const RootBranch& family) {
  const std::optional<int> negatives = negativesOf(equations, family);
  if (!negatives) return RestStability::unknown;
  std::set<RestStability> found;
  std::size_t tries = 64;
  for (const RootPart& part : family.parts) {
    std::vector<Box> open{part.parameters};
    while (!open.empty()) {
      const Box parameters = std::move(open.back());
      open.pop_back();
      const Box root =
          isWithin(part.parameters, parameters) ? part.root : rootAt(equations, part, parameters).value_or(part.root);
      const RestStability its = stabilityAt(equations, root, parameters, *negatives);
      if (its != RestStability::unknown) {
        found.insert(its);
        continue;
      }
      const std::optional<std::array<Box, 2>> halves = halvesOf(parameters);
      if (!halves || --tries == 0) return RestStability::unknown;
      open.insert(open.end(), halves->begin(), halves->end());
    }
  }
  return found.size() == 1 ? *found.begin() : RestStability::unknown;
}

bool meets(const Box& a, const Box& b) {
  return std::ranges::equal(a, b, [](const Interval& x, const Interval& y) { return !isDisjoint(x, y); });
}

/// The position that the machine is proved to rest in, as a function of its free parameters (mechanics/rest.hpp).
class ProvedPosition {
 public:
  explicit ProvedPosition(const Machine& machine)
      : position_(machine.rest->position()),
        parameters_(machine.freeParameters.size()),
        open_(machine.box.begin(), machine.box.begin() + position_.parameters() - static_cast<int>(parameters_)) {}

  /// Of these parameters.
  Box at(const Box& parameters) const {
    Box numbers = parameters;
    std::vector<int> narrow;
    for (const Interval& each : open_) {
      narrow.push_back(static_cast<int>(numbers.size()));
      numbers.push_back(each);
    }
    return encloseImage(position_, 0.0, numbers, {}, -1, nullptr, narrow)[0];
  }

 private:
  const Program& position_;
  std::size_t parameters_;
  Box open_;
};

class EquilibriaAnalysis final : public AnalysisOf<EquilibriaAnalysis, EquilibriaResult> {
 public:
  std::string_view section() const override { return "equilibria"; }
  std::string_view meaning() const override { return "all positions of rest in a region"; }
  void describe(Settings& s) override {
    NumberOf angle{"rad"}, displacement{"m"};
    angle.written = &angleUnit_;
    displacement.written = &displacementUnit_;
    angle.least = displacement.least = 0;
    angle.fault = displacement.fault = "is below 0";
    angle.expected = displacement.expected = "how far from the initial value";
    s.optional({"angles", "how far from their initial values angles are looked at, either way", ""}, angle, angles_);
    s.optional({"displacements", "likewise of displacements, m", ""}, displacement, displacements_);
  }
  bool isAsked() const override { return angles_.has_value() || displacements_.has_value(); }
  std::optional<Refusal> refusal(const Study& study) const override {
    if (!isAsked()) return {};
    const char* key = angles_ ? "angles" : "displacements";
    if (study.analysis != Study::Analysis::equilibria)
      return Refusal{key, "positions of rest are looked for where analysis = \"equilibria\"", "no such key"};
    const Mechanism& mechanism = study.mechanism;
    if (mechanism.stateNames().size() > mechanism.positions() + static_cast<std::size_t>(mechanism.degreesOfFreedom()))
      return Refusal{key, "all positions of rest are looked for where no element has states",
                     "no such key: without it, one position of rest is found"};
    for (const Mechanism::JointCoordinate& joint : mechanism.coordinates())
      if (!(joint.kind == Coordinate::angle ? angles_ : displacements_))
        return Refusal{key, fmt::format("how far '{}' is looked at is not said", joint.name),
                       joint.kind == Coordinate::angle ? "equilibria.angles" : "equilibria.displacements"};
    return {};
  }

  void find(Run& run, const Results& /*before*/, EquilibriaResult& result) const {
    const Machine& machine = run.machine;
    const Mechanism& mechanism = run.study.mechanism;
    const RestEquations equations = restEquations(mechanism, machine.freeParameters);
    Box region;
    std::vector<std::string> names = mechanism.stateNames();
    names.resize(mechanism.positions());
    for (std::size_t i = 0; i < names.size(); ++i) {
      const bool turns = mechanism.coordinates().find(names[i])->kind == Coordinate::angle;
      // Outward by more than reading rounds, so that a whole turn has no gap.
      const Interval start = mechanism.rangeOf(mechanism.initialState()[i]),
                     half = Interval(*(turns ? angles_ : displacements_)) * Interval(1 + 0x1p-50);
      region.push_back(hull(start - half, start + half));
      result.coordinate.push_back(static_cast<double>(i + 1));
    }
    const std::size_t coordinates = region.size();
    result.coordinates = fmt::format("{}", fmt::join(names, ", "));
    result.units = unitsToldOf(run.study, coordinates, angleUnit_, displacementUnit_);
    region.insert(region.end(), equations.multipliers.begin(), equations.multipliers.end());
    RootSearch search;
    search.cancelled = run.watch.stop();
    const Box parameters(machine.box.begin() + static_cast<std::ptrdiff_t>(machine.states), machine.box.end());
    std::optional<ProvedPosition> proved;  // with loops their multipliers are others
    if (!mechanism.isClosed()) proved.emplace(machine);
    std::size_t tries = 256;  // for parts of the parameters
    if (proved) search.known = [&](const Box& part) { return tries > 0 ? (--tries, proved->at(part)) : Box(); };
    AllRoots found = allRoots(equations.roots, region, parameters, search);
    if (proved) take(*proved, region, parameters, found);
    result.isComplete = found.isComplete();
    result.open = static_cast<std::int64_t>(found.undecided.size() + found.border.size() + found.partial.size());
    std::ranges::sort(found.families, {}, [](const RootBranch& family) {
      std::vector<double> middle;
      for (const Interval& each : family.root) middle.push_back(midpoint(each));
      return middle;
    });
    result.lower = result.upper = Grid({found.families.size(), coordinates});
    for (std::size_t k = 0; k < found.families.size(); ++k) {
      const RestStability stability = stabilityOf(equations, found.families[k]);
      result.number.push_back(static_cast<double>(k + 1));
      for (std::size_t i = 0; i < coordinates; ++i) {
        result.lower(k, i) = found.families[k].root[i].lower();
        result.upper(k, i) = found.families[k].root[i].upper();
      }
      result.stability.push_back(static_cast<std::int64_t>(stability));
    }
    if (result.isComplete) return;
    result.why =
        fmt::format("{} of the region {} not settled", countText(result.open, "part"), result.open == 1 ? "is" : "are");
    if (proved) result.why += becauseItMoves(run.study, names, proved->at(parameters), region);
  }

 private:
  /// The proved position is one of those that are found, unless the search came to no proof that it is alone.
  static void take(const ProvedPosition& proved, const Box& region, const Box& parameters, AllRoots& found) {
    const Box root = proved.at(parameters);
    Box middle;
    for (const Interval& each : parameters) middle.emplace_back(midpoint(each));
    const Box thin = proved.at(middle);
    if (!isWithin(root, region)) return;
    for (const auto* list : {&found.families, &found.border, &found.partial})
      for (const RootBranch& branch : *list)
        for (const RootPart& part : branch.parts)
          if (isWithin(middle, part.parameters) && meets(thin, part.root)) return;
    found.families.push_back({root, {}, {{parameters, root, {}}}});
  }

  /// Where weights and springs nearly balance, little moves much.
  static std::string becauseItMoves(const Study& study, const std::vector<std::string>& names, const Box& root,
                                    const Box& region) {
    constexpr double much = 0x1p-5;  // of what is looked at
    std::size_t most = 0;
    const auto share = [&](std::size_t i) { return width(root[i]) / width(region[i]); };
    for (std::size_t i = 1; i < names.size(); ++i)
      if (share(i) > share(most)) most = i;
    if (!(share(most) > much)) return {};
    const std::string own = unitOf(study.mechanism.coordinates().find(names[most])->kind);
    const Told told(own, study.unitTold(names[most], own));
    return fmt::format(
        ": one that is proved for all values moves by {} of {} with them, so nearly do its forces balance; narrower "
        "intervals settle more",
        inUnit(numberText(told.of(width(root[most])), 3), told.unit()), names[most]);
  }

  std::optional<double> angles_, displacements_;
  std::string angleUnit_, displacementUnit_;
};

}  // namespace

std::vector<std::string> EquilibriaResult::told() const {
  std::vector<std::string> lines{
      isComplete ? fmt::format("{} in the region, and no other", countText(number.size(), "position"))
                 : fmt::format("{} in the region, others may be there", countText(number.size(), "position"))};
  for (std::size_t k = 0; k < number.size(); ++k) {
    const std::string line = stability[k] > 0 ? "stable:" : stability[k] < 0 ? "unstable:" : "of unknown stability:";
    lines.push_back(line + boundsText(coordinates, units, lower, upper, k));
  }
  return lines;
}

void EquilibriaResult::describe(std::vector<Group>& groups) {
  groups.push_back(groupOf("/equilibria", "positions of rest, proved", *this, fieldsOf));
  groups.back().inJson = {{"told", ""}, {"coordinate", ""}, {"number", ""}, {"lower", "lower"}, {"upper", "upper"}};
  groups.back().makesSense = [this](std::size_t) { return areOrdered(lower, upper); };
}

std::unique_ptr<FurtherAnalysis> equilibriaAnalysis() { return std::make_unique<EquilibriaAnalysis>(); }

}  // namespace gamut
