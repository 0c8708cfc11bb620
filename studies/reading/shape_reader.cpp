// How probable and how possible the values of an uncertain quantity are, as a study states it: by what distributions
// and membership functions say of themselves.
#include "studies/reading/shape_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "analyses/consistency.hpp"
#include "studies/reading/table_reader.hpp"
#include "studies/words.hpp"

namespace gamut {
namespace {

constexpr Dimension unitless{};

std::string numberIn(const Dimension& dimension) {
  return dimension == unitless ? "a number without unit" : fmt::format("a number in {}", unitOf(dimension));
}
constexpr const char* induced = "induced";

/// The words of a shape.
class ShapeKeys : public ShapeFields {
 public:
  template <class Type>
  explicit ShapeKeys(const Type& type) {
    type()->describe(*this);
  }

  void support(Interval& /*support*/) override { words.push_back({.key = "support", .meaning = ""}); }
  void number(const ShapeWord& word, double& /*number*/) override { words.push_back(word); }
  void parameter(const ShapeWord& word, Trend /*trend*/, Interval& /*number*/) override { words.push_back(word); }
  void pair(const ShapeWord& word, const std::array<std::string, 2>& names, Interval& /*pair*/) override {
    words.push_back(word);
    words.back().meaning = fmt::format("`[{}, {}]`, {}", names[0], names[1], word.meaning);
  }
  void points(const ShapeWord& word, std::vector<Point>& /*points*/) override { words.push_back(word); }
  void list(const ShapeWord& word, const std::string& /*expected*/, StatedNumbers& /*numbers*/,
            bool /*mayBeEmpty*/) override {
    words.push_back(word);
  }
  void intervals(const ShapeWord& word, const std::string& /*expected*/, StatedNumbers& /*intervals*/) override {
    words.push_back(word);
  }
  bool file(const std::vector<Column>& wanted, std::vector<StatedNumbers>& /*columns*/) override {
    std::vector<std::string> headings;
    for (const Column& column : wanted)
      if (!column.isNamedByKey) headings.push_back("`" + column.name + "`");
    const std::string named = headings.empty() ? "" : fmt::format(", with columns {}", fmt::join(headings, ", "));
    words.push_back({.key = "file", .meaning = "a CSV file instead" + named});
    for (const Column& column : wanted)
      if (column.isNamedByKey) words.push_back({.key = column.name, .meaning = "the name of its column"});
    return false;
  }

  std::vector<std::string> keys() const {
    std::vector<std::string> keys;
    for (const ShapeWord& word : words) keys.push_back(word.key);
    return keys;
  }

  std::vector<ShapeWord> words;
};

/// A table of the guide.
template <class Type>
std::string tableOf(const char* heading, const std::vector<Type>& types) {
  std::string text = fmt::format("| {} | what it is | its keys |\n|---|---|---|\n", heading);
  for (const Type& type : types) {
    std::vector<std::string> keys;
    for (const ShapeWord& word : ShapeKeys(type).words)
      keys.push_back(fmt::format("`{}`{}{}{}{}", word.key, word.meaning.empty() ? "" : ": ", word.meaning,
                                 word.isOfQuantity ? "" : ", without unit",
                                 word.isNominal ? "; the nominal value unless given" : ""));
    text += fmt::format("| `{}` | {} | {} |\n", type()->name(), type()->summary(), fmt::join(keys, "<br>"));
  }
  return text;
}

/// The lists of a shape, or the file that stands for them.
class StatedShape : public ShapeFields {
 public:
  StatedShape(const TableFiles& files, const TomlSection& section, const UncertainQuantity& quantity)
      : section_(section),
        source_(section.source()),
        files_(files),
        quantity_(quantity),
        dimension_(dimensionOf(quantity.unit)),
        file_(section.find("file")) {}

  void list(const ShapeWord& word, const std::string& expected, StatedNumbers& numbers, bool mayBeEmpty) override {
    if (file_ != nullptr) return refuseBesideFile(word);
    const std::string what = section_.nameOf(word.key);
    const toml::array& entries = source_.asArray(section_.require(word.key, expected), what);
    if (entries.empty() && !mayBeEmpty) source_.fail(entries, what + " is empty", "one value at least");
    for (const toml::node& entry : entries)
      numbers.push_back(statedAs(source_.asAmount(entry, what, dimensionOfWord(word)), numbers.size()));
  }

