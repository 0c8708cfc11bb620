// Loops that cannot be closed where a machine starts, and how near they come to it.
#pragma once

#include <fmt/format.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "mechanics/description/refusal.hpp"

namespace gamut {

class OpenLoops : public UnfitPart {
 public:
  /// Where the dependent coordinates leave least open, of what was tried.
  struct Nearest {
    struct Place {
      std::string coordinate;
      double value;      ///< rad or m
      const char* unit;  ///< which
    };
    std::vector<Place> at;           ///< empty: nothing is said of it
    std::string loop;                ///< which stays open most there
    double distance = 0, angle = 0;  ///< by so much, m and rad
    bool isClosed = false;           ///< it does not, but Newton's steps do not come there
  };
  /// A number of a coordinate, or of any where there is no name, of the unit "rad" or "m", in words.
  using Tell = std::function<std::string(double value, const std::string& coordinate, const char* unit)>;

  OpenLoops(const std::string& part, std::string problem, const std::string& expected, Nearest nearest)
      : UnfitPart(part, problem + sentence(nearest, inOwnUnit), expected),
        problem_(std::move(problem)),
        nearest_(std::move(nearest)) {}

  /// The problem, and how near they come.
  std::string problemIn(const Tell& tell) const { return problem_ + sentence(nearest_, tell); }

 private:
  static std::string inOwnUnit(double value, const std::string& /*coordinate*/, const char* unit) {
    return fmt::format("{:.4g} {}", value, unit);
  }
  static std::string sentence(const Nearest& nearest, const Tell& tell) {
    if (nearest.at.empty()) return {};
    std::string where;
    for (const Nearest::Place& place : nearest.at)
      where += fmt::format("{}{} = {}", where.empty() ? "" : ", ", place.coordinate,
                           tell(place.value, place.coordinate, place.unit));
    if (nearest.isClosed) return fmt::format(": it is closed at {}, but steps from these do not come there", where);
    std::string by;
    if (nearest.distance > 0) by = tell(nearest.distance, "", "m");
    if (nearest.angle > 0) by += (by.empty() ? "" : " and ") + tell(nearest.angle, "", "rad");
    return fmt::format(": '{}' was found to stay open by {} at least, at {}", nearest.loop, by, where);
  }

  std::string problem_;
  Nearest nearest_;
};

}  // namespace gamut
