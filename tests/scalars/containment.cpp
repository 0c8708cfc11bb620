// The table of functions and ranges, what each enclosure must be, and the drawing of intervals and points.
#include "tests/scalars/containment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <sstream>

#include "tests/scalars/reference.hpp"

namespace gamut::testing {
namespace {

// ---- Where arguments lie --------------------------------------------------------------------------------------------

/// A range of arguments: a way to draw one.
struct Range {
  std::string name;
  std::function<double(RandomDoubles&)> draw;
};

Range uniformly(double lower, double upper) {
  std::ostringstream name;
  name << "[" << lower << ", " << upper << "]";
  return {name.str(), [=](RandomDoubles& random) { return random.uniform(lower, upper); }};
}

double ofExponents(RandomDoubles& random, int least, int greatest) {
  return std::ldexp(random.uniform(1, 2) * (random.integer(0, 1) == 0 ? 1 : -1), random.integer(least, greatest));
}

const Range everywhere{"everywhere", [](RandomDoubles& random) { return random.any(); }};
const Range subnormal{"subnormal", [](RandomDoubles& random) { return ofExponents(random, -1080, -1015); }};
const Range huge{"huge", [](RandomDoubles& random) { return ofExponents(random, 900, 1023); }};
/// Where squares and products underflow and overflow.
const Range halfWay{"2^+-500", [](RandomDoubles& random) {
                      return ofExponents(random, 480, 515) * (random.integer(0, 1) == 0 ? 1 : 0x1p-1030);
                    }};

/// At a point, some doubles beside it, or at a distance that is a power of two.
double nearby(RandomDoubles& random, double point) {
  if (random.integer(0, 1) == 0) {
    for (int step = random.integer(-3, 3); step != 0; step += step < 0 ? 1 : -1)
      point = step < 0 ? nextDown(point) : nextUp(point);
    return point;
  }
  const double distance = std::ldexp(random.uniform(-1, 1), -random.integer(0, 60));
  return point + (point == 0 ? 1 : point) * distance;
}

Range near(std::vector<double> points) {
  std::ostringstream name;
  for (std::size_t i = 0; i < points.size(); ++i) name << (i == 0 ? "near " : ", ") << points[i];
  return {name.str(), [points](RandomDoubles& random) {
            return nearby(random,
                          points[static_cast<std::size_t>(random.integer(0, static_cast<int>(points.size()) - 1))]);
          }};
}

/// The double nearest to k pi / 2 (pi / 2 in three parts, together 150 bits; |k| < 2^45) and its neighbours.
const Range quarterTurns{"near k pi/2", [](RandomDoubles& random) {
                           const double k = random.integer(0, 1) == 0
                                                ? random.integer(-40, 40)
                                                : std::trunc(std::ldexp(random.uniform(-1, 1), random.integer(6, 45)));
                           const double high = 0x1.921fb54442d18p+0 * k;
                           const double low = std::fma(0x1.921fb54442d18p+0, k, -high);
                           return nearby(random, high + (low + 0x1.1a62633145c07p-54 * k));
                         }};
/// The doubles that lie closest to multiples of pi / 2, 2^-60.9 ... 2^-58.8 away from them, by the continued fraction
/// of 2^e / pi for every exponent e (Kahan; Muller, Elementary Functions, 11.3.2, finds the first).
const Range closestQuarterTurns{"nearest k pi/2", [](RandomDoubles& random) {
                                  constexpr std::array points{0x1.6ac5b262ca1ffp+849, 0x1.6c6cbc45dc8dep+5,
                                                              0x1.b951f1572eba5p+23,  0x1.504cac51f1eafp+131,
                                                              0x1.6ac5b262ca1ffp+851, 0x1.e009c53148be1p+991};
                                  const double x = points[static_cast<std::size_t>(random.integer(0, 5))];
                                  return nearby(random, random.integer(0, 1) == 0 ? x : -x);
                                }};

double withoutSignedZero(double x) { return x == 0 ? 0.0 : x; }

/// Thin, two draws, or one draw and something close to it; now and then without an end.
Interval drawInterval(RandomDoubles& random, const Range& range) {
  const auto finite = [](double x) { return std::clamp(withoutSignedZero(x), -largest, largest); };
  const double a = finite(range.draw(random));
  const int shape = random.integer(0, 15);
  if (shape < 4) return a;
  double b = range.draw(random);
  if (shape < 7) b = nearby(random, a);
  if (shape < 10 && shape >= 7) b = a + (a == 0 ? 1 : a) * std::ldexp(random.uniform(-1, 1), -random.integer(1, 50));
  b = finite(b);
  if (shape == 15) return random.integer(0, 1) == 0 ? Interval(-infinity, a) : Interval(a, infinity);
  return {std::min(a, b), std::max(a, b)};
}

/// An endpoint in half of the cases, else an element between them, spread over the numbers or over the exponents.
double drawElement(RandomDoubles& random, const Interval& x) {
  const double lower = std::max(x.lower(), -largest), upper = std::min(x.upper(), largest);
  switch (random.integer(0, 7)) {
    case 0:
    case 1:
      return lower;
    case 2:
    case 3:
      return upper;
    case 4:
      return withoutSignedZero(std::clamp(random.any(), lower, upper));
    case 5:
      return withoutSignedZero(std::clamp(lower * ofExponents(random, -4, 4), lower, upper));
    default: {
      const double t = random.uniform(0, 1);
      return withoutSignedZero(std::clamp(lower * (1 - t) + upper * t, lower, upper));
    }
  }
}

// ---- Judging --------------------------------------------------------------------------------------------------------

constexpr mpfr_prec_t bits = 120;

/// A value between two numbers of 120 bits, neighbours or the same. Doubles are numbers of 120 bits, so none lies
/// between the two: comparisons with either are comparisons with the value.
class Exact {
 public:
  template <class F, class... Arguments>
  explicit Exact(const F& f, Arguments... arguments) : low_(0, bits), high_(0, bits) {
    const int inexact = f(low_, Mpfr(arguments)..., MPFR_RNDD);
    mpfr_set(high_, low_, MPFR_RNDN);
    if (inexact != 0) mpfr_nextabove(high_);
    // An infinity that is exact is a pole.
    defined_ = !mpfr_nan_p(static_cast<mpfr_ptr>(low_)) && !(inexact == 0 && mpfr_inf_p(static_cast<mpfr_ptr>(low_)));
  }
  bool isDefined() const { return defined_; }
  bool isIn(const Interval& x) {
    return !isEmpty(x) && mpfr_cmp_d(low_, x.lower()) >= 0 && mpfr_cmp_d(high_, x.upper()) <= 0;
  }
  double down() { return mpfr_get_d(low_, MPFR_RNDD); }
  double up() { return mpfr_get_d(high_, MPFR_RNDU); }
  Interval tightest() { return defined_ ? Interval(down(), up()) : Interval::empty(); }

