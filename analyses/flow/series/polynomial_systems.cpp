// Solutions of linear systems A x = b among the nodes of a polynomial series: their recursion and their certificate.
//
// With A₀ the coefficient of A that belongs to 1, factorised once for all,
//     A₀ x_{iα} = b_{iα} - Σ_{(j,β)≠0} A_{jβ} x_{i-j,α-β} .
// Whatever x̃ came of it: with r ≥ |b̃ - Ãx̃|, C about A₀⁻¹ and H ≥ |I - C A| on the whole step and box, an M-matrix I - H
// proves A regular, and  A (x - x̃) = (b̃ - Ãx̃) + (b - b̃) - (A - Ã)x̃  gives
//     |x - x̃| ≤ (I - H)⁻¹ ‖C‖ (r + ρ_b + ρ_A ‖x̃‖) .
#include <algorithm>
#include <cmath>

#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/flow/series/polynomial_series.hpp"
#include "analyses/work.hpp"

namespace gamut {

void PolynomialSeries::planSystems(const Program& program) {
  // A transposed solution is one of the transposed matrix, which is a system of its own.
  std::vector<int> numbers(2 * program.matrices().size(), -1);
  for (const LinearSolution& solution : program.solutions()) {
    const LinearMatrix& matrix = program.matrices()[solution.matrix];
    int& number = numbers[2 * solution.matrix + (solution.transposed ? 1 : 0)];
    if (number < 0) {
      number = static_cast<int>(systems_.size());
      const int n = matrix.size;
      System system{n, {}, LinearFactors(n), {}, {}, {}, {}, {}, 0, false, false};
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
          system.entries.push_back(solution.transposed ? matrix.entry(j, i) : matrix.entry(i, j));
      system.own.assign(n * n, 0.0);
      system.defects.assign(n * n * kernels::reversedStride(stride()), 0.0);
      system.norms.assign(n * n, 0.0);
      systems_.push_back(std::move(system));
    }
    solutions_.push_back({number, solution.rightSide, {}, std::vector<double>(matrix.size * m_, 0.0)});
    largestSystem_ = std::max(largestSystem_, matrix.size);
  }
  if (systems_.empty()) return;
  for (int order = 0; order <= std::min(inverseOrder, m_ - 1); ++order) inverseTerms_.emplace_back(order, -1);
  for (int symbol = 0; symbol < monomials().symbols(); ++symbol) {
    if (monomials().linear(symbol) >= 0) inverseTerms_.emplace_back(0, symbol);
    for (int g = 0; g < count(); ++g) shift_.push_back(monomials().shifted(g, symbol, 1));
  }
}

/// How many entries of a row of A are not known zeros.
int PolynomialSeries::termsIn(const System& system, int row) const {
  int count = 0;
  for (int j = 0; j < system.size; ++j) count += !plan_[system.entry(row, j)].isZero;
  return count;
}

void PolynomialSeries::factorise(System& system) {
  std::vector<double> leading;
  for (int entry : system.entries) leading.push_back(leadingOf(entry));
  system.factors.factorise(leading.data());
  system.isFactorised = true;
}

/// Order 0 of the coefficients of 1.
void PolynomialSeries::computeLeadingSolution(int first) {
  Solution& solution = solutions_[plan_[first].a];
  System& system = systems_[solution.system];
  if (!system.isFactorised) factorise(system);
  std::vector<double>& x = scratch2_;
  for (int k = 0; k < system.size; ++k) x[k] = leadingOf(solution.rightSide[k]);
  std::fill_n(solution.residual.begin(), system.size, 0.0);
  system.factors.solve(x.data(), solution.residual.data());
  for (int k = 0; k < system.size; ++k) put(plan_[first + k], 0, 0, x[k]);
}

void PolynomialSeries::computeSolution(int first, int i) {
  const SeriesNode& v = plan_[first];
  Solution& solution = solutions_[v.a];
  System& system = systems_[solution.system];
  if (!system.isFactorised) factorise(system);
  const int n = system.size, N = plan_.countOf(v, i);
  std::fill_n(&solution.residual[i * n], n, 0.0);
  const auto* pairs = monomials().pairs().data();
  const auto* start = monomials().first().data();
  const auto x = [&](int k) -> const SeriesNode& { return plan_[first + k]; };
  double* right = rightSides_.data();
  double* part = scratch_.data();
  for (int k = 0; k < n; ++k)  // what is being computed counts as zero in the sums
    for (int g = 0; g < N; ++g) put(x(k), g, i, 0.0);
  for (int k = 0; k < n; ++k) {
    double* out = right + k * count();
    const double* b = series(solution.rightSide[k]);
    for (int g = 0; g < N; ++g) out[g] = b[g * stride() + i];
    for (int j = 0; j < n && i > 0; ++j) {
      const SeriesNode& a = plan_[system.entry(k, j)];
      if (a.invariant || a.constant) continue;
      std::fill(part, part + N, 0.0);
      convolve(N, series(a), x(j), i, part);
      for (int g = 0; g < N; ++g) out[g] -= part[g];
    }
  }
  double* values = scratch2_.data();
  double varying = 0;  // entries of the matrix
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j) varying += plan_[system.entry(k, j)].constant ? 0 : 1;
  Work::count(Work::multipliedPair, varying * (start[N] - N));
  Work::count(Work::matrixTerm, 4.0 * n * n * N);
  for (int g = 0; g < N; ++g) {  // grades from below: Σ_{β≠0} A_{0β} x_{i,α-β} is known
    for (int k = 0; k < n; ++k) {
      double s = right[k * count() + g];
      for (int j = 0; j < n && g > 0; ++j) {
        const SeriesNode& a = plan_[system.entry(k, j)];
        if (a.constant) continue;
        double sum = 0;
        for (auto q = start[g]; q < start[g + 1]; ++q)
          if (pairs[q].a != 0) sum += f_[a.f + at(pairs[q].a * stride())] * f_[x(j).f + at(pairs[q].b * stride() + i)];
        s -= sum;
      }
      values[k] = s;
    }
    system.factors.solve(values, &solution.residual[i * n]);
    for (int k = 0; k < n; ++k) put(x(k), g, i, values[k]);
  }
}

