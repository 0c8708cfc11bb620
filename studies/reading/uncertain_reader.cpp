// Intervals, distributions and membership functions; each distribution and membership lies inside its interval.
#include "studies/reading/uncertain_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <regex>
#include <unordered_set>
#include <utility>

#include "mechanics/description/names.hpp"
#include "mechanics/description/written_units.hpp"
#include "studies/printable.hpp"
#include "studies/reading/settings_reader.hpp"
#include "studies/reading/shape_reader.hpp"
#include "studies/words.hpp"

namespace gamut {
namespace {

/// Text with any characters in the place of each *: what stands before the first, between two, and after the last.
class Pattern {
 public:
  /// With one * at least.
  explicit Pattern(std::string_view text) {
    const std::size_t first = text.find('*'), last = text.rfind('*');
    begin_ = text.substr(0, first);
    end_ = text.substr(last + 1);
    for (std::size_t at = first; at < last;) {
      const std::size_t next = text.find('*', at + 1);
      if (next > at + 1) between_.push_back(text.substr(at + 1, next - at - 1));
      at = next;
    }
  }

  /// Each part where it comes first leaves the most for those behind it.
  bool fits(std::string_view text) const {
    if (text.size() < begin_.size() + end_.size() || !text.starts_with(begin_) || !text.ends_with(end_)) return false;
    text = text.substr(begin_.size(), text.size() - begin_.size() - end_.size());
    for (const std::string_view part : between_) {
      const std::size_t at = text.find(part);
      if (at == text.npos) return false;
      text.remove_prefix(at + part.size());
    }
    return true;
  }

 private:
  std::string_view begin_, end_;
  std::vector<std::string_view> between_;
};

class UncertainReader {
 public:
  UncertainReader(const TomlSource& source, const TableFiles& files,
                  const std::map<std::string, const toml::node*>& places, const ShapeTypes& shapes, Study& study)
      : source_(source), files_(files), places_(places), shapes_(shapes), study_(study) {}

  void read(const toml::table& table) {
    const TomlSection section = readSettings(source_, table, "uncertain", study_);
    const toml::node& node = section.require("quantity", "the number that is uncertain, such as \"shoulder.angle\"");
    const std::vector<std::pair<const toml::node*, std::string>> quantities = quantitiesAt(node);
    if (quantities.size() > 1)
      if (const toml::node* name = section.find("name"))
        source_.fail(*name, fmt::format("one name is given to {} quantities", quantities.size()),
                     "no name: each has that of its quantity");
    for (const auto& [place, quantity] : quantities) {
      const auto read = [&, &place = place, &quantity = quantity] { readOne(section, *place, quantity); };
      if (quantities.size() > 1)
        naming(quantity, read);
      else
        read();
      tables_.push_back(&table);
    }
  }

  /// Says so if within the intervals there are values that make no sense, such as an inertia that no body has. They may
  /// still be meant: of a body that only turns about one axis, the other moments do not matter. Fails for those of
  /// which what would be computed is not what they say.
  void noteFaults() {
    const Mechanism& mechanism = study_.mechanism;
    std::map<std::string, Interval> ranges;
    for (const UncertainQuantity& q : study_.uncertain) ranges[q.quantity] = q.uncertain.range;
    for (const Described& element : mechanism.elements()) {
      std::vector<Expression> asked;
      const auto range = [&](const Expression& number) {
        asked.push_back(number);
        return mechanism.rangeOf(number, ranges);
      };
      const std::vector<Fault> anywhere = element.faults(range);
      std::vector<std::string> sentences;
      for (const Fault& doubt : element.doubts([&](const Expression& n) { return mechanism.rangeOf(n); }, range))
        sentences.push_back(doubt.sentence);
      for (const Fault& fault : mechanism.faults(element, ranges))
        sentences.push_back("for some values in the intervals " + fault.sentence);
      const auto fatal = std::ranges::find_if(anywhere, &Fault::isFatal);
      if (sentences.empty() && fatal == anywhere.end()) continue;
      const auto varies = [&](const UncertainQuantity& uncertain) {
        return std::ranges::any_of(asked, [&](const auto& n) { return mechanism.dependsOn(n, uncertain.quantity); });
      };
      const auto first = std::ranges::find_if(study_.uncertain, varies);
      if (first == study_.uncertain.end()) continue;
      const toml::table& table = *tables_[first - study_.uncertain.begin()];
      const toml::node* interval = table.get("interval");
      const toml::node& place = interval != nullptr ? *interval : *table.get("quantity");
      if (fatal != anywhere.end())
        source_.failWith(place, "for some values in the intervals " + fatal->sentence, fatal->expected);
      for (const std::string& sentence : sentences) study_.notes.push_back(source_.note(place, sentence));
    }
  }

