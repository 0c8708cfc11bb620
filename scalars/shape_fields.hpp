// The words of a shape, a distribution or a membership function: what it consists of, said once by its describe() and
// visited by readers of files, which fill it in, by results, which keep its numbers, and by the guide.
//
//   void describe(ShapeFields& f) override {
//     f.support(support);
//     f.number({.key = "apex", .meaning = "the value of membership 1", .isNominal = true, .isInside = true}, apex);
//   }
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "scalars/interval.hpp"

namespace gamut {

/// One of the numbers that a membership function or a distribution is made of.
struct ShapeNumber {
  std::string name;  ///< "lower", "apex", …
  double value = 0;
  bool isOfQuantity = true;  ///< a value of the quantity, or a distance of two; otherwise without unit
};

/// What a number, or a list of them, is called in study files.
struct ShapeWord {
  std::string key;
  std::string meaning;       ///< half a sentence
  bool isOfQuantity = true;  ///< in its unit; otherwise without unit
  bool isNominal = false;    ///< the nominal value where it is not stated; otherwise it is required
  bool isInside = false;     ///< lies in the support
  bool isPositive = false;
};

/// What grows with a parameter of a distribution: its values (an event "at most v" gets less probable with it,
/// truncated or not), or they fall, or neither for certain.
enum class Trend { rises, falls, none };

/// A number, or an interval, as it is stated.
struct StatedNumber {
  Interval enclosed;
  double nearest = 0;
  std::size_t at = 0;  ///< the entry of its list, or the row of its file
};
using StatedNumbers = std::vector<StatedNumber>;

/// What cannot be, of what is stated by a key.
struct ShapeRefusal : std::invalid_argument {
  ShapeRefusal(std::string statedBy, std::optional<std::size_t> at, std::string wrong, std::string instead,
               const std::string& sentence = "")
      : std::invalid_argument(sentence.empty() ? wrong : sentence),
        key(std::move(statedBy)),
        index(at),
        problem(std::move(wrong)),
        expected(std::move(instead)) {}

  std::string key;
  std::optional<std::size_t> index;  ///< of the entry, or of the row of the file that stands for the list
  std::string problem;               ///< "the mass is negative"; of a point what follows it in a sentence
  std::string expected;
};

class ShapeFields {
 public:
  /// The degree of membership at a value.
  struct Point {
    double value, degree;
  };
  /// Of a file: its heading, or the key that names it.
  struct Column {
    std::string name;
    bool isOfQuantity = true, isNamedByKey = false;
  };

  ShapeFields() = default;
  ShapeFields(const ShapeFields&) = delete;
  ShapeFields& operator=(const ShapeFields&) = delete;
  virtual ~ShapeFields() = default;

  // Whoever visits does with each what it is for, which may be nothing.

  /// `support = [lower, upper]`, within the interval, which it is unless stated. What follows may lie inside it.
  virtual void support(Interval& /*support*/) {}
  virtual void number(const ShapeWord& /*word*/, double& /*number*/) {}
  /// Of a distribution; an interval where it is not known.
  virtual void parameter(const ShapeWord& /*word*/, Trend /*trend*/, Interval& /*number*/) {}
  /// Two numbers of these names, from one to the other.
  virtual void pair(const ShapeWord& /*word*/, const std::array<std::string, 2>& /*names*/, Interval& /*pair*/) {}
  /// `[[value, degree], ...]`, of values in the interval that do not fall; its ends, where the support ends, are
  /// rounded outward.
  virtual void points(const ShapeWord& /*word*/, std::vector<Point>& /*points*/) {}

  /// A list of numbers, unless a file stands for it; `expected` where both are missing.
  virtual void list(const ShapeWord& /*word*/, const std::string& /*expected*/, StatedNumbers& /*numbers*/,
                    bool /*mayBeEmpty*/ = false) {}
  /// The same of pairs [lower, upper].
  virtual void intervals(const ShapeWord& /*word*/, const std::string& /*expected*/, StatedNumbers& /*intervals*/) {}
  /// A CSV file that stands for the lists before; whether there is one. `columns` of rows.
  virtual bool file(const std::vector<Column>& /*wanted*/, std::vector<StatedNumbers>& /*columns*/) { return false; }
  /// These, which the lists or the file have stated, lie within the interval; what is wrong is said of the list.
  virtual void within(const ShapeWord& /*list*/, const StatedNumbers& /*numbers*/) {}
};

/// The nearest doubles, but of the least and the greatest, which are a support, those outward.
std::vector<double> roundedOutward(const StatedNumbers& numbers);

/// The numbers of a shape: "lower" and "upper" of its support, then those that describe() names; of a parameter that is
/// an interval both ends, such as "mean" and "mean, at most"; of points "value 1", "membership 1", "value 2", ...
class ShapeNumbers : public ShapeFields {
 public:
  explicit ShapeNumbers(const Interval& support)
      : found{{"lower", support.lower(), true}, {"upper", support.upper(), true}} {}
  void number(const ShapeWord& word, double& number) override;
  void parameter(const ShapeWord& word, Trend trend, Interval& number) override;
  void pair(const ShapeWord& word, const std::array<std::string, 2>& names, Interval& pair) override;
  void points(const ShapeWord& word, std::vector<Point>& points) override;

  std::vector<ShapeNumber> found;
};

}  // namespace gamut