/// C by C A = 1 term by term: C_σ^o = -(Σ_{j≥1} C_σ^{o-j} A_j) C₀, C_ξ = -C₀ A_ξ C₀. Any C would do.
void PolynomialSeries::invert(System& system) {
  const int n = system.size;
  const std::vector<double>& leading = system.factors.inverse();
  std::vector<double> sum(n * n);
  const auto coefficient = [&](int i, int j, int g, int o) {
    const SeriesNode& a = plan_[system.entry(i, j)];
    return g < a.count ? series(a, g)[o] : 0.0;
  };
  const auto addProduct = [&](const std::vector<double>& c, int g, int o) {  // sum += c A_{og}
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < n; ++j)
        if (const double entry = coefficient(k, j, g, o); entry != 0)
          for (int i = 0; i < n; ++i) sum[i * n + j] += c[i * n + k] * entry;
  };
  system.inverse.resize(inverseTerms_.size());
  for (std::size_t t = 0; t < inverseTerms_.size(); ++t) {
    const auto [order, symbol] = inverseTerms_[t];
    std::vector<double>& c = system.inverse[t];
    if (t == 0) {
      c = leading;
      continue;
    }
    std::fill(sum.begin(), sum.end(), 0.0);
    if (symbol >= 0)
      addProduct(leading, monomials().linear(symbol), 0);
    else  // the orders come first
      for (int j = 1; j <= order; ++j) addProduct(system.inverse[order - j], 0, j);
    c.assign(n * n, 0.0);
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < n; ++k)
        for (int j = 0; j < n; ++j) c[i * n + j] -= sum[i * n + k] * leading[k * n + j];
  }
}

/// Σ_α |(I - C Ã)_{oα}| of each entry and order o, over the kept coefficients of Ã. What C cancels lies in the lowest
/// grades: of the others, for each term of C by itself, |C||Ã| counts where that is negligible.
void PolynomialSeries::multiplyByInverse(System& system) {
  const int n = system.size, terms = static_cast<int>(inverseTerms_.size()), width = kernels::reversedStride(stride());
  const std::vector<int> kept = gradesToMultiply(system);
  std::vector<int> counts;
  int last = 0;
  for (int t = 0; t < terms; ++t) {
    const int symbol = inverseTerms_[t].second;
    counts.push_back(kept[t] > 0 ? monomials().countUpTo(kept[t] - 1) : 0);
    last = std::max(last, kept[t] - 1 + (symbol < 0 ? 0 : monomials().weight(symbol)));
  }
  const int targets = monomials().countUpTo(last);
  double multiplied = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      double *product = combination_.data(), *defect = &system.defects[(i * n + j) * width];
      std::fill_n(product, targets * width, 0.0);
      std::fill_n(defect, width, 0.0);
      for (int k = 0; k < n; ++k) {
        const int entry = system.entry(k, j);
        const SeriesNode& a = plan_[entry];
        if (plan_[entry].isZero) continue;
        const int orders = a.invariant ? 1 : m_;  // a state's last order belongs to its error
        for (int t = 0; t < terms; ++t) {
          const double c = system.inverse[t][i * n + k];
          if (c == 0) continue;
          const auto [order, symbol] = inverseTerms_[t];
          const int from = std::min(a.constant ? 1 : a.count, counts[t]);
          kernels::addRows(series(a), stride(), from, c, orders, symbol < 0 ? nullptr : &shift_[symbol * count()],
                           product + order, width);
          multiplied += static_cast<double>(orders) * from;
          const double* rest = massFrom(system, kept[t], k, j);
          for (int o = 0; o < m_; ++o) defect[o + order] += std::fabs(c) * rest[o];
        }
      }
      if (i == j) product[0] -= 1;
      kernels::addRowSizes(product, width, targets, m_ + inverseOrder, defect);
    }
  Work::count(Work::matrixTerm, 0.4 * multiplied);
}

