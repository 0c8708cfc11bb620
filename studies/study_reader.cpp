// Reads a study file table by table. Everything is checked here, so that a study that was read can be run.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>

#include "mechanics/model.hpp"
#include "mechanics/names.hpp"
#include "studies/detail/mechanism_reader.hpp"
#include "studies/detail/toml_source.hpp"
#include "studies/study.hpp"

namespace gamut {
namespace {

constexpr Dimension plain{}, seconds{0, 0, 1, 0};

class StudyReader {
 public:
  StudyReader(const std::string& text, const std::string& name) : source_(text, name) {
    study_.text = text;
    study_.file = name;
  }

  Study read() {
    const TomlSection file(source_, source_.root(), "",
                           {"study", "mechanism", "uncertain", "output", "interval", "stochastic", "fuzzy", "limits"});
    readStudyTable(source_.asTable(file.require("study", "a table [study]"), "study"));
    study_.mechanism =
        readMechanism(source_, source_.asTable(file.require("mechanism", "a table [mechanism]"), "mechanism"));
    for (const toml::table* table : tables(file, "uncertain")) readUncertain(*table);
    file.require("output", "a table [[output]] for each output that is wanted");
    for (const toml::table* table : tables(file, "output")) readOutput(*table);
    checkInitialValues();
    checkMotion(*file.find("mechanism"));
    if (const toml::node* node = file.find("interval")) readInterval(source_.asTable(*node, "interval"));
    if (const toml::node* node = file.find("stochastic")) readStochastic(source_.asTable(*node, "stochastic"));
    checkPlan(file.find("stochastic"));
    if (const toml::node* node = file.find("fuzzy")) readFuzzy(source_.asTable(*node, "fuzzy"));
    if (const toml::node* node = file.find("limits")) readLimits(source_.asTable(*node, "limits"));
    return std::move(study_);
  }

 private:
  std::vector<const toml::table*> tables(const TomlSection& file, std::string_view key) const {
    std::vector<const toml::table*> result;
    const toml::node* node = file.find(key);
    if (node == nullptr) return result;
    const std::string name(key);
    if (!node->is_array())
      source_.fail(*node, fmt::format("{} is no list of tables", name), fmt::format("[[{}]]", name));
    for (const toml::node& entry : *node->as_array()) result.push_back(&source_.asTable(entry, name));
    if (result.empty()) source_.fail(*node, name + " is empty", fmt::format("a table [[{}]]", name));
    return result;
  }

  // ---- [study] ------------------------------------------------------------------------------------------------------

  void readStudyTable(const toml::table& table) {
    const TomlSection section(source_, table, "study",
                              {"title", "analysis", "horizon", "output_step", "output_times", "compare"});
    study_.title = section.text("title", std::filesystem::path(study_.file).stem().string());
    const toml::node& analysis = section.require("analysis", "\"dynamics\" or \"kinematics\"");
    const bool isMotion = source_.asChoice(analysis, "study.analysis", {"dynamics", "kinematics"}) == "dynamics";
    study_.analysis = isMotion ? Study::Analysis::dynamics : Study::Analysis::kinematics;
    if (isMotion) {
      readTimes(section);
    } else {
      for (const char* key : {"horizon", "output_step", "output_times"})
        if (const toml::node* node = section.find(key))
          source_.fail(*node, fmt::format("{} has no meaning in kinematics", section.nameOf(key)), "no such key");
      study_.time = {0.0};
    }
    readCompare(section);
  }

  void readCompare(const TomlSection& section) {
    const toml::node* node = section.find("compare");
    if (node == nullptr) return;
    std::set<std::string> found;
    for (const toml::node& entry : source_.asArray(*node, "study.compare")) {
      const std::string word = source_.asChoice(entry, "study.compare", {"interval", "stochastic", "fuzzy"});
      if (!found.insert(word).second)
        source_.fail(entry, fmt::format("study.compare names \"{}\" twice", word), "every analysis once");
    }
    if (found.empty())
      source_.fail(*node, "study.compare is empty", "\"interval\", \"stochastic\", \"fuzzy\" or some of them");
    study_.interval = found.contains("interval");
    study_.stochastic = found.contains("stochastic");
    study_.fuzzy = found.contains("fuzzy");
  }

  void readTimes(const TomlSection& section) {
    const toml::node& end = section.require("horizon", "the time to be reached, in s");
    const Amount horizon = source_.asAmount(end, "study.horizon", seconds);
    if (horizon.value <= 0) source_.fail(end, "study.horizon is not positive", "a time above 0 s");
    study_.horizon = nearest(horizon);
    const toml::node* list = section.find("output_times");
    if (list == nullptr) return readStep(section, horizon);
    if (const toml::node* step = section.find("output_step"))
      source_.fail(*step, "study.output_step and study.output_times are both given", "one of them");
    readTimeList(*list, horizon);
  }