  void intervals(const ShapeWord& word, const std::string& expected, StatedNumbers& intervals) override {
    areIntervals_ = true;
    if (file_ != nullptr) return refuseBesideFile(word);
    const std::string what = section_.nameOf(word.key);
    for (const toml::node& entry : source_.asArray(section_.require(word.key, expected), what)) {
      const Interval pair = readPair(source_, entry, what, dimensionOfWord(word));
      intervals.push_back({pair, midpoint(pair), intervals.size()});
    }
  }

  bool file(const std::vector<Column>& wanted, std::vector<StatedNumbers>& columns) override {
    if (file_ == nullptr) return false;
    std::vector<WantedColumn> named;
    for (const Column& column : wanted)
      named.push_back({column.isNamedByKey ? section_.text(column.name) : column.name,
                       column.isOfQuantity ? quantity_.unit : std::string(unit::one)});
    const TableFiles::Columns read = files_.columns(*file_, section_.nameOf("file"), named);
    lines_ = read.lines;
    for (const std::vector<Amount>& column : read.values) {
      columns.emplace_back();
      for (const Amount& amount : column) columns.back().push_back(statedAs(amount, columns.back().size()));
    }
    return true;
  }

  /// Throws StudyError at what a shape refuses.
  [[noreturn]] void fail(const ShapeRefusal& refusal) const {
    if (refusal.index) failAt(refusal.key, *refusal.index, refusal.problem, refusal.problem, refusal.expected);
    const toml::node* node = section_.find(refusal.key);
    source_.fail(node == nullptr ? section_.table() : *node, refusal.problem, refusal.expected);
  }

 protected:
  /// Of a list's entry, or of the row of the file that stands for it.
  [[noreturn]] void failAt(const std::string& key, std::size_t index, const std::string& ofFile,
                           const std::string& ofList, const std::string& expected) const {
    if (file_ != nullptr) files_.fail(*file_, lines_[index], ofFile, expected);
    source_.fail((*section_.find(key)->as_array())[index], ofList, expected);
  }
  bool areIntervals() const { return areIntervals_; }
  const Dimension& dimensionOfWord(const ShapeWord& word) const { return word.isOfQuantity ? dimension_ : unitless; }

  const TomlSection& section_;
  const TomlSource& source_;
  const TableFiles& files_;
  const UncertainQuantity& quantity_;
  Dimension dimension_;

 private:
  static StatedNumber statedAs(const Amount& amount, std::size_t at) { return {enclose(amount), nearest(amount), at}; }
  void refuseBesideFile(const ShapeWord& word) const {
    if (const toml::node* node = section_.find(word.key))
      source_.fail(*node, fmt::format("there is a file beside {}", section_.nameOf(word.key)), "one of the two");
  }

  const toml::node* file_;
  std::vector<std::size_t> lines_;  ///< of the file's rows
  bool areIntervals_ = false;
};

/// What a shape is stated on, the interval not being known.
class ShapeSpan final : public StatedShape {
 public:
  using StatedShape::StatedShape;

  void support(Interval& /*support*/) override {
    if (const toml::node* node = section_.find("support"))
      range = hull(range, readPair(source_, *node, section_.nameOf("support"), dimension_));
  }
  void points(const ShapeWord& word, std::vector<Point>& /*points*/) override {
    const toml::node* node = section_.find(word.key);
    if (node == nullptr || !node->is_array()) return;
    for (const toml::node& point : *node->as_array())
      if (point.is_array() && !point.as_array()->empty())
        range = hull(range, enclose(source_.asAmount((*point.as_array())[0], section_.nameOf(word.key), dimension_)));
  }
  void within(const ShapeWord& /*list*/, const StatedNumbers& numbers) override {
    for (const StatedNumber& number : numbers) range = hull(range, number.enclosed);
  }

  Interval range = Interval::empty();
};

/// Fills in a shape, within the interval.
class ShapeFilling final : public StatedShape {
 public:
  using StatedShape::StatedShape;

  void support(Interval& support) override {
    const toml::node* node = section_.find("support");
    const Interval range = quantity_.uncertain.range;
    support = node == nullptr ? range : readPair(source_, *node, section_.nameOf("support"), dimension_);
    if (!isSubset(support, range)) {
      const auto [inner, outer] = writtenApart(support, range);
      source_.fail(*node, fmt::format("{} {} leaves the interval", section_.nameOf("support"), inner),
                   fmt::format("a support inside {}", outer));
    }
    support_ = support;
  }

  void number(const ShapeWord& word, double& number) override {
    const toml::node* node = section_.find(word.key);
    const Dimension& dimension = dimensionOfWord(word);
    if (node == nullptr && word.isNominal)
      number = quantity_.uncertain.nominal;
    else
      number = nearest(value(section_.require(word.key, numberIn(dimension)), section_.nameOf(word.key), dimension));
    checkNumber(word, number);
  }

