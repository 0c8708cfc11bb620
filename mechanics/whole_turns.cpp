#include "mechanics/whole_turns.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <utility>

#include "mechanics/assembly.hpp"
#include "scalars/recorded.hpp"

namespace gamut {
namespace {

using Turns = std::vector<std::pair<std::string, int>>;

/// Whether all states are coordinates that triangles put.
bool arePlaced(const Mechanism& mechanism, const std::vector<std::string>& freeParameters) {
  const std::vector<std::string> states = mechanism.stateNames();
  if (!mechanism.isClosed() || mechanism.areLoopsHeld() || mechanism.isStruck()) return false;
  if (states.size() != mechanism.dependents().size()) return false;
  if (std::ranges::any_of(mechanism.loops(), [](const auto& loop) { return loop.redundant != 0; })) return false;
  bool are = false;
  record(static_cast<int>(states.size()), static_cast<int>(freeParameters.size()), 1,
         [&](auto t, const auto& x, const auto& p, auto& y) {
           Assembly<Recorded> assembly(mechanism, freeParameters, p);
           assembly.setMotion(x, t);
           are = assembly.areLoopsPlaced();
           y[0] = Recorded(0.0);
         });
  return are;
}

/// Angles of the nominal machine as it moves, one after the other less than half a radian apart.
struct Course {
  std::vector<std::string> dependents, driven;  ///< names of coordinates that are angles
  std::vector<std::vector<double>> angles;      ///< of these, a row for each time
};

class NominalCourse {
 public:
  NominalCourse(const Mechanism& mechanism, double horizon) : assembly_(mechanism), horizon_(horizon) {
    for (const auto& coordinate : mechanism.coordinates()) {
      if (coordinate.kind != Coordinate::angle) continue;
      if (coordinate.isDependent)
        course.dependents.push_back(coordinate.name);
      else if (coordinate.isDriven)
        course.driven.push_back(coordinate.name);
    }
  }

  /// To the end, or to where it can be followed no farther, as at a dead point. False where it does not even start.
  bool follow() {
    constexpr double longest = 0x1p-8, shortest = 0x1p-24;  // of the horizon
    std::vector<double> x = assembly_.closedAt(assembly_.initialState(), 0);
    if (x.empty()) return false;
    note();
    double step = longest;
    for (double done = 0; done < 1;) {
      const double next = std::min(done + step, 1.0);
      std::vector<double> there = assembly_.closedAt(x, next * horizon_);
      if (there.empty() || !note()) {
        if ((step /= 2) < shortest) return done > 0;
        continue;
      }
      x = std::move(there);
      done = next;
      step = std::min(2 * step, longest);
    }
    return true;
  }

  Course course;

 private:
  /// The present angles, unless they are too far from those before.
  bool note() {
    constexpr double far = 0.5;  // rad
    std::vector<double> now;
    for (const auto* names : {&course.dependents, &course.driven})
      for (const std::string& name : *names) now.push_back(assembly_.output(name));
    if (!course.angles.empty())
      for (std::size_t i = 0; i < now.size(); ++i)
        if (!(std::abs(now[i] - course.angles.back()[i]) < far)) return false;
    course.angles.push_back(std::move(now));
    return true;
  }

  Assembly<double> assembly_;
  double horizon_;
};

/// None, then one driven angle once or twice, either way, then two of them.
std::vector<Turns> waysToTurn(const std::vector<std::string>& driven) {
  std::vector<Turns> ways = {{}};
  for (const std::string& name : driven)
    for (const int times : {1, -1, 2, -2}) ways.push_back({{name, times}});
  for (std::size_t i = 0; i < driven.size(); ++i)
    for (std::size_t j = i + 1; j < driven.size(); ++j)
      for (const int first : {1, -1})
        for (const int second : {1, -1}) ways.push_back({{driven[i], first}, {driven[j], second}});
  return ways;
}

/// How far the angle of this number comes from its course at most, whose middle this finds.
double awayFrom(AngleCourse& of, const Course& course, std::size_t number) {
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  for (const std::vector<double>& at : course.angles) {
    double away = at[number];
    for (const auto& [name, times] : of.turns) {
      const auto driven = std::ranges::find(course.driven, name) - course.driven.begin();
      away -= times * at[course.dependents.size() + static_cast<std::size_t>(driven)];
    }
    least = std::min(least, away);
    greatest = std::max(greatest, away);
  }
  constexpr double grid = 0x1p-6;  // rad: a short number
  of.middle = std::round((least + greatest) / 2 / grid) * grid;
  return (greatest - least) / 2;
}

}  // namespace

std::optional<AngleCourses> placedLoops(const Mechanism& mechanism, const std::vector<std::string>& freeParameters,
                                        double horizon) try {
  if (!arePlaced(mechanism, freeParameters)) return std::nullopt;
  NominalCourse nominal(mechanism, horizon);
  if (!nominal.follow()) return std::nullopt;
  const Course& course = nominal.course;
  AngleCourses all;
  for (std::size_t i = 0; i < course.dependents.size(); ++i) {
    constexpr double near = 1.75, most = 2.5;  // rad; the first: nothing better is looked for
    AngleCourse& best = all[course.dependents[i]];
    double away = most;
    for (Turns& turns : waysToTurn(course.driven)) {
      AngleCourse other{0, std::move(turns)};
      const double found = awayFrom(other, course, i);
      if (found < away) away = found, best = std::move(other);
      if (away < near) break;
    }
    if (!(away < most)) return std::nullopt;
  }
  return all;
} catch (const std::exception&) {  // whoever records the machine says what is wrong with it
  return std::nullopt;
}

}  // namespace gamut
