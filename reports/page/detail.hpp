// How much of results a page shows: it stays small enough to be opened and sent, however many outputs, times and points
// there are. What it leaves out it says, and the results hold it.
#pragma once

#include <cstddef>
#include <vector>

#include "studies/results/results.hpp"

namespace gamut {

/// A page is no larger, bytes.
inline constexpr std::size_t largestPage = 10'000'000;

struct Detail {
  std::vector<char> isPlotted;  ///< of each output: its plots over time are there
  std::vector<char>
      hasCards;  ///< likewise, of what something uncertain moves: what is possible, probable and whose doing it is
  std::size_t times = 0;       ///< that an interactive plot has at most
  std::size_t paperTimes = 0;  ///< likewise a drawing
  std::size_t rows = 0;        ///< of a table
  std::size_t machineNumbers = 0;
  std::size_t textBytes = 0;  ///< of the study
  std::size_t leftOut = 0;    ///< outputs without plots
  std::size_t folded = 0;     ///< of these have drawings that are folded away

  bool plots(std::size_t output) const { return isPlotted[output] != 0; }
  bool cards(std::size_t output) const { return hasCards[output] != 0; }
};

/// Of few outputs everything. Of many those come first that are nearest to a limit, then those that requirements are
/// about, then the others in their order. Each level shows half of what the one before does.
Detail detailOf(const Results& results, int level);

}  // namespace gamut
