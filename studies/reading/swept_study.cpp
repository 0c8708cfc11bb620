#include "studies/reading/swept_study.hpp"

#include <utility>

#include "studies/reading/mechanism_reader.hpp"
#include "studies/reading/sweep_reader.hpp"
#include "studies/reading/table_reader.hpp"

namespace gamut {

struct SweptStudy::Read {
  Read(const std::string& text, const std::string& name, const std::vector<Described>& types,
       const std::optional<FilesAtHand>& files)
      : source(text, name), mechanism(readFrom(types, files)) {}

  StatedPlaces stated() const { return {source, mechanism.mechanism, mechanism.places}; }

  TomlSource source;
  ReadMechanism mechanism;

 private:
  ReadMechanism readFrom(const std::vector<Described>& types, const std::optional<FilesAtHand>& files) {
    source.setNames(namesStatedIn(source));
    const toml::node* node = source.root().get("mechanism");
    if (node == nullptr) source.fail(source.root(), "'mechanism' is missing", "a table [mechanism]");
    return readMechanism(source, source.asTable(*node, "mechanism"), types, files);
  }
};

SweptStudy::SweptStudy(const std::string& text, const std::string& name, const std::vector<Described>& types,
                       const std::optional<FilesAtHand>& files)
    : read_(std::make_unique<const Read>(text, name, types, files)) {}

SweptStudy::~SweptStudy() = default;

void SweptStudy::check(const SweepPlan& plan) const {
  gamut::check(plan);
  for (const SweepAxis& axis : plan.axes) read_->stated().check(axis);
  for (std::size_t a = 0; a < plan.axes.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (&read_->stated().of(plan.axes[a].name) == &read_->stated().of(plan.axes[b].name))
        throw Refusal("'" + plan.axes[b].name + "' and '" + plan.axes[a].name + "' are one number", "each once");
}

SweepPlan SweptStudy::withUnits(SweepPlan plan) const {
  for (SweepAxis& axis : plan.axes)
    if (const std::optional<std::string> unit = read_->stated().unitOf(axis.name); unit && *unit != "1")
      axis.ownUnit = *unit;
  return plan;
}

std::string SweptStudy::at(const SweepPlan& plan, std::size_t point) const {
  std::vector<std::pair<const toml::node*, std::string>> values;
  for (std::size_t a = 0; a < plan.axes.size(); ++a)
    values.emplace_back(&read_->stated().of(plan.axes[a].name), plan.axes[a].stated(plan.place(point, a)));
  return read_->source.with(std::move(values));
}

SweepPlan SweptStudy::plan() const { return readSweep(read_->stated(), tablesIn(read_->source, "sweep")); }

SweepPlan sweepPoints(const std::string& text, const std::string& path) {
  const std::vector<WantedColumn> columns = columnsOf(text, path);
  const TableFiles::Columns table = readColumns(text, path, columns);
  SweepPlan plan{false, {}};
  for (std::size_t i = 0; i < columns.size(); ++i) {
    SweepAxis& axis = plan.axes.emplace_back(SweepAxis{columns[i].name, columns[i].unit, {}});
    for (const Amount& value : table.values[i]) axis.values.push_back(nearest(quotient(value, oneOfUnit(axis.unit))));
  }
  return plan;
}

}  // namespace gamut
