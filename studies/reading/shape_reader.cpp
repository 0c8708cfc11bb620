// How probable and how possible the values of an uncertain quantity are, as a study states it.
#include "studies/reading/shape_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <utility>

#include "analyses/consistency.hpp"
#include "studies/reading/table_reader.hpp"
#include "studies/words.hpp"

namespace gamut {
namespace {

constexpr Dimension plain{};

class ShapeReader {
 public:
  ShapeReader(const TomlSource& source, const TomlSection& section, const TableFiles& files)
      : source_(source), section_(section), files_(files) {}

  /// What distribution and membership are stated on; empty if neither says so.
  Interval supports(const UncertainQuantity& quantity) const {
    const Dimension dimension = dimensionOf(quantity.unit);
    Interval range = Interval::empty();
    for (const char* key : {"distribution", "membership"}) {
      const toml::node* node = section_.find(key);
      if (node == nullptr || !node->is_table()) continue;
      const toml::table& table = *node->as_table();
      const std::string name = section_.nameOf(key);
      if (const toml::node* support = table.get("support"))
        range = hull(range, readPair(source_, *support, name + ".support", dimension));
      if (const toml::node* points = table.get("points"); points != nullptr && points->is_array())
        for (const toml::node& point : *points->as_array())
          if (point.is_array() && !point.as_array()->empty())
            range = hull(range, enclose(source_.asAmount((*point.as_array())[0], name + ".points", dimension)));
      if (std::string_view(key) != "distribution") continue;
      std::string type;
      const TomlSection keys = kind(section_, *node, key, kindsOfDistribution(), type);
      if (type == "evidence")
        for (const FocalInterval& focal : evidenceOf(keys, quantity).focal) range = hull(range, focal.values);
      if (type != "histogram" && type != "empirical") continue;
      for (const Amount& value :
           type == "histogram" ? histogramOf(keys, quantity).edges : valuesOf(keys, quantity).values)
        range = hull(range, enclose(value));
    }
    return range;
  }