  /// The nearest double, or an interval [least, greatest] of what it may be.
  void parameter(const ShapeWord& word, Trend /*trend*/, Interval& number) override {
    const toml::node* node = section_.find(word.key);
    const Dimension& dimension = dimensionOfWord(word);
    if (node == nullptr && word.isNominal) {
      number = quantity_.uncertain.nominal;
    } else {
      const toml::node& found = section_.require(word.key, numberIn(dimension) + ", or an interval of such numbers");
      const std::string what = section_.nameOf(word.key);
      number = found.is_array()
                   ? readPair(source_, found, what, dimension)
                   : Interval(nearest(value(found, what, dimension, ", or an interval of values [lower, upper]")));
    }
    checkNumber(word, number);
  }

  void pair(const ShapeWord& word, const std::array<std::string, 2>& names, Interval& pair) override {
    pair = readPair(source_, section_.require(word.key, fmt::format("[{}, {}]", names[0], names[1])),
                    section_.nameOf(word.key), dimensionOfWord(word));
    checkNumber(word, pair);
  }

  void points(const ShapeWord& word, std::vector<Point>& points) override {
    const std::string what = section_.nameOf(word.key);
    const toml::array& list =
        source_.asArray(section_.require(word.key, "[[value, membership], ...] with memberships from 0 to 1"), what);
    const Interval range = quantity_.uncertain.range;
    if (list.empty()) source_.fail(list, what + " is empty", "at least one point [value, membership]");
    points.clear();
    for (const toml::node& entry : list) {
      const toml::array& point = source_.asArray(entry, what);
      if (point.size() != 2) source_.fail(entry, what + " has a point that is no pair", "[value, membership]");
      const Amount amount = source_.asAmount(point[0], what, dimension_);
      const bool isFirst = &entry == list.get(0), isLast = &entry == list.get(list.size() - 1);
      const double value = isFirst ? enclose(amount).lower() : isLast ? enclose(amount).upper() : nearest(amount);
      if (!contains(range, value)) {
        const auto [inner, outer] = writtenApart(value, range);
        source_.fail(point[0], fmt::format("{} has the value {} outside the interval", what, inner),
                     fmt::format("values inside {}", outer));
      }
      if (!points.empty() && value < points.back().value)
        source_.fail(point[0],
                     fmt::format("{} has the value {} after {}", what, written(value), written(points.back().value)),
                     "values that do not fall");
      const double degree = nearest(source_.asAmount(point[1], what, unitless));
      if (!(degree >= 0 && degree <= 1))
        source_.fail(point[1], fmt::format("{} has the membership {}", what, toString(degree)),
                     "a membership from 0 to 1");
      points.push_back({value, degree});
    }
  }

  void within(const ShapeWord& list, const StatedNumbers& numbers) override {
    const std::string what = section_.nameOf(list.key);
    for (const StatedNumber& number : numbers) {
      if (isSubset(number.enclosed, quantity_.uncertain.range)) continue;
      const auto [inner, outer] = writtenApart(number.enclosed, quantity_.uncertain.range);
      if (areIntervals()) {
        const std::string problem = inner + " leaves the interval";
        failAt(list.key, number.at, problem, what + ": " + problem, "intervals inside " + outer);
      }
      const std::string problem = fmt::format("{} has the value {} outside the interval", what, inner);
      failAt(list.key, number.at, problem, problem, "values inside " + outer);
    }
  }

  /// Of a point, in the numbers of the file.
  [[noreturn]] void failAtPoint(const Membership::BadPoint& refusal) const {
    const toml::array& point = *(*section_.find(refusal.key)->as_array())[*refusal.index].as_array();
    const auto number = [&](std::size_t i) { return toString(nearest(source_.asAnyAmount(point[i], ""))); };
    source_.fail(point,
                 fmt::format("point {}, ({}, {}), of {} {}", *refusal.index + 1, number(0), number(1),
                             section_.nameOf(refusal.key), refusal.problem),
                 refusal.expected);
  }

  // ---- How numbers are written and read ----------------------------------------------------------------------------

  static double nearTo(double x, int digits) { return std::stod(fmt::format("{:.{}g}", x, digits)); }
  static Interval nearTo(const Interval& x, int digits) {
    return {nearTo(x.lower(), digits), nearTo(x.upper(), digits)};
  }

