// Thinned proved bands still hold the full ones, also along the straight lines that a plot draws between points.
#include "reports/drawing/plot.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>

#include "reports/drawing/axes.hpp"
#include "reports/drawing/paper.hpp"
#include "reports/drawing/screen.hpp"
#include "reports/drawing/spark.hpp"
#include "reports/drawing/style.hpp"
#include "reports/sections/contribution.hpp"
#include "tests/reports/example_results.hpp"

namespace gamut {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const Layer& layerNamed(const Plot& plot, const std::string& name) {
  const auto layer = std::ranges::find(plot.layers, name, &Layer::name);
  if (layer == plot.layers.end()) throw std::logic_error("no layer " + name);
  return *layer;
}

/// The line drawn through (time, line) at t.
double drawn(const std::vector<double>& time, const std::vector<double>& line, double t) {
  std::size_t j = 1;
  while (j + 1 < time.size() && time[j] < t) ++j;
  const double share = (t - time[j - 1]) / (time[j] - time[j - 1]);
  return std::lerp(line[j - 1], line[j], share);
}

void expectHolds(const Plot& thin, const Band& outer, const Plot& full, const Band& inner) {
  for (std::size_t i = 0; i < full.time.size(); ++i) {
    EXPECT_LE(drawn(thin.time, outer.lower, full.time[i]), inner.lower[i]) << full.time[i];
    EXPECT_GE(drawn(thin.time, outer.upper, full.time[i]), inner.upper[i]) << full.time[i];
  }
}

/// Limits of a short window near the end, each near to the others: labels stay on the paper, and none lies over
/// another.
TEST(PaperPlot, WritesEveryLabelWhereItCanBeRead) {
  Plot plot{"deflection", "mm", {}, {}, {}};
  Layer limits{.name = "limit", .words = "limit", .kind = Layer::Kind::line};
  for (std::size_t i = 0; i < 100; ++i) plot.time.push_back(0.01 * static_cast<double>(i));
  for (const double value : {5.0, 4.9, -5.0}) {
    Line line(100, NAN);
    for (std::size_t i = 97; i < 100; ++i) line[i] = value;
    limits.bands.push_back({line, line});
    limits.labels.push_back(value == 5 ? "limit 5 mm" : "limit 4.9 mm");
  }
  Layer motion{.name = "median", .words = "median", .kind = Layer::Kind::line};
  Line line;
  for (std::size_t i = 0; i < 100; ++i) line.push_back(-20 * std::sin(0.1 * static_cast<double>(i)));
  motion.bands.push_back({line, line});
  plot.layers = {motion, limits};
  const std::string svg = drawPlot(plot, "Plot");
  struct Place {
    double left = 0, right = 0, base = 0;
  };
  std::vector<Place> places;
  for (auto at = svg.find("label\" x=\""); at != std::string::npos; at = svg.find("label\" x=\"", at + 1)) {
    const double x = std::stod(svg.substr(at + 10)), base = std::stod(svg.substr(svg.find("y=\"", at) + 3));
    const bool isEnd = svg.substr(at - 4, 4) == "end ";
    const auto begin = svg.find('>', at) + 1;
    const double wide = 6.2 * static_cast<double>(svg.find('<', begin) - begin);
    places.push_back({isEnd ? x - wide : x, isEnd ? x : x + wide, base});
  }
  ASSERT_EQ(places.size(), 3u);
  for (const Place& one : places) {
    EXPECT_GE(one.left, marginLeft);
    EXPECT_LE(one.right, paperWidth - marginRight);
    for (const Place& other : places) {
      if (&one != &other && one.left < other.right && other.left < one.right) {
        EXPECT_GE(std::abs(one.base - other.base), 13);
      }
    }
  }
}

TEST(ThinnedPlot, KeepsProvedBandsOutside) {
  for (const std::size_t points : {2u, 3u, 17u, 100u, 299u}) {
    const Plot full = plotOf(example::pendulum(301, 1, 3), 0);
    const Plot thin = thinned(full, points);
    ASSERT_LE(thin.time.size(), points);
    ASSERT_EQ(thin.time.front(), full.time.front());
    ASSERT_EQ(thin.time.back(), full.time.back());
    for (const std::string name : {"guaranteed", "tube", "possible"}) {
      const Layer &outer = layerNamed(thin, name), &inner = layerNamed(full, name);
      EXPECT_TRUE(outer.isProved);
      for (std::size_t band = 0; band < inner.bands.size(); ++band)
        expectHolds(thin, outer.bands[band], full, inner.bands[band]);
    }
  }
}

TEST(ThinnedPlot, IsUnchangedWhereFewEnough) {
  const Plot full = plotOf(example::pendulum(61, 1), 0);
  EXPECT_EQ(thinned(full, 61).time, full.time);
  EXPECT_EQ(layerNamed(thinned(full, 61), "guaranteed").bands[0].lower, layerNamed(full, "guaranteed").bands[0].lower);
}

TEST(Tube, CoversBothIntervalsThatMeetAtATime) {
  const Results results = example::pendulum(61, 1);
  const Band tube = layerNamed(plotOf(results, 0), "tube").bands[0];
  for (std::size_t i = 0; i + 1 < 61; ++i) {
    for (const std::size_t row : {i, i + 1}) {
      EXPECT_LE(tube.lower[i], results.interval.over.lower(row, 0));
      EXPECT_GE(tube.upper[i], results.interval.over.upper(row, 0));
    }
  }
}

TEST(Plot, EstimatesBehindTheProofAlone) {
  Results results = example::pendulum();
  const auto hasEstimate = [&] {
    const Plot plot = plotOf(results, 0);
    return std::ranges::find(plot.layers, "estimated", &Layer::name) != plot.layers.end();
  };
  EXPECT_FALSE(hasEstimate());
  results.interval.reached = 1.52;
  ASSERT_TRUE(hasEstimate());
  const Layer layer = layerNamed(plotOf(results, 0), "estimated");
  EXPECT_EQ(layer.words, "estimated behind the proof, which ends at 1.52 s: where the samples are");
  EXPECT_FALSE(layer.isProved);
  for (std::size_t i = 0; i < results.time.size(); ++i) {
    EXPECT_EQ(std::isnan(layer.bands[0].lower[i]), results.time[i] < 1.5) << results.time[i];
    if (results.time[i] >= 1.5) {
      EXPECT_EQ(layer.bands[0].upper[i], results.stochastic.envelope.upper(i, 0));
    }
  }
  results.interval = {};
  results.fuzzy = {};
  EXPECT_FALSE(hasEstimate());
}

TEST(PlotAroundItsMiddle, KeepsWidthsAndLeavesTheTubeOut) {
  const Plot plot = plotOf(example::pendulum(), 0), around = aroundMiddle(plot);
  EXPECT_EQ(plot.middleName(), "the median");
  EXPECT_THROW(layerNamed(around, "tube"), std::logic_error);
  const Band was = layerNamed(plot, "guaranteed").bands[0], is = layerNamed(around, "guaranteed").bands[0];
  for (std::size_t i = 0; i < plot.time.size(); ++i) {
    EXPECT_EQ(layerNamed(around, "median").bands[0].lower[i], 0);
    EXPECT_NEAR(is.upper[i] - is.lower[i], was.upper[i] - was.lower[i], 1e-12);
  }
}

TEST(PlotAroundItsMiddle, TakesTheMiddleOfTheFrontMostBandWhereThereIsNoLine) {
  Results results = example::pendulum();
  results.stochastic.probabilities.clear();
  results.stochastic.quantiles.clear();
  const Plot plot = plotOf(results, 0);
  EXPECT_EQ(plot.middleName(), "the middle");
  EXPECT_NEAR(plot.middle()[3],
              0.5 * (results.stochastic.envelope.lower(3, 0) + results.stochastic.envelope.upper(3, 0)), 1e-15);
}

TEST(ThinnedPlot, KeepsExtremesOfLines) {
  Plot plot = plotOf(example::pendulum(3001, 1), 0);
  Layer& median = plot.layers[4];
  ASSERT_EQ(median.name, "median");
  for (const std::size_t peak : {7u, 1234u, 2999u}) median.bands[0].lower[peak] = 10.0 + static_cast<double>(peak);
  median.bands[0].lower[500] = -99;
  const Line thin = layerNamed(thinned(plot, 200), "median").bands[0].lower;
  for (const double extreme : {17.0, 1244.0, -99.0}) EXPECT_THAT(thin, ::testing::Contains(extreme));
}

/// What is kept of a smooth line lies on it, but for peaks, which stand where they hardly are elsewhere.
TEST(ThinnedPlot, MakesNoStepsOfSmoothLines) {
  for (const std::size_t times : {31u, 200u, 651u, 3001u})
    for (const std::size_t points : {10u, 30u, 200u}) {
      Plot plot = plotOf(example::pendulum(times, 1), 0);
      Layer& median = plot.layers[4];
      for (std::size_t i = 0; i < times; ++i) median.bands[0].lower[i] = 3 * plot.time[i] * plot.time[i];
      const Plot thin = thinned(plot, points);
      for (std::size_t i = 0; i < thin.time.size(); ++i)
        EXPECT_EQ(layerNamed(thin, "median").bands[0].lower[i], 3 * thin.time[i] * thin.time[i]) << times << " " << i;
    }
}

TEST(Plot, IsThinWhereItsBandIsAHairline) {
  Results results = example::pendulum();
  EXPECT_TRUE(plotOf(results, 0).isThin());
  for (std::size_t i = 0; i < results.time.size(); ++i) results.interval.over.upper(i, 0) += 100;  // not in the spread
  EXPECT_TRUE(plotOf(results, 0).isThin());
  results.interval.at.upper(30, 0) += 1;
  EXPECT_FALSE(plotOf(results, 0).isThin());
  Results constant = example::pendulum();
  for (Bounds* bounds : {&constant.interval.at, &constant.stochastic.envelope, &constant.fuzzy.outer[0]})
    for (Table* table : {&bounds->lower, &bounds->upper})
      for (double& number : table->data) number = 2;
  for (Table& quantile : constant.stochastic.quantiles)
    for (double& number : quantile.data) number = 2;
  EXPECT_FALSE(plotOf(constant, 0).isThin());
}

/// Whatever the size of the numbers, their offset and their width.
TEST(Ticks, DifferAsTheyAreWritten) {
  for (const double size : {1e-9, 1e-3, 1.0, 1e4, 1e9, 1e150})
    for (const double offset : {0.0, 1.0, -3.25, 1e4, 123456.789, -1e6})
      for (const double width : {1e-5, 0.3, 1.0, 17.0})
        for (const int wanted : {2, 3, 5, 8}) {
          const Ticks ticks = ticksOf({size * (offset - width / 3), size * (offset + width)}, wanted);
          ASSERT_GE(ticks.at.size(), 2u);
          EXPECT_LE(ticks.at.size(), static_cast<std::size_t>(3 * wanted + 1));
          for (std::size_t i = 0; i + 1 < ticks.at.size(); ++i) EXPECT_NE(ticks.text[i], ticks.text[i + 1]);
          for (const std::string& text : ticks.text) EXPECT_LE(text.size(), 9u) << text;
        }
  EXPECT_THAT(ticksOf({0, 1}, 5).text, ElementsAre("0", "0.2", "0.4", "0.6", "0.8", "1.0"));
  EXPECT_EQ(ticksOf({0, 4e-9}, 4).aside, "× 10⁻⁹");
  EXPECT_EQ(ticksOf({1234.56781, 1234.56788}, 4).aside, "1234.5678 + … × 10⁻⁶");
  EXPECT_EQ(ticksOf({-0.5, 0.5}, 5).aside, "");
  for (const double constant : {0.0, 1e-9, -5.0, 1e9}) {
    Range range;
    range.hold(constant);
    EXPECT_GE(ticksOf(range.padded(0.04), 5).at.size(), 3u);
  }
}

/// What adding a layer takes: one row in the analysis that it belongs to.
TEST(Layer, OnceStatedIsInTheDrawingTheKeyTheStyleSheetAndTheInteractivePlot) {
  Plot plot = plotOf(example::pendulum(5, 1), 0);
  const Layer layer{.name = "typical",
                    .words = "a typical sample",
                    .readout = "typical",
                    .style = {colour::black, 0, 0.7},
                    .kind = Layer::Kind::line,
                    .bands = {{plot.middle(), {}}}};
  plot.layers.push_back(layer);
  EXPECT_THAT(drawPlot(plot, "plot"), HasSubstr("<path class=\"typical\" d=\"M"));
  EXPECT_THAT(drawKey(plot.layers, "key"),
              HasSubstr("<li data-layer=\"typical\"><span class=\"swatch typical\"></span>a typical"));
  StyleSheet style;
  style.add(plot);
  EXPECT_THAT(style.css(), HasSubstr(".drawing .typical{stroke:var(--typical);stroke-width:0.7}"));
  EXPECT_THAT(style.css(), HasSubstr("--typical:#37424e;"));
  EXPECT_THAT(plotData(plot),
              HasSubstr(R"({"name":"typical","words":"a typical sample","kind":"line","readout":"typical",)"));
}

TEST(Layer, OrderIsFromBackToFront) {
  std::vector<std::string> names;
  for (const Layer& layer : plotOf(example::pendulum(), 0).layers) names.push_back(layer.name);
  EXPECT_THAT(names, ElementsAre("tube", "guaranteed", "possible", "probable", "median", "sampled"));
}

/// Of the greatest, at a share of the way across the interval; of what is drawn of one quantity of these numbers.
double heightAt(double share, const std::string& name, ShapeKind kind, const std::map<std::string, double>& numbers) {
  Results results;
  const bool isDistribution = kind == ShapeKind::distribution;
  results.uncertain = {{"q", "q", "m", 1, 2, 5, isDistribution ? name : "", isDistribution ? "" : name}};
  for (const auto& [key, value] : numbers) results.shapes.push_back({"q", kind, key, value, "m"});
  const std::string svg = drawShape(results, results.uncertain[0], kind);
  if (svg.empty()) return std::nan("");
  std::istringstream path(svg.substr(svg.find("d=\"M") + 4));
  double x = 0, y = 0, last = 20;
  for (char letter = 'L'; path >> x >> y; path >> letter)
    if (x <= 2 + 92 * share + 0.05) last = y;
  return (20 - last) / 18;
}

/// By the formulas of the densities.
TEST(ShapeDrawing, IsAsHighAsTheShape) {
  constexpr ShapeKind probable = ShapeKind::distribution, possible = ShapeKind::membership;
  constexpr double near = 0.03;  // a pixel is a twentieth of what is drawn
  for (const int step : {2, 10, 24, 48, 72, 94}) {
    const double share = step / 96.0;
    SCOPED_TRACE(share);
    const double x = 1 + 4 * share;
    EXPECT_NEAR(heightAt(share, "uniform", probable, {{"lower", 1}, {"upper", 4}}), x <= 4 ? 1 : 0, near);
    EXPECT_NEAR(heightAt(share, "triangular", probable, {{"lower", 1}, {"upper", 5}, {"mode", 2}}),
                x < 2 ? x - 1 : (5 - x) / 3, near);
    EXPECT_NEAR(heightAt(share, "triangular", possible, {{"lower", 1}, {"upper", 5}, {"apex", 4}}),
                x < 4 ? (x - 1) / 3 : 5 - x, near);
    EXPECT_NEAR(heightAt(share, "trapezoidal", possible, {{"lower", 1}, {"upper", 5}, {"left", 2}, {"right", 3}}),
                x < 2   ? x - 1
                : x > 3 ? (5 - x) / 2
                        : 1,
                near);
    EXPECT_NEAR(heightAt(share, "normal", probable,
                         {{"lower", 1}, {"upper", 5}, {"mean", 3}, {"deviation", 1}, {"cut_off", 0.05}}),
                std::exp(-0.5 * (x - 3) * (x - 3)), near);
    EXPECT_NEAR(heightAt(share, "gaussian", possible, {{"lower", 1}, {"upper", 5}, {"centre", 3}, {"deviation", 1}}),
                std::exp(-0.5 * (x - 3) * (x - 3)), near);
    EXPECT_NEAR(heightAt(share, "exponential", probable, {{"lower", 1}, {"upper", 5}, {"mean", 2}}),
                std::exp((1 - x) / 2), near);
  }
  EXPECT_TRUE(std::isnan(heightAt(0.5, "normal", probable,
                                  {{"lower", 1}, {"upper", 5}, {"mean", 3}, {"mean, at most", 4}, {"deviation", 1}})));
  EXPECT_TRUE(std::isnan(heightAt(0.5, "beta", probable, {{"lower", 1}, {"upper", 5}, {"a", 2}, {"b", 2}})));
  EXPECT_TRUE(std::isnan(heightAt(0.5, "uniform", probable, {})));  // nothing is known of it
}

}  // namespace
}  // namespace gamut
