// Which symbol of a set to bisect after a step, and the two halves. Derivation: docs/flow.md, section 4.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/flow/step/step.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

namespace {

/// W += |C| size.
void addFramed(FlowSet& set, const std::vector<double>& size) {
  const std::size_t n = size.size();
  for (std::size_t i = 0; i < n; ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < n; ++j) sum += std::fabs(set.C[i * n + j]) * size[j];
    set.W[i] = (set.W[i] + sum) * bounds::up;
  }
}

}  // namespace

double FlowStepper::relativeRemainder(const FlowSet& set) const {
  std::vector<double> total;
  errorRadius(set, total);
  constexpr double little = 1e-3;  // of the greatest state in balanced units: one that has rested is no smaller than so
  double greatest = 0, largest = 0;
  const auto unit = [&](int i) { return set.units.empty() ? 0 : set.units[i]; };
  for (int i = 0; i < n_; ++i) greatest = std::max(greatest, std::ldexp(scale_[i], -unit(i)));
  for (int i = 0; i < n_; ++i) {
    const double size = std::max(scale_[i], std::ldexp(little * greatest, unit(i)));
    largest = std::max(largest, remainderOf(set, i, total) / size);
  }
  return largest;
}

/// Of each symbol, its part in the highest grades; of operations on the way where states hold none (what they lose may
/// cancel in f); at a fresh start, in all of states. `byGrade`: what each grade holds.
std::vector<double> FlowStepper::symbolMass(std::vector<double>& byGrade) const {
  const Monomials& m = monomials();
  const int highest = m.degree() - 1;
  std::vector<double> mass;
  const auto add = [&](int node, int from, double unit) {
    for (int g = 1; g < series_.count(node); ++g) {
      if (from > 1 && m.grade(g) < from - 2 && m.grade(g) > 1) continue;
      double size = 0, power = 1;
      for (int order = 0; order <= m_; ++order, power *= theta_)
        size += std::fabs(series_.series(node)[g * series_.stride() + order]) * power;
      size /= unit;
      byGrade[m.grade(g)] += size;
      if (m.grade(g) >= from)
        for (int l = 0; l < m.symbols(); ++l) mass[l] += m.exponent(g, l) * size;
    }
  };
  const auto isFound = [&](int from, int nodes, bool areStates) {
    mass.assign(m.symbols(), 0.0);
    byGrade.assign(m.degree() + 1, 0.0);
    for (int node = 0; node < nodes; ++node) {
      const double unit = areStates ? scale_[node] : series_.norm(node);
      if (areStates || (unit > 0 && std::isfinite(unit))) add(node, from, unit);
    }
    return *std::max_element(mass.begin(), mass.end()) > 0;
  };
  int last = 0;
  for (int i = 0; i < n_; ++i) last = std::max(last, series_.outputNode(i));
  if (!isFound(highest, n_, true) && !isFound(highest, last + 1, false)) isFound(1, n_, true);
  return mass;
}

int FlowStepper::worstSymbol() const {
  if (course_.symbolAcross >= 0) return course_.symbolAcross;
  std::vector<double> byGrade;
  const std::vector<double> mass = symbolMass(byGrade);
  return static_cast<int>(std::max_element(mass.begin(), mass.end()) - mass.begin());
}

GradeDecay FlowStepper::decay() const {
  std::vector<double> byGrade;
  const std::vector<double> mass = symbolMass(byGrade);
  double sum = 0, squares = 0;
  for (const double part : mass) sum += part, squares += part * part;
  const int d = monomials().degree();
  if (d < 2) return {1.0, 1.0, 1.0};
  // Over two grades: odd or even ones may be empty.
  const double high = byGrade[d] + byGrade[d - 1], low = byGrade[d - 1] + byGrade[d - 2];
  return {low > 0 ? high / low : 1.0, squares > 0 ? sum * sum / squares : 1.0,
          byGrade[1] > 0 ? high / byGrade[1] : 1.0};
}

FlowSet FlowStepper::bisect(FlowSet& set, int symbol, const PolynomialRange& shift) const {
  const int N = series_.count();
  const std::size_t block = set.generators.size() / set.powers;
  FlowSet halves[2] = {set, set};
  for (int side : {0, 1}) {
    FlowSet& s = halves[side];
    const double middle = side == 0 ? -0.5 : 0.5;
    for (int i = 0; i < n_; ++i) {
      double norm = 0;
      for (int g = 0; g < N; ++g) norm += std::fabs(set.p[i * N + g]);
      shift.substitute(symbol, middle, 0.5, &set.p[i * N], &s.p[i * N]);
      if (norm != 0)  // zero stays zero, exactly: what rests does so in both halves
        s.W[i] = (s.W[i] + shift.shiftError() * norm) * bounds::up + bounds::tiny;
    }
    if (!set.ahead.c.empty()) {
      shift.substitute(symbol, middle, 0.5, set.ahead.c.data(), s.ahead.c.data());
      s.ahead.error = (s.ahead.error + shift.shiftError() * set.ahead.norm()) * bounds::up + bounds::tiny;
    }
    std::vector<double> rounding(n_, 0.0);
    shift.substitute(symbol, middle, 0.5, set.generators.data(), s.generators.data(), static_cast<int>(set.powers),
                     block);
    addColumnSizes(set.generators, rounding);
    for (double& size : rounding) size *= shift.shiftError();
    addFramed(s, rounding);
    if (at(symbol) < s.inputsOfXi.size()) {  // Γ + ξ Γ_l, one rounding an entry: |C| times that
      std::vector<double>& ofXi = s.inputsOfXi[symbol];
      std::vector<double> moved(n_, 0.0);
      for (std::size_t c = 0; c < ofXi.size(); ++c) {
        s.inputs[c] += middle * ofXi[c];
        moved[c % at(n_)] += bounds::unit * std::fabs(s.inputs[c]);
        ofXi[c] *= 0.5;
      }
      addFramed(s, moved);
    }
    halve(s.parameters, symbol, middle);
    halve(s.centre, s.half, symbol, middle);
  }
  set = std::move(halves[0]);
  return std::move(halves[1]);
}

}  // namespace gamut