 private:
  /// What is wrong with one of several quantities of a table is said with its name.
  template <class Action>
  static void naming(const std::string& quantity, const Action& action) {
    try {
      action();
    } catch (const StudyError& error) {
      const std::string name = "'" + quantity + "'";
      if ((error.problem() + error.expected()).find(name) != std::string::npos) throw;
      throw StudyError(error.place(), fmt::format("{}, for {}", error.problem(), name), error.expected());
    }
  }

  /// What a number follows from; empty of one that follows from nothing, or that there is not.
  std::vector<std::string> namesInFormulaOf(const std::string& quantity) const {
    if (const Mechanism::Derived* derived = study_.mechanism.derived().find(quantity)) return derived->formula.names();
    const auto place = places_.find(quantity);
    return place == places_.end() || !place->second->is_string() || study_.mechanism.mayBeUncertain(quantity)
               ? std::vector<std::string>()
               : source_.asExpression(*place->second, quantity, true).names();
  }

  /// One quantity of a table that may name several.
  void readOne(const TomlSection& section, const toml::node& node, const std::string& quantity) {
    const Mechanism& mechanism = study_.mechanism;
    if (const std::vector<std::string> names = namesInFormulaOf(quantity); !names.empty())
      source_.fail(node, fmt::format("'{}' follows from a formula", quantity),
                   fmt::format("one of the quantities in it: {}", fmt::join(names, ", ")));
    if (const Mechanism::JointCoordinate* coordinate = mechanism.coordinateWith(quantity)) {
      if (coordinate->isDriven)
        source_.fail(
            node,
            fmt::format("the joint '{}' is driven, so that '{}' follows from time", coordinate->element, quantity),
            "a parameter in the drive's position");
      if (coordinate->isDependent)
        source_.fail(node,
                     fmt::format("the joint '{}' closes a loop, so that '{}' follows from the other joints",
                                 coordinate->element, quantity),
                     "a length, or the initial value of another joint");
    }
    if (!mechanism.mayBeUncertain(quantity))
      source_.fail(node, fmt::format("unknown quantity '{}'", quantity),
                   quantityExpected(quantity, mechanism.quantities()));
    UncertainQuantity result{quantity, study_.mechanism.unitOf(quantity), {}};
    result.uncertain.name = section.text("name", quantity);
    if (!quantities_.insert(quantity).second)
      source_.fail(node, fmt::format("'{}' is made uncertain twice", quantity), "every quantity once");
    if (!names_.insert(result.uncertain.name).second)
      source_.fail(section.table(), fmt::format("two uncertain quantities are named '{}'", result.uncertain.name),
                   "different names");
    const toml::node* stated = section.find("interval");
    if (stated != nullptr) {
      readRange(*stated, result);
      noteRadians(*stated, result);
    } else {
      takeSupports(section, result);
    }
    const toml::node& interval = stated != nullptr ? *stated : supportOf(section);
    readShapes(source_, section, files_, shapes_, result);
    readCourse(section, node, result);
    result.told = unitOfStatement(stated, result);
    if (stated != nullptr) result.stated = textOf(*stated);
    try {
      result.uncertain.check();
    } catch (const std::invalid_argument& error) {
      source_.failWith(interval, error.what(), "an interval that holds the nominal value and both supports");
    }
    study_.uncertain.push_back(std::move(result));
  }

  /// What an interval follows from that is not stated: values or a file of them, or all that is said of the quantity.
  static const toml::node& supportOf(const TomlSection& section) {
    if (const toml::node* distribution = section.find("distribution"); distribution != nullptr)
      if (const toml::table* table = distribution->as_table())
        for (const char* key : {"values", "edges", "file"})
          if (const toml::node* node = table->get(key)) return *node;
    return section.table();
  }

  /// As names are quoted in messages and in formulas.
  static std::string withoutQuotes(const std::string& text) {
    const bool isQuoted = text.size() > 2 && text.front() == '\'' && text.find('\'', 1) == text.size() - 1;
    return isQuoted ? text.substr(1, text.size() - 2) : text;
  }

