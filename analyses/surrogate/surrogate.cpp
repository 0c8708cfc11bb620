// All parts come from bisections of [-1,1] in their middles; the box is bisected until each cell lies in a part.
#include "analyses/surrogate/surrogate.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <optional>
#include <utility>

#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/flow/series/polynomial_range.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

namespace {

FlowPart halfOf(FlowPart part, std::size_t symbol, double side) {
  part.centre[symbol] += side * part.half[symbol];
  part.half[symbol] *= 0.5;
  return part;
}

SurrogatePart halfOf(const SurrogatePart& part, int symbol, double side, const PolynomialRange& tables) {
  SurrogatePart half{halfOf(part.part, at(symbol), side), part.monomials, {}};
  for (const OutputModel& model : part.outputs) {
    OutputModel& own = half.outputs.emplace_back(OutputModel{std::vector<double>(model.c.size()), 0, model.bound});
    double norm = 0;
    for (const double c : model.c) norm += std::fabs(c);
    tables.substitute(symbol, side, 0.5, model.c.data(), own.c.data(), static_cast<int>(model.c.size()));
    own.radius = (model.radius + tables.shiftError() * norm) * bounds::up + bounds::tiny;
  }
  return half;
}

/// What is said of each part on its own, in the symbols of the quantities.
class Projection {
 public:
  Projection(const FlowModels& models, const std::vector<int>& components) : models_(models) {
    for (const int component : components) {
      quantities_.push_back(models.components[component]);
      if (const int symbol = quantities_.back().symbol; symbol >= 0) kept_.push_back(at(symbol));
    }
    std::ranges::sort(kept_);  // so that monomials are enumerated as before
    for (FlowSymbol& of : quantities_)
      if (of.symbol >= 0) of.symbol = static_cast<int>(std::ranges::find(kept_, at(of.symbol)) - kept_.begin());
  }

  const std::vector<FlowSymbol>& quantities() const { return quantities_; }
  int symbols() const { return static_cast<int>(kept_.size()); }

  /// Whether the part is one for all values of the other symbols.
  bool isWhole(const FlowPart& part) const {
    for (std::size_t l = 0; l < part.half.size(); ++l)
      if (part.half[l] < 1 && std::ranges::find(kept_, l) == kept_.end()) return false;
    return true;
  }

  SurrogatePart of(const FlowSnapshot& snapshot, std::size_t from, std::size_t until) {
    const Layout& layout = layoutOf(snapshot.monomials);
    SurrogatePart part{{}, layout.own, {}};
    for (const std::size_t l : kept_) {
      part.part.centre.push_back(snapshot.part.centre[l]);
      part.part.half.push_back(snapshot.part.half[l]);
    }
    for (std::size_t o = from; o < until; ++o) {
      const OutputModel& model = snapshot.outputs[o];
      OutputModel& own = part.outputs.emplace_back(OutputModel{{}, model.radius, model.bound});
      double beside = 0;  // Σ|c| of the terms that are left out, |ξ^α| <= 1
      for (std::size_t g = 0; g < model.c.size(); ++g) {
        if (layout.number[g] < 0) {
          beside += std::fabs(model.c[g]);
          continue;
        }
        own.c.resize(at(layout.number[g]) + 1, 0.0);
        own.c.back() = model.c[g];
      }
      own.radius = (model.radius + beside * bounds::up) * bounds::up;
    }
    return part;
  }

 private:
  struct Layout {
    std::shared_ptr<const Monomials> own;
    std::vector<int> number;  // of each monomial of the source, rising; -1: it holds another symbol
  };

  /// Both enumerate the monomials that they have in common alike.
  const Layout& layoutOf(const std::shared_ptr<const Monomials>& source) {
    std::vector<int> weights;
    for (int l = 0; l < source->symbols(); ++l) weights.push_back(source->weight(l));
    Layout& layout = layouts_[{std::move(weights), source->degree()}];
    if (layout.own) return layout;
    weights.clear();
    for (const std::size_t l : kept_) weights.push_back(source->weight(static_cast<int>(l)));
    layout.own = Monomials::of(std::move(weights), source->degree());
    int next = 0;
    for (int g = 0; g < source->count(); ++g) {
      bool isKept = true;
      for (int l = 0; l < source->symbols(); ++l)
        isKept = isKept && (source->exponent(g, l) == 0 || std::ranges::find(kept_, at(l)) != kept_.end());
      layout.number.push_back(isKept ? next++ : -1);
    }
    return layout;
  }

  const FlowModels& models_;
  std::vector<std::size_t> kept_;
  std::vector<FlowSymbol> quantities_;
  std::map<std::pair<std::vector<int>, int>, Layout> layouts_;  // by weights and degree of the source
};

/// Cells that tile the box, each with what is known of it. Alternatives that are cut in different symbols would make
/// about as many cells as the product of their parts' numbers: of those that come too late to be divided further, each
/// in one part at least, hulls tell.
class Tiling {
 public:
  Tiling(std::vector<SurrogatePart> parts, bool areAlternatives)
      : parts_(std::move(parts)), areAlternatives_(areAlternatives) {}

