// By branch and prune over the region. Of an angle that may be anywhere in a whole turn, and that equations take by its
// sine and cosine alone, the turn begins where no posture is: so its seam neither doubles nor cuts one.
#include "studies/analyses/postures.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "analyses/roots/all_roots.hpp"
#include "mechanics/description/names.hpp"
#include "mechanics/description/refusal.hpp"
#include "mechanics/postures.hpp"
#include "scalars/evaluation/evaluate.hpp"
#include "studies/analyses/found_positions.hpp"
#include "studies/analysis.hpp"
#include "studies/coordinate_region.hpp"
#include "studies/running/context.hpp"
#include "studies/settings.hpp"
#include "studies/words.hpp"

namespace gamut {
namespace {

std::vector<Field> fieldsOf(PosturesResult& p) {
  constexpr std::string_view posture = "/postures/number", coordinate = "/postures/coordinate";
  return p.fieldsAnd(
      {{"goal", &p.goal, unit::none, "which frame is where; empty where loops alone say it"},
       {"coordinates", &p.coordinates, unit::none, "their names, with commas"},
       fresh({"told", &p.units, unit::none, "units in which people are told of them, with commas; empty: rad, m"}),
       {"complete", &p.isComplete, unit::none, "whether these are all in the region, for every value in the intervals"},
       {"open", &p.open, unit::one, "parts of the region in which there may be others", allowed::count},
       {"coordinate", &p.coordinate, unit::one, "their numbers, from 1", {coordinate}},
       {"number", &p.number, unit::one, "of the postures, from 1", {posture}},
       {"lower",
        &p.lower,
        unit::none,
        "proved bound of the coordinate, for all values in the intervals, rad or m",
        {posture, coordinate}},
       {"upper", &p.upper, unit::none, "upper bound", {posture, coordinate}},
       {"always",
        &p.always,
        unit::one,
        "1 it is there for all values in the intervals, 0 for some, or in the region for some",
        {posture}}});
}

/// Those in which the mechanism's quantities are free, with their ranges.
std::pair<std::vector<std::string>, Box> freeQuantitiesOf(const Study& study) {
  std::pair<std::vector<std::string>, Box> free;
  for (const UncertainQuantity& each : study.uncertain)
    if (study.mechanism.isFreeParameter(each.quantity)) {
      free.first.push_back(each.quantity);
      free.second.push_back(each.uncertain.range);
    }
  return free;
}

/// Cuts whole turns open where no root is.
class Turns {
 public:
  Turns(std::vector<CoordinateRegion::Side> sides, const std::vector<bool>& turning) {
    for (std::size_t i = 0; i < sides.size(); ++i) {
      region.push_back(sides[i].range);
      inner_.push_back(sides[i].inner);
      initial_.push_back(midpoint(sides[i].range));
      isTurn_.push_back(sides[i].isTurn && turning[i]);
    }
  }

  /// Whether a seam is where a root may be, and could be elsewhere, where it is put then.
  bool reopen(const AllRoots& found) {
    bool isElsewhere = false;
    for (std::size_t i = 0; i < region.size(); ++i) {
      if (!isTurn_[i] || !isAtSeam(found, i)) continue;
      // The widest gap between roots round the turn.
      std::vector<std::pair<double, double>> taken;
      forEach(found, [&](const Box& root) {
        if (width(root[i]) >= turn) return;
        const double begin = std::remainder(root[i].lower(), turn);
        taken.emplace_back(begin, begin + width(root[i]));
      });
      if (taken.empty()) continue;
      std::ranges::sort(taken);
      double end = taken.front().second, widest = 0, seam = 0;
      for (std::size_t k = 1; k <= taken.size(); ++k) {
        const double next = k < taken.size() ? taken[k].first : taken.front().first + turn;
        if (next - end > widest) widest = next - end, seam = 0.5 * (end + next);
        if (k < taken.size()) end = std::max(end, taken[k].second);
      }
      constexpr double least = 1e-6;  // rad
      if (widest < least) continue;
      region[i] = turnAbout(seam + 0.5 * turn);
      isElsewhere = true;
    }
    return isElsewhere;
  }

  /// Whether roots may be there twice, at both ends of a turn.
  bool isAtSeam(const Box& root) const {
    for (std::size_t i = 0; i < region.size(); ++i)
      if (isTurn_[i] && isAtSeam(root[i], region[i])) return true;
    return false;
  }