  /// Both, each perhaps from the other.
  void read(UncertainQuantity& result) const {
    const bool isInduced[] = {isOf("distribution", "induced"), isOf("membership", "induced")};
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

  using Kinds = std::vector<std::pair<std::string, std::vector<std::string>>>;
  static const Kinds& kindsOfDistribution() {
    static const Kinds kinds{{"uniform", {"support"}},
                             {"triangular", {"support", "mode"}},
                             {"normal", {"support", "mean", "deviation"}},
                             {"beta", {"support", "a", "b"}},
                             {"lognormal", {"support", "log_mean", "log_deviation"}},
                             {"weibull", {"support", "shape", "scale"}},
                             {"gamma", {"support", "shape", "scale"}},
                             {"exponential", {"support", "mean"}},
                             {"histogram", {"edges", "weights", "file"}},
                             {"empirical", {"values", "file", "column"}},
                             {"evidence", {"intervals", "masses", "file"}},
                             {"induced", {}}};
    return kinds;
  }

  void readDistribution(UncertainQuantity& result) const {
    Uncertain& uncertain = result.uncertain;
    uncertain.distribution = Distribution::uniform(uncertain.range);
    const toml::node* node = section_.find("distribution");
    if (node == nullptr) return;
    std::string type;
    const TomlSection table = kind(section_, *node, "distribution", kindsOfDistribution(), type);
    const Dimension dimension = dimensionOf(result.unit);
    const Interval on = support(table, result);
    try {
      if (type == "histogram") {
        const Histogram read = histogramOf(table, result);
        uncertain.distribution =
            Distribution::histogram(doublesOf(table, "edges", {read.edges, read.lines}, result), read.weights);
      }
      if (type == "empirical")
        uncertain.distribution = Distribution::empirical(doublesOf(table, "values", valuesOf(table, result), result));
      if (type == "evidence") uncertain.distribution = Distribution::evidence(evidenceInside(table, result));
      if (type == "induced") uncertain.distribution = distributionOf(uncertain.membership);
      if (type == "uniform") uncertain.distribution = Distribution::uniform(on);
      if (type == "triangular") {
        const Interval mode = parameter(table, "mode", dimension, uncertain.nominal);
        requireInside(table, "mode", mode, on);
        uncertain.distribution = Distribution::triangular(on, mode);
      }
      if (type == "normal")
        uncertain.distribution = Distribution::normal(on, parameter(table, "mean", dimension, uncertain.nominal),
                                                      parameter(table, "deviation", dimension));
      if (type == "beta")
        uncertain.distribution = Distribution::beta(on, parameter(table, "a", plain), parameter(table, "b", plain));
      if (type == "lognormal")
        uncertain.distribution =
            Distribution::lognormal(on, parameter(table, "log_mean", plain), parameter(table, "log_deviation", plain));
      if (type == "weibull")
        uncertain.distribution =
            Distribution::weibull(on, parameter(table, "shape", plain), parameter(table, "scale", dimension));
      if (type == "gamma")
        uncertain.distribution =
            Distribution::gamma(on, parameter(table, "shape", plain), parameter(table, "scale", dimension));
      if (type == "exponential")
        uncertain.distribution = Distribution::exponential(on, parameter(table, "mean", dimension, uncertain.nominal));
    } catch (const std::invalid_argument& error) {
      source_.failWith(*node, error.what(), "a distribution inside the interval");
    }
  }

  // ---- Evidence -----------------------------------------------------------------------------------------------------

  struct Evidence {
    std::vector<FocalInterval> focal;
    std::vector<std::size_t> lines;  ///< where a file has them
  };

  /// Of lists in the study, or of a file's columns lower, upper and mass.
  Evidence evidenceOf(const TomlSection& section, const UncertainQuantity& quantity) const {
    constexpr const char *negative = "the mass is negative", *instead = "a mass of 0 or more";
    Evidence read;
    if (const toml::node* file = section.find("file")) {
      refuseBeside(section, {"intervals", "masses"});
      auto [columns, lines] =
          files_.columns(*file, section.nameOf("file"),
                         {{"lower", quantity.unit}, {"upper", quantity.unit}, {"mass", std::string(unit::one)}});
      for (std::size_t row = 0; row < columns[0].size(); ++row) {
        const Interval lower = enclose(columns[0][row]), upper = enclose(columns[1][row]);
        if (lower.lower() > upper.upper())
          files_.fail(*file, lines[row], "upper lies below lower", "intervals from lower to upper");
        if (columns[2][row].value < 0) files_.fail(*file, lines[row], negative, instead);
        read.focal.push_back({hull(lower, upper), enclose(columns[2][row])});
      }
      read.lines = std::move(lines);
      return read;
    }
    const toml::node& intervals = section.require("intervals", "[[lower, upper], ...], or a file");
    const toml::node& masses = section.require("masses", "one mass an interval");
    for (const toml::node& entry : source_.asArray(intervals, section.nameOf("intervals")))
      read.focal.push_back({readPair(source_, entry, section.nameOf("intervals"), dimensionOf(quantity.unit))});
    const toml::array& all = source_.asArray(masses, section.nameOf("masses"));
    if (all.size() != read.focal.size())
      source_.fail(masses, fmt::format("{} masses stand beside {} intervals", all.size(), read.focal.size()),
                   "one mass an interval");
    for (std::size_t i = 0; i < read.focal.size(); ++i) {
      const Amount mass = source_.asAmount(all[i], section.nameOf("masses"), plain);
      if (mass.value < 0) source_.fail(all[i], negative, instead);
      read.focal[i].mass = enclose(mass);
    }
    return read;
  }

  std::vector<FocalInterval> evidenceInside(const TomlSection& section, const UncertainQuantity& quantity) const {
    const Evidence read = evidenceOf(section, quantity);
    for (std::size_t i = 0; i < read.focal.size(); ++i) {
      if (isSubset(read.focal[i].values, quantity.uncertain.range)) continue;
      const auto [inner, outer] = writtenApart(read.focal[i].values, quantity.uncertain.range);
      const std::string problem = inner + " leaves the interval", expected = "intervals inside " + outer;
      if (!read.lines.empty()) files_.fail(*section.find("file"), read.lines[i], problem, expected);
      source_.fail((*section.find("intervals")->as_array())[i], section.nameOf("intervals") + ": " + problem, expected);
    }
    return read.focal;
  }

  // ---- Histograms and measurements ----------------------------------------------------------------------------------

  struct Histogram {
    std::vector<Amount> edges;
    std::vector<double> weights;
    std::vector<std::size_t> lines;  ///< of the edges, where a file has them
  };
  struct Values {
    std::vector<Amount> values;
    std::vector<std::size_t> lines;  ///< where a file has them
  };

  /// Of lists in the study, or of a file's columns lower, upper and weight, row by row from below; where one row ends
  /// before the next begins, there is nothing between.
  Histogram histogramOf(const TomlSection& section, const UncertainQuantity& quantity) const {
    Histogram read;
    auto& [edges, weights, lines] = read;
    const toml::node* file = section.find("file");
    if (file == nullptr) {
      edges = amounts(section.require("edges", "[lower, ..., upper], or a file"), section.nameOf("edges"),
                      dimensionOf(quantity.unit));
      const toml::node& node = section.require("weights", "one weight between each two edges");
      for (const Amount& weight : amounts(node, section.nameOf("weights"), plain)) weights.push_back(nearest(weight));
      if (weights.size() + 1 != edges.size())
        source_.fail(node, fmt::format("{} weights lie between {} edges", weights.size(), edges.size()),
                     "one weight between each two edges");
      return read;
    }
    refuseBeside(section, {"edges", "weights"});
    const auto [columns, rows] =
        files_.columns(*file, section.nameOf("file"),
                       {{"lower", quantity.unit}, {"upper", quantity.unit}, {"weight", std::string(unit::one)}});
    for (std::size_t row = 0; row < columns[0].size(); ++row) {
      if (columns[2][row].value < 0) files_.fail(*file, rows[row], "the weight is negative", "a weight of 0 or more");
      if (columns[1][row].value < columns[0][row].value)
        files_.fail(*file, rows[row], "upper lies below lower", "lower, then what is not below it");
      if (!edges.empty() && columns[0][row].value < edges.back().value)
        files_.fail(*file, rows[row], "lower lies below the upper of the row before", "rows from below");
      const bool isGap = !edges.empty() && edges.back().value != columns[0][row].value;
      if (edges.empty() || isGap) {
        edges.push_back(columns[0][row]);
        lines.push_back(rows[row]);
      }
      if (isGap) weights.push_back(0);
      edges.push_back(columns[1][row]);
      lines.push_back(rows[row]);
      weights.push_back(nearest(columns[2][row]));
    }
    if (std::ranges::none_of(weights, [](double weight) { return weight > 0; }))
      files_.fail(*file, rows.front(), "no weight is above 0", "one at least");
    return read;
  }

  void refuseBeside(const TomlSection& section, std::initializer_list<const char*> keys) const {
    for (const char* key : keys)
      if (const toml::node* node = section.find(key))
        source_.fail(*node, fmt::format("there is a file beside {}", section.nameOf(key)), "one of the two");
  }

  Values valuesOf(const TomlSection& section, const UncertainQuantity& quantity) const {
    const toml::node* file = section.find("file");
    if (file == nullptr)
      return {amounts(section.require("values", "[value, ...], or a file and its column"), section.nameOf("values"),
                      dimensionOf(quantity.unit)),
              {}};
    refuseBeside(section, {"values"});
    auto [columns, rows] = files_.columns(*file, section.nameOf("file"), {{section.text("column"), quantity.unit}});
    return {std::move(columns[0]), std::move(rows)};
  }

  std::vector<Amount> amounts(const toml::node& node, const std::string& what, const Dimension& dimension) const {
    std::vector<Amount> found;
    if (source_.asArray(node, what).empty()) source_.fail(node, what + " is empty", "one value at least");
    for (const toml::node& entry : source_.asArray(node, what))
      found.push_back(source_.asAmount(entry, what, dimension));
    return found;
  }

  /// Nearest doubles, but the least and the greatest, which are the support, rounded outward; in the interval, all.
  std::vector<double> doublesOf(const TomlSection& section, const std::string& key, const Values& read,
                                const UncertainQuantity& quantity) const {
    const std::vector<Amount>& values = read.values;
    std::vector<double> found;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!isSubset(enclose(values[i]), quantity.uncertain.range)) {
        const auto [inner, outer] = writtenApart(enclose(values[i]), quantity.uncertain.range);
        const std::string problem = fmt::format("{} has the value {} outside the interval", section.nameOf(key), inner),
                          expected = "values inside " + outer;
        if (i < read.lines.size()) files_.fail(*section.find("file"), read.lines[i], problem, expected);
        source_.fail((*section.find(key)->as_array())[i], problem, expected);
      }
      found.push_back(nearest(values[i]));
    }
    if (found.empty()) return found;
    const auto [least, greatest] = std::ranges::minmax_element(found);
    *least = enclose(values[static_cast<std::size_t>(least - found.begin())]).lower();
    *greatest = enclose(values[static_cast<std::size_t>(greatest - found.begin())]).upper();
    return found;
  }

