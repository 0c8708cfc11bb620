// What of a machine is seen, and when: for the picture in the report.
#pragma once

#include <cstddef>
#include <vector>

#include "mechanics/skeleton.hpp"
#include "scalars/program/program.hpp"
#include "studies/machine.hpp"

namespace gamut {

/// Programs take what the machine's equations take.
struct Seen {
  Skeleton skeleton;
  std::vector<std::size_t> times;  ///< indices of output times, rising; first and last are among them
  std::vector<double> at;          ///< s: those times
  Program positions, velocities;   ///< x, y, z of every point [m, m/s]
  Program drawn;                   ///< positions, then the unit vectors of the axes
  Program heights;                 ///< of each profile, in their order, the height [m] and the speed [m/s]
  bool isEnclosed = false;         ///< the places of all points are to be bounded

  bool empty() const { return skeleton.parts.empty(); }
};

/// At most so many times, and fewer of so many points that their places exceed the second; but never fewer than the
/// third: what a page can hold.
inline constexpr std::size_t mostSeenTimes = 301, mostSeenPlaces = 3000, leastSeenTimes = 31;
/// Samples whose motions are seen.
inline constexpr std::size_t seenSamples = 6;
/// To either side of a profile's point, where its height is told.
inline constexpr std::size_t seenSteps = 50;
/// Of more moving points no places are enclosed.
inline constexpr std::size_t mostEnclosedPoints = 120;

/// Empty for a mechanism of states alone.
Seen whatIsSeen(const Machine& machine);

}  // namespace gamut