  /// 0, step, 2 step, …, horizon: each the double nearest to the decimal.
  void readStep(const TomlSection& section, const Amount& horizon) {
    const toml::node& node = section.require("output_step", "output_step in s, or a list output_times");
    const Amount step = source_.asAmount(node, "study.output_step", seconds);
    if (step.value <= 0) source_.fail(node, "study.output_step is not positive", "a time above 0 s");
    if (step.piPower != horizon.piPower)
      source_.fail(node, "study.output_step is a multiple of another power of pi than study.horizon",
                   "both without pi");
    const mpq_class count = horizon.value / step.value;
    if (count > static_cast<unsigned long>(maxOutputTimes) - 2)
      source_.fail(node, fmt::format("study.output_step gives more than {} output times", maxOutputTimes),
                   "a longer step or a shorter horizon");
    Amount time = step;
    for (unsigned long i = 0; i <= count; ++i) {
      time.value = step.value * i;
      study_.time.push_back(nearest(time));
    }
    if (study_.time.back() < study_.horizon) study_.time.push_back(study_.horizon);
    if (study_.time.size() > 1 && study_.time[1] == 0)
      source_.fail(node, "study.output_step is too small", "a longer step");
  }

  void readTimeList(const toml::node& node, const Amount& horizon) {
    const toml::array& list = source_.asArray(node, "study.output_times");
    if (list.empty()) source_.fail(node, "study.output_times is empty", "at least one time");
    if (list.size() > maxOutputTimes - 2)
      source_.fail(node, fmt::format("study.output_times has more than {} times", maxOutputTimes - 2), "fewer times");
    study_.time.push_back(0.0);
    for (const toml::node& entry : list) {
      const double time = nearest(source_.asAmount(entry, "study.output_times", seconds));
      const bool isStart = time == 0 && &entry == list.get(0);
      if (!isStart && !(time > study_.time.back()))
        source_.fail(entry, fmt::format("the output time {} s does not follow {} s", time, study_.time.back()),
                     "times that rise from 0 s");
      if (time > nearest(horizon))
        source_.fail(entry, fmt::format("the output time {} s is beyond the horizon", time),
                     fmt::format("at most {} s", study_.horizon));
      if (!isStart) study_.time.push_back(time);
    }
    if (study_.time.back() < study_.horizon) study_.time.push_back(study_.horizon);
  }

  // ---- [[uncertain]] ------------------------------------------------------------------------------------------------

  void readUncertain(const toml::table& table) {
    const TomlSection section(source_, table, "uncertain",
                              {"name", "quantity", "interval", "distribution", "membership"});
    const toml::node& node = section.require("quantity", "the number that is uncertain, such as \"shoulder.angle\"");
    const std::string quantity = source_.asText(node, "uncertain.quantity");
    const std::vector<std::string> known = study_.mechanism.quantities();
    if (std::find(known.begin(), known.end(), quantity) == known.end())
      source_.fail(node, fmt::format("unknown quantity '{}'", quantity), quantityExpected(quantity, known));
    UncertainQuantity result{quantity, study_.mechanism.unitOf(quantity), {}};
    result.uncertain.name = section.text("name", quantity);
    for (const UncertainQuantity& other : study_.uncertain) {
      if (other.quantity == quantity)
        source_.fail(node, fmt::format("'{}' is made uncertain twice", quantity), "every quantity once");
      if (other.uncertain.name == result.uncertain.name)
        source_.fail(table, fmt::format("two uncertain quantities are named '{}'", other.uncertain.name),
                     "different names");
    }
    const toml::node& interval = section.require("interval", "\"± 1 %\", \"± 2 deg\" or [lower, upper]");
    readRange(interval, result);
    readDistribution(section, result);
    readMembership(section, result);
    try {
      result.uncertain.check();
    } catch (const std::invalid_argument& error) {
      source_.failWith(interval, error.what(), "an interval that holds the nominal value and both supports");
    }
    study_.uncertain.push_back(std::move(result));
  }

  static std::string quantityExpected(const std::string& word, const std::vector<std::string>& known) {
    const std::string nearest = nearestName(word, known);
    return nearest.empty() ? "a number of the mechanism"
                           : fmt::format("a quantity of the mechanism, such as '{}'", nearest);
  }

