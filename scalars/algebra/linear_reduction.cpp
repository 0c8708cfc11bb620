// Markowitz's order: the pivot that may fill in the fewest entries.
#include "scalars/algebra/linear_reduction.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace gamut {
namespace {

using detail::at;

constexpr double smallest = 1e-3;  // of the greatest number in its row: a pivot

/// How large a number certainly is; 0 for what is no number.
double sizeOfNumber(const Recorded& x) {
  const Recorder& recorder = *Recorder::current();
  return recorder.isConstant(x.node()) ? mignitude(recorder.value(x.node())) : 0.0;
}

}  // namespace

LinearReduction::LinearReduction(int size, std::vector<Recorded>& entries) : rows_(at(size)), columns_(at(size)) {
  std::iota(rows_.begin(), rows_.end(), 0);
  std::iota(columns_.begin(), columns_.end(), 0);
  const auto entry = [&](int i, int j) -> Recorded& { return entries[at(i * size + j)]; };
  std::vector<char> isThere(entries.size());
  std::vector<double> number(entries.size());
  const auto look = [&](int i, int j) {
    isThere[at(i * size + j)] = !isKnownZero(entry(i, j));
    number[at(i * size + j)] = sizeOfNumber(entry(i, j));
  };
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j) look(i, j);
  while (!rows_.empty()) {
    std::vector<int> inRow(at(size), 0), inColumn(at(size), 0);
    for (int i : rows_)
      for (int j : columns_)
        if (isThere[at(i * size + j)] != 0) ++inRow[at(i)], ++inColumn[at(j)];
    Step step{-1, -1, {}, {}, {}};
    int least = std::numeric_limits<int>::max();
    for (int i : rows_) {
      double greatest = 0;
      for (int j : columns_) greatest = std::max(greatest, number[at(i * size + j)]);
      for (int j : columns_) {
        const double own = number[at(i * size + j)];
        const int cost = (inRow[at(i)] - 1) * (inColumn[at(j)] - 1);
        if (own > 0 && own >= smallest * greatest && cost < least) least = cost, step.row = i, step.column = j;
      }
    }
    // At most `least` entries come, those of the pivot's row and column go.
    if (step.row < 0 || least > inRow[at(step.row)] + inColumn[at(step.column)] - 1) break;
    std::erase(rows_, step.row);
    std::erase(columns_, step.column);
    step.inverse = 1.0 / entry(step.row, step.column);
    for (int j : columns_)
      if (isThere[at(step.row * size + j)] != 0) step.upper.push_back({j, entry(step.row, j)});
    for (int i : rows_) {
      if (isThere[at(i * size + step.column)] == 0) continue;
      const Recorded factor = entry(i, step.column) * step.inverse;
      for (const Term& term : step.upper) {
        Recorded& changed = entry(i, term.index);
        changed = changed - factor * term.value;
        look(i, term.index);
      }
      step.lower.push_back({i, factor});
    }
    steps_.push_back(std::move(step));
  }
}

void LinearReduction::reduce(std::span<Recorded> r) const {
  for (const Step& step : steps_)
    for (const Term& term : step.lower) r[at(term.index)] = r[at(term.index)] - term.value * r[at(step.row)];
}

void LinearReduction::complete(std::span<const Recorded> r, std::span<Recorded> x) const {
  for (std::size_t k = steps_.size(); k-- > 0;) {
    const Step& step = steps_[k];
    Recorded sum = r[at(step.row)];
    for (const Term& term : step.upper) sum = sum - term.value * x[at(term.index)];
    x[at(step.column)] = sum * step.inverse;
  }
}

}  // namespace gamut
