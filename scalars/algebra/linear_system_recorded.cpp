// Systems of Recorded numbers: what is small or falls apart is written out, the rest is recorded as a whole.
#include <algorithm>
#include <utility>

#include "scalars/algebra/linear_system.hpp"
#include "scalars/index.hpp"

namespace gamut {
namespace {

using detail::at;

constexpr int writtenOut = 2;  // equations

}  // namespace

LinearSystem<Recorded>::LinearSystem(MatrixKind kind, int size, std::vector<Recorded> entries)
    : kind_(kind), size_(size), entries_(std::move(entries)) {
  detail::requireSquare(size, entries_.size());
  if (kind == MatrixKind::positiveDefinite)
    for (int i = 0; i < size; ++i)
      for (int j = 0; j < i; ++j) entries_[at(j) * at(size) + at(i)] = entry(i, j);
  // Rows that an entry connects, directly or through others, are one part.
  std::vector<char> taken(size, 0);
  for (int first = 0; first < size; ++first) {
    if (taken[first] != 0) continue;
    std::vector<int> rows{first};
    taken[first] = 1;
    for (std::size_t next = 0; next < rows.size(); ++next)
      for (int j = 0; j < size; ++j)
        if (taken[j] == 0 && !(isKnownZero(entry(rows[next], j)) && isKnownZero(entry(j, rows[next])))) {
          rows.push_back(j);
          taken[j] = 1;
        }
    std::sort(rows.begin(), rows.end());
    parts_.push_back(part(std::move(rows)));
  }
}

LinearSystem<Recorded>::Part LinearSystem<Recorded>::part(std::vector<int> rows) const {
  Part result;
  const int n = static_cast<int>(rows.size());
  const auto m = [&](int i, int j) -> const Recorded& { return entry(rows[i], rows[j]); };
  if (n == 1) {
    result.inverse = 1.0 / m(0, 0);
  } else if (n <= writtenOut) {
    const Recorded product = kind_ == MatrixKind::positiveDefinite ? sqr(m(1, 0)) : m(0, 1) * m(1, 0);
    result.inverse = 1.0 / (m(0, 0) * m(1, 1) - product);
  } else {
    LinearMatrix matrix{kind_, n, {}};
    matrix.entries.assign(at(n) * at(n), Recorded(0.0).node());
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        if (!isKnownZero(m(i, j))) matrix.entries[at(i) * at(n) + at(j)] = m(i, j).node();
    result.matrix = Recorder::current()->matrix(std::move(matrix));
  }
  result.rows = std::move(rows);
  return result;
}

void LinearSystem<Recorded>::solve(std::span<Recorded> x, bool transposed) const {
  detail::requireRightSide(size_, x.size());
  for (const Part& part : parts_) {
    const auto r = [&](std::size_t i) -> Recorded& { return x[part.rows[i]]; };
    if (part.matrix >= 0) {
      std::vector<int> rightSide;
      for (std::size_t i = 0; i < part.rows.size(); ++i) rightSide.push_back(r(i).node());
      const std::vector<int> solution = Recorder::current()->solve(part.matrix, transposed, rightSide);
      for (std::size_t i = 0; i < solution.size(); ++i) r(i) = Recorded::node(solution[i]);
    } else if (part.rows.size() == 1) {
      r(0) = r(0) * part.inverse;
    } else {  // Cramer's rule
      const int i = part.rows[0], j = part.rows[1];
      const Recorded &above = transposed ? entry(j, i) : entry(i, j), &below = transposed ? entry(i, j) : entry(j, i);
      const Recorded first = (entry(j, j) * r(0) - above * r(1)) * part.inverse;
      r(1) = (entry(i, i) * r(1) - below * r(0)) * part.inverse;
      r(0) = first;
    }
  }
}

}  // namespace gamut
