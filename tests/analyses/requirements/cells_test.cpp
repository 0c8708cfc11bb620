// What is known of single points, from models written by hand.
#include "analyses/requirements/cells.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "analyses/flow/models.hpp"
#include "analyses/flow/series/monomials.hpp"

namespace gamut {
namespace {

using Verdict = Cell::Verdict;

/// One margin of one quantity in [-1, 1] at one time: constant + slope η on each part.
struct LinearPart {
  double centre, half, constant, slope;
};

FlowModels modelsOf(const std::vector<LinearPart>& parts) {
  FlowModels models;
  models.components = {{0, 1, 0}};
  models.symbols = 1;
  models.modelled = 1;
  models.at.resize(1);
  const auto monomials = std::make_shared<const Monomials>(std::vector<int>{1}, 1);
  for (const LinearPart& part : parts) {
    FlowSnapshot snapshot;
    snapshot.part = {{part.centre}, {part.half}};
    snapshot.monomials = monomials;
    snapshot.outputs = {{{part.constant, part.slope}, 0, Interval(-10.0, 10.0)}};
    models.at[0].push_back(std::make_shared<const FlowSnapshot>(std::move(snapshot)));
  }
  return models;
}

Verdict verdictAt(const std::vector<LinearPart>& parts, double xi) {
  const FlowModels models = modelsOf(parts);
  return Cells(models, {CellQuestion::When::always, {0}, {0}, 0, 0}).verdictAt({xi});
}

/// A place is known to some 2^-51, which is 2^-21 of a part that was bisected thirty times.
TEST(Cells, KnowAPlaceInASmallPartAsWellAsRoundingAllows) {
  constexpr double half = 0x1p-30, centre = 0x1p-2 + half;
  EXPECT_EQ(verdictAt({{centre, half, -0x1p-20, 1}}, centre), Verdict::open);
  EXPECT_EQ(verdictAt({{centre, half, -0x1p-18, 1}}, centre), Verdict::violated);
  EXPECT_EQ(verdictAt({{centre, half, 0x1p-20, 1}}, centre), Verdict::open);
  EXPECT_EQ(verdictAt({{centre, half, 0x1p-18, 1}}, centre), Verdict::met);
  EXPECT_EQ(verdictAt({{0, 1, -0x1p-40, 1}}, 0), Verdict::violated);  // of the whole box
  EXPECT_EQ(verdictAt({{0, 1, -0x1p-50, 1}}, 0), Verdict::open);
}

/// Next to where two parts meet it may lie in either.
TEST(Cells, KnowAPlaceWherePartsMeetAsFarAsBothAgree) {
  const std::vector<LinearPart> apart = {{-0.5, 0.5, -1, 0.5}, {0.5, 0.5, 1, 0.5}};
  for (const double xi : {-0x1p-52, 0.0, 0x1p-52}) EXPECT_EQ(verdictAt(apart, xi), Verdict::open) << xi;
  EXPECT_EQ(verdictAt(apart, -0x1p-40), Verdict::violated);
  EXPECT_EQ(verdictAt(apart, 0x1p-40), Verdict::met);
  const std::vector<LinearPart> agreed = {{-0.5, 0.5, -1, 0.5}, {0.5, 0.5, -1, 0.5}};
  for (const double xi : {-1.0, 0.0, 0x1p-52, 1.0}) EXPECT_EQ(verdictAt(agreed, xi), Verdict::violated) << xi;
}

}  // namespace
}  // namespace gamut
