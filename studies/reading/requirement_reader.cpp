// A comparison is read side by side; a margin is the difference of its sides, above zero where it holds.
#include "studies/reading/requirement_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <string_view>

#include "mechanics/description/written_units.hpp"
#include "studies/reading/uncertain_reader.hpp"

namespace gamut {
namespace {

constexpr Dimension seconds{0, 0, 1, 0};
constexpr const char* comparisonExpected =
    "a comparison with <, <=, > or >=, such as \"tip.position.z > 0.2 m\" or \"-5 deg < arm.angle < 5 deg\"";

/// "<", "<=", ">" or ">=" in a text.
struct Sign {
  std::size_t begin = 0, end = 0;
  bool isGreater = false, isMetAtZero = false;
};

class RequirementReader {
 public:
  RequirementReader(const TomlSource& source, Study& study, std::vector<const toml::node*>& nodes)
      : source_(source), study_(study), nodes_(nodes) {
    for (const OutputInfo& output : study.outputs) outputs_.push_back(output);
  }

  void read(const toml::table& table) {
    const TomlSection section(source_, table, "requirement", {"name", "always", "eventually", "from", "until"});
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
    requirement.isAlways = always != nullptr;
    for (const Requirement& other : study_.requirements)
      if (other.name == requirement.name)
        source_.fail(section.find("name") == nullptr ? node : *section.find("name"),
                     fmt::format("two requirements are named '{}'", other.name), "different names");
    readWindow(section, requirement);
    readComparison(node, text, requirement);
    study_.requirements.push_back(std::move(requirement));
  }

 private:
  // ---- Window -------------------------------------------------------------------------------------------------------

  void readWindow(const TomlSection& section, Requirement& requirement) {
    requirement.until = study_.horizon;
    for (const char* key : {"from", "until"}) {
      const toml::node* node = section.find(key);
      if (node == nullptr) continue;
      const std::string name = section.nameOf(key);
      if (study_.analysis == Study::Analysis::kinematics)
        source_.fail(*node, name + " has no meaning in kinematics", "no such key");
      const double time = nearest(source_.asAmount(*node, name, seconds));
      if (!(time >= 0 && time <= study_.horizon))
        source_.fail(*node, fmt::format("{} is {} s, outside the study's time", name, time),
                     fmt::format("a time from 0 s to {} s", study_.horizon));
      (std::string_view(key) == "from" ? requirement.from : requirement.until) = time;
      // What is known at an output time is known exactly there.
      std::vector<double>& times = study_.motion.times;
      const auto place = std::ranges::lower_bound(times, time);
      if (place == times.end() || *place != time) times.insert(place, time);
    }
    if (requirement.from > requirement.until)
      source_.fail(section.table(),
                   fmt::format("the requirement's time begins at {} s, after its end at {} s", requirement.from,
                               requirement.until),
                   "from before until");
    if (study_.motion.times.size() > maxOutputTimes)
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
      const bool isMetAtZero = i + 1 < text.size() && text[i + 1] == '=';
      signs.push_back({i, i + (isMetAtZero ? 2 : 1), c == '>', isMetAtZero});
      i = signs.back().end - 1;
    }
    if (signs.empty()) source_.fail(node, fmt::format("'{}' compares nothing", text), comparisonExpected);
    if (signs.size() > 2 || (signs.size() == 2 && signs[0].isGreater != signs[1].isGreater))
      source_.fail(node, fmt::format("'{}' has comparisons that do not belong together", text),
                   "one comparison, or two in the same direction; other ones as requirements of their own");
    return signs;
  }