  /// To the nearest. 15 digits give a number of the file back that was rounded to either side; one number if both ends
  /// do.
  static std::string written(const Interval& x, int digits = 15) {
    const std::string lower = fmt::format("{:.{}g}", x.lower(), digits);
    const std::string upper = fmt::format("{:.{}g}", x.upper(), digits);
    return lower == upper ? lower : fmt::format("[{}, {}]", lower, upper);
  }

  /// What leaves an interval and that interval, each with digits enough, and no more, to see it.
  static std::pair<std::string, std::string> writtenApart(const Interval& found, const Interval& around) {
    const int own = isSubset(nearTo(found, 15), around) ? 17 : 15;
    int digits = 6;
    while (digits < 17 && isSubset(nearTo(found, own), nearTo(around, digits))) ++digits;
    return {written(found, own), written(around, digits)};
  }

 private:
  /// Throws StudyError at the key's place.
  void checkNumber(const ShapeWord& word, const Interval& found) const {
    const toml::node* node = section_.find(word.key);  // missing where the nominal value stands in
    const toml::node& place = node == nullptr ? section_.table() : *node;
    if (word.isInside && !isSubset(found, support_)) {
      const auto [inner, outer] = writtenApart(found, support_);
      source_.fail(place,
                   fmt::format("{}{} {} leaves the support", section_.nameOf(word.key),
                               node == nullptr ? ", the nominal value" : "", inner),
                   "values inside " + outer);
    }
    if (word.isPositive && !(found.lower() > 0))
      source_.fail(place, section_.nameOf(word.key) + " is not positive", fmt::format("a {} above 0", word.key));
  }

  /// Of a parameter, which is no deviation from something; `otherwise` is what may stand in its place.
  Amount value(const toml::node& node, const std::string& what, const Dimension& dimension,
               const std::string& otherwise = "") const {
    const std::string text = node.value_or(std::string());
    for (const std::string_view sign : deviationSigns)
      if (text.starts_with(sign)) {
        const std::size_t begin = std::min(text.find_first_not_of(' ', sign.size()), text.size());
        source_.fail(node, fmt::format("{} is the deviation \"{}\"", what, text),
                     fmt::format("a value, such as \"{}\"{}", text.substr(begin), otherwise));
      }
    return source_.asAmount(node, what, dimension);
  }

  Interval support_;
};

class ShapeReader {
 public:
  ShapeReader(const TomlSource& source, const TomlSection& section, const TableFiles& files, const ShapeTypes& types)
      : source_(source), section_(section), files_(files), types_(types) {}

  /// What distribution and membership are stated on; empty if neither says so.
  Interval supports(const UncertainQuantity& quantity) const {
    return hull(span("distribution", types_.distributions, quantity), span("membership", types_.memberships, quantity));
  }

  /// Both, each perhaps from the other.
  void read(UncertainQuantity& result) const {
    const bool isInduced[] = {isOf("distribution", induced), isOf("membership", induced)};
    if (isInduced[0] && isInduced[1])
      source_.fail(*section_.find("membership"), "distribution and membership are each to follow from the other",
                   "one of the two to be stated");
    if (isInduced[0]) {
      readMembership(result);
      readDistribution(result);
    } else {
      readDistribution(result);
      readMembership(result);
    }
  }

 private:
  bool isOf(const char* key, std::string_view type) const {
    const toml::node* node = section_.find(key);
    const toml::node* found = node != nullptr && node->is_table() ? node->as_table()->get("type") : nullptr;
    return found != nullptr && found->value<std::string_view>() == type;
  }

  template <class Type>
  Interval span(const char* key, const std::vector<Type>& types, const UncertainQuantity& quantity) const {
    const toml::node* node = section_.find(key);
    if (node == nullptr || !node->is_table()) return Interval::empty();
    const auto [type, table] = kind(key, *node, types);
    if (type == nullptr) return Interval::empty();
    ShapeSpan found(files_, table, quantity);
    try {
      type()->describe(found);
    } catch (const ShapeRefusal& refusal) {
      found.fail(refusal);
    }
    return found.range;
  }

  void readDistribution(UncertainQuantity& result) const {
    Uncertain& uncertain = result.uncertain;
    uncertain.distribution = Distribution::uniform(uncertain.range);
    if (const toml::node* node = section_.find("distribution"))
      uncertain.distribution = readShape<Distribution>("distribution", *node, types_.distributions, result,
                                                       "a distribution inside the interval",
                                                       [&] { return distributionOf(uncertain.membership); });
  }

