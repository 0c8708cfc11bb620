#include "studies/reading/dependence_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "mechanics/description/names.hpp"
#include "studies/reading/settings_reader.hpp"

namespace gamut {
namespace {

constexpr Dimension plain{};

class DependenceReader {
 public:
  DependenceReader(const TomlSource& source, Study& study) : source_(source), study_(study) {}

  void read(const toml::table& table) {
    const TomlSection section = readSettings(source_, table, "dependence", study_);
    const std::vector<std::size_t> quantities = quantitiesOf(section);
    const toml::node *rank = section.find("rank_correlation"), *unknown = section.find("unknown");
    if ((rank == nullptr) == (unknown == nullptr))
      source_.fail(rank == nullptr ? static_cast<const toml::node&>(table) : *unknown,
                   "a dependence has either dependence.rank_correlation or dependence.unknown",
                   "rank_correlation = 0.5, a matrix [[1, 0.5], [0.5, 1]], or unknown = true");
    if (unknown != nullptr) {
      if (!source_.asBool(*unknown, "dependence.unknown"))
        source_.fail(*unknown, "dependence.unknown is false", "unknown = true; without it quantities are independent");
      study_.dependence.unknown.push_back(quantities);
      return;
    }
    const std::vector<std::vector<Interval>> matrix = matrixOf(*rank, quantities.size());
    for (std::size_t i = 0; i < matrix.size(); ++i)
      for (std::size_t j = 0; j < matrix[i].size(); ++j)
        if (i != j && isEqual(abs(matrix[i][j]), Interval(1.0)))
          source_.fail(*rank,
                       fmt::format("with a dependence.rank_correlation of {} two quantities are one and the same "
                                   "uncertain number",
                                   midpoint(matrix[i][j])),
                       "one uncertain quantity and a formula of it for the other, or a correlation such as 0.999");
    try {
      study_.dependence.copulas.emplace_back(quantities, matrix);
    } catch (const std::invalid_argument& error) {
      source_.failWith(*rank, error.what(), "a symmetric positive definite matrix with ones in its diagonal");
    }
  }

 private:
  /// By their names, or those of the quantities; none is in two dependences.
  std::vector<std::size_t> quantitiesOf(const TomlSection& section) {
    const toml::node& node = section.require("quantities", "[\"a\", \"b\", ...], uncertain quantities");
    std::vector<std::size_t> found;
    for (const toml::node& entry : source_.asArray(node, "dependence.quantities")) {
      const std::string name = source_.asText(entry, "dependence.quantities");
      const auto place = std::ranges::find_if(
          study_.uncertain, [&](const UncertainQuantity& q) { return q.uncertain.name == name || q.quantity == name; });
      if (place == study_.uncertain.end()) {
        std::vector<std::string> names;
        for (const UncertainQuantity& q : study_.uncertain) names.push_back(q.uncertain.name);
        source_.fail(entry, fmt::format("no uncertain quantity is called '{}'", name), expectedName(name, names));
      }
      if (place->varies)
        source_.fail(entry, fmt::format("'{}' varies in time, so that it depends on nothing else", name),
                     "quantities that are constant");
      const auto number = static_cast<std::size_t>(place - study_.uncertain.begin());
      if (std::ranges::find(taken_, number) != taken_.end())
        source_.fail(entry, fmt::format("'{}' is in a dependence already", name), "every quantity once");
      taken_.push_back(number);
      found.push_back(number);
    }
    if (found.size() < 2)
      source_.fail(node, fmt::format("dependence.quantities names {}", found.empty() ? "nothing" : "one quantity"),
                   "two quantities at least");
    return found;
  }

  /// One number for two quantities, or row by row.
  std::vector<std::vector<Interval>> matrixOf(const toml::node& node, std::size_t size) const {
    const auto number = [&](const toml::node& entry) {
      return enclose(source_.asAmount(entry, "dependence.rank_correlation", plain));
    };
    if (!node.is_array()) {
      if (size != 2)
        source_.fail(node, fmt::format("one dependence.rank_correlation is given for {} quantities", size),
                     "a matrix [[1, 0.5, ...], ...]");
      const Interval rank = number(node);
      return {{1.0, rank}, {rank, 1.0}};
    }
    std::vector<std::vector<Interval>> rows;
    for (const toml::node& row : *node.as_array()) {
      rows.emplace_back();
      for (const toml::node& entry : source_.asArray(row, "dependence.rank_correlation"))
        rows.back().push_back(number(entry));
    }
    return rows;
  }

  const TomlSource& source_;
  Study& study_;
  std::vector<std::size_t> taken_;
};

}  // namespace

void readDependence(const TomlSource& source, const std::vector<const toml::table*>& tables, Study& study) {
  DependenceReader reader(source, study);
  for (const toml::table* table : tables) reader.read(*table);
}

}  // namespace gamut
