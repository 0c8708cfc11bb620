// Images of boxes that are bisected.
#include "analyses/flow/image.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "analyses/flow/flow.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "tests/analyses/reference.hpp"

namespace gamut::testing {
namespace {

Program ishigami() {
  return record(3, 0, 1, [](auto, const auto& x, const auto&, auto& y) {
    y[0] = sin(x[0]) + 7.0 * sqr(sin(x[1])) + 0.1 * sqr(sqr(x[2])) * sin(x[0]);
  });
}

TEST(Image, IsBisectedUntilItIsKnown) {
  const Box box(3, Interval(-std::numbers::pi, std::numbers::pi)), inner(3, Interval(-1.0, 1.0));
  const Image image = findImage(ishigami(), 0, box, {inner}, {0}, -1, nullptr);
  EXPECT_GT(image.parts, 1U);
  const double greatest = 1 + 7 + 0.1 * std::pow(std::numbers::pi, 4), least = -1 - 0.1 * std::pow(std::numbers::pi, 4);
  EXPECT_GE(image.ranges[0][0].upper(), greatest - 1e-9);
  EXPECT_LE(image.ranges[0][0].upper(), greatest + 0.05);
  EXPECT_LE(image.ranges[0][0].lower(), least + 1e-9);
  EXPECT_GE(image.ranges[0][0].lower(), least - 0.05);
  const double atOne = 1.1 * std::sin(1.0) + 7 * std::sin(1.0) * std::sin(1.0);
  EXPECT_GE(image.ranges[1][0].upper(), atOne);
  EXPECT_LE(image.ranges[1][0].upper(), atOne + 0.1);
  double volume = 0, unknown = 0;
  for (const auto& snapshot : image.models->at[0]) {
    double own = 1;
    for (const double half : snapshot->part.half) own *= half;
    volume += own;
    unknown += own * 2 * snapshot->outputs[0].radius;
  }
  EXPECT_EQ(volume, 1);
  EXPECT_LT(unknown, 1e-3 * (greatest - least));
}

/// Whatever the function bends or breaks like, and whatever is bisected.
TEST(Image, HoldsWhatIsAtEveryPoint) {
  const Program g = record(3, 0, 6, [](auto, const auto& x, const auto&, auto& y) {
    y[0] = sin(3.0 * x[0]) * x[1] + x[2];
    y[1] = abs(x[0] - 0.3 * x[1]) + x[2];
    y[2] = sqrt(x[2] + 1.001);
    y[3] = 1.0 / (1.1 + x[0] * x[1]);
    y[4] = exp(2.0 * x[0]) * sin(5.0 * x[2]);
    y[5] = x[0] + 1e-12 * x[1];
  });
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> any(-1, 1);
  for (const double scale : {1.0, 0.01}) {
    const Box box(3, Interval(-scale, scale)), inner(3, Interval(-0.3 * scale, 0.2 * scale));
    const Image image = findImage(g, 0, box, {inner}, {0, 1, 2, 3, 4, 5}, -1, nullptr);
    const FlowModels& models = *image.models;
    Evaluator<Interval> evaluator(g);
    std::vector<Interval> x(3), y(6);
    for (int i = 0; i < 20000; ++i) {
      for (Interval& value : x) value = Interval(scale * any(random));
      evaluator(Interval(0.0), x, y);
      bool isInner = true;
      for (const Interval& value : x) isInner = isInner && isSubset(value, inner[0]);
      int holding = 0;
      for (const auto& snapshot : models.at[0]) {
        std::vector<Interval> eta;
        for (std::size_t l = 0; l < 3; ++l)
          eta.push_back((x[l] / Interval(scale) - Interval(snapshot->part.centre[l])) / snapshot->part.half[l]);
        bool isHere = true;
        for (const Interval& e : eta) isHere = isHere && isSubset(e, Interval(-1.0, 1.0));
        if (!isHere) continue;
        ++holding;
        for (std::size_t o = 0; o < 6; ++o) {
          const OutputModel& model = snapshot->outputs[o];
          EXPECT_FALSE(isEmpty(intersection(model.bound, y[o])));
          if (model.c.empty()) continue;
          Interval sum(0.0);
          for (std::size_t m = 0; m < model.c.size(); ++m) {
            Interval term(model.c[m]);
            for (int l = 0; l < 3; ++l)
              for (int n = snapshot->monomials->exponent(static_cast<int>(m), l); n > 0; --n)
                term = term * eta[static_cast<std::size_t>(l)];
            sum = sum + term;
          }
          EXPECT_FALSE(isEmpty(intersection(sum + Interval(-model.radius, model.radius), y[o]))) << o;
        }
      }
      EXPECT_LE(holding, 1);  // but on faces, or next to them
      for (std::size_t o = 0; o < 6; ++o) {
        EXPECT_FALSE(isEmpty(intersection(image.ranges[0][o], y[o])));
        if (isInner) {
          EXPECT_FALSE(isEmpty(intersection(image.ranges[1][o], y[o])));
        }
      }
    }
  }
}

TEST(Image, CostsNoMoreThanItMay) {
  const Box box(3, Interval(-std::numbers::pi, std::numbers::pi));
  EXPECT_EQ(findImage(ishigami(), 0, box, {}, {0}, -1, nullptr, 0).parts, 1U);
  const Program linear = record(3, 0, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = x[0] - x[1] + x[2]; });
  EXPECT_EQ(findImage(linear, 0, box, {}, {0}, -1, nullptr).parts, 1U);  // nothing is unknown
}

}  // namespace
}  // namespace gamut::testing
