// What a study file says, but for the elements of its mechanism: sections and their keys, each described once, and
// visited by the reader, which fills them in, by the guide and by the schema of study files.
//
//   s.whole({"levels", "number of alpha-cuts from 0 to 1", "11"}, 2, 101, study.levels);
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mechanics/description/units.hpp"
#include "studies/study.hpp"

namespace gamut {

/// How a setting is written, and what a guide says of it, in Markdown.
struct Key {
  std::string name;
  std::string meaning = {};
  std::string otherwise = {};  ///< what holds where it is left out; "required"
  bool isOfMotion = false;     ///< it has no meaning in kinematics
};

/// A number is in this unit unless it is written with one, and in this range.
struct NumberOf {
  std::string unit = {};  ///< empty: none
  double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
  bool isAbove = false;                   ///< the least itself is not allowed
  std::string fault = {}, expected = {};  ///< what is said of one outside: "is not positive", "a number above 0"
  double scale = 1;                       ///< what is kept, of one of the unit
  std::string* written = nullptr;         ///< the unit with which it is written goes here

  bool allows(double value) const { return (isAbove ? value > least : value >= least) && value <= most; }
};

/// From one number to another, both in their units, one of which is written as `unit`; by names.
struct StatedRange {
  Amount first, second;
  std::string unit;
};
using NamedRanges = std::map<std::string, StatedRange>;

/// What a visitor does with each kind of setting; unless it says so, what it does with any.
class Settings {
 public:
  Settings() = default;
  Settings(const Settings&) = delete;
  Settings& operator=(const Settings&) = delete;
  virtual ~Settings() = default;

  virtual void any(const Key& /*key*/) {}
  virtual void flag(const Key& key, bool& /*value*/, bool /*allowsAuto*/ = false) { any(key); }
  virtual void number(const Key& key, const NumberOf& /*of*/, double& /*value*/) { any(key); }
  virtual void integer(const Key& key, std::int64_t /*least*/, std::int64_t /*most*/, bool /*allowsAuto*/,
                       std::int64_t& /*value*/) {
    any(key);
  }
  /// One of the words, which is handed to `take`.
  virtual void choice(const Key& key, const std::vector<std::string>& /*words*/,
                      const std::function<void(const std::string&)>& /*take*/) {
    any(key);
  }
  /// A name, or so many.
  virtual void text(const Key& key, std::string& /*value*/) { any(key); }
  virtual void texts(const Key& key, std::size_t /*least*/, std::size_t /*most*/,
                     std::vector<std::string>& /*values*/) {
    any(key);
  }
  /// A table { NAME = [lower, upper] }.
  virtual void ranges(const Key& key, NamedRanges& /*ranges*/) { any(key); }
  /// A table of settings.
  virtual void table(const Key& key, const std::function<void(Settings&)>& /*describe*/) { any(key); }
  /// What its reader reads for itself; `schema` is JSON Schema, or a word for a longer one: "distribution",
  /// "membership", "elements".
  virtual void own(const Key& key, const char* /*schema*/) { any(key); }

  void optional(const Key& key, const NumberOf& of, std::optional<double>& value) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    double stated = value.value_or(none);
    number(key, of, stated);
    if (!std::isnan(stated)) value = stated;
  }
  template <class T>
  void whole(const Key& key, std::int64_t least, std::int64_t most, T& value, bool allowsAuto = false) {
    auto number = static_cast<std::int64_t>(value);
    integer(key, least, most, allowsAuto, number);
    value = static_cast<T>(number);
  }
};

/// What of a robot is taken, and how it stands.
struct RobotChoices {
  bool isFree = false;  ///< its root moves in six degrees of freedom; else it is fixed to the inertial frame
  bool damping = true, friction = true, springs = true, mimic = true;
  bool collision = false;  ///< links have the shapes by which they touch
};

/// The keys of [mechanism], those of a robot where there is one.
void describeMechanism(Settings& settings, bool hasRobot, RobotChoices& robot);

struct StudySection {
  std::string name;  ///< "interval"
  bool isList;       ///< [[output]]
  bool isRequired;
  std::string meaning;
  std::function<void(Settings& settings, Study& study)> describe;
};

/// All but the mechanism, in the order in which a file mostly has them, those of the study's analyses among them.
std::vector<StudySection> studySections(const Study& study);

/// That of this name, which there is.
StudySection studySection(const Study& study, std::string_view name);

/// The names of keys.
std::vector<std::string> keysOf(const std::function<void(Settings&)>& describe);

/// Rows of a table in Markdown: each key of the section, with `prefix` before it, its meaning and what holds otherwise.
std::string guideTo(std::string_view section, const std::string& prefix = "");

}  // namespace gamut
