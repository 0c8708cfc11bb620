// Probabilities are proved where the results hold distributions; elsewhere quantiles of the samples stand for them.
// Memberships are stairs: outside a level's cut the membership is proved to be lower.
#include "reports/page/instant.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "reports/drawing/distribution.hpp"
#include "reports/drawing/membership.hpp"
#include "reports/sections/contribution.hpp"
#include "reports/sections/limits.hpp"

namespace gamut {
namespace {

/// A pen in the units of a moment.
class BesidePen {
 public:
  BesidePen(double low, double high) : low_(low), high_(high) {}

  void go(double across, double value) {
    pen_.go(besideWidth * across, -besideHeight * (std::clamp(value, low_, high_) - low_) / (high_ - low_));
  }
  void stroke(double value) {
    pen_.lift();
    go(-1, value);
    go(1, value);
    pen_.lift();
  }
  void lift() { pen_.lift(); }
  void close() { pen_.close(); }
  void draw(std::string_view kind, std::string& to) { drawPath(kind, pen_, to); }

 private:
  double low_, high_;
  Pen pen_;
};

void strokeStairs(const std::vector<Cut>& cuts, BesidePen& shapes, std::string& to) {
  const auto levelAfter = [&](std::size_t i) { return i + 1 < cuts.size() ? cuts[i + 1].alpha : 1; };
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    shapes.go(i == 0 ? 0 : -cuts[i].alpha, cuts[i].lower);
    shapes.go(-levelAfter(i), cuts[i].lower);
  }
  for (std::size_t i = cuts.size(); i-- > 0;) {
    shapes.go(-levelAfter(i), cuts[i].upper);
    shapes.go(i == 0 ? 0 : -cuts[i].alpha, cuts[i].upper);
  }
  shapes.draw("beside-possible", to);
}

void strokeReached(const std::vector<Cut>& cuts, BesidePen& shapes, std::string& to) {
  for (const Cut& cut : cuts) shapes.go(-cut.alpha, cut.lower);
  for (std::size_t i = cuts.size(); i-- > 0;) shapes.go(-cuts[i].alpha, cuts[i].upper);
  shapes.draw("beside-reached", to);
}

/// Of one output at one output time.
class KnownThere {
 public:
  KnownThere(const Results& results, std::size_t output, std::size_t row)
      : results_(results),
        output_(output),
        row_(row),
        outer_(cutsOf(results.fuzzy.alpha, results.fuzzy.outer, row, output)),
        inner_(cutsOf(results.fuzzy.alpha, results.fuzzy.inner, row, output)) {
    const DistributionResult& d = results.distribution;
    const auto at = d.present ? std::ranges::find(d.time, results.time[row]) : d.time.end();
    if (at != d.time.end()) stairs_ = stairsOf(results, static_cast<std::size_t>(at - d.time.begin()), output);
    if (results.interval.present) hold(results.interval.at, guaranteed_);
    if (results.stochastic.present) hold(results.stochastic.envelope, sampled_);
    for (const double value : stairs_.value) range_.hold(value);
    for (const Cut& cut : outer_) range_.hold(Line{cut.lower, cut.upper});
  }

  /// Nothing where nothing is known.
  std::optional<BesideMoment> drawn(double middle) const {
    if (!(range_.low <= range_.high)) return std::nullopt;
    const Range range = range_.padded(0);
    if (!isDrawn(range.high - range.low)) return std::nullopt;
    BesideMoment moment{.time = results_.time[row_], .low = range.low, .high = range.high, .middle = middle};
    BesidePen shapes(range.low, range.high);
    if (stairs_.value.size() > 1)
      drawProved(shapes, moment);
    else
      drawQuantiles(shapes, moment);
    if (!guaranteed_.lower.empty()) {
      shapes.stroke(guaranteed_.lower[0]);
      shapes.stroke(guaranteed_.upper[0]);
      shapes.draw("beside-guaranteed", moment.shapes);
    }
    if (outer_.empty()) return moment;
    moment.isPossible = true;
    strokeStairs(outer_, shapes, moment.shapes);
    if (!inner_.empty()) strokeReached(inner_, shapes, moment.shapes);
    return moment;
  }

