// Intervals, distributions and membership functions; each distribution and membership lies inside its interval.
#include "studies/reading/uncertain_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <regex>
#include <utility>

#include "mechanics/description/names.hpp"

namespace gamut {
namespace {

constexpr Dimension plain{};

class UncertainReader {
 public:
  UncertainReader(const TomlSource& source, Study& study) : source_(source), study_(study) {}

  void read(const toml::table& table) {
    const TomlSection section(source_, table, "uncertain",
                              {"name", "quantity", "interval", "distribution", "membership", "varies", "rate"});
    const toml::node& node = section.require("quantity", "the number that is uncertain, such as \"shoulder.angle\"");
    const std::vector<std::pair<const toml::node*, std::string>> quantities = quantitiesAt(node);
    if (quantities.size() > 1)
      if (const toml::node* name = section.find("name"))
        source_.fail(*name, fmt::format("one name is given to {} quantities", quantities.size()),
                     "no name: each has that of its quantity");
    for (const auto& [place, quantity] : quantities) {
      readOne(section, *place, quantity);
      tables_.push_back(&table);
    }
  }

  /// Says so if within the intervals there are values that make no sense, such as an inertia that no body has. They may
  /// still be meant: of a body that only turns about one axis, the other moments do not matter.
  void noteFaults() {
    const Mechanism& mechanism = study_.mechanism;
    for (const Described& element : mechanism.elements()) {
      std::vector<Expression> asked;
      const auto range = [&](const Expression& number) {
        asked.push_back(number);
        return mechanism.rangeOf(number, ranges());
      };
      element.faults(range);
      std::vector<std::string> sentences;
      for (const Fault& doubt : element.doubts([&](const Expression& n) { return mechanism.rangeOf(n); }, range))
        sentences.push_back(doubt.sentence);
      for (const Fault& fault : mechanism.faults(element, ranges()))
        sentences.push_back("for some values in the intervals " + fault.sentence);
      if (sentences.empty()) continue;
      const auto varies = [&](const UncertainQuantity& uncertain) {
        return std::ranges::any_of(asked, [&](const auto& n) { return mechanism.dependsOn(n, uncertain.quantity); });
      };
      const auto first = std::ranges::find_if(study_.uncertain, varies);
      if (first == study_.uncertain.end()) continue;
      const toml::table& table = *tables_[static_cast<std::size_t>(first - study_.uncertain.begin())];
      const toml::node* interval = table.get("interval");
      for (const std::string& sentence : sentences)
        study_.notes.push_back(source_.note(interval != nullptr ? *interval : *table.get("quantity"), sentence));
    }
  }

 private:
  /// One quantity of a table that may name several.
  void readOne(const TomlSection& section, const toml::node& node, const std::string& quantity) {
    const std::vector<std::string> known = study_.mechanism.quantities();
    for (const Mechanism::Derived& derived : study_.mechanism.derived())
      if (derived.name == quantity)
        source_.fail(node, fmt::format("'{}' follows from a formula", quantity),
                     fmt::format("one of the quantities in it: {}", fmt::join(derived.formula.names(), ", ")));
    for (const Mechanism::JointCoordinate& coordinate : study_.mechanism.coordinates())
      if (coordinate.isDriven && (coordinate.name == quantity || coordinate.rate == quantity))
        source_.fail(
            node, fmt::format("the joint '{}' is driven, so that '{}' follows from time", coordinate.element, quantity),
            "a parameter in the drive's position");
    if (std::find(known.begin(), known.end(), quantity) == known.end())
      source_.fail(node, fmt::format("unknown quantity '{}'", quantity), quantityExpected(quantity, known));
    UncertainQuantity result{quantity, study_.mechanism.unitOf(quantity), {}};
    result.uncertain.name = section.text("name", quantity);
    for (const UncertainQuantity& other : study_.uncertain) {
      if (other.quantity == quantity)
        source_.fail(node, fmt::format("'{}' is made uncertain twice", quantity), "every quantity once");
      if (other.uncertain.name == result.uncertain.name)
        source_.fail(section.table(), fmt::format("two uncertain quantities are named '{}'", other.uncertain.name),
                     "different names");
    }
    const toml::node* stated = section.find("interval");
    if (stated != nullptr)
      readRange(*stated, result);
    else
      takeSupports(section, result);
    const toml::node& interval = stated != nullptr ? *stated : static_cast<const toml::node&>(section.table());
    readDistribution(section, result);
    readMembership(section, result);
    readCourse(section, node, result);
    try {
      result.uncertain.check();
    } catch (const std::invalid_argument& error) {
      source_.failWith(interval, error.what(), "an interval that holds the nominal value and both supports");
    }
    study_.uncertain.push_back(std::move(result));
  }