  /// [lower, upper], or a deviation to both sides of the nominal value: relative to it in percent, or in its unit.
  void readRange(const toml::node& node, UncertainQuantity& result) {
    const std::string what = "uncertain.interval";
    const Dimension dimension = dimensionOf(result.unit);
    const Interval nominal = study_.mechanism.nominal(result.quantity);
    result.uncertain.nominal = midpoint(nominal);
    if (node.is_array()) {
      result.uncertain.range = pair(node, what, dimension);
    } else {
      const std::string text = source_.asText(node, what);
      const auto sign = std::find_if(signs.begin(), signs.end(), [&](auto s) { return text.starts_with(s); });
      if (sign == signs.end())
        source_.fail(node, fmt::format("{} is \"{}\"", what, text), "\"± 1 %\", \"± 2 deg\" or [lower, upper]");
      const std::string rest = text.substr(sign->size());
      Amount deviation = source_.readAnyAmount(node, what, rest);
      if (deviation.value <= 0) source_.fail(node, what + " has no positive deviation", "a deviation above 0");
      if (deviation.isRelative && !deviation.hasUnit) {
        const Interval share = enclose(deviation);
        result.uncertain.range = nominal * hull(1.0 - share, 1.0 + share);  // |v - nominal| <= share |nominal|
      } else {
        deviation = source_.readAmount(node, what, rest, dimension);
        const Interval size = enclose(deviation);
        result.uncertain.range = hull(nominal - size, nominal + size);
      }
    }
    const Interval& range = result.uncertain.range;
    if (!(range.lower() < range.upper()))
      source_.fail(node, what + " holds one value only", "a lower bound below the upper one");
    if (dimension == Dimension{1, 0, 0, 0} && range.lower() < 0)
      source_.fail(node, fmt::format("{} reaches down to a negative mass", what), "a lower bound of at least 0 kg");
    if (!contains(range, result.uncertain.nominal))
      source_.fail(node, fmt::format("{} does not hold the nominal value {:.6g}", what, result.uncertain.nominal),
                   "an interval around the nominal value");
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
                                    {"lognormal", {"support", "log_mean", "log_deviation"}}},
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

  /// An initial value that follows an uncertain parameter would be a second copy of it, which no analysis could tell.
  void checkInitialValues() const {
    const std::vector<std::string> names = study_.mechanism.stateNames();
    const std::vector<Quantity> initial = study_.mechanism.initialState();
    for (std::size_t i = 0; i < names.size(); ++i)
      for (const UncertainQuantity& uncertain : study_.uncertain)
        if (initial[i].parameter() == uncertain.quantity && initial[i].parameter() != names[i])
          source_.fail(
              source_.root(),
              fmt::format("the uncertain parameter '{}' sets the initial value '{}'", uncertain.quantity, names[i]),
              fmt::format("the initial value as a number, and '{}' as the uncertain quantity", names[i]));
  }

  /// Records the equations of motion once: they exist, or the mechanism is at fault.
  void checkMotion(const toml::node& mechanism) const {
    try {
      if (study_.analysis == Study::Analysis::dynamics) recordMotion(study_.mechanism);
    } catch (const std::invalid_argument& error) {
      source_.failWith(mechanism, error.what(), "a mass that every joint moves");
    }
  }

  // ---- [[output]] ---------------------------------------------------------------------------------------------------

  void readOutput(const toml::table& table) {
    const TomlSection section(source_, table, "output", {"name", "quantity"});
    const toml::node& node = section.require("quantity", "what is wanted, such as \"tip.position.z\" or \"energy\"");
    const std::string quantity = source_.asText(node, "output.quantity");
    const std::vector<std::string> known = study_.mechanism.outputQuantities();
    if (std::find(known.begin(), known.end(), quantity) == known.end())
      source_.fail(node, fmt::format("unknown quantity '{}'", quantity), quantityExpected(quantity, known));
    const std::string name = section.text("name", quantity);
    for (const OutputInfo& other : study_.outputs)
      if (other.name == name) {
        const toml::node* at = section.find("name");
        source_.fail(at == nullptr ? node : *at, fmt::format("two outputs are named '{}'", name), "different names");
      }
    study_.outputs.push_back({name, quantity, study_.mechanism.unitOf(quantity)});
  }

  // ---- [interval], [stochastic], [fuzzy], [limits]
  // ----------------------------------------------------------------------------

  /// A whole number, or "auto" for the default.
  int integerOrAuto(const TomlSection& section, std::string_view key, int otherwise, int least, int most) const {
    const toml::node* node = section.find(key);
    if (node == nullptr || (node->is_string() && node->as_string()->get() == "auto")) return otherwise;
    if (!node->is_integer())
      source_.fail(*node, fmt::format("{} is neither a whole number nor \"auto\"", section.nameOf(key)),
                   fmt::format("\"auto\" or a whole number between {} and {}", least, most));
    return static_cast<int>(section.integer(key, otherwise, least, most));
  }

