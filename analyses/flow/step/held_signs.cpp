#include "analyses/flow/step/held_signs.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scalars/algebra/decompositions.hpp"
#include "scalars/index.hpp"
#include "scalars/program/recorder.hpp"
#include "scalars/program/sides.hpp"

namespace gamut {

using detail::at;

namespace {

/// s*, the diagonal of G, and then by rows what is beside the diagonal of G diag(G)⁻¹.
Program heldSignsOf(const FlowJumps& jumps, const std::vector<char>& held) {
  const Program given = withHeldGiven(jumps.f, held);
  const std::size_t n = at(given.states()), count = jumps.count(), signs = at(given.parameters()) - count;
  Recorder recorder(given.states(), given.parameters());
  std::vector<int> values, instead(given.nodes().size(), -1), of, rates, factors, outputs;
  for (int i = 0; i < given.parameters(); ++i) values.push_back(recorder.parameter(i));
  for (std::size_t j = 0; j < count; ++j) {
    if (held[j] == 0) continue;
    of.push_back(static_cast<int>(j));
    values[signs + j] = recorder.constant(0.0);
    instead[given.outputNodes()[n + j]] = recorder.constant(0.0);
  }
  const std::vector<int> here = recorder.append(given, values, instead);
  const auto output = [&](std::size_t o) { return here[given.outputNodes()[o]]; };
  const std::size_t K = of.size(), each = 1 + n + count;
  LinearMatrix fall{MatrixKind::general, static_cast<int>(K), std::vector<int>(K * K)};  // of rates, by products φ s
  for (std::size_t j = 0; j < K; ++j) {
    const std::size_t first = n + 2 * count + j * each;
    rates.push_back(output(n + count + at(of[j])));
    factors.push_back(output(first));
    for (std::size_t k = 0; k < K; ++k) fall.entries[k * K + j] = recorder.neg(output(first + 1 + n + at(of[k])));
  }
  const std::vector<int> entries = fall.entries;
  const std::vector<int> products = K == 1 ? std::vector<int>{recorder.mul(rates[0], recorder.recip(entries[0]))}
                                           : recorder.solve(recorder.matrix(std::move(fall)), false, rates);
  for (std::size_t k = 0; k < K; ++k) outputs.push_back(recorder.mul(products[k], recorder.recip(factors[k])));
  for (std::size_t k = 0; k < K; ++k) outputs.push_back(recorder.mul(entries[k * K + k], factors[k]));
  for (std::size_t k = 0; k < K; ++k)
    for (std::size_t j = 0; j < K; ++j)
      if (k != j) outputs.push_back(recorder.mul(entries[k * K + j], recorder.recip(entries[j * K + j])));
  return recorder.finish(outputs);
}

/// W of which W_k C_kj = W_j C_jk along the strongest ways from the first, where these have the same sign; else 1.
std::vector<double> symmetrising(const Eigen::MatrixXd& C) {
  const Eigen::Index K = C.rows();
  std::vector<double> W(K, 0.0);
  for (Eigen::Index found = 0; found < K; ++found) {
    Eigen::Index next = -1;
    double best = 0, weight = 1;
    for (Eigen::Index k = 0; k < K; ++k)
      for (Eigen::Index j = 0; j < K; ++j)
        if (const double both = C(k, j) * C(j, k); W[k] > 0 && W[j] == 0 && both > best) {
          best = both;
          next = j;
          weight = W[k] * C(k, j) / C(j, k);
        }
    for (Eigen::Index j = 0; j < K && next < 0; ++j)
      if (W[j] == 0) next = j;
    W[next] = weight;
  }
  return W;
}

}  // namespace

HeldSigns::HeldSigns(const FlowJumps& jumps, const std::vector<char>& held, std::shared_ptr<const Monomials> monomials,
                     int order, double length, double resolution, const std::atomic<bool>* cancelled)
    : AlongStep(heldSignsOf(jumps, held), std::move(monomials), order, length, resolution, cancelled) {
  for (const char isHeld : held) place_.push_back(isHeld != 0 ? count_++ : -1);
}

int HeldSigns::worstSymbol(std::size_t jump, double sigma) const {
  const Monomials& monomials = series().monomials();
  const int node = series().outputNode(place_[jump]);
  std::vector<double> mass(monomials.symbols(), 0.0);
  for (int g = 1; g < series().count(node); ++g) {
    const double* c = series().series(node) + g * series().stride();
    double sum = 0;
    for (int order = series().stride(); order-- > 0;) sum = sum * sigma + c[order];
    monomials.addMass(g, std::fabs(sum), mass);
  }
  return greatestOf(mass);
}

/// B S Bᵀ is positive definite with S, and is so if each of its diagonal is above the sum of what is beside it; B about
/// the inverse of S's Cholesky factor.
bool HeldSigns::decides(double from, double to) const {
  const Eigen::Index K = count_;
  for (int k = 0; k < count_; ++k)
    if (!(over(count_ + k, from, to).lower() > 0)) return false;
  std::vector<Interval> C(K * K, Interval(1.0));
  Eigen::MatrixXd middle = Eigen::MatrixXd::Identity(K, K);
  int output = 2 * count_;
  for (Eigen::Index k = 0; k < K; ++k)
    for (Eigen::Index j = 0; j < K; ++j) {
      if (k == j) continue;
      Interval& entry = C[k * K + j] = over(output++, from, to);
      if (!isCommon(entry)) return false;
      middle(k, j) = midpoint(entry);
    }
  const std::vector<double> W = symmetrising(middle);
  if (!std::ranges::all_of(W, [](double weight) { return weight > 0 && std::isfinite(weight); })) return false;
  const auto entry = [&](Eigen::Index k, Eigen::Index j) {
    return Interval(0.5) * (Interval(W[k]) * C[k * K + j] + Interval(W[j]) * C[j * K + k]);
  };
  Eigen::MatrixXd S(K, K);
  for (Eigen::Index k = 0; k < K; ++k)
    for (Eigen::Index j = 0; j < K; ++j) S(k, j) = midpoint(entry(k, j));
  const std::optional<Eigen::MatrixXd> factor = choleskyFactorOf(S);
  if (!factor) return false;
  const Eigen::MatrixXd B = lowerSolved(*factor, Eigen::MatrixXd::Identity(K, K));
  for (Eigen::Index k = 0; k < K; ++k) {
    Interval dominant(0.0);
    std::vector<Interval> row(K, Interval(0.0));  // of B S
    for (Eigen::Index j = 0; j < K; ++j)
      for (Eigen::Index l = 0; l < K; ++l) row[j] += Interval(B(k, l)) * entry(l, j);
    for (Eigen::Index j = 0; j < K; ++j) {
      Interval product(0.0);
      for (Eigen::Index l = 0; l < K; ++l) product += row[l] * Interval(B(j, l));
      dominant += k == j ? product : Interval(-magnitude(product));
    }
    if (!(dominant.lower() > 0)) return false;
  }
  return true;
}

}  // namespace gamut