  /// Text, with * for any characters, or a list of such texts.
  std::vector<std::pair<const toml::node*, std::string>> quantitiesAt(const toml::node& node) const {
    std::vector<std::pair<const toml::node*, std::string>> found;
    const auto add = [&](const toml::node& entry) {
      const std::string text = source_.asText(entry, "uncertain.quantity");
      if (text.find('*') == std::string::npos) {
        found.emplace_back(&entry, text);
        return;
      }
      const std::size_t before = found.size();
      for (const std::string& quantity : study_.mechanism.quantities())
        if (fits(quantity, text)) found.emplace_back(&entry, quantity);
      if (found.size() == before)
        source_.fail(entry, fmt::format("no quantity fits '{}'", text),
                     "a pattern that `gamut quantities` shows a quantity of");
    };
    if (!node.is_array()) {
      add(node);
      return found;
    }
    for (const toml::node& entry : *node.as_array()) add(entry);
    if (found.empty()) source_.fail(node, "uncertain.quantity is empty", "at least one quantity");
    return found;
  }

  /// Whether the text is the pattern, with any characters in the place of each *.
  static bool fits(std::string_view text, std::string_view pattern) {
    const std::size_t star = pattern.find('*');
    if (star == pattern.npos) return text == pattern;
    if (!text.starts_with(pattern.substr(0, star))) return false;
    for (std::size_t skipped = star; skipped <= text.size(); ++skipped)
      if (fits(text.substr(skipped), pattern.substr(star + 1))) return true;
    return false;
  }

  /// Without an interval: what distribution and membership are stated on.
  void takeSupports(const TomlSection& section, UncertainQuantity& result) {
    const Dimension dimension = dimensionOf(result.unit);
    Interval range = Interval::empty();
    for (const char* key : {"distribution", "membership"}) {
      const toml::node* node = section.find(key);
      if (node == nullptr || !node->is_table()) continue;
      const std::string name = section.nameOf(key);
      if (const toml::node* support = node->as_table()->get("support"))
        range = hull(range, pair(*support, name + ".support", dimension));
      const toml::node* points = node->as_table()->get("points");
      if (points == nullptr || !points->is_array()) continue;
      for (const toml::node& point : *points->as_array())
        if (point.is_array() && !point.as_array()->empty())
          range = hull(range, enclose(source_.asAmount((*point.as_array())[0], name + ".points", dimension)));
    }
    if (isEmpty(range))
      section.require("interval", fmt::format("{}, or a distribution or membership with a support", waysToSayIt));
    result.uncertain.nominal = midpoint(study_.mechanism.nominal(result.quantity));
    result.uncertain.range = range;
    checkRange(section.table(), "the support of '" + result.quantity + "'", result);
  }

  std::map<std::string, Interval> ranges() const {
    std::map<std::string, Interval> result;
    for (const UncertainQuantity& q : study_.uncertain) result[q.quantity] = q.uncertain.range;
    return result;
  }

  /// [lower, upper], or deviations from the nominal value, to both sides alike or not.
  void readRange(const toml::node& node, UncertainQuantity& result) {
    const std::string what = "uncertain.interval";
    const Dimension dimension = dimensionOf(result.unit);
    const Interval nominal = study_.mechanism.nominal(result.quantity);
    result.uncertain.nominal = midpoint(nominal);
    result.uncertain.blur = width(nominal);
    if (node.is_array()) {
      result.uncertain.range = pair(node, what, dimension);
    } else {
      const auto [below, above] = deviations(node, what, source_.asText(node, what));
      const Reach down = reachOf(node, what, below, result, nominal), up = reachOf(node, what, above, result, nominal);
      if (isEqual(down.size, Interval(0.0)) && isEqual(up.size, Interval(0.0)))
        source_.fail(node, what + " has no positive deviation", "a deviation above 0");
      if (down.isShare && up.isShare) {  // of |nominal|
        const bool isNegative = nominal.upper() <= 0;
        result.uncertain.range =
            nominal * hull(1.0 - (isNegative ? up : down).size, 1.0 + (isNegative ? down : up).size);
      } else {
        const auto size = [&](const Reach& reach) { return reach.isShare ? reach.size * abs(nominal) : reach.size; };
        result.uncertain.range = hull(nominal - size(down), nominal + size(up));
      }
    }
    checkRange(node, what, result);
  }

