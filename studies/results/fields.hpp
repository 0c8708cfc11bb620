// What the parts of the results say of themselves: every field once, with its name in the file, its unit, its meaning
// and its dimensions. The writer and the reader of HDF5, `gamut info`, the comparison of two results and the tables of
// docs/results-file.md are made from this.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "analyses/table.hpp"
#include "studies/results/grid.hpp"

namespace gamut {

/// A text as it is, control characters included: a data set of its own.
struct WholeText {
  std::string* text;
};

/// The words of an enumeration, in its order, with which its values are told and kept.
template <class Enum>
inline constexpr std::array<std::string_view, 0> words{};

template <class Enum>
constexpr std::string_view wordOf(Enum value) {
  return words<Enum>.at(static_cast<std::size_t>(value));
}

/// A value of an enumeration of bytes.
struct Choice {
  unsigned char* value;
  std::span<const std::string_view> all;

  template <class Enum>
  static Choice of(Enum& value) {
    static_assert(std::is_same_v<std::underlying_type_t<Enum>, unsigned char>);
    return {reinterpret_cast<unsigned char*>(&value), words<Enum>};
  }
  std::string word() const { return std::string(all[*value]); }
  /// False of a word that is none of all.
  bool take(std::string_view word) const {
    const auto found = std::ranges::find(all, word);
    if (found != all.end()) *value = static_cast<unsigned char>(found - all.begin());
    return found != all.end();
  }
};

/// Numbers however they lie, or bounds of them, which are two in the file, NAME_lower and NAME_upper. They have a place
/// for every combination of the field's dimensions, the last one running fastest; empty ones are not there.
class Numbers {
 public:
  using Holder =
      std::variant<std::vector<double>*, Grid*, Table*, std::vector<Table>*, Envelope*, std::vector<Envelope>*>;

  template <class T, class = std::enable_if_t<std::is_constructible_v<Holder, T*>>>
  Numbers(T* holder) : holder_(holder) {}  // NOLINT(google-explicit-*): a field's value is where it lies

  const Holder& holder() const { return holder_; }
  /// What their names end in: "", or "_lower" and "_upper".
  std::vector<std::string_view> ends() const;
  /// The lists in which those of an end lie, one after the other.
  std::vector<std::vector<double>*> lists(std::size_t end = 0) const;
  /// Those of an end; put into `room` if they do not lie in one list.
  std::span<const double> all(std::size_t end, std::vector<double>& room) const;
  bool empty() const;
  bool hasShape(const GridShape& shape, bool mayBeEmpty) const;
  void take(std::size_t end, const GridShape& shape, std::vector<double> numbers) const;

 private:
  Holder holder_;
};

/// Where the value of a field lies.
using FieldValue = std::variant<double*, std::int64_t*, std::uint64_t*, bool*, std::string*, WholeText, Choice,
                                std::vector<std::int64_t>*, Numbers>;

namespace dimension {  // a path in the file, where its scale lies
inline constexpr std::string_view time = "/time", output = "/output", quantity = "/quantity",
                                  probability = "/stochastic/probability", sample = "/stochastic/kept/number",
                                  motion = "/stochastic/kept/motion_number", alpha = "/fuzzy/alpha",
                                  dispute = "/comparison/disputed/number";
}

namespace unit {
inline constexpr std::string_view none, one = "1", second = "s", byte = "bytes", ofOutput = "of the output",
                                        ofQuantity = "of the quantity";  // the last two one for each
}

/// Between which numbers every single number of a field lies, both included; NaN only where nothing is said.
struct Allowed {
  double least = -std::numeric_limits<double>::infinity(), greatest = -least;
};

namespace allowed {
inline constexpr Allowed anything{}, finite{-std::numeric_limits<double>::max(), std::numeric_limits<double>::max()},
    count{0, 9007199254740992.0}, share{0, 1};  // counts are exact in doubles too
}

struct Field {
  std::string_view name;  ///< in its group; an absolute path for what lies elsewhere
  FieldValue value;
  std::string_view unit, meaning;
  /// One that is the field's own path, and the only one, makes the field that dimension's scale, whose numbers rise.
  std::vector<std::string_view> dimensions;
  Allowed allowed;
  std::string_view indexOf;  ///< of an index: the dimension, whose extent it lies below
  bool isNoise = false;      ///< its digits follow no rule that compression could use
  bool isNew = false;        ///< files of this format may be without it, and leave it as it is

