// By halving a grid of the outputs' values (analyses/roots/reach.hpp).
#include "studies/analyses/workspace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "analyses/roots/reach.hpp"
#include "mechanics/description/names.hpp"
#include "mechanics/description/refusal.hpp"
#include "mechanics/postures.hpp"
#include "studies/analysis.hpp"
#include "studies/coordinate_region.hpp"
#include "studies/running/context.hpp"
#include "studies/settings.hpp"
#include "studies/words.hpp"

namespace gamut {
namespace {

std::vector<Field> fieldsOf(WorkspaceResult& w) {
  constexpr std::string_view first = "/workspace/from", second = "/workspace/beside_from";
  return w.fieldsAnd(
      {{"first", &w.first, unit::none, "name of the output whose values cells are of"},
       {"second", &w.second, unit::none, "name of the other; empty where there is one alone"},
       {"first_unit", &w.firstUnit, unit::none, "unit of the first"},
       {"second_unit", &w.secondUnit, unit::none, "unit of the second"},
       {"least", &w.least, unit::none, "area, or length, that is reached for all values in the intervals, at least"},
       {"most", &w.most, unit::none, "area, or length, that is reached for any of them, at most"},
       {"from", &w.from, unit::none, "where cells begin, by the first output, in its unit", {first}},
       {"to", &w.to, unit::none, "where they end", {first}},
       {"beside_from", &w.besideFrom, unit::none, "likewise by the second; 0 where there is none", {second}},
       {"beside_to", &w.besideTo, unit::none, "where they end; 1 where there is none", {second}},
       {"cells",
        &w.reached,
        unit::one,
        "1 all of the cell is reached for all values in the intervals, -1 none of it for any, 0 not known",
        {first, second},
        {-1, 1}}});
}

class WorkspaceAnalysis final : public AnalysisOf<WorkspaceAnalysis, WorkspaceResult> {
 public:
  std::string_view section() const override { return "workspace"; }
  std::string_view meaning() const override { return "which values of outputs can be reached"; }
  void describe(Settings& s) override {
    s.texts({"outputs", "names of one or two outputs: which of their values, together, coordinates come to", ""}, 1, 2,
            outputs_);
    s.whole({"cells", "into how many cells each output's values are divided (4 to 256)", "64"}, 4, 256, cells_);
    region_.describe(s);
  }
  bool isAsked() const override { return !outputs_.empty() || region_.isStated(); }

  std::optional<Refusal> refusal(const Study& study) const override {
    if (!isAsked()) return {};
    if (outputs_.empty()) return Refusal{"outputs", "workspace.outputs is not said", "names of one or two outputs"};
    if (study.analysis != Study::Analysis::kinematics)
      return Refusal{"outputs", "the workspace is looked for where analysis = \"kinematics\"", "no such key"};
    std::vector<std::string> names;
    for (const WantedOutput& output : study.outputs) names.push_back(output.name);
    for (const std::string& name : outputs_)
      if (std::ranges::find(names, name) == names.end())
        return Refusal{"outputs", fmt::format("unknown output '{}'", name), expectedName(name, names)};
    if (outputs_.size() == 2 && outputs_.front() == outputs_.back())
      return Refusal{"outputs", fmt::format("workspace.outputs names '{}' twice", outputs_.front()), "two outputs"};
    const Mechanism& mechanism = study.mechanism;
    try {
      requireCoordinates(mechanism, "workspaces");
    } catch (const UnfitPart& unfit) {
      return Refusal{"outputs", unfit.problem(), unfit.expected()};
    }
    const std::size_t rows = outputs_.size() + mechanism.dependents().size(), coordinates = mechanism.positions();
    if (rows > coordinates)
      return Refusal{
          "outputs",
          fmt::format("{} that {} free cannot move {} outputs, each for itself",
                      countText(static_cast<long long>(coordinates - mechanism.dependents().size()), "coordinate"),
                      rows == coordinates + 1 ? "is" : "are", outputs_.size()),
          "one output, or more joints"};
    return region_.refusal(mechanism, "workspace");
  }