  /// With each angle of a turn near to where it is at first.
  Box nearStart(Box root) const {
    for (std::size_t i = 0; i < region.size(); ++i)
      if (isTurn_[i])
        if (const double turns = std::round((midpoint(root[i]) - initial_[i]) / turn); turns != 0)
          root[i] = root[i] - Interval(turns) * twoPi();
    return root;
  }

  /// Whether it is within what is stated, not just what that is widened to.
  bool isInside(const Box& root) const {
    for (std::size_t i = 0; i < region.size(); ++i)
      if (!isTurn_[i] && !isSubset(root[i], inner_[i])) return false;
    return true;
  }

  Box region;

 private:
  static constexpr double turn = 6.283185307179586;

  template <class Do>
  static void forEach(const AllRoots& found, const Do& act) {
    for (const auto* list : {&found.families, &found.border, &found.partial})
      for (const RootBranch& branch : *list) act(branch.root);
    for (const UndecidedRoots& each : found.undecided) act(each.states);
  }
  static bool isAtSeam(const Interval& x, const Interval& range) {
    constexpr double little = 1e-9;  // rad, more than the turn's ends overlap by
    return x.lower() < range.lower() + little || x.upper() > range.upper() - little;
  }
  /// What is not decided is open wherever the seam is.
  bool isAtSeam(const AllRoots& found, std::size_t i) const {
    for (const auto* list : {&found.families, &found.border, &found.partial})
      for (const RootBranch& branch : *list)
        if (isAtSeam(branch.root[i], region[i])) return true;
    return false;
  }

  Box inner_;
  std::vector<double> initial_;
  std::vector<bool> isTurn_;
};

class PosturesAnalysis final : public AnalysisOf<PosturesAnalysis, PosturesResult> {
 public:
  std::string_view section() const override { return "postures"; }
  std::string_view meaning() const override { return "all postures in which a frame is where it shall be"; }
  void describe(Settings& s) override {
    s.text({"frame", "which frame of the mechanism shall be at its goal; none: loops alone are closed", ""}, frame_);
    s.text({"goal", "the frame that it shall be at", "required with `frame`"}, goal_);
    s.choice({"match",
              "what shall be the same: `\"position\"`, `\"axis\"` (position and direction of the z-axis) or `\"pose\"` "
              "(position and orientation)",
              "`\"pose\"`"},
             {"position", "axis", "pose"}, [this](const std::string& word) {
               match_ = word == "position" ? PostureMatch::position
                        : word == "axis"   ? PostureMatch::axis
                                           : PostureMatch::pose;
             });
    region_.describe(s);
  }
  bool isAsked() const override { return !frame_.empty() || !goal_.empty() || region_.isStated(); }

  std::optional<Refusal> refusal(const Study& study) const override {
    if (!isAsked()) return {};
    const Mechanism& mechanism = study.mechanism;
    const char* key = !frame_.empty() ? "frame" : "goal";
    if (study.analysis != Study::Analysis::kinematics)
      return Refusal{key, "postures are looked for where analysis = \"kinematics\"", "no such key"};
    for (const auto& [word, name, other] : {std::tuple{"frame", frame_, "goal"}, {"goal", goal_, "frame"}}) {
      if (name.empty() && (word == std::string_view("frame") ? !goal_.empty() : !frame_.empty()))
        return Refusal{other, fmt::format("postures.{} is not said", word), "both postures.frame and postures.goal"};
      if (!name.empty() && std::ranges::find(mechanism.frames(), name) == mechanism.frames().end())
        return Refusal{word, fmt::format("unknown frame '{}'", name), expectedName(name, mechanism.frames())};
    }
    try {
      requireCoordinates(mechanism, "postures");
      if (std::optional<Refusal> refusal = region_.refusal(mechanism, "postures")) return refusal;
      const auto [names, ranges] = freeQuantitiesOf(study);
      postureEquations(mechanism, names, ranges, goal());
    } catch (const UnfitPart& unfit) {
      return Refusal{key, unfit.problem(), unfit.expected()};
    }
    return {};
  }

