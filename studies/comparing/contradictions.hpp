// Where two results cannot both be true of one motion: sets that are proved to hold the same number and have none in
// common. There is no tolerance, but for samples, which may be off by their measured error.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "studies/comparing/relation.hpp"
#include "studies/comparing/shared.hpp"

namespace gamut {

struct Contradiction {
  enum class Of : unsigned char {
    enclosure,
    tube,            ///< over the time since the output time before
    plainIntervals,  ///< of kinematics
    alphaCut,
    sample,  ///< of the one, outside the enclosure of the other
    distribution,
    mean,
    deviation,
    firstIndex,  ///< of Sobol'
    totalIndex,
    requirement  ///< its guaranteed answers
  };

  Of of = Of::enclosure;
  /// Both are of the same motion and of the same values, so that one of them is wrong; otherwise the models differ.
  bool isProof = false;
  std::string name{}, unit{};                            ///< of the output; of the requirement
  std::string detail{};                                  ///< the quantity of an index; the words of a requirement
  double at = std::numeric_limits<double>::quiet_NaN();  ///< the level of an alpha-cut; the value of a distribution
  std::set<double> times{};                              ///< s: all at which that is so; the rest is of the worst
  double time = 0, distance = 0;                         ///< s; between both sets
  double lower = 0, upper = 0;                           ///< of the first: of a sample, least and greatest
  double otherLower = 0, otherUpper = 0;                 ///< of the second
  bool isSampleOfFirst = false;
};

template <>
inline constexpr std::array<std::string_view, 11> words<Contradiction::Of>{
    "enclosure", "tube",      "plain_intervals", "alpha_cut",   "sample",     "distribution",
    "mean",      "deviation", "first_index",     "total_index", "requirement"};

struct Contradictions {
  std::vector<Contradiction> found;
  std::vector<Contradiction> undecided;  ///< samples outside by so little that their error may be the reason
  std::size_t compared = 0;              ///< pairs of sets, without which nothing can be said
};

Contradictions contradictionsOf(const Results& first, const Results& second, const Shared& shared,
                                const Relation& relation);

}  // namespace gamut
