// Play of joints: where the parts of a joint may lie against each other within its clearance, as numbers. Which of them
// a joint takes, loads decide; as uncertain quantities, all are taken into account.
#pragma once

#include "mechanics/description/described.hpp"

namespace gamut {

/// Of a pin in its hole: e c (cos ψ, sin ψ) across the axis, a disc of radius c for 0 ≤ e ≤ 1 and all ψ, and `axial`
/// along it.
struct Play {
  static constexpr const char* type = "play";
  static constexpr int order = 124;  ///< in the documentation
  static constexpr const char* summary =
      "play of a pin in its hole, ahead of a `revolute` or behind it: `to` lies off `from` by `eccentricity` times "
      "`clearance`, in a `direction` across the axis, and by `axial` along it. Where `eccentricity` is uncertain from "
      "0 "
      "to 1 and `direction` from -180 deg to 180 deg, it lies anywhere in a disc; a uniform one has for the "
      "eccentricity "
      "the distribution `beta` with a = 2, b = 1";

  std::string name, from, to;
  Axis axis = axisZ;
  Expression clearance = 0.0, eccentricity = 0.0, direction = 0.0, axial = 0.0;  ///< m, 1, rad, m

  void describe(Fields& f);
  template <class S>
  void assemble(Assembler<S>& a) const;
  std::vector<Fault> faults(const RangeOf& rangeOf) const;
};

/// Of a slider in its guide: its two ends, a length l apart, lie f c and r c off the guide's axis, so that it is turned
/// by φ, sin φ = (f − r) c / l.
struct GuidePlay {
  static constexpr const char* type = "guide-play";
  static constexpr int order = 126;  ///< in the documentation
  static constexpr const char* summary =
      "play of a slider in its guide, ahead of a `prismatic` or behind it: the ends of the slider lie off the axis of "
      "the guide, by `front` and `rear` times `clearance`, each from -1 to 1; `to` lies in the middle between them, "
      "turned as they are. In space, one for each direction across";

  std::string name, from, to;
  Axis axis = axisX, across = axisY;
  Expression length = 1.0, clearance = 0.0, front = 0.0, rear = 0.0;  ///< m, m, 1, 1

  void describe(Fields& f);
  template <class S>
  void assemble(Assembler<S>& a) const;
  std::vector<Fault> faults(const RangeOf& rangeOf) const;
};

}  // namespace gamut
