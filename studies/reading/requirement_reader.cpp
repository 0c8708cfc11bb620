// A comparison is read side by side; a margin is the difference of its sides, above zero where it holds.
#include "studies/reading/requirement_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <string_view>

#include "mechanics/description/written_units.hpp"
#include "studies/reading/settings_reader.hpp"
#include "studies/reading/uncertain_reader.hpp"

namespace gamut {
namespace {

constexpr Dimension windowDimension{0, 0, 1, 0};
constexpr const char* comparisonExpected =
    "a comparison with <, <=, > or >=, such as \"tip.position.z > 0.2 m\" or \"-5 deg < arm.angle < 5 deg\"";

/// "<", "<=", ">" or ">=" in a text.
struct Sign {
  std::size_t begin = 0, end = 0;
  bool isGreater = false, isStrict = false;
};

/// One side of a comparison, in SI units.
struct Side {
  Expression expression = 0.0;
  std::optional<Expression> magnitudeOf;  ///< x where abs(x) is stated
  std::string text;                       ///< as it is stated
  std::string unitOfNumber;               ///< of a number with one
  std::string unitOfOutput;               ///< of the first output that it names, or is
  bool isPlainNumber = false;             ///< without a unit

  bool isZero() const { return expression.amount() && expression.amount()->value == 0; }
};

class RequirementReader {
 public:
  RequirementReader(const TomlSource& source, Study& study, std::vector<const toml::node*>& nodes)
      : source_(source), study_(study), nodes_(nodes), outputs_(study.outputs) {}

  void read(const toml::table& table) {
    const TomlSection section = readSettings(source_, table, "requirement", study_);
    const toml::node *always = section.find("always"), *eventually = section.find("eventually");
    if (always != nullptr && eventually != nullptr)
      source_.fail(*eventually, "requirement.always and requirement.eventually are both given", "one of them");
    if (eventually == nullptr)
      always = &section.require("always", fmt::format("always or eventually: {}", comparisonExpected));
    const toml::node& node = always != nullptr ? *always : *eventually;
    const std::string key = always != nullptr ? "always" : "eventually";
    const std::string text = source_.asText(node, "requirement." + key);
    Requirement requirement;
    requirement.name = section.text("name", text);
    requirement.statement = key + " " + text;
    requirement.demand.isAlways = always != nullptr;
    requirement.firstMargin = study_.outputs.size();
    for (const Requirement& other : study_.requirements)
      if (other.name == requirement.name)
        source_.fail(section.find("name") == nullptr ? node : *section.find("name"),
                     fmt::format("two requirements are named '{}'", other.name), "different names");
    readWindow(section, requirement.demand);
    readComparison(node, text, requirement.demand);
    addMargins(node, requirement);
    study_.requirements.push_back(std::move(requirement));
  }

 private:
  // ---- Window -------------------------------------------------------------------------------------------------------

  void readWindow(const TomlSection& section, Demand& demand) {
    demand.until = study_.horizon;
    for (const char* key : {"from", "until"}) {
      const toml::node* node = section.find(key);
      if (node == nullptr) continue;
      const std::string name = section.nameOf(key);
      const double time = nearest(source_.asAmount(*node, name, windowDimension));
      if (!(time >= 0 && time <= study_.horizon))
        source_.fail(*node, fmt::format("{} is {} s, outside the study's time", name, time),
                     fmt::format("a time from 0 s to {} s", study_.horizon));
      (std::string_view(key) == "from" ? demand.from : demand.until) = time;
      // What is known at an output time is known exactly there.
      std::vector<double>& times = study_.times;
      const auto place = std::ranges::lower_bound(times, time);
      if (place == times.end() || *place != time) times.insert(place, time);
    }
    if (demand.from > demand.until)
      source_.fail(
          section.table(),
          fmt::format("the requirement's time begins at {} s, after its end at {} s", demand.from, demand.until),
          "from before until");
    if (study_.times.size() > maxOutputTimes)
      source_.fail(section.table(), fmt::format("there are more than {} output times", maxOutputTimes), "fewer");
  }

  // ---- Comparison ---------------------------------------------------------------------------------------------------