  void readComparison(const toml::node& node, const std::string& text, Requirement& requirement) {
    const std::vector<Sign> signs = signsIn(node, text);
    std::vector<Side> sides;
    for (std::size_t i = 0; i <= signs.size(); ++i) {
      const std::size_t begin = i == 0 ? 0 : signs[i - 1].end, end = i == signs.size() ? text.size() : signs[i].begin;
      sides.push_back(readSide(node, text, begin, end));
    }
    takeUnits(node, text, sides);
    if (signs.size() == 2) refuseContradiction(node, text, signs, sides.front(), sides.back());
    for (std::size_t i = 0; i < signs.size(); ++i) {
      const Side &greater = sides[signs[i].isGreater ? i : i + 1], &less = sides[signs[i].isGreater ? i + 1 : i];
      const std::string which = signs.size() == 1                ? ""
                                : signs[i].isGreater == (i == 0) ? ", from above"
                                                                 : ", from below";
      const std::vector<std::string> wanted = wantedUnits(sides);
      const auto add = [&](const std::string& side, const Side& below) {
        addMargin(node, requirement.name + side, greater, below, wanted);
        requirement.margins.push_back(study_.outputs.size() - 1);
        requirement.isMetAtZero.push_back(signs[i].isMetAtZero ? 1 : 0);
      };
      // |x| < c is -c < x < c, without a kink.
      const std::string inside = signs.size() == 1 ? insideOfAbs(less.quantity) : "";
      if (inside.empty()) {
        add(which, less);
      } else {
        add(", from above", {inside, less.expression});
        add(", from below", {fmt::format("-({})", inside), less.expression});
      }
    }
  }

  /// One side of a comparison.
  struct Side {
    std::string quantity;  ///< with outputs' names replaced by what they are
    Expression expression = 0.0;
    bool isZero = false;
    std::string ofOutput = {};  ///< unit of the first output that it names, or is
    std::string ofNumber = {};  ///< of a number with one
  };

  /// Blanks stand for the rest of the text, so that columns are the text's.
  Side readSide(const toml::node& node, const std::string& text, std::size_t begin, std::size_t end) const {
    std::string alone(text.size(), ' ');
    alone.replace(begin, end - begin, text, begin, end - begin);
    alone.resize(end);
    const std::string trimmed = trim(text.substr(begin, end - begin));
    if (trimmed.empty())
      source_.fail(node, fmt::format("'{}' has nothing on one side of a comparison", text), comparisonExpected);
    Side side;
    try {
      side.expression = Expression::parse(alone, [this](std::string_view word) {
        const std::string name(word);
        return isQuantity(name) || outputNamed(name) != nullptr;
      });
      for (const std::string& name : side.expression.names())
        if (name != "t" && outputNamed(name) == nullptr && !isQuantity(name))
          source_.fail(node, fmt::format("unknown quantity '{}'", name), quantityExpected(name, namesForMessages()));
      dimensionOf(side.expression);
    } catch (const UnitError& error) {
      if (outputNamed(trimmed) != nullptr && unitNamed(trimmed) != nullptr)
        source_.fail(node, fmt::format("'{}' is a unit as well as an output", trimmed),
                     fmt::format("the output in single quotes, '{}'", trimmed));
      source_.fail(node, error);
    }
    const std::optional<Amount> amount = side.expression.amount();
    side.isZero = amount && amount->value == 0;
    side.quantity = withoutOutputs(trimmed, side.expression.names());
    for (const std::string& name : side.expression.names())
      if (const OutputInfo* output = outputThatIs(name); output != nullptr && side.ofOutput.empty())
        side.ofOutput = output->unit;
    if (amount) side.ofNumber = unitBehindNumber(trimmed);
    return side;
  }

  /// In which a margin is told, where it is one of them: the unit of the output that is compared, one that is not of SI
  /// first; else that of its limit.
  static std::vector<std::string> wantedUnits(const std::vector<Side>& sides) {
    std::vector<std::string> units;
    for (const bool isSi : {false, true})
      for (const Side& side : sides)
        if (!side.ofOutput.empty() && isOfSi(side.ofOutput) == isSi) units.push_back(side.ofOutput);
    for (const Side& side : sides)
      if (!side.ofNumber.empty()) units.push_back(side.ofNumber);
    return units;
  }

