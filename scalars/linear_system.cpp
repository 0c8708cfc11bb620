// Systems of intervals, fuzzy numbers and samples: verified, cut by cut, sample by sample.
#include "scalars/linear_system.hpp"

#include <Eigen/Core>
#include <string>

#include "scalars/verified_algebra.hpp"

namespace gamut {
namespace {

using detail::at;

/// The larger of two counts of which one is 1, or which are equal.
std::size_t common(std::size_t a, std::size_t b, const char* of) {
  if (a != b && a != 1 && b != 1)
    throw std::invalid_argument("a linear system does not combine " + std::to_string(a) + " and " + std::to_string(b) +
                                ' ' + of);
  return std::max(a, b);
}

}  // namespace

void detail::requireSquare(int size, std::size_t entries) {
  if (size < 1 || entries != at(size) * at(size))
    throw std::invalid_argument("a linear system needs as many equations as unknowns, one at least");
}

void detail::requireRightSide(int size, std::size_t given) {
  if (given != at(size)) throw std::invalid_argument("a right-hand side has as many numbers as there are equations");
}

void LinearSystem<Interval>::solve(std::span<Interval> x, bool transposed) const {
  detail::requireRightSide(size_, x.size());
  const auto isEmptyOne = [](const Interval& entry) { return isEmpty(entry); };
  if (std::any_of(columns_.begin(), columns_.end(), isEmptyOne) || std::any_of(x.begin(), x.end(), isEmptyOne)) {
    std::fill(x.begin(), x.end(), Interval::empty());
    return;
  }
  using Matrix = Eigen::Matrix<Interval, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector = Eigen::Matrix<Interval, Eigen::Dynamic, 1>;
  const Eigen::Map<const Matrix> matrix(columns_.data(), size_, size_);
  const Eigen::Map<const Vector> rightSide(x.data(), size_);
  const bool mirrored = transposed && kind_ == MatrixKind::general;
  auto& proof = proofs_[mirrored ? 1 : 0];
  if (!proof)
    proof = mirrored ? std::make_shared<const detail::RegularMatrix>(Matrix(matrix.transpose()))
                     : std::make_shared<const detail::RegularMatrix>(matrix);
  Vector solution(size_);
  if (!proof->enclose(rightSide, solution.data())) solution.setConstant(Interval::entire());
  std::copy_n(solution.data(), x.size(), x.begin());
}

std::size_t LinearSystem<Fuzzy>::commonLevels(std::size_t a, std::size_t b) { return common(a, b, "levels"); }

void LinearSystem<Fuzzy>::solve(std::span<Fuzzy> x, bool transposed) const {
  std::size_t levels = cuts_.size();
  for (const Fuzzy& r : x) levels = commonLevels(levels, r.levels());
  std::vector<std::vector<Interval>> cuts(x.size());  // of each component
  std::vector<Interval> cut(x.size());
  for (std::size_t level = 0; level < levels; ++level) {
    for (std::size_t i = 0; i < x.size(); ++i) cut[i] = x[i].cut(level);
    cuts_[cuts_.size() == 1 ? 0 : level].solve(cut, transposed);
    for (std::size_t i = 0; i < x.size(); ++i)
      cuts[i].push_back(level == 0 ? cut[i] : intersection(cut[i], cuts[i].back()));
  }
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = Fuzzy(std::move(cuts[i]));
}

std::size_t LinearSystem<Samples>::commonSize(std::size_t a, std::size_t b) { return common(a, b, "samples"); }

void LinearSystem<Samples>::solve(std::span<Samples> x, bool transposed) const {
  std::size_t samples = samples_.size();
  for (const Samples& r : x) samples = commonSize(samples, r.size());
  std::vector<std::vector<double>> values(x.size(), std::vector<double>(samples));  // of each component
  std::vector<double> one(x.size());
  for (std::size_t sample = 0; sample < samples; ++sample) {
    for (std::size_t i = 0; i < x.size(); ++i) one[i] = x[i][sample];
    samples_[samples_.size() == 1 ? 0 : sample].solve(one, transposed);
    for (std::size_t i = 0; i < x.size(); ++i) values[i][sample] = one[i];
  }
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = Samples(std::move(values[i]));
}

}  // namespace gamut