  /// Outside of parentheses and quotes.
  std::vector<Sign> signsIn(const toml::node& node, const std::string& text) const {
    std::vector<Sign> signs;
    int depth = 0;
    bool isQuoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
      const char c = text[i];
      if (c == '\'') isQuoted = !isQuoted;
      if (isQuoted) continue;
      if (c == '(') ++depth;
      if (c == ')') --depth;
      if (depth > 0) continue;
      if (c == '=' || c == '!')
        source_.fail(node, fmt::format("'{}' is no comparison that a margin could be found of", text),
                     comparisonExpected);
      if (c != '<' && c != '>') continue;
      const bool isStrict = i + 1 == text.size() || text[i + 1] != '=';
      signs.push_back({i, i + (isStrict ? 1 : 2), c == '>', isStrict});
      i = signs.back().end - 1;
    }
    if (signs.empty()) source_.fail(node, fmt::format("'{}' compares nothing", text), comparisonExpected);
    if (signs.size() > 2 || (signs.size() == 2 && signs[0].isGreater != signs[1].isGreater))
      source_.fail(node, fmt::format("'{}' has comparisons that do not belong together", text),
                   "one comparison, or two in the same direction; other ones as requirements of their own");
    return signs;
  }

  void readComparison(const toml::node& node, const std::string& text, Demand& demand) {
    const std::vector<Sign> signs = signsIn(node, text);
    std::vector<Side> sides;
    for (std::size_t i = 0; i <= signs.size(); ++i) {
      const std::size_t begin = i == 0 ? 0 : signs[i - 1].end, end = i == signs.size() ? text.size() : signs[i].begin;
      sides.push_back(readSide(node, text, begin, end));
    }
    takeUnits(node, text, sides);
    if (signs.size() == 2) refuseContradiction(node, text, signs, sides.front(), sides.back());
    units_ = wantedUnits(sides);
    for (std::size_t i = 0; i < signs.size(); ++i) {
      const Side &left = sides[i], &right = sides[i + 1], &lesser = signs[i].isGreater ? right : left;
      const bool isMagnitude = signs.size() == 1 && lesser.magnitudeOf;
      if (left.expression.isConstant() && right.expression.isConstant())
        source_.fail(node, fmt::format("'{}' compares numbers with each other, whatever the motion", text),
                     comparisonExpected);
      if (isMagnitude) refuseNegative(node, text, signs[i].isGreater ? left : right, signs[i].isStrict);
      // What stands in the middle is compared with both ends; of two sides, a magnitude, what is no number, or the
      // first.
      const bool isLeft = signs.size() == 2 ? i == 1 : isMagnitude ? &lesser == &left : !left.expression.isConstant();
      const Side &what = isLeft ? left : right, &limit = isLeft ? right : left;
      DemandTerm term{
          what.expression,   signs[i].isGreater == isLeft ? DemandTerm::Side::above : DemandTerm::Side::below,
          limit.expression,  signs[i].isStrict,
          what.text,         limit.text,
          limit.unitOfNumber};
      if (isMagnitude)
        addMagnitude(*lesser.magnitudeOf, std::move(term), demand);
      else
        demand.terms.push_back(std::move(term));
    }
  }

  /// |x| < c is -c < x < c, without a kink.
  static void addMagnitude(const Expression& inside, DemandTerm term, Demand& demand) {
    term.expression = inside;
    if (term.what.starts_with("abs(") && term.what.ends_with(')'))
      term.what = term.what.substr(4, term.what.size() - 5);
    demand.terms.push_back(term);
    term.side = DemandTerm::Side::above;
    term.limit = -term.limit;
    term.limitText = "-" + inParentheses(term.limitText);
    demand.terms.push_back(std::move(term));
  }

  /// Blanks stand for the rest of the text, so that columns are the text's.
  Side readSide(const toml::node& node, const std::string& text, std::size_t begin, std::size_t end) const {
    std::string alone(text.size(), ' ');
    alone.replace(begin, end - begin, text, begin, end - begin);
    alone.resize(end);
    Side side;
    side.text = trim(text.substr(begin, end - begin));
    if (side.text.empty())
      source_.fail(node, fmt::format("'{}' has nothing on one side of a comparison", text), comparisonExpected);
    if (outputNamed("pi") != nullptr && namesPi(side.text))
      source_.fail(node, "'pi' is a number as well as an output", "the output in single quotes, 'pi', or another name");
    try {
      side.expression = Expression::parse(alone, [this](std::string_view word) {
        const std::string name(word);
        return isQuantity(name) || outputNamed(name) != nullptr;
      });
      for (const std::string& name : side.expression.names()) {
        if (name != "t" && outputNamed(name) == nullptr && !isQuantity(name))
          source_.fail(node, fmt::format("unknown quantity '{}'", name), quantityExpected(name, namesForMessages()));
        refuseTwoMeanings(node, name);
        if (const WantedOutput* output = outputThatIs(name); output != nullptr && side.unitOfOutput.empty())
          side.unitOfOutput = output->unit;
      }
      const auto instead = [this](const std::string& name) -> const Expression* {
        const WantedOutput* output = outputNamed(name);
        return output != nullptr ? &output->expression : nullptr;
      };
      if (const std::optional<Expression> inside = side.expression.insideOfAbs())
        side.magnitudeOf = inside->with(instead);
      side.expression = side.expression.with(instead);
      study_.mechanism.dimensionOf(side.expression);
    } catch (const UnitError& error) {
      if (outputNamed(side.text) != nullptr && unitNamed(side.text) != nullptr)
        source_.fail(node, fmt::format("'{}' is a unit as well as an output", side.text),
                     fmt::format("the output in single quotes, '{}'", side.text));
      source_.fail(node, error.problem(), error.expected());
    }
    if (const std::optional<Amount> amount = side.expression.amount()) {
      side.unitOfNumber = unitBehindNumber(side.text);
      side.isPlainNumber = !amount->hasUnit && !amount->isRelative;
    }
    return side;
  }