/// How many grades of Ã each term of C is multiplied with: as few as leave no more than 1e-3 of x, of all terms
/// together and row by row in the units of x, and none whose products would be no monomials of the series.
std::vector<int> PolynomialSeries::gradesToMultiply(const System& system) {
  constexpr double negligible = 1e-3;
  const int n = system.size, terms = static_cast<int>(inverseTerms_.size()), grades = monomials().degree() + 1;
  mass_.assign((grades + 1) * n * n * stride(), 0.0);
  std::vector<double>& unit = vector_;
  for (int i = 0; i < n; ++i) unit[i] = *std::max_element(&system.norms[i * n], &system.norms[i * n] + n);
  std::vector<double> rows((grades + 1) * n, 0.0);  // Σ_j |Ã_{kj}| from a grade on
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j) {
      const int entry = system.entry(k, j);
      const SeriesNode& a = plan_[entry];
      if (plan_[entry].isZero) continue;
      const int all = a.constant ? 1 : a.count, orders = a.invariant ? 1 : m_;
      for (int q = std::min(grades - 1, monomials().grade(all - 1)); q >= 0; --q) {
        double *sizes = massFrom(system, q, k, j), *above = massFrom(system, q + 1, k, j), sum = 0;
        const int first = monomials().firstOf(q), end = std::min(all, monomials().countUpTo(q));
        std::copy_n(above, m_, sizes);
        kernels::addRowSizes(series(a, first), stride(), end - first, orders, sizes);
        for (int o = 0; o < m_; ++o) sum += sizes[o] * power_[o];
        rows[q * n + k] += sum * unit[j];
      }
    }
  std::vector<int> kept;
  for (int t = 0; t < terms; ++t) {
    const auto [order, symbol] = inverseTerms_[t];
    const auto isNegligible = [&](int q) {
      for (int i = 0; i < n; ++i) {
        double sum = 0;
        for (int k = 0; k < n; ++k) sum += std::fabs(system.inverse[t][i * n + k]) * rows[q * n + k];
        if (!(sum * power_[order] <= negligible / terms * unit[i])) return false;
      }
      return true;
    };
    int grade = grades - (symbol < 0 ? 0 : monomials().weight(symbol));
    while (grade > 0 && isNegligible(grade - 1)) --grade;
    kept.push_back(grade);
  }
  return kept;
}

/// ‖I - C Ã‖ entrywise over the kept coefficients of Ã, and ‖C‖. A coefficient of the product is a sum of at most
/// n products a term of C, and 1: as many roundings and one more.
void PolynomialSeries::tabulateSystem(System& system) {
  const double theta = power_[1] > 0 ? power_[1] : 1.0;
  if (system.multipliedFor == 0) invert(system);  // C is the same for every θ
  const int n = system.size, terms = static_cast<int>(inverseTerms_.size()), width = kernels::reversedStride(stride());
  std::fill(system.norms.begin(), system.norms.end(), 0.0);
  for (int t = 0; t < terms; ++t)
    for (std::size_t i = 0; i < system.norms.size(); ++i)
      system.norms[i] += std::fabs(system.inverse[t][i]) * power_[inverseTerms_[t].first];
  for (double& entry : system.norms) entry *= bounds::up;
  if (!(theta <= 2 * system.multipliedFor)) {  // what is negligible in a short step need not be in a longer one
    multiplyByInverse(system);
    system.multipliedFor = theta;
  }
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      double size = i == j ? 1 : 0, sum = 0, power = 1;
      for (int k = 0; k < n; ++k) size += system.norms[i * n + k] * norm_[system.entry(k, j)];
      const double* defect = &system.defects[(i * n + j) * width];
      for (int o = 0; o < m_ + inverseOrder; ++o, power *= theta) sum += defect[o] * power;
      system.own[i * n + j] = (sum + (n * terms + 2) * bounds::unit * size) * bounds::up + bounds::tiny;
    }
}

