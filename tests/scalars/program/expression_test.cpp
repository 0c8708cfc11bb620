// Which nodes of two programs compute the same.
#include "scalars/program/expression.hpp"

#include <gtest/gtest.h>

#include "scalars/program/recorder.hpp"
#include "scalars/recorded.hpp"

namespace gamut::expression_test {
namespace {

bool isSame(const Program& f, const Program& g) {
  return isSameExpression(f, f.outputNodes()[0], g, g.outputNodes()[0]);
}

template <class F>
Program recorded(F f, int parameters = 2) {
  return record(2, parameters, 1, [=](auto t, const auto& x, const auto& p, auto& y) { y[0] = f(t, x, p); });
}

TEST(SameExpression, IsKnownWhateverStandsBesideAndBefore) {
  const Program alone = recorded([](auto t, const auto& x, const auto& p) { return sin(x[0] * p[1]) - x[1] * t; });
  const Program beside = record(2, 5, 2, [](auto t, const auto& x, const auto& p, auto& y) {
    y[1] = exp(x[1]) + t * x[1] * p[4];
    y[0] = sin(p[1] * x[0]) - t * x[1];
  });
  EXPECT_TRUE(isSame(alone, beside));
  EXPECT_FALSE(isSameExpression(alone, alone.outputNodes()[0], beside, beside.outputNodes()[1]));
}

TEST(SameExpression, TellsOperandsApart) {
  const Program f = recorded([](auto, const auto& x, const auto& p) { return x[0] * p[0] - x[1]; });
  EXPECT_FALSE(isSame(f, recorded([](auto, const auto& x, const auto& p) { return x[1] - x[0] * p[0]; })));
  EXPECT_FALSE(isSame(f, recorded([](auto, const auto& x, const auto& p) { return x[0] * p[1] - x[1]; })));
  EXPECT_FALSE(isSame(f, recorded([](auto, const auto& x, const auto& p) { return x[0] * p[0] + x[1]; })));
  EXPECT_FALSE(isSame(f, recorded([](auto t, const auto& x, const auto& p) { return x[0] * p[0] - t; })));
}

TEST(SameExpression, TellsConstantsByTheirEnclosures) {
  const auto with = [](const char* number) {
    return recorded([=](auto, const auto& x, const auto&) { return sin(x[0]) - constant<Recorded>(Interval(number)); });
  };
  EXPECT_TRUE(isSame(with("0.1"), with("0.1")));
  EXPECT_FALSE(isSame(with("0.1"), with("0.1000000000000001")));
}

TEST(SameExpression, TellsSystemsByMatrixRightSideAndComponent) {
  const auto with = [](double entry, double right, int component) {
    Recorder recorder(2, 0);
    const int one = recorder.constant(1.0);
    const int matrix =
        recorder.matrix({MatrixKind::general, 2, {recorder.state(0), one, one, recorder.constant(entry)}});
    const std::vector<int> x = recorder.solve(matrix, false, {recorder.state(1), recorder.constant(right)});
    return recorder.finish({x[component]});
  };
  EXPECT_TRUE(isSame(with(3, 2, 1), with(3, 2, 1)));
  EXPECT_FALSE(isSame(with(3, 2, 1), with(3, 2, 0)));
  EXPECT_FALSE(isSame(with(3, 2, 1), with(4, 2, 1)));
  EXPECT_FALSE(isSame(with(3, 2, 1), with(3, 5, 1)));
}

}  // namespace
}  // namespace gamut::expression_test