  void readInterval(const toml::table& table) {
    const TomlSection section(source_, table, "interval", {"tolerance", "order", "degree", "split", "max_pieces"});
    FlowOptions& flow = study_.flow;
    flow.tolerance = section.positive("tolerance", flow.tolerance);
    if (flow.tolerance > 1) source_.fail(*section.find("tolerance"), "interval.tolerance is above 1", "a small number");
    flow.order = integerOrAuto(section, "order", flow.order, 4, 30);
    flow.degree = integerOrAuto(section, "degree", flow.degree, 1, 30);
    const toml::node* split = section.find("split");
    if (split != nullptr && !(split->is_string() && split->as_string()->get() == "auto"))
      flow.split = section.flag("split", flow.split);
    flow.maxPieces = static_cast<int>(section.integer("max_pieces", flow.maxPieces, 1, 1000000));
  }

  void readStochastic(const toml::table& table) {
    const TomlSection section(source_, table, "stochastic", {"samples", "plan", "seed", "tolerance", "method"});
    EnsembleOptions& ensemble = study_.ensemble;
    ensemble.samples =
        static_cast<std::size_t>(section.integer("samples", static_cast<std::int64_t>(ensemble.samples), 1, 10000000));
    if (const toml::node* node = section.find("plan"))
      ensemble.plan = planNamed(
          source_.asChoice(*node, "stochastic.plan", {"sobol", "random", "latin-hypercube", "halton", "grid"}));
    ensemble.seed = static_cast<std::uint64_t>(
        section.integer("seed", static_cast<std::int64_t>(ensemble.seed), 0, std::numeric_limits<std::int64_t>::max()));
    if (const toml::node* node = section.find("method"))
      ensemble.method =
          source_.asChoice(*node, "stochastic.method", {"adams", "bdf"}) == "bdf" ? Method::bdf : Method::adams;
    const toml::node* node = section.find("tolerance");
    if (node == nullptr) return;
    const TomlSection tolerance(source_, source_.asTable(*node, "stochastic.tolerance"), "stochastic.tolerance",
                                {"relative", "absolute"});
    ensemble.tolerance.relative = tolerance.positive("relative", ensemble.tolerance.relative);
    ensemble.tolerance.absolute = tolerance.positive("absolute", ensemble.tolerance.absolute);
  }

  /// Not every plan serves every number of quantities.
  void checkPlan(const toml::node* stochastic) const {
    if (!study_.stochastic) return;
    try {
      Sampling(study_.ensemble.plan, study_.uncertain.size(), 1, study_.ensemble.seed);
    } catch (const std::invalid_argument& error) {
      source_.failWith(stochastic == nullptr ? source_.root() : *stochastic, error.what(), "another plan");
    }
  }

  void readFuzzy(const toml::table& table) {
    const TomlSection section(source_, table, "fuzzy", {"levels"});
    study_.levels = static_cast<int>(section.integer("levels", study_.levels, 2, 101));
  }

  void readLimits(const toml::table& table) {
    const TomlSection section(source_, table, "limits",
                              {"time", "memory", "enclosure_time", "enclosure_memory", "sample_time"});
    const auto limit = [&](std::string_view key, const Dimension& dimension, double scale) -> std::optional<double> {
      const toml::node* node = section.find(key);
      if (node == nullptr) return std::nullopt;
      const double value = nearest(source_.asAmount(*node, section.nameOf(key), dimension));
      if (!(value > 0)) source_.fail(*node, section.nameOf(key) + " is not positive", "a number above 0");
      return scale * value;
    };
    constexpr double gigabyte = 1e9;
    study_.limits = {limit("time", seconds, 1), limit("memory", plain, gigabyte), limit("enclosure_time", seconds, 1),
                     limit("enclosure_memory", plain, gigabyte), limit("sample_time", seconds, 1)};
  }

  static constexpr std::array<std::string_view, 3> signs{"±", "+-", "+/-"};

  TomlSource source_;
  Study study_;
};

}  // namespace

Study readStudyText(const std::string& text, const std::string& name) { return StudyReader(text, name).read(); }

Study readStudy(const std::string& path) {
  std::error_code error;
  std::ifstream file(path, std::ios::binary);
  if (!std::filesystem::is_regular_file(path, error) || !file)
    throw StudyError(path + ": cannot be read; expected a study file (TOML)");
  const std::string content{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  return readStudyText(content, path);
}

}  // namespace gamut
