// Markowitz's order: the pivot that may fill in the fewest entries.
#include "scalars/algebra/linear_reduction.hpp"

#include <algorithm>
#include <compare>
#include <optional>
#include <set>
#include <utility>

namespace gamut {
namespace {

constexpr double smallest = 1e-3;  // of the greatest number in its row: a pivot

/// How large a number certainly is; 0 for what is no number.
double sizeOfNumber(const Recorded& x) {
  const Recorder& recorder = *Recorder::current();
  return recorder.isConstant(x.node()) ? mignitude(recorder.value(x.node())) : 0.0;
}

}  // namespace

namespace {

/// The entries that are left, and the cheapest pivot of each row.
class Markowitz {
 public:
  explicit Markowitz(LinearReduction::Rows& matrix) : matrix_(matrix), columns_(matrix.size()), best_(matrix.size()) {
    for (std::size_t i = 0; i < matrix.size(); ++i) {
      std::erase_if(matrix[i], [](const auto& entry) { return isKnownZero(entry.second); });
      for (const auto& [j, entry] : matrix[i]) columns_[j].insert(static_cast<int>(i));
    }
    for (std::size_t i = 0; i < matrix.size(); ++i) look(static_cast<int>(i));
  }

  struct Pivot {
    int cost, row, column;
    auto operator<=>(const Pivot&) const = default;  // NOLINT(modernize-use-nullptr): compares with a literal 0
  };
  /// That may fill in the fewest entries, by row and column where several do; null if no entry is fit for one.
  const Pivot* cheapest() const { return pivots_.empty() ? nullptr : &*pivots_.begin(); }

  int inRow(int i) const { return static_cast<int>(matrix_[i].size()); }
  int inColumn(int j) const { return static_cast<int>(columns_[j].size()); }
  const std::set<int>& rowsOf(int column) const { return columns_[column]; }

  /// The row and the column are no longer there, for pivots.
  void take(int row, int column) {
    for (const auto& [j, entry] : matrix_[row]) touch(j), columns_[j].erase(row);
    for (const int i : columns_[column]) changed_.insert(i);
    forget(row);
    changed_.erase(row);
  }
  void set(int i, int j, const Recorded& value) {
    touch(j);
    changed_.insert(i);
    if (isKnownZero(value)) {
      matrix_[i].erase(j);
      columns_[j].erase(i);
    } else {
      matrix_[i][j] = value;
      columns_[j].insert(i);
    }
  }
  /// After all that a step changes.
  void update(int column) {
    for (const int i : columns_[column]) matrix_[i].erase(column);
    columns_[column].clear();
    for (const int j : touched_) changed_.insert(columns_[j].begin(), columns_[j].end());
    for (const int i : changed_) look(i);
    touched_.clear();
    changed_.clear();
  }

 private:
  void touch(int column) { touched_.insert(column); }
  void forget(int i) {
    if (best_[i]) pivots_.erase(*best_[i]);
    best_[i].reset();
  }
  void look(int i) {
    forget(i);
    double greatest = 0;
    for (const auto& [j, entry] : matrix_[i]) greatest = std::max(greatest, sizeOfNumber(entry));
    for (const auto& [j, entry] : matrix_[i]) {
      const double own = sizeOfNumber(entry);
      if (!(own > 0 && own >= smallest * greatest)) continue;
      const Pivot pivot{(inRow(i) - 1) * (inColumn(j) - 1), i, j};
      if (!best_[i] || pivot < *best_[i]) best_[i] = pivot;
    }
    if (best_[i]) pivots_.insert(*best_[i]);
  }

  LinearReduction::Rows& matrix_;
  std::vector<std::set<int>> columns_;  // rows with an entry there
  std::vector<std::optional<Pivot>> best_;
  std::set<Pivot> pivots_;
  std::set<int> touched_, changed_;  // columns, rows
};

}  // namespace

LinearReduction::LinearReduction(Rows& matrix) {
  Markowitz left(matrix);
  std::vector<char> isRowGone(matrix.size(), 0), isColumnGone(matrix.size(), 0);
  while (const Markowitz::Pivot* pivot = left.cheapest()) {
    const auto [cost, row, column] = *pivot;
    // At most `cost` entries come, those of the pivot's row and column go.
    if (cost > left.inRow(row) + left.inColumn(column) - 1) break;
    isRowGone[row] = isColumnGone[column] = 1;
    Step step{row, column, 1.0 / matrix[row].at(column), {}, {}};
    for (const auto& [j, entry] : matrix[row])
      if (j != column) step.upper.push_back({j, entry});
    left.take(row, column);
    for (const int i : left.rowsOf(column)) {
      const Recorded factor = matrix[i].at(column) * step.inverse;
      for (const Term& term : step.upper) {
        const auto old = matrix[i].find(term.index);
        left.set(i, term.index, (old == matrix[i].end() ? Recorded(0.0) : old->second) - factor * term.value);
      }
      step.lower.push_back({i, factor});
    }
    left.update(column);
    steps_.push_back(std::move(step));
  }
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    if (isRowGone[i] == 0) rows_.push_back(static_cast<int>(i));
    if (isColumnGone[i] == 0) columns_.push_back(static_cast<int>(i));
  }
}

void LinearReduction::reduce(std::span<Recorded> r) const {
  for (const Step& step : steps_)
    for (const Term& term : step.lower) r[term.index] = r[term.index] - term.value * r[step.row];
}

void LinearReduction::complete(std::span<const Recorded> r, std::span<Recorded> x) const {
  for (std::size_t k = steps_.size(); k-- > 0;) {
    const Step& step = steps_[k];
    Recorded sum = r[step.row];
    for (const Term& term : step.upper) sum = sum - term.value * x[term.index];
    x[step.column] = sum * step.inverse;
  }
}

}  // namespace gamut
