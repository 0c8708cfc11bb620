// Interval expressions beside ordinary ones on the same operands, where an optimiser may merge the two, fold them while
// compiling, hoist them out of loops or contract a * b + c: every enclosure must hold the exact value all the same.
//
//   neighbours [THREADS]
//
// does it all in so many threads at once (1), prints a digest of all enclosures, the same however this was compiled and
// wherever it runs, and returns 0 if no enclosure failed and all threads agree.
#include <algorithm>
#include <array>
#include <cfenv>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/compilers/judge.hpp"

namespace gamut::testing {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();  // no ordinary value beside

/// a * b rounded to nearest, whatever else becomes of the expression: a value in memory.
[[gnu::noinline]] double product(double a, double b) {
  volatile double p = a * b;
  return p;
}

// ---- Straight-line code: inlined, so that the optimiser sees both kinds together ------------------------------------

[[gnu::always_inline]] inline void arithmetic(Judge& judge, double a, double b, double c) {
  const double sum = a + b, difference = a - b, times = a * b, quotient = a / b, root = std::sqrt(std::abs(c));
  const Interval x(a), y(b), z(c);
  judge.encloses("a + b", x + y, Exact(a) + b, sum);
  judge.encloses("a - b", x - y, Exact(a) - b, difference);
  judge.encloses("a * b", x * y, Exact(a) * b, times);
  judge.enclosesRatio("a / b", x / y, a, b, quotient);
  judge.enclosesRoot("sqrt |c|", sqrt(abs(z)), std::abs(c), root);
  judge.encloses("c^2", sqr(z), Exact(c) * c, c * c);

  // Contractible into fused multiply-adds, the ordinary ones as well as those inside the interval operations.
  judge.encloses("a * b + c", x * y + z, Exact(a) * b + c, a * b + c);
  judge.encloses("c - a * b", z - x * y, Exact(c) - Exact(a) * b, c - a * b);
  judge.encloses("a * b - b * c", x * y - y * z, Exact(a) * b - Exact(b) * c, a * b - b * c);

  // Common subexpressions of both kinds.
  if (std::isfinite(sum) && std::isfinite(difference)) {
    judge.encloses("(a + b) (a - b)", (x + y) * (x - y), (Exact(a) + b) * (Exact(a) - b), sum * difference);
    const Interval error = x - (Interval(sum) - y);
    judge.encloses("a - (fl(a + b) - b)", error, Exact(a) - (Exact(sum) - b), a - (sum - b));
  }
}

/// Bounds of fl(a * b) + c; a function of its own, in which a * b has no other use than the sum.
[[gnu::noinline]] Interval sumWithProduct(double a, double b, double c) { return {addDown(a * b, c), addUp(a * b, c)}; }

/// Ordinary products that become intervals and are used for nothing else, so that nothing keeps them from being
/// contracted into the interval operation: the enclosure is of what the rounded product gives.
[[gnu::always_inline]] inline void contractible(Judge& judge, double a, double b, double c, double d) {
  const double p = product(a, b), q = product(c, d);
  if (!std::isfinite(p) || !std::isfinite(q) || !std::isfinite(product(a, a))) return;
  judge.encloses("[a * b] + c", Interval(a * b) + Interval(c), Exact(p) + c, p + c);
  judge.encloses("c - [a * b]", Interval(c) - Interval(a * b), Exact(c) - p, c - p);
  judge.encloses("[a * b] - [c * d]", Interval(a * b) - Interval(c * d), Exact(p) - q, p - q);
  judge.encloses("[a * b] * c", Interval(a * b) * Interval(c), Exact(p) * c, p * c);
  judge.enclosesRatio("[a * b] / c", Interval(a * b) / Interval(c), p, c, p / c);
  judge.enclosesRatio("c / [a * b]", Interval(c) / Interval(a * b), c, p, c / p);
  judge.enclosesRoot("sqrt [a * a]", sqrt(Interval(a * a)), product(a, a), std::sqrt(product(a, a)));
  judge.encloses("addDown, addUp of a * b", sumWithProduct(a, b, c), Exact(p) + c, p + c);
}

/// Intervals that are not thin, beside the midpoint and the radius that a user would write.
[[gnu::always_inline]] inline void wide(Judge& judge, double a, double b, double c, double d) {
  const Interval x(std::min(a, b), std::max(a, b)), y(std::min(c, d), std::max(c, d));
  const double middle = 0.5 * a + 0.5 * b, scaled = middle * d;
  const Interval sum = x + y, difference = x - y, times = x * y, quotient = x / y;
  judge.encloses("midpoint", x, Exact(0.5) * a + Exact(0.5) * b, middle);
  for (const double s : {a, b}) {
    for (const double t : {c, d}) {
      judge.encloses("X + Y", sum, Exact(s) + t, s + t);
      judge.encloses("X - Y", difference, Exact(s) - t, s - t);
      judge.encloses("X * Y", times, Exact(s) * t, s * t);
      judge.enclosesRatio("X / Y", quotient, s, t, s / t);
    }
  }
  if (std::isfinite(scaled)) judge.encloses("middle * d", Interval(middle) * d, Exact(middle) * d, scaled);
  judge.take(Interval(0, width(x)));
  judge.take(Interval(midpoint(y)));
}

// ---- Loops: hoisted, vectorised, accumulated ------------------------------------------------------------------------

constexpr int length = 48;
using Operands = std::array<double, length>;

[[gnu::always_inline]] inline void loops(Judge& judge, const Operands& a, const Operands& b, double c) {
  std::array<double, length> sums, products, hoisted;
  std::array<Interval, length> Sums, Products, Hoisted;
  for (int i = 0; i < length; ++i) {
    sums[i] = a[i] + b[i];
    Sums[i] = Interval(a[i]) + b[i];
    products[i] = a[i] * b[i];
    Products[i] = Interval(a[i]) * b[i];
    hoisted[i] = (a[0] / c) * b[i];  // a[0] / c does not change
    Hoisted[i] = (Interval(a[0]) / c) * b[i];
  }
  for (int i = 0; i < length; ++i) {
    judge.encloses("a[i] + b[i]", Sums[i], Exact(a[i]) + b[i], sums[i]);
    judge.encloses("a[i] * b[i]", Products[i], Exact(a[i]) * b[i], products[i]);
    judge.enclosesRatio("a[0] / c * b[i]", Hoisted[i], Exact(a[0]) * b[i], c, hoisted[i]);
  }

  double sum = 0, dot = 0, horner = 0;
  Interval Sum, Dot, Horner;
  Exact exactSum(0.0), exactDot(0.0), exactHorner(0.0);
  for (int i = 0; i < length; ++i) {
    sum += a[i];
    Sum += a[i];
    dot += a[i] * b[i];
    Dot += Interval(a[i]) * b[i];
  }
  for (int i = 0; i < length / 4; ++i) {
    horner = horner * c + b[i];
    Horner = Horner * c + b[i];
  }
  for (int i = 0; i < length; ++i) {
    exactSum = exactSum + a[i];
    exactDot = exactDot + Exact(a[i]) * b[i];
    if (i < length / 4) exactHorner = exactHorner * c + b[i];
  }
  judge.encloses("sum of a[i]", Sum, exactSum, sum);
  judge.encloses("sum of a[i] b[i]", Dot, exactDot, dot);
  judge.encloses("polynomial at c", Horner, exactHorner, horner);
}

// ---- Elementary functions -------------------------------------------------------------------------------------------

struct Elementary {
  const char* name;
  Interval (*interval)(const Interval&);
  double (*ordinary)(double);
  int (*exact)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);
  double lower, upper;  // where it is tried
};