  void checkRange(const toml::node& node, const std::string& what, const UncertainQuantity& result) const {
    const Interval& range = result.uncertain.range;
    if (!(range.lower() < range.upper()))
      source_.fail(node, what + " holds one value only", "a lower bound below the upper one");
    if (dimensionOf(result.unit) == Dimension{1, 0, 0, 0} && range.lower() < 0)
      source_.fail(node, fmt::format("{} reaches down to a negative mass", what), "a lower bound of at least 0 kg");
    if (!contains(range, result.uncertain.nominal))
      source_.fail(node, fmt::format("{} does not hold the nominal value {:.6g}", what, result.uncertain.nominal),
                   "an interval around the nominal value");
  }

  /// "± 1 mm": twice "1 mm"; "+2 / -1 mm": "1 mm", "2 mm". The unit of the second is that of both unless each has one.
  std::pair<std::string, std::string> deviations(const toml::node& node, const std::string& what,
                                                 const std::string& text) const {
    const auto sign = std::find_if(signs.begin(), signs.end(), [&](auto s) { return text.starts_with(s); });
    if (sign != signs.end()) return {text.substr(sign->size()), text.substr(sign->size())};
    static const std::regex bothSides(
        R"(\s*([+-])\s*([0-9.eE]+(?:[eE][+-]?[0-9]+)?)([^/]*)/\s*([+-])\s*([0-9.]+(?:[eE][+-]?[0-9]+)?)(.*))");
    std::string plainText = text;
    for (std::size_t at = 0; (at = plainText.find("−", at)) != std::string::npos;)
      plainText.replace(at, std::string_view("−").size(), "-");
    std::smatch parts;
    if (!std::regex_match(plainText, parts, bothSides) || parts[1] == parts[4])
      source_.fail(node, fmt::format("{} is \"{}\"", what, text), waysToSayIt);
    const bool hasUnit = parts[3].str().find_first_not_of(' ') != std::string::npos;
    const std::string first = parts[2].str() + (hasUnit ? parts[3] : parts[6]).str(),
                      second = parts[5].str() + parts[6].str();
    return parts[1] == "-" ? std::pair(first, second) : std::pair(second, first);
  }

  /// A deviation, in the quantity's unit or as a share of the nominal value.
  struct Reach {
    Interval size;
    bool isShare = false;
  };

  Reach reachOf(const toml::node& node, const std::string& what, const std::string& text,
                const UncertainQuantity& result, const Interval& nominal) const {
    const Amount deviation = source_.readAnyAmount(node, what, text);
    if (deviation.value < 0) source_.fail(node, what + " has no positive deviation", "a deviation above 0");
    if (!deviation.isRelative || deviation.hasUnit)
      return {enclose(source_.readAmount(node, what, text, dimensionOf(result.unit)))};
    if (isEqual(nominal, Interval(0.0)))
      source_.fail(node, fmt::format("{} is a share of the nominal value, which is 0", what),
                   fmt::format("an absolute deviation, such as \"± 0.01 {}\"", result.unit));
    return {enclose(deviation), true};
  }

  /// [lower, upper] as the hull of both enclosures.
  Interval pair(const toml::node& node, const std::string& what, const Dimension& dimension) const {
    const toml::array& list = source_.asArray(node, what);
    if (list.size() != 2)
      source_.fail(node, fmt::format("{} has {} numbers", what, list.size()), "two, [lower, upper]");
    const Interval lower = enclose(source_.asAmount(list[0], what, dimension));
    const Interval upper = enclose(source_.asAmount(list[1], what, dimension));
    if (!(lower.lower() <= upper.upper()))
      source_.fail(node, what + " has its lower bound above its upper one", "[lower, upper]");
    return {lower.lower(), upper.upper()};
  }

