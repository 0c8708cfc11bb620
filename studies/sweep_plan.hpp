// What a sweep varies: numbers that a study states, each of which takes some values, all of them together (a grid) or
// row by row (a list).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "mechanics/description/units.hpp"

namespace gamut {

/// A number that is varied, and what it is to be, in the unit in which that is stated.
struct SweepAxis {
  std::string name;            ///< "rod.length", "study.horizon"
  std::string unit;            ///< empty: none was written, so that numbers are in the SI unit
  std::vector<double> values;  ///< finite; of a grid different ones, rising
  std::string ownUnit = {};    ///< the SI unit of the number; empty where it has none, or it is not known

  /// In which people are told of the values.
  const std::string& toldUnit() const { return unit.empty() ? ownUnit : unit; }

  /// As a study states it: `0.9`, `"20 deg"`; the shortest decimal that is this double.
  std::string stated(std::size_t value) const;
};

struct SweepPlan {
  bool isGrid = true;  ///< all combinations, the last axis running fastest; else point i has value i of each axis
  std::vector<SweepAxis> axes;

  std::size_t points() const;
  /// The place of a point's value on an axis.
  std::size_t place(std::size_t point, std::size_t axis) const;
  double value(std::size_t point, std::size_t axis) const { return axes[axis].values[place(point, axis)]; }
  /// "rod.length = 0.9 m, speed = 2".
  std::string told(std::size_t point) const;
};

inline constexpr std::size_t mostSweepPoints = 100000;

/// Throws Refusal if there is no axis or too many points, if an axis or a value is there twice, or if a list's are not
/// as long as each other.
void check(const SweepPlan& plan);

/// An axis of a grid of these numbers. A plain one is in the SI unit, or, where `sharesLast`, in the unit of the next
/// one that has one. Throws Refusal for units of several kinds, a share in percent and what is not finite.
SweepAxis sweepAxis(const std::string& name, const std::vector<std::string>& numbers, bool sharesLast);

/// The same of a list, in the order in which they are stated; plain ones are in the SI unit.
SweepAxis sweepColumn(const std::string& name, const std::vector<std::string>& numbers);

/// So many numbers from one to another, evenly, the ends among them; each is the double that is nearest. As sweepAxis.
SweepAxis evenSweepAxis(const std::string& name, const std::string& from, const std::string& to, std::size_t count,
                        bool sharesLast);

/// "rod.length=0.9:1.1:21", from one to another, so many; or "speed=1, 2, 5 m/s", a list. Throws Refusal.
SweepAxis parseSweepAxis(std::string_view text);

}  // namespace gamut