  /// As a word of its own outside of quotes.
  static bool namesPi(const std::string& text) {
    const auto isOfWord = [&](std::size_t i) {
      return i < text.size() &&
             (std::isalnum(static_cast<unsigned char>(text[i])) != 0 || text[i] == '_' || text[i] == '.');
    };
    for (std::size_t i = text.find("pi"); i != std::string::npos; i = text.find("pi", i + 1))
      if (std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(i), '\'') % 2 == 0 &&
          (i == 0 || !isOfWord(i - 1)) && !isOfWord(i + 2))
        return true;
    return false;
  }

  /// In which a margin is told, where it is one of them: the unit of the output that is compared, one that is not of SI
  /// first; else that of its limit.
  static std::vector<std::string> wantedUnits(const std::vector<Side>& sides) {
    std::vector<std::string> units;
    for (const bool isSi : {false, true})
      for (const Side& side : sides)
        if (!side.unitOfOutput.empty() && isOfSi(side.unitOfOutput) == isSi) units.push_back(side.unitOfOutput);
    for (const Side& side : sides)
      if (!side.unitOfNumber.empty()) units.push_back(side.unitOfNumber);
    return units;
  }

  static bool isOfSi(const std::string& unit) { return unit == "1" || unitOf(gamut::dimensionOf(unit)) == unit; }

  /// A plain number is one in the SI unit of what it is compared with, as everywhere in a study.
  void takeUnits(const toml::node& node, const std::string& text, std::vector<Side>& sides) {
    const auto first = std::ranges::find_if_not(sides, &Side::isPlainNumber);
    dimension_ = first == sides.end() ? Dimension{} : study_.mechanism.dimensionOf(first->expression);
    for (Side& side : sides) {
      const Dimension own = study_.mechanism.dimensionOf(side.expression);
      if (own == dimension_ || isAlikeButForRadians(own, dimension_) || side.isZero()) continue;
      if (!side.isPlainNumber)
        source_.fail(node, fmt::format("'{}' compares {} with {}", text, unitOf(dimension_), unitOf(own)),
                     "quantities of one kind" + std::max(perRadian(dimension_, own), perRadian(own, dimension_)));
      const bool isOneNumber = side.text.find_first_of("+-*/^( ", 1) == std::string::npos;
      side.text = fmt::format(fmt::runtime(isOneNumber ? "{} {}" : "({}) {}"), side.text, unitOf(dimension_));
    }
    for (const Side& side : sides)
      dimension_.isOfMoment = dimension_.isOfMoment || study_.mechanism.dimensionOf(side.expression).isOfMoment;
  }

  /// Nothing lies between limits that have changed places.
  void refuseContradiction(const toml::node& node, const std::string& text, const std::vector<Sign>& signs,
                           const Side& first, const Side& last) const {
    const std::optional<Amount> a = first.expression.amount(), b = last.expression.amount();
    if (!a || !b) return;
    const bool isGreater = signs[0].isGreater, isMetByOne = !signs[0].isStrict && !signs[1].isStrict;
    const double below = nearest(isGreater ? *b : *a), above = nearest(isGreater ? *a : *b);
    if (below > above || (below == above && !isMetByOne))
      source_.fail(node, fmt::format("'{}' is met by nothing: its limits leave nothing between them", text),
                   fmt::format("the {} limit first", isGreater ? "greater" : "lesser"));
  }

  /// A magnitude that is to lie below a number.
  void refuseNegative(const toml::node& node, const std::string& text, const Side& limit, bool isStrict) const {
    const std::optional<Amount> amount = limit.expression.amount();
    if (!amount) return;
    if (const double most = nearest(*amount); most < 0 || (most == 0 && isStrict))
      source_.fail(node, fmt::format("'{}' is met by nothing: no magnitude is below 0", text), "a limit above 0");
  }