  void readMembership(UncertainQuantity& result) const {
    Uncertain& uncertain = result.uncertain;
    uncertain.membership = Membership::triangular(uncertain.range.lower(), uncertain.nominal, uncertain.range.upper());
    if (const toml::node* node = section_.find("membership"))
      uncertain.membership = readShape<Membership>("membership", *node, types_.memberships, result,
                                                   "a membership function inside the interval", [&] {
                                                     requireToFollow(*node, uncertain);
                                                     return membershipOf(uncertain.distribution, uncertain.nominal);
                                                   });
  }

  void requireToFollow(const toml::node& node, const Uncertain& uncertain) const {
    if (!uncertain.distribution.isPrecise())
      source_.fail(node, "a membership follows from one distribution, and there are several",
                   "a membership of its own, or a distribution whose parameters are numbers");
    if (const Interval& from = uncertain.distribution.support(); !contains(from, uncertain.nominal))
      source_.fail(node,
                   fmt::format("the nominal value {} lies outside the distribution's support {}",
                               ShapeFilling::written(uncertain.nominal), ShapeFilling::written(from)),
                   "a distribution that holds it, or another membership");
  }

  template <class Shape, class Type, class Follows>
  Shape readShape(const char* key, const toml::node& node, const std::vector<Type>& types,
                  const UncertainQuantity& quantity, const char* expected, const Follows& follows) const {
    const auto [type, table] = kind(key, node, types);
    ShapeFilling filling(files_, table, quantity);
    try {
      if (type == nullptr) return follows();
      auto law = type();
      law->describe(filling);
      return Shape(std::move(law));
    } catch (const Membership::BadPoint& refusal) {
      filling.failAtPoint(refusal);
    } catch (const ShapeRefusal& refusal) {
      filling.fail(refusal);
    } catch (const std::invalid_argument& error) {
      source_.failWith(node, error.what(), expected);
    }
  }

  /// What a table is of, and the table, whose keys are those of its type; null: it follows from the other one.
  template <class Type>
  std::pair<Type, TomlSection> kind(const char* key, const toml::node& node, const std::vector<Type>& types) const {
    const std::string name = section_.nameOf(key);
    std::vector<std::string> words;
    for (const Type& type : types) words.emplace_back(type()->name());
    words.emplace_back(induced);
    if (node.is_string()) {
      const std::string& word = node.as_string()->get();
      const std::string nearest = meantName(word, words);
      source_.fail(node, fmt::format("{} is \"{}\"", name, word),
                   fmt::format("a table, such as {{ type = \"{}\" }}", nearest.empty() ? words.front() : nearest));
    }
    const toml::table& table = source_.asTable(node, name);
    const toml::node* found = table.get("type");
    if (found == nullptr)
      source_.fail(node, fmt::format("'{}.type' is missing", name), fmt::format("{{ type = \"{}\" }}", words.front()));
    const std::string chosen = source_.asChoice(*found, name + ".type", words);
    const auto at = static_cast<std::size_t>(std::ranges::find(words, chosen) - words.begin());
    std::vector<std::string> keys{"type"};
    if (at == types.size()) return {nullptr, TomlSection(source_, table, name, keys)};
    for (const std::string& own : ShapeKeys(types[at]).keys()) keys.push_back(own);
    return {types[at], TomlSection(source_, table, name, keys)};
  }

  const TomlSource& source_;
  const TomlSection& section_;
  const TableFiles& files_;
  const ShapeTypes& types_;
};

}  // namespace

Interval readPair(const TomlSource& source, const toml::node& node, const std::string& what,
                  const Dimension& dimension) {
  const toml::array& list = source.asArray(node, what);
  if (list.size() != 2)
    source.fail(node, fmt::format("{} has {}", what, countText(static_cast<long long>(list.size()), "number")),
                "two, [lower, upper]");
  const Interval lower = enclose(source.asAmount(list[0], what, dimension));
  const Interval upper = enclose(source.asAmount(list[1], what, dimension));
  if (!(lower.lower() <= upper.upper()))
    source.fail(node, what + " has its lower bound above its upper one", "[lower, upper]");
  return {lower.lower(), upper.upper()};
}

Interval supportsOf(const TomlSource& source, const TomlSection& section, const TableFiles& files,
                    const ShapeTypes& types, const UncertainQuantity& quantity) {
  return ShapeReader(source, section, files, types).supports(quantity);
}

void readShapes(const TomlSource& source, const TomlSection& section, const TableFiles& files, const ShapeTypes& types,
                UncertainQuantity& quantity) {
  ShapeReader(source, section, files, types).read(quantity);
}

std::string shapesGuide(const ShapeTypes& types) {
  return tableOf("distribution", types.distributions) + "\n" + tableOf("membership", types.memberships);
}

}  // namespace gamut