 private:
  Mpfr low_, high_;
  bool defined_;
};

using ExactOfOne = std::function<int(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t)>;
using ExactOfTwo = std::function<int(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t)>;
using OnIntervals = std::function<Interval(const Interval&)>;
using OnTwoIntervals = std::function<Interval(const Interval&, const Interval&)>;

class Judge {
 public:
  /// `expected`: what the enclosure must be, where known.
  template <class... Arguments>
  void judge(const Interval& enclosure, Exact& value, const std::optional<Interval>& expected,
             const Arguments&... arguments) {
    ++outcome_.cases;
    outcome_.undefined += !value.isDefined();
    const bool outside = value.isDefined() && !value.isIn(enclosure);
    const bool loose = expected && !isEqual(*expected, enclosure);
    outcome_.outside += outside;
    outcome_.loose += loose;
    if (!(outside || loose) || !outcome_.first.empty()) return;
    std::ostringstream text;
    text << std::hexfloat << (outside ? "outside:" : "loose:");
    ((text << " [" << arguments.lower() << ", " << arguments.upper() << "]"), ...);
    text << " -> [" << enclosure.lower() << ", " << enclosure.upper() << "], value in [" << value.down() << ", "
         << value.up() << "]";
    outcome_.first = text.str();
  }
  const ContainmentOutcome& outcome() const { return outcome_; }

