#include "analyses/dependence.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "analyses/normal_distribution.hpp"

namespace gamut {
namespace {

std::string middleText(const Interval& value) { return toString(midpoint(value)); }

}  // namespace

GaussianCopula::GaussianCopula(std::vector<std::size_t> quantities, std::vector<std::vector<Interval>> rankCorrelation)
    : quantities_(std::move(quantities)), rank_(std::move(rankCorrelation)) {
  const std::vector<std::vector<Interval>>& rank = rank_;
  const std::size_t n = quantities_.size();
  const auto at = [](std::size_t i, std::size_t j) {
    return "row " + std::to_string(i + 1) + ", column " + std::to_string(j + 1);
  };
  if (rank.size() != n || std::ranges::any_of(rank, [&](const auto& row) { return row.size() != n; }))
    throw std::invalid_argument("a rank correlation matrix of " + std::to_string(n) + " quantities has " +
                                std::to_string(n) + " rows and columns");
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      if (i == j && !isEqual(rank[i][j], Interval(1.0)))
        throw std::invalid_argument("a rank correlation matrix has ones in its diagonal, not " +
                                    middleText(rank[i][j]) + " (" + at(i, j) + ")");
      if (!isEqual(rank[i][j], rank[j][i]))
        throw std::invalid_argument("a rank correlation matrix is symmetric, but " + at(i, j) + " is " +
                                    middleText(rank[i][j]) + " and " + at(j, i) + " is " + middleText(rank[j][i]));
      if (magnitude(rank[i][j]) > 1)
        throw std::invalid_argument("rank correlations lie between -1 and 1, unlike " + middleText(rank[i][j]) + " (" +
                                    at(i, j) + ")");
    }
  root_.assign(n, std::vector<Interval>(n, Interval(0.0)));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      Interval rest = i == j ? Interval(1.0) : 2.0 * sin(pi() * rank[i][j] / Interval(6.0));
      for (std::size_t k = 0; k < j; ++k) rest = rest - (i == j ? sqr(root_[i][k]) : root_[i][k] * root_[j][k]);
      if (i != j) {
        root_[i][j] = rest / root_[j][j];
      } else if (rest.lower() > 0) {
        root_[i][i] = sqrt(rest);
      } else {
        throw std::invalid_argument(
            "the rank correlations, as those of normal numbers, are not positive definite: the first " +
            std::to_string(i + 1) + " quantities cannot be correlated so");
      }
    }
}

void GaussianCopula::correlate(std::span<double> point) const {
  constexpr double least = 0x1p-60, most = 1 - 0x1p-53;
  std::vector<double> w;
  for (const std::size_t q : quantities_) w.push_back(aboutNormalQuantile(std::clamp(point[q], least, most)));
  for (std::size_t i = 0; i < w.size(); ++i) {
    double z = 0;
    for (std::size_t j = 0; j <= i; ++j) z += midpoint(root_[i][j]) * w[j];
    point[quantities_[i]] = aboutNormalBelow(z);
  }
}

}  // namespace gamut
