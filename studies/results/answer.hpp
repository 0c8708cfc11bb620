// What every analysis says of its end.
#pragma once

#include <string>
#include <vector>

#include "studies/results/fields.hpp"

namespace gamut {

struct Answer {
  bool present = false;  ///< it was asked for
  double reached = 0;    ///< s: what it says holds up to here; 0 in kinematics
  std::string why;       ///< why it ended early; empty if it did not
  double cpu = 0;        ///< s

  /// The fields of all answers, then those of one.
  std::vector<Field> fieldsAnd(std::vector<Field> others) {
    std::vector<Field> fields{{"reached", &reached, unit::second, "time up to which it came", {}},
                              {"why", &why, unit::none, "why it ended early; empty if it did not", {}},
                              {"cpu", &cpu, unit::second, "CPU time", {}}};
    fields.insert(fields.end(), others.begin(), others.end());
    return fields;
  }
};

}  // namespace gamut
