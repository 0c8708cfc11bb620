// A distribution and a membership function of one's own: all that there is of each stands here.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "analyses/family.hpp"
#include "reports/summary.hpp"
#include "scalars/membership_lines.hpp"
#include "studies/running/run.hpp"
#include "tests/studies/sample_study.hpp"

namespace gamut {
namespace {

using ::testing::HasSubstr;

/// P(v) = w^exponent, w running from 0 to 1 over the support. Its density is w^-1 exp(exponent log w), but for a
/// factor: it rises with the exponent.
class PowerLaw final : public Family {
 public:
  std::string_view name() const override { return "power"; }
  std::string_view summary() const override { return "P(v) = w^exponent, w running from 0 to 1 over the support"; }
  void describe(ShapeFields& f) override {
    f.support(on);
    f.parameter({.key = "exponent", .meaning = "1 or more", .isOfQuantity = false}, Trend::rises, exponent);
  }
  double quantile(double u) const override {
    const double value = on.lower() + std::pow(u, 1 / midpoint(exponent)) * (on.upper() - on.lower());
    return std::clamp(value, on.lower(), on.upper());
  }
  bool isMonotone(const Interval& /*values*/) const override { return true; }

  Interval exponent{1.0};

 protected:
  std::unique_ptr<Family> copy() const override { return std::make_unique<PowerLaw>(*this); }
  void check() const override {
    requireShape(exponent.lower() >= 1, "the exponent is below 1, at " + shownNumber(exponent));
  }
  Interval enclosed(const Interval& v) const override {
    const Interval share = intersection((v - Interval(on.lower())) / span(), Interval(0.0, 1.0));
    return intersection(pow(share, exponent), Interval(0.0, 1.0));
  }
  Interval densest() const override { return exponent / span(); }

 private:
  Interval span() const { return Interval(on.upper()) - Interval(on.lower()); }
};

/// 1 - |v - summit| / reach, raised to 0.
class TentMembership final : public MembershipLines {
 public:
  std::string_view name() const override { return "tent"; }
  std::string_view summary() const override { return "falls by 1 over the reach to both sides"; }
  void describe(ShapeFields& f) override {
    f.number({.key = "summit", .meaning = "where it is 1", .isNominal = true}, summit);
    f.number({.key = "reach", .meaning = "to either side", .isPositive = true}, reach);
  }
  void settle() override { points_ = trapezoid({summit - reach, summit + reach}, summit); }
  std::unique_ptr<MembershipLaw> copy() const override { return std::make_unique<TentMembership>(*this); }

  double summit = 0, reach = 0;
};

ShapeTypes withOwn() {
  ShapeTypes types;
  types.distributions.push_back([]() -> std::unique_ptr<DistributionLaw> { return std::make_unique<PowerLaw>(); });
  types.memberships.push_back([]() -> std::unique_ptr<MembershipLaw> { return std::make_unique<TentMembership>(); });
  return types;
}

Study ownStudy(const std::string& distribution, const std::string& membership) {
  std::string text = sampleStudyWith("distribution = { type = \"uniform\" }", "distribution = " + distribution);
  const std::string old = "membership = { type = \"triangular\" }";
  text.replace(text.find(old), old.size(), "membership = " + membership);
  text.replace(text.find("[stochastic]"), std::string::npos,
               "[distribution]\ntimes = 2\n[stochastic]\nsamples = 4096\nplan = \"random\"\nseed = 7\n");
  return readStudyText(text, "s.toml", elementTypes(), {}, withOwn());
}

std::string refusalOfOwn(const std::string& distribution, const std::string& membership) {
  try {
    ownStudy(distribution, membership);
  } catch (const StudyError& error) {
    return error.what();
  }
  return "it was read";
}

constexpr const char *ownPower = "{ type = \"power\", exponent = 3 }",
                     *ownTent = "{ type = \"tent\", reach = \"0.2 deg\" }";

TEST(OwnShapes, AreSampledBoundedAndCut) {
  const Results results = run(ownStudy(ownPower, ownTent));
  EXPECT_EQ(results.stopped, "");
  const UncertainInfo& quantity = results.uncertain.front();
  EXPECT_EQ(quantity.distribution, "power");
  EXPECT_EQ(quantity.membership, "tent");
  EXPECT_EQ(shapeText(results, quantity, ShapeKind::distribution), "power (exponent 3)");
  EXPECT_THAT(shapeText(results, quantity, ShapeKind::membership), HasSubstr("tent (on "));
  ASSERT_TRUE(results.distribution.present);
  EXPECT_EQ(results.distribution.why, "");
  for (const double excess : results.distribution.excess.data) EXPECT_LE(excess, results.distribution.band);
  EXPECT_FALSE(results.fuzzy.outer.empty());
}

TEST(OwnShapes, HaveBoundsOfAllThatTheirParametersAllow) {
  const Uncertain quantity = ownStudy("{ type = \"power\", exponent = [1, 3] }", ownTent).uncertain.front().uncertain;
  const Distribution& distribution = quantity.distribution;
  EXPECT_FALSE(distribution.isPrecise());
  const Interval bound = distribution.enclosedBelow(midpoint(distribution.support()));
  EXPECT_NEAR(bound.lower(), 0.125, 1e-9);
  EXPECT_NEAR(bound.upper(), 0.5, 1e-9);
  EXPECT_TRUE(contains(bound, 0.25));
}

TEST(OwnShapes, AreRefusedLikeOthers) {
  EXPECT_EQ(refusalOfOwn("{ type = \"power\", exponnt = 3 }", ownTent),
            "s.toml:32:34: unknown key 'exponnt' in [uncertain.distribution]; expected 'exponent'? (one of: type, "
            "support, exponent)");
  EXPECT_EQ(
      refusalOfOwn("{ type = \"power\" }", ownTent),
      "s.toml:32:16: 'uncertain.distribution.exponent' is missing; expected a number without unit, or an interval of "
      "such numbers");
  EXPECT_EQ(refusalOfOwn("{ type = \"power\", exponent = 0.5 }", ownTent),
            "s.toml:32:16: the exponent is below 1, at 0.5; expected a distribution inside the interval");
  EXPECT_EQ(refusalOfOwn(ownPower, "{ type = \"tent\", reach = -1 }"),
            "s.toml:33:39: uncertain.membership.reach is not positive; expected a reach above 0");
  EXPECT_THAT(refusalOfOwn("{ type = \"pover\" }", ownTent), HasSubstr("expected 'power'?"));
  EXPECT_THAT(refusalOfOwn(ownPower, "{ type = \"tent\", reach = 1 }"),
              HasSubstr("the membership function reaches beyond its interval"));
}

}  // namespace
}  // namespace gamut