  void readMembership(UncertainQuantity& result) const {
    Uncertain& uncertain = result.uncertain;
    uncertain.membership = Membership::triangular(uncertain.range.lower(), uncertain.nominal, uncertain.range.upper());
    const toml::node* node = section_.find("membership");
    if (node == nullptr) return;
    std::string type;
    const TomlSection table = kind(section_, *node, "membership",
                                   {{"triangular", {"support", "apex"}},
                                    {"trapezoidal", {"support", "core"}},
                                    {"gaussian", {"support", "centre", "deviation"}},
                                    {"table", {"points"}},
                                    {"induced", {}}},
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
        const Interval core =
            readPair(source_, table.require("core", "[left, right]"), table.nameOf("core"), dimension);
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
      if (type == "induced" && !uncertain.distribution.isPrecise())
        source_.fail(*node, "a membership follows from one distribution, and there are several",
                     "a membership of its own, or a distribution whose parameters are numbers");
      if (const Interval& from = uncertain.distribution.support();
          type == "induced" && !contains(from, uncertain.nominal))
        source_.fail(*node,
                     fmt::format("the nominal value {} lies outside the distribution's support {}",
                                 written(uncertain.nominal), written(from)),
                     "a distribution that holds it, or another membership");
      if (type == "induced") uncertain.membership = membershipOf(uncertain.distribution, uncertain.nominal);
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

  // ---- What both are made of -------------------------------------------------------------------------------------

  Interval support(const TomlSection& section, const UncertainQuantity& quantity) const {
    const toml::node* node = section.find("support");
    const Interval range = quantity.uncertain.range;
    if (node == nullptr) return range;
    const Interval found = readPair(source_, *node, section.nameOf("support"), dimensionOf(quantity.unit));
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
    return nearest(value(*node, section.nameOf(key), dimensionOf(quantity.unit)));
  }

  double requiredNumber(const TomlSection& section, std::string_view key, const Dimension& dimension) const {
    const toml::node& node = section.require(key, fmt::format("a number in {}", unitOf(dimension)));
    return nearest(value(node, section.nameOf(key), dimension));
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

  /// Of a distribution: the nearest double, or an interval [least, greatest] of what it may be; `otherwise` without the
  /// key, unless that is NaN.
  Interval parameter(const TomlSection& section, std::string_view key, const Dimension& dimension,
                     double otherwise = std::numeric_limits<double>::quiet_NaN()) const {
    const toml::node* node = section.find(key);
    if (node == nullptr && !std::isnan(otherwise)) return otherwise;
    const toml::node& found =
        section.require(key, fmt::format("a number in {}, or an interval of such numbers", unitOf(dimension)));
    if (found.is_array()) return readPair(source_, found, section.nameOf(key), dimension);
    return nearest(value(found, section.nameOf(key), dimension, ", or an interval of values [lower, upper]"));
  }

  /// The keys of one kind of distribution or membership function.
  TomlSection kind(const TomlSection& parent, const toml::node& node, const std::string& key,
                   const std::vector<std::pair<std::string, std::vector<std::string>>>& kinds,
                   std::string& type) const {
    const std::string name = parent.nameOf(key);
    std::vector<std::string> types;
    for (const auto& entry : kinds) types.push_back(entry.first);
    if (node.is_string()) {
      const std::string& word = node.as_string()->get();
      const std::string nearest = meantName(word, types);
      source_.fail(node, fmt::format("{} is \"{}\"", name, word),
                   fmt::format("a table, such as {{ type = \"{}\" }}", nearest.empty() ? types.front() : nearest));
    }
    const toml::table& table = source_.asTable(node, name);
    const toml::node* found = table.get("type");
    if (found == nullptr)
      source_.fail(node, fmt::format("'{}.type' is missing", name), fmt::format("{{ type = \"{}\" }}", types.front()));
    type = source_.asChoice(*found, name + ".type", types);
    std::vector<std::string> keys{"type"};
    for (const auto& entry : kinds)
      if (entry.first == type) keys.insert(keys.end(), entry.second.begin(), entry.second.end());
    return {source_, table, name, keys};
  }

  const TomlSource& source_;
  const TomlSection& section_;
  const TableFiles& files_;
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
                    const UncertainQuantity& quantity) {
  return ShapeReader(source, section, files).supports(quantity);
}

void readShapes(const TomlSource& source, const TomlSection& section, const TableFiles& files,
                UncertainQuantity& quantity) {
  ShapeReader(source, section, files).read(quantity);
}

}  // namespace gamut