// As lambdas, for the optimiser to see both sides of each call.
#define ELEMENTARY(function, lower, upper)                                                                             \
  Elementary {                                                                                                         \
#function, [](const Interval& x) { return function(x); }, [](double x) { return std::function(x); },               \
                                                                                                      mpfr_##function, \
                                                                                                      lower, upper     \
  }
constexpr Elementary functions[] = {
    ELEMENTARY(exp, -750, 709), ELEMENTARY(exp2, -1080, 1020), ELEMENTARY(expm1, -1, 700),  ELEMENTARY(log, 0, 1e300),
    ELEMENTARY(log2, 0, 10),    ELEMENTARY(log10, 0, 10),      ELEMENTARY(log1p, -1, 10),   ELEMENTARY(cbrt, -1e9, 1e9),
    ELEMENTARY(sin, -1e9, 1e9), ELEMENTARY(cos, -30, 30),      ELEMENTARY(tan, -30, 30),    ELEMENTARY(asin, -1, 1),
    ELEMENTARY(acos, -1, 1),    ELEMENTARY(atan, -50, 50),     ELEMENTARY(sinh, -700, 700), ELEMENTARY(cosh, -700, 700),
    ELEMENTARY(tanh, -20, 20),  ELEMENTARY(asinh, -1e9, 1e9),  ELEMENTARY(acosh, 1, 1e9),   ELEMENTARY(atanh, -1, 1)};