  void find(Run& run, const Results& /*before*/, WorkspaceResult& result) const {
    const Machine& machine = run.machine;
    const Mechanism& mechanism = run.study.mechanism;
    const Box parameters(machine.box.begin() + static_cast<std::ptrdiff_t>(machine.states), machine.box.end());
    std::vector<Expression> expressions;
    std::vector<std::string> units;
    for (const std::string& name : outputs_) {
      const WantedOutput& output = *std::ranges::find(run.study.outputs, name, &WantedOutput::name);
      expressions.push_back(output.inUnit());
      units.push_back(output.unit);
    }
    const Program places = placesOf(mechanism, machine.freeParameters, expressions);
    const std::vector<bool> turning = turningStates(places);
    Box region;
    ReachSearch search;
    search.cells.assign(outputs_.size(), cells_);
    search.cancelled = run.watch.stop();
    const std::vector<CoordinateRegion::Side> sides = region_.sides(mechanism);
    for (std::size_t i = 0; i < sides.size(); ++i) {
      region.push_back(sides[i].range);
      search.inner.push_back(sides[i].inner);
      search.turning.push_back(sides[i].isTurn && turning[i]);
    }
    result.first = outputs_.front();
    result.firstUnit = units.front();
    if (outputs_.size() > 1) {
      result.second = outputs_.back();
      result.secondUnit = units.back();
    }
    const Box grid = outputsOver(places, outputs_.size(), region, parameters, search);
    for (std::size_t k = 0; k < grid.size(); ++k)
      if (!isCommon(grid[k]) || !(width(grid[k]) > 0)) {
        result.why = fmt::format("'{}' {}", outputs_[k],
                                 isCommon(grid[k]) ? "is the same everywhere" : "is not bounded in the region");
        return;
      }
    const Reach found = reach(places, region, parameters, grid, search);
    if (!found.isWhole) result.why = "not all of it was looked at";
    take(found, result);
  }

 private:
  static void take(const Reach& found, WorkspaceResult& result) {
    const auto cellsOf = [](const std::vector<double>& edges, std::vector<double>& from, std::vector<double>& to) {
      from.assign(edges.begin(), edges.end() - 1);
      to.assign(edges.begin() + 1, edges.end());
    };
    cellsOf(found.edges.front(), result.from, result.to);
    cellsOf(found.edges.size() > 1 ? found.edges.back() : std::vector<double>{0, 1}, result.besideFrom,
            result.besideTo);
    result.reached = Grid({result.from.size(), result.besideFrom.size()});
    Interval always(0.0), ever(0.0);
    for (std::size_t i = 0; i < result.from.size(); ++i)
      for (std::size_t j = 0; j < result.besideFrom.size(); ++j) {
        const Reached as = found.cells[i * result.besideFrom.size() + j];
        result.reached(i, j) = static_cast<double>(as);
        if (as == Reached::never) continue;
        const Interval area =
            (Interval(result.to[i]) - result.from[i]) * (Interval(result.besideTo[j]) - result.besideFrom[j]);
        ever += area;
        if (as == Reached::always) always += area;
      }
    result.least = always.lower();
    result.most = ever.upper();
  }

  std::vector<std::string> outputs_;
  int cells_ = 64;
  CoordinateRegion region_;
};

}  // namespace

std::string WorkspaceResult::unitOfArea() const {
  return second.empty() ? firstUnit : firstUnit == secondUnit ? firstUnit + "²" : firstUnit + " " + secondUnit;
}

std::int64_t WorkspaceResult::count(double kind) const { return std::ranges::count(reached.data, kind); }

std::vector<std::string> WorkspaceResult::told() const {
  if (reached.data.empty()) return {};
  const std::string what = second.empty() ? first : fmt::format("{} and {}", first, second), unit = unitOfArea();
  const auto [atLeast, atMost] = outwardText(least, most, 5);
  return {fmt::format("{}: {} {} are reached for all values at least, {} {} for any at most", what, atLeast, unit,
                      atMost, unit),
          fmt::format("of {}: {} reached, {} not reached, {} not settled",
                      countText(static_cast<long long>(reached.data.size()), "cell"), count(1), count(-1), count(0))};
}

void WorkspaceResult::describe(std::vector<Group>& groups) {
  groups.push_back(groupOf("/workspace", "which values of outputs are reached, proved", *this, fieldsOf));
  for (const char* field : {"from", "to", "beside_from", "beside_to", "cells"}) groups.back().inJson[field] = "";
}

std::unique_ptr<FurtherAnalysis> workspaceAnalysis() { return std::make_unique<WorkspaceAnalysis>(); }

}  // namespace gamut
