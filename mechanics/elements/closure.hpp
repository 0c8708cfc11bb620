// A loop that is closed between two frames.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanics/description/described.hpp"

namespace gamut {

struct Closure {
  static constexpr const char* type = "closure";
  static constexpr int order = 132;  ///< in the documentation
  static constexpr const char* summary =
      "closes a loop: a joint between two frames that other elements move already. As many coordinates of the loop as "
      "it takes freedoms follow from the others";

  std::string name, from, to, as = "ball";
  ExpressionVector fromPoint = {0.0, 0.0, 0.0}, toPoint = {0.0, 0.0, 0.0};  ///< m
  Axis axis = axisZ, toAxis = axisZ;
  std::vector<std::string> dependent;
  std::size_t redundant = 0;
  std::optional<HeldRows> left = std::nullopt;  ///< of a mechanism's: what of `as` does not hold anyway

  void describe(Fields& f);
  std::vector<Fault> faults(const RangeOf& rangeOf) const;
  template <class S>
  void assemble(Assembler<S>& a) const;

 private:
  HeldRows wanted() const;
  HeldRows rows() const { return left ? *left : wanted(); }
};

/// A rod without mass between points of two frames.
struct RodClosure {
  static constexpr const char* type = "rod";
  static constexpr int order = 134;  ///< in the documentation
  static constexpr const char* summary =
      "a rod without mass between points of two frames, which it keeps at a distance: it closes a loop, by one "
      "coordinate of it that follows from the others";

  std::string name, from, to;
  ExpressionVector fromPoint = {0.0, 0.0, 0.0}, toPoint = {0.0, 0.0, 0.0};  ///< m
  Expression length = 1.0;                                                  ///< m
  std::vector<std::string> dependent;
  std::size_t redundant = 0;

  void describe(Fields& f);
  std::vector<Fault> faults(const RangeOf& rangeOf) const;
  template <class S>
  void assemble(Assembler<S>& a) const;
};

}  // namespace gamut