  Interval support(const TomlSection& section, const UncertainQuantity& quantity) const {
    const toml::node* node = section.find("support");
    const Interval range = quantity.uncertain.range;
    if (node == nullptr) return range;
    const Interval found = pair(*node, section.nameOf("support"), dimensionOf(quantity.unit));
    if (!isSubset(found, range)) {
      const auto [inner, outer] = writtenApart(found, range);
      source_.fail(*node, fmt::format("{} {} leaves the interval", section.nameOf("support"), inner),
                   fmt::format("a support inside {}", outer));
    }
    return found;
  }

  /// Throws StudyError at the key's place unless `found` lies inside the support.
  void requireInside(const TomlSection& section, std::string_view key, const Interval& found,
                     const Interval& support) const {
    if (isSubset(found, support)) return;
    const auto [inner, outer] = writtenApart(found, support);
    const toml::node* node = section.find(key);  // missing where the nominal value stands in
    source_.fail(node == nullptr ? section.table() : *node,
                 fmt::format("{}{} {} leaves the support", section.nameOf(key),
                             node == nullptr ? ", the nominal value" : "", inner),
                 "values inside " + outer);
  }

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

  /// The nearest double; `otherwise` without the key.
  double number(const TomlSection& section, std::string_view key, const UncertainQuantity& quantity,
                double otherwise) const {
    const toml::node* node = section.find(key);
    if (node == nullptr) return otherwise;
    return nearest(source_.asAmount(*node, section.nameOf(key), dimensionOf(quantity.unit)));
  }

  double requiredNumber(const TomlSection& section, std::string_view key, const Dimension& dimension) const {
    const toml::node& node = section.require(key, fmt::format("a number in {}", unitOf(dimension)));
    return nearest(source_.asAmount(node, section.nameOf(key), dimension));
  }

  /// The keys of one kind of distribution or membership function.
  TomlSection kind(const TomlSection& parent, const toml::node& node, const std::string& key,
                   const std::vector<std::pair<std::string, std::vector<std::string>>>& kinds,
                   std::string& type) const {
    const std::string name = parent.nameOf(key);
    const toml::table& table = source_.asTable(node, name);
    std::vector<std::string> types;
    for (const auto& entry : kinds) types.push_back(entry.first);
    const toml::node* found = table.get("type");
    if (found == nullptr)
      source_.fail(node, fmt::format("'{}.type' is missing", name), fmt::format("{{ type = \"{}\" }}", types.front()));
    type = source_.asChoice(*found, name + ".type", types);
    std::vector<std::string> keys{"type"};
    for (const auto& entry : kinds)
      if (entry.first == type) keys.insert(keys.end(), entry.second.begin(), entry.second.end());
    return {source_, table, name, keys};
  }

  void readDistribution(const TomlSection& section, UncertainQuantity& result) const {
    Uncertain& uncertain = result.uncertain;
    uncertain.distribution = Distribution::uniform(uncertain.range);
    const toml::node* node = section.find("distribution");
    if (node == nullptr) return;
    std::string type;
    const TomlSection table = kind(section, *node, "distribution",
                                   {{"uniform", {"support"}},
                                    {"triangular", {"support", "mode"}},
                                    {"normal", {"support", "mean", "deviation"}},
                                    {"beta", {"support", "a", "b"}},
                                    {"lognormal", {"support", "log_mean", "log_deviation"}},
                                    {"weibull", {"support", "shape", "scale"}},
                                    {"gamma", {"support", "shape", "scale"}},
                                    {"exponential", {"support", "mean"}}},
                                   type);
    const Dimension dimension = dimensionOf(result.unit);
    const Interval on = support(table, result);
    try {
      if (type == "uniform") uncertain.distribution = Distribution::uniform(on);
      if (type == "triangular")
        uncertain.distribution = Distribution::triangular(on, number(table, "mode", result, uncertain.nominal));
      if (type == "normal")
        uncertain.distribution = Distribution::normal(on, number(table, "mean", result, uncertain.nominal),
                                                      requiredNumber(table, "deviation", dimension));
      if (type == "beta")
        uncertain.distribution =
            Distribution::beta(on, requiredNumber(table, "a", plain), requiredNumber(table, "b", plain));
      if (type == "lognormal")
        uncertain.distribution = Distribution::lognormal(on, requiredNumber(table, "log_mean", plain),
                                                         requiredNumber(table, "log_deviation", plain));
      if (type == "weibull")
        uncertain.distribution =
            Distribution::weibull(on, requiredNumber(table, "shape", plain), requiredNumber(table, "scale", dimension));
      if (type == "gamma")
        uncertain.distribution =
            Distribution::gamma(on, requiredNumber(table, "shape", plain), requiredNumber(table, "scale", dimension));
      if (type == "exponential")
        uncertain.distribution = Distribution::exponential(on, number(table, "mean", result, uncertain.nominal));
    } catch (const std::invalid_argument& error) {
      source_.failWith(*node, error.what(), "a distribution inside the interval");
    }
  }

