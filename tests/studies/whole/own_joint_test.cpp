// A joint of one's own, in a file of its own, in a study: nothing else of Gamut knows of it, and all serves it.
#include <gmock/gmock.h>

#include "mechanics/model.hpp"
#include "mechanics/skeleton.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "studies/running/run.hpp"
#include "studies/study.hpp"
#include "tests/mechanics/toy/parallel_cranks.hpp"

namespace gamut {
namespace {

Study swing() {
  std::vector<Described> types = elementTypes();
  types.emplace_back(testing::ParallelCranks{});
  return readStudyText(R"(
    [study]
    title = "A swing boat"
    analysis = "dynamics"
    horizon = 1.0
    output_step = 0.5
    [mechanism]
    gravity = [0, 0, -9.81]
    [[mechanism.element]]
    type = "parallel-cranks"
    name = "cranks"
    from = "inertial"
    to = "boat"
    length = 2.0
    initial = { angle = "60 deg" }
    [[mechanism.element]]
    type = "mass"
    name = "body"
    at = "boat"
    mass = 100
    centre = [0, 0.5, -0.25]
    inertia = [20, 30, 40]
    [[uncertain]]
    quantity = "cranks.length"
    interval = "± 1 %"
    [[output]]
    quantity = "cranks.angle"
    [[output]]
    quantity = "body.position.z"
    [stochastic]
    samples = 64
  )",
                       "swing", types);
}

/// Whatever body the cranks carry, they move as a pendulum of their length does: l β̈ = −g sin β.
TEST(OwnJointInAStudy, MovesAsItsEquationSays) {
  const Study study = swing();
  Evaluator<double> motion(recordMotion(study.mechanism));
  for (const double angle : {-1.2, 0.3, 1.0}) {
    const std::vector<double> rates = motion(0, {angle, 0.7});
    EXPECT_EQ(rates[0], 0.7);
    EXPECT_NEAR(rates[1], -9.81 / 2 * std::sin(angle), 1e-12);
  }
}

TEST(OwnJointInAStudy, IsEnclosedAndSampled) {
  const Results results = run(swing());
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
}

TEST(OwnJointInAStudy, IsSeen) {
  const Skeleton skeleton = skeletonOf(swing().mechanism);
  ASSERT_EQ(skeleton.parts.size(), 2U);
  EXPECT_EQ(skeleton.parts[0].type, "parallel-cranks");
  EXPECT_EQ(skeleton.parts[0].kind, Skeleton::Kind::joint);
  EXPECT_EQ(skeleton.parts[0].turns, 1);
}

}  // namespace
}  // namespace gamut