 private:
  ContainmentOutcome outcome_;
};

// ---- Functions of one argument --------------------------------------------------------------------------------------

enum class Shape { rising, falling, even, sine, cosine, tangent, other };

struct OfOneArgument {
  std::string name;
  OnIntervals of;
  ExactOfOne exact;
  Shape shape;
  std::vector<Range> ranges;
};

/// floor(2 x / pi - offset) / 4, rounded down: how many times x has passed offset pi / 2 modulo 2 pi. The quotient has
/// at most 1024 bits before the point and comes no closer to an integer than 2^-62 of itself (for x = 0 it is one), so
/// 1400 bits decide.
class Passages {
 public:
  Passages(double x, unsigned long offset) {
    thread_local Mpfr pi(0, 1500), quotient(0, 1400);
    mpfr_const_pi(pi, MPFR_RNDN);  // kept by MPFR
    mpfr_set_d(quotient, x, MPFR_RNDN);
    mpfr_mul_2ui(quotient, quotient, 1, MPFR_RNDN);
    mpfr_div(quotient, quotient, pi, MPFR_RNDN);
    mpz_init(count_);
    mpfr_get_z(count_, quotient, MPFR_RNDD);
    mpz_sub_ui(count_, count_, offset);
    mpz_fdiv_q_ui(count_, count_, 4);
  }
  ~Passages() { mpz_clear(count_); }
  Passages(const Passages&) = delete;
  Passages& operator=(const Passages&) = delete;
  bool operator==(const Passages& other) const { return mpz_cmp(count_, other.count_) == 0; }