  static bool isOfSi(const std::string& unit) { return unit == "1" || unitOf(gamut::dimensionOf(unit)) == unit; }

  /// A plain number is one in the SI unit of what it is compared with, as everywhere in a study.
  void takeUnits(const toml::node& node, const std::string& text, std::vector<Side>& sides) const {
    const auto isPlainNumber = [](const Side& side) {
      const std::optional<Amount> amount = side.expression.amount();
      return amount && !amount->hasUnit && !amount->isRelative;
    };
    const auto first = std::ranges::find_if_not(sides, isPlainNumber);
    if (first == sides.end()) return;
    const Dimension dimension = dimensionOf(first->expression);
    for (Side& side : sides) {
      const Dimension own = dimensionOf(side.expression);
      if (own == dimension || side.isZero) continue;
      if (isAlikeButForRadians(own, dimension)) {
        side.quantity = inParentheses(side.quantity);
        for (int n = own.angle; n != dimension.angle; n += n < dimension.angle ? 1 : -1)
          side.quantity += n < dimension.angle ? "*(1 rad)" : "/(1 rad)";
        continue;
      }
      if (!isPlainNumber(side))
        source_.fail(node, fmt::format("'{}' compares {} with {}", text, unitOf(dimension), unitOf(own)),
                     "quantities of one kind" + std::max(perRadian(dimension, own), perRadian(own, dimension)));
      const bool isOneNumber = side.quantity.find_first_of("+*/^( ") == std::string::npos;
      side.quantity = isOneNumber ? fmt::format("{} {}", side.quantity, unitInFormulas(dimension))
                                  : fmt::format("({})*(1 {})", side.quantity, unitInFormulas(dimension));
    }
  }

  /// Nothing lies between limits that have changed places.
  void refuseContradiction(const toml::node& node, const std::string& text, const std::vector<Sign>& signs,
                           const Side& first, const Side& last) const {
    const std::optional<Amount> a = first.expression.amount(), b = last.expression.amount();
    if (!a || !b) return;
    const bool isGreater = signs[0].isGreater, isMetByOne = signs[0].isMetAtZero && signs[1].isMetAtZero;
    const double below = nearest(isGreater ? *b : *a), above = nearest(isGreater ? *a : *b);
    if (below > above || (below == above && !isMetByOne))
      source_.fail(node, fmt::format("'{}' is met by nothing: its limits leave nothing between them", text),
                   fmt::format("the {} limit first", isGreater ? "greater" : "lesser"));
  }

  void addMargin(const toml::node& node, const std::string& name, const Side& greater, const Side& less,
                 const std::vector<std::string>& wanted) {
    std::string quantity, unit;
    try {
      quantity = less.isZero ? greater.quantity
                 : greater.isZero
                     ? fmt::format("-({})", less.quantity)
                     : fmt::format("{} - {}", inParentheses(greater.quantity), inParentheses(less.quantity));
      const Dimension dimension = study_.mechanism.dimensionOf(study_.mechanism.parse(quantity));
      const auto found = std::ranges::find_if(wanted, [&](const std::string& of) {
        return gamut::dimensionOf(of) == dimension || isAlikeButForRadians(gamut::dimensionOf(of), dimension);
      });
      unit = found != wanted.end() ? *found : unitOf(dimension);
    } catch (const UnitError& error) {
      source_.fail(node, error);
    }
    for (const OutputInfo& other : study_.outputs)
      if (other.name == name)
        source_.fail(node, fmt::format("an output and a requirement's margin are both named '{}'", name),
                     "a name of its own for the requirement");
    study_.outputs.push_back(OutputInfo{name, quantity, unit});
    nodes_.push_back(&node);
  }

