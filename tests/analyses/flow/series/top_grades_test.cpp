// What highest grades say of another degree, and of halving a symbol.
#include "analyses/flow/series/top_grades.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

namespace gamut {
namespace {

/// Sets the coefficient of ξ₁^a ξ₂^b.
void set(std::vector<double>& p, const Monomials& m, std::size_t state, int a, int b, double value) {
  for (int g = 0; g < m.count(); ++g)
    if (m.exponent(g, 0) == a && m.exponent(g, 1) == b)
      p[state * static_cast<std::size_t>(m.count()) + static_cast<std::size_t>(g)] = value;
}

TEST(TopGrades, NothingSaysNothing) {
  const TopGrades none;
  EXPECT_TRUE(none.isEmpty());
  EXPECT_EQ(none.gainOfHalving(0, 0), 1);
}

TEST(TopGrades, HalvingTakesAPowerOfTwoOfEachPower) {
  const Monomials m({1, 1}, 4);
  std::vector<double> p(static_cast<std::size_t>(m.count()));
  set(p, m, 0, 0, 0, 7);  // what does not vary does not count
  set(p, m, 0, 1, 0, 32);
  set(p, m, 0, 2, 0, 8);
  set(p, m, 0, 3, 0, -4);
  set(p, m, 0, 4, 0, 4);
  TopGrades tops;
  tops.add(p, m);
  EXPECT_EQ(tops.decay(), 12.0 / 8);                                        // (8 + 4) / (4 + 4)
  EXPECT_EQ(tops.gainOfHalving(0, 0), 8 / (0.5 + 0.25));                    // 4/8 + 4/16
  EXPECT_EQ(tops.gainOfHalving(0, 1), (0.5 + 0.25) / (0.0625 + 0.015625));  // 4/64 + 4/256
  EXPECT_EQ(tops.gainOfHalving(1, 0), 1);
}

TEST(TopGrades, StatesCountInProportionToWhatTheyVary) {
  const Monomials m({1, 1}, 2);
  std::vector<double> p(2 * static_cast<std::size_t>(m.count()));
  set(p, m, 0, 1, 0, 3e6), set(p, m, 0, 2, 0, 1e6);  // a quarter of grade 2, in the first symbol
  set(p, m, 1, 0, 1, 3e-9), set(p, m, 1, 0, 2, 1e-9);
  TopGrades tops;
  tops.add(p, m);
  EXPECT_DOUBLE_EQ(tops.gainOfHalving(0, 0), tops.gainOfHalving(1, 0));
}

TEST(TopGrades, WhatIsJoinedIsOfBoth) {
  const Monomials m({1, 1}, 3);
  std::vector<double> p(static_cast<std::size_t>(m.count())), q = p;
  set(p, m, 0, 1, 0, 1), set(p, m, 0, 3, 0, 1);
  set(q, m, 0, 0, 1, 1), set(q, m, 0, 0, 3, 3);
  TopGrades both, first, second;
  both.add(p, m), both.add(q, m);
  first.add(p, m), second.add(q, m);
  first.join(second);
  first.join({});
  for (const int symbol : {0, 1}) EXPECT_EQ(first.gainOfHalving(symbol, 0), both.gainOfHalving(symbol, 0));
  EXPECT_GT(first.gainOfHalving(1, 0), first.gainOfHalving(0, 0));
}

}  // namespace
}  // namespace gamut