  Field(std::string_view itsName, FieldValue where, std::string_view itsUnit, std::string_view whatItIs,
        Allowed between = allowed::anything, std::string_view indexInto = "")
      : name(itsName), value(where), unit(itsUnit), meaning(whatItIs), allowed(between), indexOf(indexInto) {}
  Field(std::string_view itsName, FieldValue where, std::string_view itsUnit, std::string_view whatItIs,
        std::vector<std::string_view> itsDimensions, Allowed between = allowed::anything)
      : Field(itsName, where, itsUnit, whatItIs, between) {
    dimensions = std::move(itsDimensions);
  }
};

inline Field noise(Field field) {
  field.isNoise = true;
  return field;
}

inline Field fresh(Field field) {
  field.isNew = true;
  return field;
}

/// A group of the file: one record, whose single values are attributes, or a list of records, one data set a field.
struct Group {
  std::string_view path, meaning;
  std::string_view dimension;  ///< of a list: its first field is the scale; empty for one record
  std::size_t size = 1;        ///< records, none if it is not there
  /// Makes so many records, empty ones.
  std::function<void(std::size_t)> resize;
  /// Of record i < size, which must stay where it is. What depends on earlier groups is taken as they are now.
  std::function<std::vector<Field>(std::size_t)> fields;
  /// Whether the numbers of record i make sense together.
  std::function<bool(std::size_t)> makesSense = [](std::size_t) { return true; };
  /// Where fields stand in JSON, in the object of their part or in that of an output, if not by their names: keys with
  /// '/' between them, 0 and 1 of a list, '*' of a dimension beside times and outputs; "": nowhere.
  std::map<std::string_view, std::string_view> inJson = {};

  bool isList() const { return !dimension.empty(); }
};

/// The path of a field in the file.
std::string pathOf(const Group& group, const Field& field);

/// Whether the field is a dimension's scale.
bool isScale(const Group& group, const Field& field);

/// A group that is there always, or, of a part that says so, if it is `present`.
template <class Part>
Group groupOf(std::string_view path, std::string_view meaning, Part& part, std::vector<Field> (*fields)(Part&)) {
  Group group{path, meaning, "", 1, [](std::size_t) {}, {}};
  if constexpr (requires { part.present; }) {
    group.size = part.present ? 1 : 0;
    group.resize = [&part](std::size_t size) { part.present = size > 0; };
  }
  group.fields = [&part, fields](std::size_t) { return fields(part); };
  return group;
}

/// A list of records.
template <class Record>
Group listOf(std::string_view path, std::string_view meaning, std::string_view dimension, std::vector<Record>& records,
             std::vector<Field> (*fields)(Record&)) {
  Group group{path, meaning, dimension, records.size(), {}, {}};
  group.resize = [&records](std::size_t size) { records.assign(size, Record()); };
  group.fields = [&records, fields](std::size_t i) { return fields(records[i]); };
  return group;
}

/// How many places each dimension has.
using Extents = std::map<std::string, std::size_t, std::less<>>;
Extents extentsOf(const std::vector<Group>& groups);

/// The dimensions of a field, that of the list in front, if the group is one.
std::vector<std::string_view> dimensionsOf(const Group& group, const Field& field);

/// So many places, or none where a dimension is not there.
GridShape shapeOf(const std::vector<std::string_view>& dimensions, const Extents& extents);

/// Whether the bounds are those of an interval that is not empty, or one is NaN.
bool isInterval(double lower, double upper);

/// Whether the bounds (or the numbers themselves) are those of shares, from 0 to 1, or both are NaN: nothing is known.
bool areShares(const Grid& lower, const Grid& upper);
bool areShares(const Grid& numbers);

/// The path of the first field whose value has not the shape that its dimensions give it; empty if there is none.
std::string misshapen(const std::vector<Group>& groups);

/// The path of the first field, or list, whose numbers make no sense; empty if all do.
std::string senseless(const std::vector<Group>& groups);

/// Whether two values are of the same shape and the same to the last bit.
bool isSame(const FieldValue& one, const FieldValue& other);

/// One visitor of several functions.
template <class... Functions>
struct Visitor : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Visitor(Functions...) -> Visitor<Functions...>;

}  // namespace gamut