  /// x of "abs(x)"; empty for anything else.
  static std::string insideOfAbs(const std::string& quantity) {
    constexpr std::string_view begin = "abs(";
    if (!quantity.starts_with(begin) || !quantity.ends_with(')')) return {};
    int depth = 0;
    for (std::size_t i = begin.size() - 1; i + 1 < quantity.size(); ++i)
      if ((depth += quantity[i] == '(' ? 1 : quantity[i] == ')' ? -1 : 0) == 0) return {};
    return quantity.substr(begin.size(), quantity.size() - begin.size() - 1);
  }

  bool isQuantity(const std::string& name) const {
    return study_.mechanism.knows(name) || study_.mechanism.isOutputQuantity(name);
  }

  /// What is a quantity is that, also where an output has its name.
  const OutputInfo* outputNamed(const std::string& name) const {
    if (isQuantity(name)) return nullptr;
    const auto found = std::ranges::find(outputs_, name, &OutputInfo::name);
    return found == outputs_.end() ? nullptr : &*found;
  }

  /// The same, or the first that is the quantity of this name.
  const OutputInfo* outputThatIs(const std::string& name) const {
    if (!isQuantity(name)) return outputNamed(name);
    const auto found = std::ranges::find(outputs_, name, &OutputInfo::quantity);
    return found == outputs_.end() ? nullptr : &*found;
  }

  std::vector<std::string> namesForMessages() const {
    std::vector<std::string> names = study_.mechanism.namesInFormulas();
    for (const OutputInfo& output : outputs_) names.push_back(output.name);
    return names;
  }

  Dimension dimensionOf(const Expression& expression) const {
    return expression.dimension([&](const std::string& name) {
      const OutputInfo* output = outputNamed(name);
      return study_.mechanism.dimensionOf(output != nullptr ? study_.mechanism.parse(quantityOf(*output))
                                                            : Expression::named(name));
    });
  }

  /// As a term of a formula.
  static std::string inParentheses(const std::string& quantity) {
    const bool isPlain = quantity.find_first_of("+-*/^() ") == std::string::npos ||
                         quantity.find_first_not_of(
                             "0123456789. abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_") == std::string::npos;
    return isPlain ? quantity : "(" + quantity + ")";
  }

  /// A name that is no word is put in quotes in formulas.
  std::string quantityOf(const OutputInfo& output) const {
    return isQuantity(output.quantity) ? quoted(output.quantity) : output.quantity;
  }

  static std::string quoted(const std::string& name) {
    const bool isWord = std::ranges::all_of(
        name, [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '.' || c >= 0x80; });
    return isWord ? name : "'" + name + "'";
  }

  std::string withoutOutputs(std::string text, const std::vector<std::string>& names) const {
    const auto isOfWord = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '.' || c == '\''; };
    for (const std::string& name : names) {
      const OutputInfo* output = outputNamed(name);
      if (output == nullptr) continue;
      const std::string instead = inParentheses(quantityOf(*output));
      for (const std::string& word : {"'" + name + "'", quoted(name)})  // quotes are well where none are needed
        for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at)) {
          const bool isQuoted = word.front() != '\'' &&
                                std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\'') % 2 != 0;
          const bool isWhole =
              !isQuoted && (at == 0 || !isOfWord(static_cast<unsigned char>(text[at - 1]))) &&
              (at + word.size() == text.size() || !isOfWord(static_cast<unsigned char>(text[at + word.size()])));
          if (isWhole) text.replace(at, word.size(), instead);
          at += isWhole ? instead.size() : word.size();
        }
    }
    return text;
  }

  static std::string trim(const std::string& text) {
    const std::size_t first = text.find_first_not_of(" \t\n"), last = text.find_last_not_of(" \t\n");
    return first == std::string::npos ? std::string() : text.substr(first, last - first + 1);
  }

  const TomlSource& source_;
  Study& study_;
  std::vector<const toml::node*>& nodes_;
  std::vector<OutputInfo> outputs_;  // of the study, without margins
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
