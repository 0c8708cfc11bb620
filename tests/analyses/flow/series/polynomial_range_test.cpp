// Ranges of polynomials: they hold every value (128 bits, no tolerance) and are hardly wider than what sampling finds.
#include "analyses/flow/series/polynomial_range.hpp"

#include <gtest/gtest.h>

#include "tests/analyses/reference.hpp"

namespace gamut::testing {
namespace {

struct Polynomial {
  std::shared_ptr<const Monomials> monomials;
  std::vector<double> c;

  Polynomial(const std::vector<int>& weights, int degree, double decay, Points& points)
      : monomials(std::make_shared<const Monomials>(weights, degree)) {
    for (int g = 0; g < monomials->count(); ++g)
      c.push_back(points.integer(0, 4) == 0 ? 0.0 : points.uniform(-1, 1) * std::pow(decay, monomials->grade(g)));
  }
  template <class S>
  S value(const std::vector<S>& xi) const {
    S sum(0.0);
    for (int g = 0; g < monomials->count(); ++g) {
      S term(c[at(g)]);
      for (int l = 0; l < monomials->symbols(); ++l)
        for (int i = 0; i < monomials->exponent(g, l); ++i) term *= xi[at(l)];
      sum += term;
    }
    return sum;
  }
};

Box randomBox(int symbols, Points& points) {
  Box box;
  for (int l = 0; l < symbols; ++l) {
    const double a = points.signedUnit(), b = points.signedUnit();
    switch (points.integer(0, 3)) {
      case 0:
        box.push_back(Interval(-1, 1));
        break;
      case 1:
        box.push_back(Interval(a));
        break;
      case 2:
        box.push_back(Interval(a, std::min(1.0, std::nextafter(a, 2.0))));
        break;
      default:
        box.push_back(Interval(std::min(a, b), std::max(a, b)));
    }
  }
  return box;
}

TEST(PolynomialRange, HoldsEveryValueOverBoxesAndSubBoxes) {
  Points points(31);
  for (int round = 0; round < 400; ++round) {
    const int symbols = points.integer(0, 4);
    std::vector<int> weights;
    for (int l = 0; l < symbols; ++l) weights.push_back(points.integer(1, 2));
    const Polynomial p(weights, symbols == 0 ? 0 : points.integer(1, symbols < 3 ? 8 : 4), points.uniform(0.1, 1.5),
                       points);
    PolynomialRange range(p.monomials);
    const Box box = round % 3 == 0 ? Box(at(symbols), Interval(-1, 1)) : randomBox(symbols, points);
    const Interval enclosure = range(p.c.data(), box, std::pow(10.0, -points.integer(1, 9)));
    for (int sample = 0; sample < 30; ++sample)
      ASSERT_THAT(enclosure, Encloses(p.value(sample < 15 ? points.corner(box) : points.inside(box))));
  }
}

TEST(PolynomialRange, HoldsTheValuesWhereThePolynomialIsGreatest) {
  Points points(32);
  for (int round = 0; round < 150; ++round) {  // one symbol: the extremes by a fine grid, refined in 128 bits
    const Polynomial p({1}, points.integer(2, 12), 1.0, points);
    PolynomialRange range(p.monomials);
    const Interval enclosure = range(p.c.data(), {Interval(-1, 1)}, 1e-12);
    for (const double sign : {1.0, -1.0}) {
      double best = 0, most = -1e300;
      for (int i = -500; i <= 500; ++i)
        if (const double y = sign * p.value(std::vector<double>{i / 500.0}); y > most) most = y, best = i / 500.0;
      Precise low = std::max(-1.0, best - 0.002), high = std::min(1.0, best + 0.002);
      for (int i = 0; i < 120; ++i) {  // golden section in all but name: thirds
        const Precise a = low + (high - low) / 3, b = high - (high - low) / 3;
        (sign * p.value(Vector{a}) < sign * p.value(Vector{b}) ? low : high) =
            sign * p.value(Vector{a}) < sign * p.value(Vector{b}) ? a : b;
      }
      ASSERT_THAT(enclosure, Encloses(p.value(Vector{low})));
    }
  }
}

TEST(PolynomialRange, TellsWhereThePolynomialIsLeastAndGreatest) {
  Points points(34);
  for (int round = 0; round < 200; ++round) {
    const int symbols = points.integer(1, 4);
    const Polynomial p(std::vector<int>(at(symbols), 1), symbols < 3 ? 6 : 4, points.uniform(0.1, 1.0), points);
    PolynomialRange range(p.monomials);
    const Box box = round % 2 == 0 ? Box(at(symbols), Interval(-1, 1)) : randomBox(symbols, points);
    const Interval enclosure = range(p.c.data(), box, 1e-6);
    for (const PolynomialRange::Extreme* extreme : {&range.least(), &range.greatest()}) {
      for (int l = 0; l < symbols; ++l) {
        EXPECT_GE(extreme->xi[at(l)], box[at(l)].lower() - 1e-12);
        EXPECT_LE(extreme->xi[at(l)], box[at(l)].upper() + 1e-12);
      }
      EXPECT_NEAR(p.value(extreme->xi), extreme->value, 1e-11);
    }
    EXPECT_LE(range.least().value - enclosure.lower(), range.gap() + 1e-12);
    EXPECT_LE(enclosure.upper() - range.greatest().value, range.gap() + 1e-12);
    EXPECT_LE(range.gap(), 1e-5 * width(enclosure) + 1e-9);
  }
}

TEST(PolynomialRange, IsHardlyWiderThanSampling) {
  Points points(33);
  for (int symbols = 1; symbols <= 4; ++symbols)
    for (int round = 0; round < 12; ++round) {
      const Polynomial p(std::vector<int>(at(symbols), 1), symbols < 3 ? 6 : 4, 0.4, points);
      PolynomialRange range(p.monomials);
      const Box box(at(symbols), round % 2 == 0 ? Interval(-1, 1) : Interval(-0.25, 0.75));
      const Interval enclosure = range(p.c.data(), box);
      const int across[] = {0, 4000, 80, 22, 13};
      double lower = 1e300, upper = -1e300;
      std::vector<int> index(at(symbols), 0);
      for (bool more = true; more;) {
        std::vector<double> xi;
        for (int l = 0; l < symbols; ++l)
          xi.push_back(box[at(l)].lower() + (box[at(l)].upper() - box[at(l)].lower()) * index[at(l)] / across[symbols]);
        const double y = p.value(xi);
        lower = std::min(lower, y);
        upper = std::max(upper, y);
        more = false;
        for (int l = 0; l < symbols && !more; ++l) {
          more = index[at(l)] < across[symbols];
          index[at(l)] = more ? index[at(l)] + 1 : 0;
        }
      }
      const double samplingMiss[] = {0, 1e-4, 0.003, 0.01, 0.03};  // of the grid itself, and of the bisections allowed
      EXPECT_LE(width(enclosure), (upper - lower) * (1.001 + samplingMiss[symbols]))
          << symbols << " symbols, round " << round;
    }
}

TEST(PolynomialRange, OfNothingIsNothing) {
  const auto monomials = std::make_shared<const Monomials>(std::vector<int>{1, 1}, 3);
  const std::vector<double> none(static_cast<std::size_t>(monomials->count()), 0.0);
  PolynomialRange range(monomials);
  for (const Interval& part : {Interval(-1, 1), Interval(-0.25, 0.75)})
    EXPECT_TRUE(isEqual(range(none.data(), {part, Interval(-1, 1)}), Interval(0.0)));
}

TEST(PolynomialRange, OfAConstantOrALinearPolynomialIsExact) {
  const auto constant = std::make_shared<const Monomials>(std::vector<int>{}, 0);
  const double c = 0.1;
  EXPECT_TRUE(isEqual(PolynomialRange(constant)(&c, {}), Interval(0.1)));
  const auto linear = std::make_shared<const Monomials>(std::vector<int>{1, 1}, 1);
  const double plane[] = {1.0, 0.5, 0.25};
  const Interval range = PolynomialRange(linear)(plane, {Interval(-1, 1), Interval(-1, 1)});
  EXPECT_LE(width(range), 1.5 + 1e-14);
  EXPECT_TRUE(isSubset(Interval(0.25, 1.75), range));
}

TEST(PolynomialRange, OfWhatIsNotFiniteIsTheWholeLine) {
  const auto monomials = std::make_shared<const Monomials>(std::vector<int>{1}, 2);
  PolynomialRange range(monomials);
  for (double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    const double c[] = {1.0, bad, 0.0};
    EXPECT_TRUE(isEntire(range(c, {Interval(-1, 1)})));
    EXPECT_TRUE(isEntire(range(c, {Interval(0, 0.5)})));
  }
}

TEST(PolynomialRange, SubstitutionKeepsThePolynomialUpToItsStatedError) {
  Points points(34);
  for (int round = 0; round < 200; ++round) {
    const int symbols = points.integer(1, 3), symbol = points.integer(0, symbols - 1);
    const Polynomial p(std::vector<int>(at(symbols), 1), points.integer(1, 6), 1.0, points);
    const PolynomialRange range(p.monomials);
    const double middle = points.uniform(-0.7, 0.7), half = points.uniform(0, 1 - std::fabs(middle));
    Polynomial moved = p;
    range.substitute(symbol, middle, half, p.c.data(), moved.c.data());
    double norm = 0;
    for (double value : p.c) norm += std::fabs(value);
    for (int sample = 0; sample < 4; ++sample) {
      Vector eta, xi;
      for (int l = 0; l < symbols; ++l) eta.push_back(Precise(points.signedUnit()));
      xi = eta;
      xi[at(symbol)] = Precise(middle) + Precise(half) * eta[at(symbol)];
      ASSERT_LE(Precise(abs(p.value(xi) - moved.value(eta))), Precise(range.shiftError()) * norm);
    }
  }
}

}  // namespace
}  // namespace gamut::testing