  void readMembership(const TomlSection& section, UncertainQuantity& result) const {
    Uncertain& uncertain = result.uncertain;
    uncertain.membership = Membership::triangular(uncertain.range.lower(), uncertain.nominal, uncertain.range.upper());
    const toml::node* node = section.find("membership");
    if (node == nullptr) return;
    std::string type;
    const TomlSection table = kind(section, *node, "membership",
                                   {{"triangular", {"support", "apex"}},
                                    {"trapezoidal", {"support", "core"}},
                                    {"gaussian", {"support", "centre", "deviation"}},
                                    {"table", {"points"}}},
                                   type);
    const Dimension dimension = dimensionOf(result.unit);
    const Interval on = support(table, result);
    try {
      if (type == "triangular") {
        const double apex = number(table, "apex", result, uncertain.nominal);
        requireInside(table, "apex", apex, on);
        uncertain.membership = Membership::triangular(on.lower(), apex, on.upper());
      }
      if (type == "trapezoidal") {
        const Interval core = pair(table.require("core", "[left, right]"), table.nameOf("core"), dimension);
        requireInside(table, "core", core, on);
        uncertain.membership = Membership::trapezoidal(on.lower(), core.lower(), core.upper(), on.upper());
      }
      if (type == "gaussian") {
        const double centre = number(table, "centre", result, uncertain.nominal);
        requireInside(table, "centre", centre, on);
        const double deviation = requiredNumber(table, "deviation", dimension);
        if (!(deviation > 0))
          source_.fail(*table.find("deviation"), table.nameOf("deviation") + " is not positive", "a deviation above 0");
        uncertain.membership = Membership::gaussian(on, centre, deviation);
      }
      if (type == "table") uncertain.membership = tableOf(table, result);
    } catch (const std::invalid_argument& error) {
      source_.failWith(*node, error.what(), "a membership function inside the interval");
    }
  }

  /// `varies = "freely"`, or a `rate` that is the most it changes by in a second.
  void readCourse(const TomlSection& section, const toml::node& quantity, UncertainQuantity& result) const {
    const toml::node *varies = section.find("varies"), *rate = section.find("rate");
    if (varies == nullptr && rate == nullptr) return;
    const toml::node& first = varies != nullptr ? *varies : *rate;
    if (varies != nullptr) source_.asChoice(*varies, "uncertain.varies", {"freely"});
    if (varies != nullptr && rate != nullptr)
      source_.fail(*rate, "what varies freely has no uncertain.rate", "one of the two");
    for (const char* key : {"distribution", "membership"})
      if (const toml::node* node = section.find(key))
        source_.fail(*node, fmt::format("what varies in time has no uncertain.{}", key), "an interval alone");
    if (study_.analysis == Study::Analysis::kinematics)
      source_.fail(first, "in kinematics nothing varies in time", "analysis = \"dynamics\"");
    const std::vector<std::string> states = study_.mechanism.stateNames();
    if (std::ranges::find(states, result.quantity) != states.end())
      source_.fail(quantity, fmt::format("'{}' is an initial value, which cannot vary in time", result.quantity),
                   "a parameter or a number of an element");
    result.varies = true;
    const Interval& range = result.uncertain.range;
    result.uncertain.membership = Membership::trapezoidal(range.lower(), range.lower(), range.upper(), range.upper());
    if (rate == nullptr) return;
    const std::string unit = rateUnitOf(result.unit);
    const Dimension dimension = dimensionOf(unit);
    std::string text = rate->is_string() ? source_.asText(*rate, "uncertain.rate") : "";
    for (const std::string_view sign : signs)
      if (text.starts_with(sign)) text.erase(0, sign.size());
    result.rate = enclose(text.empty() ? source_.asAmount(*rate, "uncertain.rate", dimension, unit)
                                       : source_.readAmount(*rate, "uncertain.rate", text, dimension, unit))
                      .upper();
    if (!(result.rate > 0)) source_.fail(*rate, "uncertain.rate is not positive", "the most it changes by in a second");
  }

