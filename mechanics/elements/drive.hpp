// A drive: a joint's motion is given as an expression of time.
#pragma once

#include "mechanics/description/described.hpp"

namespace gamut {

/// A motion that is the height of a profile, such as a road, over which the machine goes.
struct DrivenProfile {
  Expression speed = 0.0;  ///< m/s; 0: the motion is none
  Axis along = axisX;      ///< in the frame that carries the joint
};

struct Drive {
  static constexpr const char* type = "drive";
  static constexpr int order = 260;  ///< in the documentation
  static constexpr const char* summary =
      "a joint's coordinate as an expression of time `t`, instead of a state; its rate and acceleration follow";

  std::string name, joint;
  Expression position = 0.0;  ///< rad or m
  DrivenProfile profile = {};

  void describe(Fields& f);
  template <class S>
  void assemble(Assembler<S>& a) const;
};

struct TableDrive {
  static constexpr const char* type = "table-drive";
  static constexpr int order = 270;  ///< in the documentation
  static constexpr const char* summary =
      "a joint's coordinate by a table in a CSV file, joined by a natural cubic spline; rate and acceleration follow, "
      "and before and behind the table it goes on at a steady rate";

  std::string name, joint;
  TimeTable table = {};  ///< rad or m
  DrivenProfile profile = {};

  void describe(Fields& f);
  template <class S>
  void assemble(Assembler<S>& a) const;
};

}  // namespace gamut