#undef ELEMENTARY

/// f at s and t and over what lies between, beside the ordinary f.
[[gnu::always_inline]] inline void elementary(Judge& judge, const Elementary& f, double s, double t) {
  const double a = std::min(s, t), b = std::max(s, t), rise = f.ordinary(b) - f.ordinary(a);
  const Interval atA = f.interval(a), atB = f.interval(b), range = f.interval({a, b}), Rise = atB - atA;
  judge.enclosesFunction(f.name, atA, f.exact, a);
  judge.enclosesFunction(f.name, atB, f.exact, b);
  for (const double x : {a, midpoint({a, b}), b}) judge.enclosesFunction(f.name, range, f.exact, x);
  // libm errs by a few units in the last place, and so may the rise: near the enclosure is all that can be asked.
  const double tolerance = 0x1p-48 * (magnitude(atA) + magnitude(atB));
  judge.encloses(f.name, Rise + Interval(-tolerance, tolerance), Exact(midpoint(Rise)), rise);
}

/// Functions of two intervals at the corners of their box.
void elementary(Judge& judge, const Interval& x, const Interval& y) {
  const Interval power = pow(abs(x), y), angle = atan2(y, x), distance = hypot(x, y), cube = pow(y, 3);
  const SinCos both = sinCos(x);
  judge.areEqual("sinCos", both.sin, sin(x));
  judge.areEqual("sinCos", both.cos, cos(x));
  for (const double s : {x.lower(), x.upper()}) {
    for (const double t : {y.lower(), y.upper()}) {
      judge.enclosesFunction("pow", power, mpfr_pow, std::abs(s), t);
      judge.enclosesFunction("atan2", angle, mpfr_atan2, t, s);
      judge.enclosesFunction("hypot", distance, mpfr_hypot, s, t);
      judge.encloses("y^3", cube, Exact(t) * t * t, none);
    }
  }
}

// ---- Rounding modes -------------------------------------------------------------------------------------------------

[[gnu::noinline]] std::vector<Interval> everyOperation(const Interval& x, const Interval& y, double c) {
  std::vector<Interval> results{x + y,
                                x - y,
                                x * y,
                                x / y,
                                x * c,
                                c / y,
                                sqr(x),
                                sqrt(abs(y)),
                                x * y + c * x,
                                Interval(0, width(x)),
                                midpoint(y),
                                Interval(toString(x)),
                                Interval("[0.1, 1/3]"),
                                pow(x, 3),
                                pow(abs(x), y),
                                atan2(y, x),
                                hypot(x, y)};
  for (const Elementary& f : functions) results.push_back(f.interval(x));
  return results;
}

/// An enclosure does not depend on the rounding mode that the caller left.
void roundingModes(Judge& judge, const Interval& x, const Interval& y, double c) {
  auto* volatile operations = everyOperation;  // the mode is changed around a call that the optimiser cannot move
  const std::vector<Interval> nearest = operations(x, y, c);
  for (const int mode : {FE_DOWNWARD, FE_UPWARD, FE_TOWARDZERO}) {
    std::fesetround(mode);
    const std::vector<Interval> directed = operations(x, y, c);
    std::fesetround(FE_TONEAREST);
    for (std::size_t i = 0; i < nearest.size(); ++i)
      judge.areEqual("in another rounding mode", directed[i], nearest[i]);
  }
}

// ---- Text -----------------------------------------------------------------------------------------------------------

/// 0.1 is read outward beside the compiler's own 0.1, and what is printed is read back around what was.
void text(Judge& judge, double a) {
  judge.enclosesRatio("\"0.1\"", Interval("0.1"), 1.0, 10.0, 0.1);
  judge.enclosesRatio("\"0.3\"", Interval("0.3"), 3.0, 10.0, 0.3);
  const Interval x(a);
  for (const int digits : {3, 17}) {
    const std::string written = toString(x, digits);
    judge.take(written);
    judge.encloses("read back", Interval(written), a, a);
  }
}

// ---- All of it ------------------------------------------------------------------------------------------------------

/// Operands that the optimiser knows: it may compute with them while compiling.
constexpr double constants[] = {0.1, -2.5e-7, 3.14159265358979, -7, 0x1p-1074, 0x1.fffffffffffffp1023, 1.0 / 3, 1e16};
constexpr std::size_t size = std::size(constants);