  void addMargins(const toml::node& node, const Requirement& requirement) {
    const auto found = std::ranges::find_if(units_, [&](const std::string& unit) {
      return gamut::dimensionOf(unit) == dimension_ || isAlikeButForRadians(gamut::dimensionOf(unit), dimension_);
    });
    const std::string unit = found != units_.end() ? *found : unitOf(dimension_);
    for (const DemandTerm& term : requirement.demand.terms) {
      const bool isAbove = term.side == DemandTerm::Side::above;
      const std::string name = requirement.name + (requirement.margins() == 1 ? ""
                                                   : isAbove                  ? ", from below"
                                                                              : ", from above");
      if (std::ranges::find(study_.outputs, name, &WantedOutput::name) != study_.outputs.end())
        source_.fail(node, fmt::format("an output and a requirement's margin are both named '{}'", name),
                     "a name of its own for the requirement");
      study_.outputs.push_back({{name, marginText(term), unit}, term.margin()});
      nodes_.push_back(&node);
    }
  }

  static std::string marginText(const DemandTerm& term) {
    const bool isAbove = term.side == DemandTerm::Side::above,
               isOfZero = term.limit.amount() && term.limit.amount()->value == 0;
    const std::string what = inParentheses(term.what), limit = inParentheses(term.limitText);
    if (isOfZero) return isAbove ? term.what : "-" + what;
    return isAbove ? fmt::format("{} - {}", what, limit) : fmt::format("{} - {}", limit, what);
  }

  // ---- Names --------------------------------------------------------------------------------------------------------

  bool isQuantity(const std::string& name) const {
    return study_.mechanism.knows(name) || study_.mechanism.isOutputQuantity(name);
  }

  /// What is a quantity is that, also where an output has its name.
  const WantedOutput* outputNamed(const std::string& name) const {
    if (isQuantity(name)) return nullptr;
    const auto found = std::ranges::find(outputs_, name, &WantedOutput::name);
    return found == outputs_.end() ? nullptr : &*found;
  }

  /// An output may have the name of the quantity that it is, and of no other.
  void refuseTwoMeanings(const toml::node& node, const std::string& name) const {
    if (name != "t" && !isQuantity(name)) return;
    const auto found = std::ranges::find(outputs_, name, &WantedOutput::name);
    if (found == outputs_.end()) return;
    const auto form = found->expression.affineIn(Expression::named(name));
    if (!form || !isEqual(form->factor, Interval(1.0)) || !isEqual(form->offset, Interval(0.0)))
      source_.fail(
          node,
          fmt::format("'{}' is a quantity as well as an output, which is another one, '{}'", name, found->quantity),
          "another name for the output");
  }

  /// The same, or the first that is the quantity of this name.
  const WantedOutput* outputThatIs(const std::string& name) const {
    if (!isQuantity(name)) return outputNamed(name);
    const auto found = std::ranges::find(outputs_, name, &WantedOutput::quantity);
    return found == outputs_.end() ? nullptr : &*found;
  }

  std::vector<std::string> namesForMessages() const {
    std::vector<std::string> names = study_.mechanism.namesInFormulas();
    for (const WantedOutput& output : outputs_) names.push_back(output.name);
    return names;
  }

  /// As a term of a formula.
  static std::string inParentheses(const std::string& text) {
    const bool isOne = text.find_first_of("+-*/^ ", 1) == std::string::npos || !unitBehindNumber(text).empty() ||
                       (text.front() == '\'' && text.find('\'', 1) == text.size() - 1);
    return isOne && text.front() != '-' ? text : "(" + text + ")";
  }

  static std::string trim(const std::string& text) {
    const std::size_t first = text.find_first_not_of(" \t\n"), last = text.find_last_not_of(" \t\n");
    return first == std::string::npos ? std::string() : text.substr(first, last - first + 1);
  }

  const TomlSource& source_;
  Study& study_;
  std::vector<const toml::node*>& nodes_;
  std::vector<WantedOutput> outputs_;  // of the study, without margins
  Dimension dimension_;                // of both sides
  std::vector<std::string> units_;     // in which their margins may be told
};

}  // namespace

bool isAlikeButForRadians(const Dimension& a, const Dimension& b) {
  Dimension turned = b;
  turned.angle = a.angle;
  return a == turned && std::min(a.angle, b.angle) >= 0 && (a.mass != 0 || a.length != 0);
}

std::string perRadian(const Dimension& quantity, const Dimension& wanted) {
  Dimension turned = quantity;
  turned.angle = wanted.angle;
  return quantity.angle == -1 && wanted.angle == 0 && turned == wanted ? " (or \"(1 rad)\" times the quantity)" : "";
}

void readRequirements(const TomlSource& source, const std::vector<const toml::table*>& tables, Study& study,
                      std::vector<const toml::node*>& nodes) {
  RequirementReader reader(source, study, nodes);
  for (const toml::table* table : tables) reader.read(*table);
}

}  // namespace gamut
