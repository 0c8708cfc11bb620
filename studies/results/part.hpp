// What every analysis finds: how it ended, and how its part of the results is called and described.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "studies/results/boxed.hpp"
#include "studies/results/fields.hpp"

namespace gamut {

struct Part {
  bool present = false;  ///< it was asked for, and there is something
  std::string why;       ///< why it is less than was asked for; empty if it is not
  std::string stopped;   ///< why the run ended before all was done; empty if it did not

  /// In tables and sentences: "enclosure", "4096 samples".
  virtual std::string title() const = 0;
  /// What it consists of: "4 pieces, 210 steps".
  virtual std::string amount() const { return {}; }
  /// CPU time, s; 0 of what is counted with another part.
  virtual double spent() const { return 0; }
  /// Adds the groups of this part.
  virtual void describe(std::vector<Group>& groups) = 0;

  /// The fields of all parts, then those of one.
  std::vector<Field> fieldsAnd(std::vector<Field> others) {
    std::vector<Field> fields{
        {"why", &why, unit::none, "why it is less than was asked for; empty if it is not"},
        {"stopped", &stopped, unit::none, "why the run ended before all of it was done; empty if it did not"}};
    fields.insert(fields.end(), others.begin(), others.end());
    return fields;
  }

 protected:
  ~Part() = default;
};

/// A part that holds up to some time.
struct TimedPart : Part {
  double reached = 0;  ///< s; 0 in kinematics
  double cpu = 0;      ///< s

  double spent() const override { return cpu; }
  /// The fields of all of these, then those of one.
  std::vector<Field> fieldsAnd(std::vector<Field> others) {
    others.insert(others.begin(), {{"reached", &reached, unit::second, "time up to which it came"},
                                   {"cpu", &cpu, unit::second, "CPU time"}});
    return Part::fieldsAnd(std::move(others));
  }

 protected:
  ~TimedPart() = default;
};

/// A part that a study asks for by `compare`: the motion as it is guaranteed, probable or possible.
struct Answer : TimedPart {
  /// In `compare`, and of the cost in JSON: "interval".
  virtual std::string_view word() const = 0;

 protected:
  ~Answer() = default;
};

/// What an analysis beside the answers finds (studies/analysis.hpp).
struct FurtherPart : TimedPart {
  virtual ~FurtherPart() = default;
  virtual std::unique_ptr<FurtherPart> copy() const = 0;
  /// Its key in JSON, and the name of its group in the file.
  virtual std::string_view key() const = 0;
  /// What is done to what the title names: "enclosed".
  virtual std::string_view verb() const = 0;
  /// What is found, in sentences of a line each, where that is not seen elsewhere.
  virtual std::vector<std::string> told() const { return {}; }
  /// What keeps a verdict from being complete: "derivatives were not enclosed to the end"; empty if nothing does.
  virtual std::string unfinished() const;
  /// Why.
  const std::string& whyUnfinished() const { return stopped.empty() ? why : stopped; }

 protected:
  FurtherPart() = default;
  FurtherPart(const FurtherPart&) = default;
  FurtherPart& operator=(const FurtherPart&) = default;
};

/// An empty one of each analysis.
std::vector<Boxed<FurtherPart>> furtherParts();

}  // namespace gamut