/// With H = own + ‖C‖ ρ_A.
bool PolynomialSeries::boundSystem(System& system) {
  const int n = system.size;
  const std::vector<double>& C = system.norms;
  double* H = system.amplifier.matrix(n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      double s = system.own[i * n + j];
      for (int k = 0; k < n; ++k) {
        const int entry = system.entry(k, j);
        s += C[i * n + k] * (rho_[entry].e0 + rho_[entry].e1 + lowOf(entry));
      }
      H[i * n + j] = s * bounds::up + bounds::tiny;
    }
  return system.isBounded = system.amplifier.bound(C);
}

/// |b̃ - Ãx̃| for each component. Kept coefficients: γ_{N+2T+1} of all terms, with T entries in the row, a convolution's
/// N ≤ weights inside and at most 2T subtractions outside (by grades TN in all, each product counted once), and the
/// measured residual of A₀ x = s, whose evaluation has T + 1 roundings of |s| + |A₀||x̃|, where |s| ≤ residual +
/// |A₀||x̃|. Then what x̃ and b do not keep. In double-double the same of its roundings; of later orders all of that and
/// the second doubles, 5T + 7 roundings of |A||x̃|.
void PolynomialSeries::solutionOwnErrors(int first) {
  const SeriesNode& v = plan_[first];
  const Solution& solution = solutions_[v.a];
  const System& system = systems_[solution.system];
  const int n = system.size;
  for (int k = 0; k < n; ++k) {
    const int b = solution.rightSide[k];
    const int terms = termsIn(system, k);
    const bool fine = isFine(first);
    double residual = 0;
    for (int i = 0; i < (v.invariant ? 1 : m_); ++i)
      residual += (i < fine_.orders() && fine ? fine_.residual(v.a, k, i) : solution.residual[i * n + k]) * power_[i];
    double rounding = (2 * terms + 1) * norm_[b] + 3 * (terms + 1) * system.factors.size(k, &norm_[first]);
    double coarse = fine ? (2 * terms + 1) * coarseNorm(b, fine_.orders()) : 0.0;
    double e0 = 2 * residual + (isGraded() ? dropped(b, v.degree) : 0.0), e1 = 0;
    for (int j = 0; j < n; ++j) {
      const int a = system.entry(k, j), x = first + j;
      if (plan_[a].isZero) continue;
      rounding += (plan_.isByGrades ? terms : 1) * weighted_[a] * weighted_[x] + (2 * terms + 1) * norm_[a] * norm_[x];
      if (fine) coarse += (5 * terms + 7) * coarseProduct(a, x, 0);
      e1 += tailTime(a, x);
      if (isGraded()) e0 += tailDegree(a, x, v.degree, 0);
    }
    rounding = fine ? bounds::fine * rounding + bounds::unit * coarse : bounds::unit * rounding;
    own_[first + k] = SeriesError{e0 + rounding, e1}.up();
  }
}

bool PolynomialSeries::boundSolution(int first) {
  const Solution& solution = solutions_[plan_[first].a];
  System& system = systems_[solution.system];
  if (!system.isBounded && !boundSystem(system)) return false;
  const int n = system.size;
  std::vector<double>&residual0 = vector_, &residual1 = vector2_;
  const auto low = [&](int node) { return isFine(first) ? 0.0 : lowOf(node); };
  for (int k = 0; k < n; ++k) {
    const int b = solution.rightSide[k];
    double e0 = own_[first + k].e0 + rho_[b].e0 + low(b), e1 = own_[first + k].e1 + rho_[b].e1;
    for (int j = 0; j < n; ++j) {
      const int a = system.entry(k, j);
      e0 += (rho_[a].e0 + low(a)) * norm_[first + j];
      e1 += rho_[a].e1 * norm_[first + j];
    }
    residual0[k] = e0;
    residual1[k] = e1;
  }
  bool isFinite = true;
  for (int i = 0; i < n; ++i) {
    double e0 = 0, e1 = 0;
    for (int k = 0; k < n; ++k) {
      e0 += system.amplifier(i, k) * residual0[k];
      e1 += system.amplifier(i, k) * residual1[k];
    }
    rho_[first + i] = {e0 * bounds::up + bounds::tiny, e1 * bounds::up + bounds::tiny};
    isFinite = isFinite && isBelowLargest(first + i);
  }
  return isFinite;
}

}  // namespace gamut
