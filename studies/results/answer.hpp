// What every analysis answers: how far it came, and how its part of the results is called and described.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "studies/results/fields.hpp"

namespace gamut {

struct Answer {
  bool present = false;  ///< it was asked for
  double reached = 0;    ///< s: what it says holds up to here; 0 in kinematics
  std::string why;       ///< why it ended early; empty if it did not
  double cpu = 0;        ///< s

  /// In `compare` of a study, and of the cost in JSON: "interval".
  virtual std::string_view word() const = 0;
  /// In tables and sentences: "enclosure", "4096 samples".
  virtual std::string title() const = 0;
  /// What it consists of: "4 pieces, 210 steps".
  virtual std::string amount() const = 0;
  /// Adds the groups of this part.
  virtual void describe(std::vector<Group>& groups) = 0;

  /// The fields of all answers, then those of one.
  std::vector<Field> fieldsAnd(std::vector<Field> others) {
    std::vector<Field> fields{{"reached", &reached, unit::second, "time up to which it came", {}},
                              {"why", &why, unit::none, "why it ended early; empty if it did not", {}},
                              {"cpu", &cpu, unit::second, "CPU time", {}}};
    fields.insert(fields.end(), others.begin(), others.end());
    return fields;
  }

 protected:
  ~Answer() = default;
};

}  // namespace gamut