  /// Text, with * for any characters, or a list of such texts.
  std::vector<std::pair<const toml::node*, std::string>> quantitiesAt(const toml::node& node) const {
    std::vector<std::pair<const toml::node*, std::string>> found;
    const auto add = [&](const toml::node& entry) {
      const std::string text = source_.asText(entry, "uncertain.quantity");
      if (text.find('*') == std::string::npos) {
        found.emplace_back(&entry, withoutQuotes(text));
        return;
      }
      const std::size_t before = found.size();
      const Pattern pattern(text);
      for (const std::string& quantity : study_.mechanism.quantities())
        if (pattern.fits(quantity)) found.emplace_back(&entry, quantity);
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

  /// Without an interval: what distribution and membership are stated on.
  void takeSupports(const TomlSection& section, UncertainQuantity& result) {
    const Interval range = supportsOf(source_, section, files_, shapes_, result);
    if (isEmpty(range))
      section.require("interval", fmt::format("{}, or a distribution or membership with a support", waysToSayIt));
    result.uncertain.nominal = midpoint(study_.mechanism.nominal(result.quantity));
    result.uncertain.range = range;
    checkRange(supportOf(section), "the support of '" + result.quantity + "'", result);
  }

  /// [lower, upper], or deviations from the nominal value, to both sides alike or not.
  void readRange(const toml::node& node, UncertainQuantity& result) {
    const std::string what = "uncertain.interval";
    const Dimension dimension = dimensionOf(result.unit);
    const Interval nominal = study_.mechanism.nominal(result.quantity);
    result.uncertain.nominal = midpoint(nominal);
    result.uncertain.blur = width(nominal);
    if (node.is_array()) {
      result.uncertain.range = readPair(source_, node, what, dimension);
    } else {
      if (!node.is_string()) source_.fail(node, what + " is neither text nor a list", waysToSayIt);
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

  /// The unit of the nominal value, as it is written; where that has none the interval's, if its ends are stated, or
  /// the nominal value is zero, or it is one of an angle. Empty: the SI unit.
  std::string unitOfStatement(const toml::node* interval, const UncertainQuantity& result) const {
    const auto unitOfNode = [&](const toml::node& node) {
      return node.is_string() ? unitOfKind(**node.as_string(), result.unit) : std::string();
    };
    if (const auto place = places_.find(result.quantity); place != places_.end())
      if (std::string unit = unitOfNode(*place->second); !unit.empty()) return unit;
    if (interval == nullptr) return {};
    if (const toml::array* ends = interval->as_array()) {
      for (const toml::node& end : *ends)
        if (std::string unit = unitOfNode(end); !unit.empty()) return unit;
      return {};
    }
    const bool isOfInterval = result.uncertain.nominal == 0 || dimensionOf(result.unit) == Dimension{0, 0, 0, 1};
    if (!isOfInterval || !interval->is_string()) return {};
    const auto [below, above] = deviations(*interval, "uncertain.interval", **interval->as_string());
    std::string unit = unitOfKind(above, result.unit);
    return unit.empty() ? unitOfKind(below, result.unit) : unit;
  }

  /// "± 2 %", "[1 kg, 2 kg]", as it is written but for quotes.
  static std::string textOf(const toml::node& interval) {
    if (interval.is_string()) return **interval.as_string();
    const toml::array* ends = interval.as_array();
    std::vector<std::string> texts;
    for (const toml::node& end : *ends)
      texts.push_back(end.is_string()    ? **end.as_string()
                      : end.is_integer() ? fmt::format("{}", **end.as_integer())
                                         : fmt::format("{}", **end.as_floating_point()));
    return fmt::format("[{}]", fmt::join(texts, ", "));
  }

  /// Empty too of a unit of another kind.
  static std::string unitOfKind(const std::string& text, const std::string& kind) {
    std::string unit = unitBehindNumber(text);
    return unit.empty() || isCompatible(dimensionOf(unit), dimensionOf(kind)) ? unit : "";
  }

  /// Beside degrees, a bare number may be meant as such.
  void noteRadians(const toml::node& interval, const UncertainQuantity& result) {
    const auto place = places_.find(result.quantity);
    if (result.unit != "rad" || place == places_.end() || !place->second->is_string()) return;
    const auto isInDegrees = [](const std::string& text) {
      return text.find("deg") != std::string::npos || text.find("°") != std::string::npos;
    };
    const auto isBare = [&](const toml::node& node) {  // an exponent is no unit
      if (node.is_number()) return true;
      if (!node.is_string()) return false;
      const std::string& text = **node.as_string();
      return text.find("°") == std::string::npos && std::ranges::none_of(text, [](char c) {
               return c == '%' || (c != 'e' && c != 'E' && std::isalpha(static_cast<unsigned char>(c)) != 0);
             });
    };
    const bool isOfBare = interval.is_array() ? std::ranges::any_of(*interval.as_array(), isBare) : isBare(interval);
    if (!isOfBare || !isInDegrees(**place->second->as_string())) return;
    study_.notes.push_back(source_.note(
        interval, fmt::format("the interval of '{}' has no unit and is read in rad, its nominal value is in degrees",
                              result.quantity)));
  }

  void checkRange(const toml::node& node, const std::string& what, const UncertainQuantity& result) const {
    const Interval& range = result.uncertain.range;
    if (!(range.lower() < range.upper()))
      source_.fail(node, what + " holds one value only", "a lower bound below the upper one");
    if (dimensionOf(result.unit) == Dimension{1, 0, 0, 0} && range.lower() < 0)
      source_.fail(node, fmt::format("{} reaches down to a negative mass", what), "a lower bound of at least 0 kg");
    if (!contains(range, result.uncertain.nominal))
      source_.fail(node,
                   fmt::format("{} does not hold the nominal value {}", what,
                               inUnit(numberText(result.uncertain.nominal, 6), result.unit)),
                   "an interval around the nominal value");
  }

  /// "± 1 mm": twice "1 mm"; "+2 / -1 mm": "1 mm", "2 mm". The unit of the second is that of both unless each has one.
  std::pair<std::string, std::string> deviations(const toml::node& node, const std::string& what,
                                                 const std::string& text) const {
    const auto sign = std::ranges::find_if(deviationSigns, [&](auto s) { return text.starts_with(s); });
    if (sign != deviationSigns.end()) return {text.substr(sign->size()), text.substr(sign->size())};
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

  /// `varies = "freely"`, or a `rate` that is the most it changes by in a second.
  void readCourse(const TomlSection& section, const toml::node& quantity, UncertainQuantity& result) const {
    if (study_.analysis == Study::Analysis::equilibria &&
        study_.mechanism.initialValues().find(result.quantity) != nullptr)
      source_.fail(quantity,
                   fmt::format("'{}' is where rest is looked for first, which nothing depends on", result.quantity),
                   "a parameter or a number of an element");
    const toml::node *varies = section.find("varies"), *rate = section.find("rate");
    if (varies == nullptr && rate == nullptr) return;
    const toml::node& first = varies != nullptr ? *varies : *rate;
    if (varies != nullptr) source_.asChoice(*varies, "uncertain.varies", {"freely"});
    if (varies != nullptr && rate != nullptr)
      source_.fail(*rate, "what varies freely has no uncertain.rate", "one of the two");
    for (const char* key : {"distribution", "membership"})
      if (const toml::node* node = section.find(key))
        source_.fail(*node, fmt::format("what varies in time has no uncertain.{}", key), "an interval alone");
    if (!study_.moves())
      source_.fail(first, fmt::format("in {} nothing varies in time", study_.analysisName()),
                   "analysis = \"dynamics\"");
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
    for (const std::string_view sign : deviationSigns)
      if (text.starts_with(sign)) text.erase(0, sign.size());
    result.rate = enclose(text.empty() ? source_.asAmount(*rate, "uncertain.rate", dimension, unit)
                                       : source_.readAmount(*rate, "uncertain.rate", text, dimension, unit))
                      .upper();
    if (!(result.rate > 0)) source_.fail(*rate, "uncertain.rate is not positive", "the most it changes by in a second");
  }

  static constexpr const char* waysToSayIt = "\"± 1 %\", \"± 2 deg\", \"+2 / -1 mm\" or [lower, upper]";

  const TomlSource& source_;
  const TableFiles& files_;
  const std::map<std::string, const toml::node*>& places_;
  const ShapeTypes& shapes_;
  Study& study_;
  std::vector<const toml::table*> tables_;              // of each uncertain quantity
  std::unordered_set<std::string> quantities_, names_;  // that are uncertain so far
};

}  // namespace

void readUncertain(const TomlSource& source, const std::vector<const toml::table*>& tables, const TableFiles& files,
                   const std::map<std::string, const toml::node*>& places, const ShapeTypes& shapes, Study& study) {
  UncertainReader reader(source, files, places, shapes, study);
  for (const toml::table* table : tables) reader.read(*table);
  reader.noteFaults();
}

std::string quantityExpected(const std::string& word, const std::vector<std::string>& known) {
  const std::string names = expectedName(word, known);
  return fmt::format("a quantity of the mechanism, {}{}", names.starts_with('\'') ? "such as " : "", names);
}

std::string outputExpected(const std::string& word, const std::vector<std::string>& known, const Mechanism& mechanism) {
  for (const Described& element : mechanism.elements()) {
    const std::string prefix = element.name() + ".";
    if (!word.starts_with(prefix)) continue;
    std::vector<std::string> own;
    for (const std::string& name : known)
      if (name.starts_with(prefix) && mechanism.isOutputQuantity(name)) own.push_back(name);
    if (own.empty())
      return fmt::format("a quantity that another element gives, or a formula of such: the {} '{}' gives none",
                         element.type(), element.name());
    if (!nearestName(word, known).empty()) break;  // a typo of that
    return fmt::format("what '{}' gives, {}", element.name(), oneOf(own));
  }
  return quantityExpected(word, known);
}

}  // namespace gamut