  void find(Run& run, const Results& /*before*/, PosturesResult& result) const {
    const Machine& machine = run.machine;
    const Mechanism& mechanism = run.study.mechanism;
    const Box parameters(machine.box.begin() + static_cast<std::ptrdiff_t>(machine.states), machine.box.end());
    const PostureEquations equations = postureEquations(mechanism, machine.freeParameters, parameters, goal());
    Turns turns(region_.sides(mechanism), turningStates(equations.also));
    RootSearch search;
    search.also = &equations.also;
    search.cancelled = run.watch.stop();
    AllRoots found = allRoots(equations.roots, turns.region, parameters, search);
    constexpr int tries = 3;
    for (int k = 0; k < tries && turns.reopen(found); ++k)
      found = allRoots(equations.roots, turns.region, parameters, search);

    if (goal()) result.goal = fmt::format("{} at {}", frame_, goal_);
    result.coordinates = fmt::format("{}", fmt::join(equations.coordinates, ", "));
    result.units = region_.units(run.study, equations.coordinates.size());
    for (std::size_t i = 0; i < equations.coordinates.size(); ++i)
      result.coordinate.push_back(static_cast<double>(i + 1));
    result.open = static_cast<std::int64_t>(found.undecided.size());
    result.isComplete = found.undecided.empty();
    std::vector<std::pair<Box, bool>> postures;
    const auto take = [&](const std::vector<RootBranch>& branches, bool isAlways) {
      for (const RootBranch& branch : branches) {
        const std::optional<bool> isMeant = isMeantAt(equations, branch);
        if (isMeant && !*isMeant) continue;
        if (!isMeant || turns.isAtSeam(branch.root)) {
          ++result.open;
          result.isComplete = false;
          continue;
        }
        const bool isSure = isAlways && turns.isInside(branch.root);
        result.isComplete = result.isComplete && isSure;
        postures.emplace_back(turns.nearStart(branch.root), isSure);
      }
    };
    take(found.families, true);
    take(found.border, false);
    take(found.partial, false);
    std::ranges::sort(postures, {}, [](const auto& posture) {
      std::vector<double> middle;
      for (const Interval& each : posture.first) middle.push_back(midpoint(each));
      return middle;
    });
    result.lower = result.upper = Grid({postures.size(), result.coordinate.size()});
    for (std::size_t k = 0; k < postures.size(); ++k) {
      result.number.push_back(static_cast<double>(k + 1));
      result.always.push_back(postures[k].second ? 1 : 0);
      for (std::size_t i = 0; i < result.coordinate.size(); ++i) {
        result.lower(k, i) = postures[k].first[i].lower();
        result.upper(k, i) = postures[k].first[i].upper();
      }
    }
    if (result.open > 0)
      result.why = fmt::format("{} of the region {} not settled", countText(result.open, "part"),
                               result.open == 1 ? "is" : "are");
    else if (!result.isComplete)
      result.why = "some postures are there for some values only, or leave the region";
  }

 private:
  std::optional<PostureGoal> goal() const {
    if (frame_.empty()) return {};
    return PostureGoal{frame_, goal_, match_};
  }

  /// The same all along a branch: no root lies where the sign changes.
  static std::optional<bool> isMeantAt(const PostureEquations& equations, const RootBranch& branch) {
    if (!equations.meant) return true;
    for (const RootPart& part : branch.parts) {
      const Interval sign = evaluate<Interval>(*equations.meant, part.root, part.parameters).front();
      if (sign.lower() > 0) return true;
      if (sign.upper() < 0) return false;
    }
    return {};
  }

  std::string frame_, goal_;
  PostureMatch match_ = PostureMatch::pose;
  CoordinateRegion region_;
};

}  // namespace

std::vector<std::string> PosturesResult::told() const {
  std::vector<std::string> lines{fmt::format("{}{} in the region, {}", goal.empty() ? "" : goal + ": ",
                                             countText(number.size(), "posture"),
                                             isComplete ? "and no other"
                                             : open > 0 ? "others may be there"
                                                        : "and no other, but not for all values")};
  for (std::size_t k = 0; k < number.size(); ++k) {
    const std::string line =
        always[k] != 0 ? fmt::format("{}:", number[k]) : fmt::format("{}, for some values:", number[k]);
    lines.push_back(line + boundsText(coordinates, units, lower, upper, k));
  }
  return lines;
}

void PosturesResult::describe(std::vector<Group>& groups) {
  groups.push_back(groupOf("/postures", "postures, proved", *this, fieldsOf));
  groups.back().inJson = {{"told", ""}, {"coordinate", ""}, {"number", ""}, {"lower", "lower"}, {"upper", "upper"}};
  groups.back().makesSense = [this](std::size_t) { return areOrdered(lower, upper); };
}

std::unique_ptr<FurtherAnalysis> posturesAnalysis() { return std::make_unique<PosturesAnalysis>(); }

}  // namespace gamut
