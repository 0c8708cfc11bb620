// Systems of intervals, fuzzy numbers and samples: verified, cut by cut, sample by sample.
#include "scalars/algebra/linear_system.hpp"

#include <Eigen/Core>
#include <string>

#include "scalars/algebra/verified_algebra.hpp"

namespace gamut {
namespace {

/// Each cut inside the one below it.
void append(std::vector<Interval>& cuts, const Interval& cut) {
  cuts.push_back(cuts.empty() ? cut : intersection(cut, cuts.back()));
}
void append(std::vector<double>& samples, double sample) { samples.push_back(sample); }

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

std::size_t detail::commonCount(std::size_t a, std::size_t b, const char* of) {
  if (a != b && a != 1 && b != 1)
    throw std::invalid_argument("a linear system does not combine " + std::to_string(a) + " and " + std::to_string(b) +
                                ' ' + of);
  return std::max(a, b);
}

template <class S>
void detail::SystemOfParts<S>::solve(std::span<S> x, bool transposed) const {
  std::size_t count = systems_.size();
  for (const S& r : x) count = commonCount(count, Parts::count(r), Parts::name);
  std::vector<std::vector<typename Parts::Part>> components(x.size());
  std::vector<typename Parts::Part> one(x.size());
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t i = 0; i < x.size(); ++i) one[i] = Parts::part(x[i], k);
    systems_[systems_.size() == 1 ? 0 : k].solve(one, transposed);
    for (std::size_t i = 0; i < x.size(); ++i) append(components[i], one[i]);
  }
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = S(std::move(components[i]));
}

template class detail::SystemOfParts<Fuzzy>;
template class detail::SystemOfParts<Samples>;

}  // namespace gamut
