#include "mechanics/postures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string_view>
#include <utility>

#include "mechanics/assembly.hpp"
#include "mechanics/description/refusal.hpp"
#include "scalars/evaluation/evaluate.hpp"
#include "scalars/recorded.hpp"

namespace gamut {
namespace {

/// The name of an equation, and which of its records it is.
struct Row {
  std::string name;
  std::size_t output;
};

/// Of all that is recorded: equations of loops, then of the goal; the sign; what holds at the goal besides.
struct Recording {
  Program program;
  std::vector<Row> rows;
  std::vector<std::size_t> also;
  std::optional<std::size_t> meant;
};

/// Moves it there, at rest.
void stand(Assembly<Recorded>& assembly, const Mechanism& mechanism, std::span<const Recorded> coordinates) {
  std::vector<Recorded> x(mechanism.stateNames().size(), Recorded(0.0));
  std::ranges::copy(coordinates, x.begin());
  assembly.setState(x);
}

Recording recorded(const Mechanism& mechanism, const std::vector<std::string>& freeParameters,
                   const std::optional<PostureGoal>& goal) {
  Recording recording;
  const std::size_t n = mechanism.positions();
  const int loops = static_cast<int>(mechanism.dependents().size());
  std::size_t count = 0;
  for (int i = 0; i < loops; ++i) recording.rows.push_back({"", count++});
  if (goal) {
    for (const char* axis : {"x", "y", "z"})
      recording.rows.push_back({fmt::format("{}.position.{}", goal->frame, axis), count++});
    if (goal->match == PostureMatch::axis)
      for (const char* axis : {"x", "y"})
        recording.rows.push_back(
            {fmt::format("the z-axis of '{}' along the {}-axis of '{}'", goal->frame, axis, goal->goal), count++});
    if (goal->match == PostureMatch::pose)
      for (const char* axis : {"x", "y", "z"})
        recording.rows.push_back({fmt::format("the turn of '{}' about {}", goal->frame, axis), count++});
    if (goal->match != PostureMatch::position) {
      recording.meant = count++;
      for (int k = 0; k < (goal->match == PostureMatch::axis ? 3 : 9); ++k) recording.also.push_back(count++);
    }
  }
  recording.program =
      record(static_cast<int>(n), static_cast<int>(freeParameters.size()), static_cast<int>(count),
             [&](auto, const auto& q, const auto& p, auto& y) {
               Assembly<Recorded> assembly(mechanism, freeParameters, p);
               std::vector<Recorded> x(mechanism.stateNames().size(), Recorded(0.0));
               std::copy_n(q.begin(), n, x.begin());
               assembly.setState(x);
               std::size_t at = 0;
               for (const Recorded& row : assembly.system().residuals()) y[at++] = row;
               if (!goal) return;
               const Frame<Recorded>&frame = assembly.frame(goal->frame), &wanted = assembly.frame(goal->goal);
               const Vector3<Recorded> place = frame.positionInInertial(), there = wanted.positionInInertial();
               for (int i = 0; i < 3; ++i) y[at++] = place[i] - there[i];
               const Matrix3<Recorded>&t = frame.R, &g = wanted.R;
               const auto product = [&](int i, int j) {  // t_i·g_j
                 return Recorded(t(0, i) * g(0, j) + t(1, i) * g(1, j) + t(2, i) * g(2, j));
               };
               if (goal->match == PostureMatch::axis) {
                 for (int j = 0; j < 3; ++j) y[at++] = product(2, j);
                 for (int i = 0; i < 3; ++i) y[at++] = t(i, 2) - g(i, 2);
               }
               if (goal->match == PostureMatch::pose) {
                 for (int i = 0; i < 3; ++i) {
                   const int j = (i + 1) % 3, k = (i + 2) % 3;
                   Recorded sum(0.0);
                   for (int axis = 0; axis < 3; ++axis) sum = sum + (g(j, axis) * t(k, axis) - g(k, axis) * t(j, axis));
                   y[at++] = sum;
                 }
                 y[at++] = product(0, 0) + product(1, 1) + product(2, 2);
                 for (int i = 0; i < 3; ++i)
                   for (int axis = 0; axis < 3; ++axis) y[at++] = t(i, axis) - g(i, axis);
               }
             });
  return recording;
}

Program chosen(const Program& from, const std::vector<std::size_t>& outputs) {
  return record(from.states(), from.parameters(), static_cast<int>(outputs.size()),
                [&](const auto& t, const auto& x, const auto& p, auto& y) {
                  const std::vector<Recorded> values = written(from, {x.begin(), x.end()}, {p.begin(), p.end()}, t);
                  for (std::size_t i = 0; i < outputs.size(); ++i) y[i] = values[outputs[i]];
                });
}

}  // namespace

void requireCoordinates(const Mechanism& mechanism, const std::string& what) {
  const std::vector<std::string> names = mechanism.stateNames();
  for (std::size_t i = 0; i < mechanism.positions(); ++i)
    if (mechanism.coordinates().find(names[i]) == nullptr)
      throw UnfitPart(names[i],
                      fmt::format("'{}' is no angle or displacement of a joint, of which {} ask", names[i], what),
                      "hinges and sliders in place of balls, free frames and what rolls");
  if (names.size() > mechanism.positions() + static_cast<std::size_t>(mechanism.degreesOfFreedom()))
    throw UnfitPart(names.back(),
                    fmt::format("'{}' is a state of its own, of which {} know nothing", names.back(), what),
                    "no element with a state");
  if (mechanism.positions() == 0)
    throw UnfitPart("", fmt::format("no coordinate is free, as {} need", what), "a joint without a drive");
}

PostureEquations postureEquations(const Mechanism& mechanism, const std::vector<std::string>& freeParameters,
                                  const Box& parameters, const std::optional<PostureGoal>& goal) {
  requireCoordinates(mechanism, "postures");
  const Recording all = recorded(mechanism, freeParameters, goal);
  const std::size_t n = mechanism.positions();
  std::vector<std::size_t> rows, also;
  const std::vector<Interval> values = evaluate<Interval>(all.program, Box(n, Interval(0.0)), parameters);
  for (const Row& row : all.rows) {
    also.push_back(row.output);
    if (!all.program.isInvariant(all.program.outputNodes()[row.output]) || row.name.empty()) {
      rows.push_back(row.output);
      continue;
    }
    if (const Interval& value = values[row.output]; !isEqual(value, Interval(0.0)))
      throw UnfitPart(goal->frame,
                      fmt::format("no coordinate changes {}, which {} as of '{}'", row.name,
                                  contains(value, 0.0) ? "is not known to be just" : "is not", goal->goal),
                      "a goal that the frame can come to, of the same numbers in what no joint changes");
  }
  if (rows.size() != n) {
    const std::string count = fmt::format("{} equation{} for {} coordinate{}", rows.size(), rows.size() == 1 ? "" : "s",
                                          n, n == 1 ? "" : "s");
    const std::string what = goal ? fmt::format("'{}' at '{}' is {}", goal->frame, goal->goal, count)
                                  : fmt::format("closed loops are {}", count);
    throw UnfitPart(goal ? goal->frame : mechanism.stateNames().front(), what,
                    rows.size() < n
                        ? fmt::format("as many: drives for {} of the coordinates, or {}", n - rows.size(),
                                      goal ? "a match that asks for more" : "a frame that shall be at a goal")
                        : "as many: a match that asks for less, or a goal in whose axes what no joint changes is zero");
  }
  PostureEquations equations;
  equations.coordinates = mechanism.stateNames();
  equations.coordinates.resize(n);
  equations.roots = chosen(all.program, rows);
  also.insert(also.end(), all.also.begin(), all.also.end());
  equations.also = chosen(all.program, also);
  if (all.meant) equations.meant = chosen(all.program, {*all.meant});
  return equations;
}

Program placesOf(const Mechanism& mechanism, const std::vector<std::string>& freeParameters,
                 const std::vector<Expression>& expressions) {
  const std::size_t loops = mechanism.dependents().size();
  return record(static_cast<int>(mechanism.positions()), static_cast<int>(freeParameters.size()),
                static_cast<int>(expressions.size() + loops), [&](auto, const auto& q, const auto& p, auto& y) {
                  Assembly<Recorded> assembly(mechanism, freeParameters, p);
                  stand(assembly, mechanism, q);
                  std::size_t at = 0;
                  for (const Expression& expression : expressions) y[at++] = assembly.output(expression);
                  for (const Recorded& row : assembly.system().residuals()) y[at++] = row;
                });
}

std::vector<bool> turningStates(const Program& program) {
  // Of each node by how many turns it goes on where the state does by one, as far as that is always the same.
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  std::vector<bool> turning;
  for (int state = 0; state < program.states(); ++state) {
    std::vector<double> turns;
    for (int i = 0; i < static_cast<int>(program.nodes().size()); ++i) {
      const Node& n = program.nodes()[i];
      const auto factor = [&](int node) {
        if (program.nodes()[node].op != Op::constant) return unknown;
        const Interval& value = program.constants()[program.nodes()[node].a];
        return isThin(value) && std::abs(value.lower()) < 0x1p20 && std::trunc(value.lower()) == value.lower()
                   ? value.lower()
                   : unknown;
      };
      bool isFixed = true;  // its operands go on by nothing
      detail::forEachOperand(program.table(), i, [&](int operand) { isFixed = isFixed && turns[operand] == 0; });
      double by = isFixed ? 0 : unknown;
      if (n.op == Op::state) by = n.a == state ? 1 : 0;
      if (n.op == Op::add) by = turns[n.a] + turns[n.b];
      if (n.op == Op::sub) by = turns[n.a] - turns[n.b];
      if (n.op == Op::neg) by = -turns[n.a];
      if (n.op == Op::mul && !isFixed)
        by = turns[n.b] == 0 ? turns[n.a] * factor(n.b) : turns[n.a] == 0 ? factor(n.a) * turns[n.b] : unknown;
      // Of the functions that programs hold these two are the same a whole turn on.
      if (const std::string_view name = nameOf(n.op); (name == "sin" || name == "cos") && !std::isnan(turns[n.a]))
        by = 0;
      turns.push_back(by);
    }
    bool isTurning = true;
    for (const int output : program.outputNodes()) isTurning = isTurning && turns[output] == 0;
    turning.push_back(isTurning);
  }
  return turning;
}

}  // namespace gamut