template <std::size_t... i>
void knownOperands(Judge& judge, std::index_sequence<i...>) {
  (arithmetic(judge, constants[i], constants[(i * 5 + 3) % size], constants[(i * 7 + 1) % size]), ...);
  (contractible(judge, constants[i], constants[(i * 3 + 1) % size], constants[(i + 3) % size],
                constants[(i + 5) % size]),
   ...);
  (wide(judge, constants[i], constants[(i * 3 + 2) % size], constants[(i + 1) % size], constants[(i * 9 + 4) % size]),
   ...);
}

class Random {
 public:
  int integer(int lower, int upper) { return lower + static_cast<int>(engine_() % (upper - lower + 1)); }
  /// Either sign, magnitude 2^-exponent to 2^exponent.
  double moderate(int exponent) {
    const double mantissa = 1 + static_cast<double>(engine_() >> 11) * 0x1p-53;
    const int sign = integer(0, 1) == 0 ? 1 : -1;
    return std::ldexp(sign * mantissa, integer(-exponent, exponent));
  }
  double uniform(double lower, double upper) {
    // Through memory: operands must not depend on how expressions are contracted.
    volatile double part = (upper - lower) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
    return std::min(lower + part, upper);
  }
  /// Any finite double: subnormal, huge, or a short number that makes results exact.
  double any() {
    switch (integer(0, 7)) {
      case 0:
        return integer(-8, 8);
      case 1:
        return std::ldexp(moderate(40), -1040);
      case 2:
        return std::ldexp(moderate(20), 1000);
      case 3:
        return moderate(900);
      default:
        return moderate(30);
    }
  }

 private:
  std::mt19937_64 engine_{6029};
};

void randomOperands(Judge& judge) {
  Random random;
  // In lists, which are evaluated from left to right everywhere, as arguments are not.
  for (int i = 0; i < 1500; ++i) {
    const double any[] = {random.any(), random.any(), random.any(), random.any()};
    arithmetic(judge, any[0], any[1], any[2]);
    wide(judge, any[0], any[1], any[2], any[3]);
    const double moderate[] = {random.moderate(30), random.moderate(30), random.moderate(50), random.moderate(50)};
    contractible(judge, moderate[0], moderate[1], moderate[2], moderate[3]);
  }
  for (int i = 0; i < 40; ++i) {
    Operands a, b;
    for (double& value : a) value = random.moderate(30);
    for (double& value : b) value = random.moderate(30);
    loops(judge, a, b, random.moderate(6));
  }
  for (const Elementary& f : functions)
    for (int i = 0; i < 40; ++i) {
      const double ends[] = {random.uniform(f.lower, f.upper), random.uniform(f.lower, f.upper)};
      elementary(judge, f, ends[0], ends[1]);
    }
  for (int i = 0; i < 30; ++i) {
    const double ends[] = {random.moderate(4), random.moderate(4), random.moderate(2), random.moderate(2)};
    const Interval x(std::min(ends[0], ends[1]), std::max(ends[0], ends[1]));
    const Interval y(std::min(ends[2], ends[3]), std::max(ends[2], ends[3]));
    elementary(judge, x, y);
    roundingModes(judge, x, y, ends[i % 4]);
    const double any[] = {random.any(), random.any()};
    roundingModes(judge, ends[i % 4], any[0], any[1]);
  }
  for (int i = 0; i < 100; ++i) text(judge, random.any());
}

Judge everything() {
  Judge judge;
  knownOperands(judge, std::make_index_sequence<size>());
  randomOperands(judge);
  return judge;
}

}  // namespace
}  // namespace gamut::testing

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::max(1, std::atoi(argv[1])) : 1;
  std::vector<gamut::testing::Judge> judges(count);
  std::vector<std::thread> threads;
  for (int i = 1; i < count; ++i) threads.emplace_back([&judges, i] { judges[i] = gamut::testing::everything(); });
  judges[0] = gamut::testing::everything();
  for (std::thread& thread : threads) thread.join();

  long failures = 0;
  for (const auto& judge : judges) failures += judge.failures() + (judge.digest() != judges[0].digest() ? 1 : 0);
  std::fprintf(stderr, "%d x %ld enclosures, %ld failures\n", count, judges[0].enclosures(), failures);
  std::printf("%016llx\n", static_cast<unsigned long long>(judges[0].digest()));
  return failures == 0 ? 0 : 1;
}