  Membership tableOf(const TomlSection& section, const UncertainQuantity& quantity) const {
    const toml::array& list = source_.asArray(
        section.require("points", "[[value, membership], ...] with memberships from 0 to 1"), section.nameOf("points"));
    try {
      return Membership::table(points(list, section.nameOf("points"), quantity));
    } catch (const Membership::BadPoint& error) {
      const toml::array& point = *list[error.index].as_array();
      const auto number = [&](std::size_t i) { return toString(nearest(source_.asAnyAmount(point[i], ""))); };
      source_.fail(point,
                   fmt::format("point {}, ({}, {}), of {} {}", error.index + 1, number(0), number(1),
                               section.nameOf("points"), error.problem),
                   "memberships from 0 to 1 that rise to 1, stay, and fall");
    }
  }

  /// points = [[value, membership], ...]: nearest doubles, but the ends, which are the support, rounded outward.
  std::vector<Membership::Point> points(const toml::array& list, const std::string& what,
                                        const UncertainQuantity& quantity) const {
    const Interval range = quantity.uncertain.range;
    if (list.empty()) source_.fail(list, what + " is empty", "at least one point [value, membership]");
    std::vector<Membership::Point> result;
    for (const toml::node& entry : list) {
      const toml::array& point = source_.asArray(entry, what);
      if (point.size() != 2) source_.fail(entry, what + " has a point that is no pair", "[value, membership]");
      const Amount amount = source_.asAmount(point[0], what, dimensionOf(quantity.unit));
      const bool isFirst = &entry == list.get(0), isLast = &entry == list.get(list.size() - 1);
      const double value = isFirst ? enclose(amount).lower() : isLast ? enclose(amount).upper() : nearest(amount);
      if (!contains(range, value)) {
        const auto [inner, outer] = writtenApart(value, range);
        source_.fail(point[0], fmt::format("{} has the value {} outside the interval", what, inner),
                     fmt::format("values inside {}", outer));
      }
      if (!result.empty() && value < result.back().value)
        source_.fail(point[0],
                     fmt::format("{} has the value {} after {}", what, written(value), written(result.back().value)),
                     "values that do not fall");
      const double degree = nearest(source_.asAmount(point[1], what, plain));
      if (!(degree >= 0 && degree <= 1))
        source_.fail(point[1], fmt::format("{} has the membership {}", what, toString(degree)),
                     "a membership from 0 to 1");
      result.push_back({value, degree});
    }
    return result;
  }

  static constexpr std::array<std::string_view, 3> signs{"±", "+-", "+/-"};
  static constexpr const char* waysToSayIt = "\"± 1 %\", \"± 2 deg\", \"+2 / -1 mm\" or [lower, upper]";

  const TomlSource& source_;
  Study& study_;
  std::vector<const toml::table*> tables_;  // of each uncertain quantity
};

}  // namespace

void readUncertain(const TomlSource& source, const std::vector<const toml::table*>& tables, Study& study) {
  UncertainReader reader(source, study);
  for (const toml::table* table : tables) reader.read(*table);
  reader.noteFaults();
}

std::string quantityExpected(const std::string& word, const std::vector<std::string>& known) {
  const std::string names = expectedName(word, known);
  return fmt::format("a quantity of the mechanism, {}{}", names.starts_with('\'') ? "such as " : "", names);
}

}  // namespace gamut
