// In which region of the coordinates an analysis looks, as studies say it.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "studies/analysis.hpp"
#include "studies/settings.hpp"

namespace gamut {

class CoordinateRegion {
 public:
  /// Its keys: `ranges`, `angles` and `displacements`.
  void describe(Settings& settings);
  bool isStated() const { return angles_.has_value() || displacements_.has_value() || !ranges_.empty(); }
  /// What does not fit the mechanism, or what is not said.
  std::optional<FurtherAnalysis::Refusal> refusal(const Mechanism& mechanism, const std::string& section) const;

  struct Side {
    std::string name;
    Interval range;  ///< rad, m; outward
    Interval inner;  ///< the same, inward; empty of a number that is no double
    bool isTurn;     ///< it is a whole turn, no more
  };
  /// Of each coordinate that is a state, in the order of Mechanism::stateNames().
  std::vector<Side> sides(const Mechanism& mechanism) const;
  /// Of these, the units in which people are told of them: that of the range, else unitsToldOf().
  std::string units(const Study& study, std::size_t coordinates) const;

 private:
  std::optional<double> angles_, displacements_;
  NamedRanges ranges_;
  std::string angleUnit_, displacementUnit_;
};

/// The units in which people are told of the first coordinates of Mechanism::stateNames(), with ", " between them: that
/// of each as the study states it (Study::unitTold), else that in which it is looked at. `ofRanges`: by name, before
/// all others.
std::string unitsToldOf(const Study& study, std::size_t coordinates, const std::string& angles,
                        const std::string& displacements,
                        const std::map<std::string, std::string, std::less<>>& ofRanges = {});

/// A whole turn about a middle, outward.
Interval turnAbout(double middle);

}  // namespace gamut
