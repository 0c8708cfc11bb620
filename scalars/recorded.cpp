// The functions of Recorded that are composed of operations. Each formula is an identity of real numbers on the domain
// that the header names; variables occur as seldom as possible, so that ranges stay tight.
#include "scalars/recorded.hpp"

#include <cmath>

namespace gamut {
namespace {

Recorded power(const Recorded& x, unsigned exponent) {
  if (exponent == 0) return 1.0;
  if (exponent == 1) return x;
  const Recorded half = power(x, exponent / 2);
  return exponent % 2 == 0 ? sqr(half) : sqr(half) * x;
}

}  // namespace

Recorded tan(const Recorded& x) { return sin(x) / cos(x); }

// With x = sin φ, |φ| <= π/2: sin φ/(1 + cos φ) = tan(φ/2).
Recorded asin(const Recorded& x) { return 2.0 * atan(x / (1.0 + sqrt(1.0 - sqr(x)))); }

// π/2 - asin x, with π/4 = atan 1.
Recorded acos(const Recorded& x) { return 2.0 * (atan(Recorded(1.0)) - atan(x / (1.0 + sqrt(1.0 - sqr(x))))); }

// With x = r cos φ, y = r sin φ: sin φ/(1 + cos φ) = tan(φ/2). Where y is exactly 0 the quotient by r + x is that even
// where this is 0 for the angle π: so it is y √(1/(r + x))², which has no value there.
Recorded atan2(const Recorded& y, const Recorded& x) {
  Recorder& current = Recorded::recorder();
  const int nodeOfY = y.node(), nodeOfX = x.node();
  if (current.isConstant(nodeOfY) && current.isConstant(nodeOfX))
    if (const Interval angle = atan2(current.value(nodeOfY), current.value(nodeOfX)); !isEmpty(angle))
      return Recorded(angle);
  if (current.isExactly(nodeOfY, 0.0)) return 2.0 * atan(Recorded(1.0)) * (1.0 - sign(x));
  return 2.0 * atan(y * sqr(1.0 / sqrt(x + hypot(x, y))));
}

Recorded sinh(const Recorded& x) { return 0.5 * (exp(x) - exp(-x)); }
Recorded cosh(const Recorded& x) { return 0.5 * (exp(x) + exp(-x)); }

Recorded asinh(const Recorded& x) { return log(x + sqrt(sqr(x) + 1.0)); }
Recorded acosh(const Recorded& x) { return log(x + sqrt(sqr(x) - 1.0)); }
Recorded atanh(const Recorded& x) { return 0.5 * log((1.0 + x) / (1.0 - x)); }

Recorded exp2(const Recorded& x) { return exp(x * log(Recorded(2.0))); }
Recorded exp10(const Recorded& x) { return exp(x * log(Recorded(10.0))); }
Recorded expm1(const Recorded& x) { return exp(x) - 1.0; }
Recorded log2(const Recorded& x) { return log(x) / log(Recorded(2.0)); }
Recorded log10(const Recorded& x) { return log(x) / log(Recorded(10.0)); }
Recorded log1p(const Recorded& x) { return log(1.0 + x); }
Recorded cbrt(const Recorded& x) { return rootn(x, 3); }

Recorded rootn(const Recorded& x, int n) {
  if (n == 0) throw std::domain_error("there is no zeroth root");
  return exp(log(x) / Recorded(static_cast<double>(n)));
}

Recorded where(const Recorded& condition, const Recorded& x, const Recorded& y) {
  return y + 0.5 * (1.0 + sign(condition)) * (x - y);
}
Recorded min(const Recorded& x, const Recorded& y) { return 0.5 * (x + y - abs(x - y)); }
Recorded max(const Recorded& x, const Recorded& y) { return 0.5 * (x + y + abs(x - y)); }
Recorded hypot(const Recorded& x, const Recorded& y) { return sqrt(sqr(x) + sqr(y)); }

Recorded pow(const Recorded& x, int exponent) {
  const unsigned size = static_cast<unsigned>(exponent);  // modulo 2^32: 0u - size is |exponent| even of the least int
  return exponent < 0 ? 1.0 / power(x, 0u - size) : power(x, size);
}

Recorded pow(const Recorded& x, double exponent) {
  if (exponent == std::trunc(exponent) && std::fabs(exponent) < 1024) return pow(x, static_cast<int>(exponent));
  return pow(x, Recorded(exponent));
}

Recorded pow(const Recorded& x, const Recorded& y) { return exp(y * log(x)); }

std::vector<Recorded> written(const Program& f, const std::vector<Recorded>& x, const std::vector<Recorded>& p,
                              const Recorded& t) {
  std::vector<int> parameters, instead(f.nodes().size(), -1);
  for (const Recorded& value : p) parameters.push_back(value.node());
  for (std::size_t i = 0; i < x.size(); ++i) instead[i] = x[i].node();
  instead[x.size() + p.size()] = t.node();
  const std::vector<int> here = Recorder::current()->append(f, parameters, instead);
  std::vector<Recorded> y;
  for (const int output : f.outputNodes()) y.push_back(Recorded::node(here[output]));
  return y;
}

}  // namespace gamut