 private:
  void hold(const Bounds& bounds, Band& band) {
    if (bounds.empty() || row_ >= bounds.lower.times) return;
    const double lower = bounds.lower(row_, output_), upper = bounds.upper(row_, output_);
    if (!isDrawn(lower) || !isDrawn(upper) || !(lower <= upper)) return;
    band = {{lower}, {upper}};
    range_.hold(band);
  }

  void drawProved(BesidePen& shapes, BesideMoment& moment) const {
    const std::size_t count = stairs_.value.size();
    for (std::size_t i = 0; i + 1 < count; ++i) {
      shapes.go(std::clamp(stairs_.upper[i + 1], 0.0, 1.0), stairs_.value[i]);
      shapes.go(std::clamp(stairs_.upper[i + 1], 0.0, 1.0), stairs_.value[i + 1]);
    }
    for (std::size_t i = count - 1; i-- > 0;) {
      shapes.go(std::clamp(stairs_.lower[i], 0.0, 1.0), stairs_.value[i + 1]);
      shapes.go(std::clamp(stairs_.lower[i], 0.0, 1.0), stairs_.value[i]);
    }
    shapes.close();
    shapes.draw("beside-bounds", moment.shapes);
    moment.isProbable = true;
    if (std::isnan(stairs_.sampled.front())) return;
    for (std::size_t i = 0; i < count; ++i) shapes.go(std::clamp(stairs_.sampled[i], 0.0, 1.0), stairs_.value[i]);
    shapes.draw("beside-share", moment.shapes);
  }

  void drawQuantiles(BesidePen& shapes, BesideMoment& moment) const {
    const StochasticResult& s = results_.stochastic;
    if (sampled_.lower.empty() || s.quantiles.size() != s.probabilities.size() || s.quantiles.empty()) return;
    if (!std::ranges::is_sorted(s.probabilities)) return;
    shapes.go(0, sampled_.lower[0]);
    for (std::size_t q = 0; q < s.quantiles.size(); ++q)
      shapes.go(std::clamp(s.probabilities[q], 0.0, 1.0),
                row_ < s.quantiles[q].times ? s.quantiles[q](row_, output_) : std::nan(""));
    shapes.go(1, sampled_.upper[0]);
    shapes.draw("beside-share", moment.shapes);
    moment.isProbable = true;
  }

  const Results& results_;
  std::size_t output_, row_;
  Range range_;
  Stairs stairs_;
  Band guaranteed_, sampled_;
  std::vector<Cut> outer_, inner_;
};

std::set<std::size_t> besideRows(const Results& results, std::size_t output) {
  constexpr std::size_t most = 12;
  std::set<std::size_t> rows;
  const std::vector<double>& times = results.time;
  const auto add = [&](double time) {
    const auto nearest = std::ranges::min_element(times, {}, [&](double t) { return std::abs(t - time); });
    rows.insert(static_cast<std::size_t>(nearest - times.begin()));
  };
  if (times.empty()) return rows;
  if (results.distribution.present && !results.distribution.time.empty())
    for (const double time : results.distribution.time) add(time);
  else
    for (std::size_t i = 0; i <= most; ++i) rows.insert(i * (times.size() - 1) / most);
  if (const double instant = instantOf(results, output); std::isfinite(instant)) add(instant);
  return rows;
}

}  // namespace

std::vector<BesideMoment> besideOf(const Results& results, std::size_t output) {
  std::vector<BesideMoment> moments;
  const Line middle = plotOf(results, output).middle();
  for (const std::size_t row : besideRows(results, output))
    if (auto moment = KnownThere(results, output, row).drawn(row < middle.size() ? middle[row] : std::nan("")))
      moments.push_back(std::move(*moment));
  return moments;
}

}  // namespace gamut