  /// None if it is cancelled on the way.
  std::optional<std::vector<SurrogatePart>> tiles(int symbols, const std::atomic<bool>* cancelled) {
    const std::size_t most = 1024 + 16 * parts_.size();
    Cell whole{{std::vector<double>(symbols, 0.0), std::vector<double>(symbols, 1.0)}, {}};
    for (std::size_t i = 0; i < parts_.size(); ++i) whole.near.push_back(i);
    for (std::deque<Cell> cells{std::move(whole)}; !cells.empty(); cells.pop_front()) {
      if (cancelled != nullptr && *cancelled) return std::nullopt;
      divide(cells.front(), tiles_.size() + cells.size() > most, cells);
    }
    return std::move(tiles_);
  }

 private:
  struct Cell {
    FlowPart part;
    std::vector<std::size_t> near;  // the numbers of parts that may meet it
  };

  void divide(const Cell& cell, bool isLate, std::deque<Cell>& halves) {
    std::vector<std::size_t> near;
    for (const std::size_t i : cell.near)
      if (meet(parts_[i].part, cell.part)) near.push_back(i);
    if (near.empty()) {  // nothing is known of it
      tiles_.push_back({cell.part, parts_.front().monomials, {}});
      tiles_.back().outputs.assign(parts_.front().outputs.size(), {{}, 0, Interval::entire()});
      return;
    }
    const auto holds = [&](std::size_t i) { return isInside(cell.part, parts_[i].part); };
    const auto holding = std::ranges::find_if(near, holds);
    if (areAlternatives_ && !isLate ? std::ranges::all_of(near, holds) : holding != near.end()) {
      if (!areAlternatives_) near = {*holding};
      if (isLate) std::iter_swap(near.begin(), holding);  // it covers all of the cell, and others a part
      tiles_.push_back(all(cell.part, near));
      return;
    }
    for (std::size_t l = 0; l < cell.part.half.size(); ++l)
      for (const std::size_t i : near)
        if (parts_[i].part.half[l] < cell.part.half[l]) {
          for (const double side : {-0.5, 0.5}) halves.push_back({halfOf(cell.part, l, side), near});
          return;
        }
  }

  /// What holds whichever of them is so. The first one holds the cell.
  SurrogatePart all(const FlowPart& cell, const std::vector<std::size_t>& numbers) {
    SurrogatePart tile = onCell(parts_[numbers.front()], cell);
    for (std::size_t i = 1; i < numbers.size(); ++i) {
      const bool isSmaller = !isInside(cell, parts_[numbers[i]].part);
      const SurrogatePart other = isSmaller ? parts_[numbers[i]] : onCell(parts_[numbers[i]], cell);
      for (std::size_t o = 0; o < tile.outputs.size(); ++o) {
        OutputModel& model = tile.outputs[o];
        const OutputModel& more = other.outputs[o];
        model.bound = hull(model.bound, more.bound);
        if (isSmaller || other.monomials != tile.monomials || more.c.empty() || model.c.empty()) {
          model.c.clear();
          continue;
        }
        // |P - Q| <= Σ|p_g - q_g|
        double apart = 0;
        for (std::size_t g = 0; g < std::max(model.c.size(), more.c.size()); ++g)
          apart += std::fabs((g < model.c.size() ? model.c[g] : 0.0) - (g < more.c.size() ? more.c[g] : 0.0));
        model.radius = std::max(model.radius, (more.radius + apart * bounds::up) * bounds::up);
      }
    }
    return tile;
  }

  SurrogatePart onCell(SurrogatePart part, const FlowPart& cell) {
    const PolynomialRange& tables = tables_.try_emplace(part.monomials.get(), part.monomials).first->second;
    for (std::size_t l = 0; l < cell.half.size(); ++l)
      while (part.part.half[l] > cell.half[l])
        part = halfOf(part, static_cast<int>(l), cell.centre[l] > part.part.centre[l] ? 0.5 : -0.5, tables);
    return part;
  }

  std::vector<SurrogatePart> parts_;
  bool areAlternatives_;
  std::vector<SurrogatePart> tiles_;
  std::map<const Monomials*, PolynomialRange> tables_;
};

}  // namespace

Surrogate surrogateOf(const FlowModels& models, const std::vector<int>& components, std::size_t from, std::size_t until,
                      const std::atomic<bool>* cancelled) {
  Projection projection(models, components);
  Surrogate surrogate{projection.quantities(), projection.symbols(), {}, {}};
  for (std::size_t row = 0; row < models.at.size() && until <= models.modelled; ++row) {
    bool areAlternatives = models.areAlternatives;
    std::vector<SurrogatePart> parts;
    for (const auto& snapshot : models.at[row]) {
      if (snapshot->outputs.size() < until) break;
      areAlternatives = areAlternatives || !projection.isWhole(snapshot->part);
      parts.push_back(projection.of(*snapshot, from, until));
    }
    if (parts.empty() || parts.size() < models.at[row].size()) continue;
    auto tiles = Tiling(std::move(parts), areAlternatives).tiles(surrogate.symbols, cancelled);
    if (!tiles) break;
    surrogate.rows.push_back(row);
    surrogate.at.push_back(std::move(*tiles));
  }
  return surrogate;
}

}  // namespace gamut