 private:
  mpz_t count_;
};

/// (offset + 4 k) pi / 2 lies between the endpoints of x for an integer k.
bool passes(const Interval& x, unsigned long offset) {
  return !isBounded(x) || !(Passages(x.lower(), offset) == Passages(x.upper(), offset));
}

/// The range of sin, cos or tan over an x that is not thin, by its values at the endpoints and what x passes.
Interval periodicRange(const ExactOfOne& f, const Interval& x, Shape shape) {
  const bool tangent = shape == Shape::tangent;
  const unsigned long top = shape == Shape::cosine ? 0 : 1;
  const bool maximum = passes(x, top), minimum = passes(x, top + 2);
  if (tangent && (maximum || minimum)) return Interval::entire();
  if (maximum && minimum) return {-1, 1};
  Exact a(f, x.lower()), b(f, x.upper());
  return {minimum ? -1 : std::min(a.down(), b.down()), maximum ? 1 : std::max(a.up(), b.up())};
}

/// What the enclosure must be, given the value at a point of x; nothing where one value does not tell.
std::optional<Interval> expectedFrom(Exact& value, const Interval& x, double point, Shape shape,
                                     const Interval& enclosure) {
  if (isThin(x)) return value.tightest();
  if (!value.isDefined() || isEmpty(enclosure)) return {};
  const bool lowest = shape == Shape::rising    ? point == x.lower()
                      : shape == Shape::falling ? point == x.upper()
                                                : shape == Shape::even && std::abs(point) == mignitude(x);
  const bool highest = shape == Shape::rising    ? point == x.upper()
                       : shape == Shape::falling ? point == x.lower()
                                                 : shape == Shape::even && std::abs(point) == magnitude(x);
  return Interval(lowest ? value.down() : enclosure.lower(), highest ? value.up() : enclosure.upper());
}

ContainmentOutcome run(const OfOneArgument& f, const Range& range, long cases, std::uint64_t seed) {
  RandomDoubles random(seed);
  Judge judge;
  for (long i = 0; i < cases; ++i) {
    const Interval x = drawInterval(random, range);
    const double point = drawElement(random, x);
    const Interval enclosure = f.of(x);
    Exact value(f.exact, point);
    const bool periodic = f.shape == Shape::sine || f.shape == Shape::cosine || f.shape == Shape::tangent;
    judge.judge(
        enclosure, value,
        periodic && !isThin(x) ? periodicRange(f.exact, x, f.shape) : expectedFrom(value, x, point, f.shape, enclosure),
        x);
  }
  return judge.outcome();
}

int signExact(mpfr_ptr result, mpfr_srcptr x, mpfr_rnd_t direction) {
  return mpfr_set_si(result, mpfr_sgn(x), direction);
}
int absExact(mpfr_ptr result, mpfr_srcptr x, mpfr_rnd_t direction) { return mpfr_abs(result, x, direction); }

/// x^n and the n-th root, for one n.
OfOneArgument integerPower(int n) {
  return {"pow " + std::to_string(n),
          [n](const Interval& x) { return pow(x, n); },
          [n](mpfr_ptr result, mpfr_srcptr x, mpfr_rnd_t direction) { return mpfr_pow_si(result, x, n, direction); },
          n < 0        ? Shape::other
          : n % 2 == 0 ? Shape::even
                       : Shape::rising,
          {uniformly(-3, 3), everywhere, subnormal, huge, near({0, 1, -1})}};
}
OfOneArgument root(int n) {
  return {"rootn " + std::to_string(n),
          [n](const Interval& x) { return rootn(x, n); },
          [n](mpfr_ptr result, mpfr_srcptr x, mpfr_rnd_t direction) {
            return mpfr_rootn_ui(result, x, static_cast<unsigned long>(n), direction);
          },
          Shape::rising,
          {uniformly(-9, 99), everywhere, subnormal, near({0, 1, 64})}};
}

Interval sineOfBoth(const Interval& x) { return sinCos(x).sin; }
Interval cosineOfBoth(const Interval& x) { return sinCos(x).cos; }

std::vector<OfOneArgument> functionsOfOneArgument() {
  using enum Shape;
  const std::vector<Range> turns{uniformly(-10, 10), everywhere, subnormal, huge, quarterTurns, closestQuarterTurns};
  const std::vector<Range> steps{uniformly(-9, 9), everywhere, near({0, 0.5, 1.5, -2.5, 3, 0x1p51, 0x1p52, 0x1p53})};
  const std::vector<Range> logarithms{uniformly(-1, 10), everywhere, subnormal, huge, near({0, 1, 2, 10, 1e22})};
  const std::vector<Range> unit{uniformly(-1.5, 1.5), everywhere, subnormal, near({-1, -0.5, 0, 0.5, 1})};
  const std::vector<Range> line{uniformly(-9, 9), everywhere, subnormal, huge, near({-1, 0, 1, 19, 22})};
  const std::vector<Range> growing{uniformly(-20, 20), everywhere, subnormal, uniformly(700, 720),
                                   near({-745.2, -708.4, -37.5, 0, 709.8, 710.5})};
  return {
      {"sqr",
       static_cast<Interval (*)(const Interval&)>(sqr),
       mpfr_sqr,
       even,
       {uniformly(-5, 5), everywhere, subnormal, halfWay, near({0, 1})}},
      {"sqrt", sqrt, mpfr_sqrt, rising, {uniformly(-1, 9), everywhere, subnormal, huge, near({0, 1, 4})}},
      {"cbrt", cbrt, mpfr_cbrt, rising, {uniformly(-9, 9), everywhere, subnormal, huge, near({0, 1, -8})}},
      {"abs", abs, absExact, even, {uniformly(-3, 3), everywhere, subnormal, huge}},
      {"exp", exp, mpfr_exp, rising, growing},
      {"exp2",
       exp2,
       mpfr_exp2,
       rising,
       {uniformly(-20, 20), everywhere, subnormal, uniformly(1020, 1028), near({-1075, -1074, -1022, 0, 1, 1024})}},
      {"exp10",
       exp10,
       mpfr_exp10,
       rising,
       {uniformly(-20, 20), everywhere, subnormal, uniformly(305, 310), near({-323.4, -307.7, 0, 1, 22, 308.25})}},
      {"expm1", expm1, mpfr_expm1, rising, growing},
      {"log", log, mpfr_log, rising, logarithms},
      {"log2", log2, mpfr_log2, rising, logarithms},
      {"log10", log10, mpfr_log10, rising, logarithms},
      {"log1p", log1p, mpfr_log1p, rising, {uniformly(-1.5, 9), everywhere, subnormal, huge, near({-1, 0, 1})}},
      {"sin", sin, mpfr_sin, sine, turns},
      {"cos", cos, mpfr_cos, cosine, turns},
      {"sinCos.sin", sineOfBoth, mpfr_sin, sine, turns},
      {"sinCos.cos", cosineOfBoth, mpfr_cos, cosine, turns},
      {"tan", tan, mpfr_tan, tangent, turns},
      {"asin", asin, mpfr_asin, rising, unit},
      {"acos", acos, mpfr_acos, falling, unit},
      {"atan", atan, mpfr_atan, rising, line},
      {"sinh", sinh, mpfr_sinh, rising, growing},
      {"cosh", cosh, mpfr_cosh, even, growing},
      {"tanh", tanh, mpfr_tanh, rising, line},
      {"asinh", asinh, mpfr_asinh, rising, line},
      {"acosh", acosh, mpfr_acosh, rising, {uniformly(0, 9), everywhere, huge, near({1})}},
      {"atanh", atanh, mpfr_atanh, rising, unit},
      {"sign", sign, signExact, rising, steps},
      {"floor", floor, mpfr_rint_floor, rising, steps},
      {"ceil", ceil, mpfr_rint_ceil, rising, steps},
      {"trunc", trunc, mpfr_rint_trunc, rising, steps},
      {"round", round, mpfr_rint_round, rising, steps},
      {"roundEven", roundEven, mpfr_rint_roundeven, rising, steps},
      integerPower(-3),
      integerPower(-2),
      integerPower(3),
      integerPower(4),
      integerPower(11),
      root(2),
      root(3),
      root(6),
  };
}

// ---- Functions of two arguments -------------------------------------------------------------------------------------

struct OfTwoArguments {
  std::string name;
  OnTwoIntervals of;
  ExactOfTwo exact;
  /// Over a rectangle on which it is defined the function takes its extremes at corners.
  bool extremesAtCorners;
  std::vector<std::pair<Range, Range>> ranges;
};

/// What the enclosure must be, from the values at the four corners; nothing if one of them is undefined.
std::optional<Interval> expectedFromCorners(const ExactOfTwo& exact, const Interval& x, const Interval& y) {
  double lower = infinity, upper = -infinity;
  for (const double a : {x.lower(), x.upper()}) {
    for (const double b : {y.lower(), y.upper()}) {
      Exact corner(exact, a, b);
      if (!corner.isDefined()) return {};
      lower = std::min(lower, corner.down());
      upper = std::max(upper, corner.up());
    }
  }
  return Interval(lower, upper);
}

ContainmentOutcome run(const OfTwoArguments& f, const std::pair<Range, Range>& range, long cases, std::uint64_t seed) {
  RandomDoubles random(seed);
  Judge judge;
  for (long i = 0; i < cases; ++i) {
    const Interval x = drawInterval(random, range.first), y = drawInterval(random, range.second);
    const double a = drawElement(random, x), b = drawElement(random, y);
    const Interval enclosure = f.of(x, y);
    Exact value(f.exact, a, b);
    std::optional<Interval> expected;
    if (isThin(x) && isThin(y)) {
      expected = value.tightest();
    } else if (f.extremesAtCorners && i % 4 == 0 && isBounded(x) && isBounded(y)) {
      expected = expectedFromCorners(f.exact, x, y);
    }
    judge.judge(enclosure, value, expected, x, y);
  }
  return judge.outcome();
}

int undefined(mpfr_ptr result) {
  mpfr_set_nan(result);
  return 0;
}
/// Nothing at x / 0, at atan2(0, 0), and at negative numbers' and zero's powers, where MPFR has conventions.
int quotientExact(mpfr_ptr result, mpfr_srcptr x, mpfr_srcptr y, mpfr_rnd_t direction) {
  return mpfr_zero_p(y) ? undefined(result) : mpfr_div(result, x, y, direction);
}
int angleExact(mpfr_ptr result, mpfr_srcptr y, mpfr_srcptr x, mpfr_rnd_t direction) {
  return mpfr_zero_p(y) && mpfr_zero_p(x) ? undefined(result) : mpfr_atan2(result, y, x, direction);
}
int powerExact(mpfr_ptr result, mpfr_srcptr x, mpfr_srcptr y, mpfr_rnd_t direction) {
  const bool inDomain = mpfr_sgn(x) > 0 || (mpfr_zero_p(x) && mpfr_sgn(y) > 0);
  return inDomain ? mpfr_pow(result, x, y, direction) : undefined(result);
}

Interval sum(const Interval& x, const Interval& y) { return x + y; }
Interval difference(const Interval& x, const Interval& y) { return x - y; }
Interval product(const Interval& x, const Interval& y) { return x * y; }
/// Where zero lies in y the extremes are not at the corners; corners are then never all defined, or surround a pole.
Interval quotient(const Interval& x, const Interval& y) { return x / y; }

std::vector<OfTwoArguments> functionsOfTwoArguments() {
  const Range few = uniformly(-8, 8), axes = near({0, 1, -1});
  const std::vector<std::pair<Range, Range>> ranges{{few, few},   {everywhere, everywhere}, {subnormal, subnormal},
                                                    {huge, huge}, {halfWay, halfWay},       {axes, axes}};
  const std::vector<std::pair<Range, Range>> powers{{uniformly(0, 4), few},
                                                    {everywhere, everywhere},
                                                    {near({0, 1}), huge},
                                                    {subnormal, uniformly(-2, 2)},
                                                    {uniformly(0, 4), uniformly(-1100, 1100)},
                                                    {axes, axes}};
  return {
      {"+", sum, mpfr_add, true, ranges},
      {"-", difference, mpfr_sub, true, ranges},
      {"*", product, mpfr_mul, true, ranges},
      {"/", quotient, quotientExact, false, ranges},
      {"min", [](const Interval& x, const Interval& y) { return min(x, y); }, mpfr_min, true, ranges},
      {"max", [](const Interval& x, const Interval& y) { return max(x, y); }, mpfr_max, true, ranges},
      {"hypot", hypot, mpfr_hypot, false, ranges},
      {"atan2", atan2, angleExact, false, ranges},
      {"pow", [](const Interval& x, const Interval& y) { return pow(x, y); }, powerExact, true, powers},
  };
}

}  // namespace

const std::vector<ContainmentTrial>& containmentTrials() {
  static const std::vector<ContainmentTrial> all = [] {
    std::vector<ContainmentTrial> trials;
    for (const OfOneArgument& f : functionsOfOneArgument())
      for (const Range& range : f.ranges)
        trials.push_back(
            {f.name, range.name, [f, range](long n, std::uint64_t seed) { return run(f, range, n, seed); }});
    for (const OfTwoArguments& f : functionsOfTwoArguments())
      for (const auto& range : f.ranges)
        trials.push_back({f.name, range.first.name + " x " + range.second.name,
                          [f, range](long n, std::uint64_t seed) { return run(f, range, n, seed); }});
    return trials;
  }();
  return all;
}

}  // namespace gamut::testing
