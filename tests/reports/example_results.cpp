// A damped swing with an uncertain amplitude: centre(t) +- width(t); each answer takes its share of the width.
#include "tests/reports/example_results.hpp"
#include "studies/analyses/derivatives.hpp"

#include <cmath>
#include <string>

namespace gamut::example {
namespace {

double centre(double t, std::size_t output) {
  return 2.3 * std::cos((2.1 + 0.3 * static_cast<double>(output)) * t) * std::exp(-0.1 * t);
}
double width(double t) { return 0.023 * (1 + 1.7 * t + 0.4 * std::sin(5 * t)); }

void setBand(Bounds& bounds, std::size_t i, std::size_t k, double middle, double half) {
  bounds.lower(i, k) = middle - half;
  bounds.upper(i, k) = middle + half;
}

void describe(Results& results, std::size_t outputs) {
  results.title = "Pendulum whose first angle is known to one percent";
  results.analysis = "dynamics";
  results.studyFile = "pendulum.toml";
  results.studyText = "[study]\ntitle = \"Pendulum\"\nhorizon = 3.0\n";
  results.seed = 20041;
  results.version = "0.1.0";
  results.host = "workshop";
  results.date = "2026-01-02T03:04:05Z";
  results.libraries = {{"SUNDIALS", "6.4.1"}, {"HDF5", "1.10.8"}};
  results.uncertain = {{"first angle", "shoulder.angle", "rad", 2.2777, 2.3, 2.3223, "uniform", "triangular"}};
  const char* names[] = {"shoulder angle", "elbow angle", "tip height", "tip speed", "energy", "load", "shoulder rate"};
  const char* units[] = {"rad", "rad", "m", "m/s", "J", "N", "rad/s"};
  for (std::size_t k = 0; k < outputs; ++k) {
    results.outputs.push_back({names[k % 7], "element." + std::to_string(k), units[k % 7]});
  }
}

}  // namespace

Results pendulum(std::size_t times, std::size_t outputs, std::size_t levels) {
  Results results;
  describe(results, outputs);
  results.horizon = 3;
  for (std::size_t i = 0; i < times; ++i) {
    results.time.push_back(3.0 * static_cast<double>(i) / static_cast<double>(times - 1));
  }
  IntervalResult& interval = results.interval;
  StochasticResult& stochastic = results.stochastic;
  FuzzyResult& fuzzy = results.fuzzy;
  interval.present = stochastic.present = fuzzy.present = results.comparison.present = true;
  interval.reached = stochastic.reached = fuzzy.reached = 3;
  interval.pieces = 1;
  interval.steps = 412;
  interval.cpu = 1.73;
  stochastic.plan = Placement::sobol;
  stochastic.samples = 4096;
  stochastic.corners = 2;
  stochastic.integrated = stochastic.planned();
  stochastic.relativeTolerance = 1e-10;
  stochastic.absoluteTolerance = 1e-12;
  stochastic.cpu = 8.21;
  stochastic.probabilities = {0.05, 0.25, 0.5, 0.75, 0.95};
  stochastic.quantiles.assign(5, Table(times, outputs));
  stochastic.mean = stochastic.deviation = stochastic.error = Table(times, outputs);
  fuzzy.cpu = 2.02;
  fuzzy.transformation.present = true;
  fuzzy.transformation.method = "extended";
  interval.at = interval.over = stochastic.envelope = Bounds(times, outputs);
  results.comparison.verdict = Agreement::inside;
  results.comparison.overestimation = Table(times, outputs);
  for (std::size_t level = 0; level < levels; ++level) {
    fuzzy.alpha.push_back(static_cast<double>(level) / static_cast<double>(levels - 1));
    fuzzy.outer.emplace_back(times, outputs);
    fuzzy.inner.emplace_back(times, outputs);
  }
  for (std::size_t i = 0; i < times; ++i) {
    const double t = results.time[i], before = i > 0 ? results.time[i - 1] : t, w = width(t);
    const double ratio = 1.001 + 0.001 * t;
    for (std::size_t k = 0; k < outputs; ++k) {
      const double c = centre(t, k), last = centre(before, k);
      setBand(stochastic.envelope, i, k, c, w);
      setBand(interval.at, i, k, c, ratio * w);
      interval.over.lower(i, k) = std::fmin(c, last) - 1.05 * w;
      interval.over.upper(i, k) = std::fmax(c, last) + 1.05 * w;
      for (std::size_t q = 0; q < 5; ++q) {
        stochastic.quantiles[q](i, k) = c + (2 * stochastic.probabilities[q] - 1) * w;
      }
      stochastic.mean(i, k) = c;
      stochastic.deviation(i, k) = 0.58 * w;
      stochastic.error(i, k) = 1e-11;
      results.comparison.overestimation(i, k) = ratio;
      for (std::size_t level = 0; level < levels; ++level) {
        setBand(fuzzy.outer[level], i, k, c, ratio * (1 - fuzzy.alpha[level]) * w);
        setBand(fuzzy.inner[level], i, k, c, (1 - fuzzy.alpha[level]) * w);
      }
    }
  }
  results.comparison.maximum = 1.004;
  results.comparison.median = 1.0025;
  results.comparison.maximumOf.assign(outputs, 1.004);
  return results;
}

Results kinematics() {
  Results results = pendulum(2, 2);
  results.title = "Crank whose arms are known to a tenth of a millimetre";
  results.analysis = "kinematics";
  results.horizon = results.interval.reached = results.stochastic.reached = results.fuzzy.reached = 0;
  results.time = {0};
  const auto cut = [](Table& grid) {
    grid.times = 1;
    grid.data.resize(grid.outputs);
  };
  const auto cutBand = [&](Bounds& bounds) {
    cut(bounds.lower);
    cut(bounds.upper);
  };
  cutBand(results.interval.at);
  cutBand(results.stochastic.envelope);
  results.interval.over = {};
  for (Table* grid : {&results.stochastic.mean, &results.stochastic.deviation, &results.stochastic.error,
                      &results.comparison.overestimation}) {
    cut(*grid);
  }
  for (Table& grid : results.stochastic.quantiles) cut(grid);
  for (Bounds& bounds : results.fuzzy.outer) cutBand(bounds);
  for (Bounds& bounds : results.fuzzy.inner) cutBand(bounds);
  results.interval.direct = Bounds(1, 2);
  for (std::size_t k = 0; k < 2; ++k) setBand(results.interval.direct, 0, k, centre(0, k), 2.6 * width(0));
  return results;
}

Results machine(bool isSpatial, std::size_t seen) {
  Results results = pendulum();
  PictureResult& m = results.picture;
  m.present = m.places.present = true;
  m.directions = {{"x", 0}, {"y", 0}, {"z", -9.81}};
  m.points = {{"inertial", true, true}, {"elbow", false, false}, {"tip", false, false}, {"wall", true, true}};
  m.parts = {{"shoulder", "revolute", PartKind::joint, 0, 0, 1, 0, 0},
             {"upper", "link", PartKind::rigid, 0, 1, 0, 0, 0},
             {"heavy", "mass", PartKind::mass, 1, 1, 0, 0, 2.0},
             {"wrist", "revolute", PartKind::joint, 1, 1, 1, 0, 0},
             {"lower", "link", PartKind::rigid, 1, 2, 0, 0, 0},
             {"light", "mass", PartKind::mass, 2, 2, 0, 0, 0.5},
             {"rubber", "spring-damper", PartKind::spring, 3, 2, 0, 0, 0}};
  m.axes = {{"shoulder.axis", 0}, {"wrist.axis", 3}};
  Places& p = m.places;
  p.sample = {0, 1};
  const auto place = [&](std::vector<double>& to, std::size_t i, double off, double turn) {
    const double angle = centre(results.horizon * static_cast<double>(i) / static_cast<double>(seen - 1), 0) + turn,
                 x = isSpatial ? 0.3 * std::cos(angle) : 0;
    const double coordinates[] = {
        0, 0, 0, x, std::sin(angle), -std::cos(angle), 2 * x, 2 * std::sin(angle), -std::cos(angle) - 0.5, 0, 2, -1};
    for (std::size_t k = 0; k < 12; ++k) to.push_back(coordinates[k] + (k < 3 || k > 8 ? 0 : off));
  };
  for (std::size_t i = 0; i < seen; ++i) {
    p.time.push_back(results.horizon * static_cast<double>(i) / static_cast<double>(seen - 1));
    place(p.nominal, i, 0, 0);
    place(p.lower, i, -0.05, 0);
    place(p.upper, i, 0.05, 0);
    for (std::size_t k = 0; k < 12; ++k) p.sag.push_back(0.01);
    for (const double e : {1, 0, 0, 1, 0, 0}) p.axes.push_back(e);
  }
  for (const double turn : {-0.02, 0.02})
    for (std::size_t i = 0; i < seen; ++i) place(p.samples, i, 0, turn);
  return results;
}

Results sensitive() {
  constexpr std::size_t outputs = 2, quantities = 2;
  Results results = pendulum(61, outputs);
  results.uncertain.push_back({"<mass>", "tip.mass", "kg", 0.9, 1, 1.1, "uniform", "triangular"});
  StochasticResult& s = results.stochastic;
  s.plan = Placement::random;
  s.covered = 0.99537;
  s.meanError = s.deviationError = Table(61, outputs);
  s.quantileLower = s.quantileUpper = s.quantiles;
  for (std::size_t i = 0; i < 61; ++i)
    for (std::size_t k = 0; k < outputs; ++k) {
      s.meanError(i, k) = s.deviationError(i, k) = 0.001 + 0.0001 * static_cast<double>(i);
      for (std::size_t q = 0; q < s.quantiles.size(); ++q) {
        s.quantileLower[q](i, k) -= 0.002;
        s.quantileUpper[q](i, k) += 0.003;
      }
    }
  s.convergence = {true, {1024, 2048, 4096}, {0.7, 0.8, 0.8, 0.9, 0.95, 0.99}, {0.04, 0.05, 0.02, 0.03, 0.01, 0.02}};
  SensitivityResult& sensitivity = results.sensitivity;
  DerivativeResult& derivatives = results.of<DerivativeResult>();
  InfluenceResult& influence = results.fuzzy.influence;
  sensitivity.present = derivatives.present = influence.present = true;
  sensitivity.samples = 8192;
  derivatives.reached = 2;
  derivatives.why = "the work that limits.derivatives allows is done";
  for (std::size_t i = 0; i < 61; i += 10) {
    const double t = results.time[i], share = t < 1.5 ? 0.2 : 0.7;  // of the mass
    sensitivity.time.push_back(t);
    influence.time.push_back(t);
    if (t <= derivatives.reached) derivatives.time.push_back(t);
    for (std::size_t k = 0; k < outputs * quantities; ++k) {
      const double own = k % quantities == 0 ? 1 - share : share;
      sensitivity.first.lower.data.push_back(own - 0.02);
      sensitivity.first.upper.data.push_back(own - 0.01);
      sensitivity.total.lower.data.push_back(own - 0.001);
      sensitivity.total.upper.data.push_back(own + 0.001);
      sensitivity.firstSampled.data.push_back(own - 0.015);
      sensitivity.totalSampled.data.push_back(own + 0.004);
      sensitivity.firstError.data.push_back(0.03);
      sensitivity.totalError.data.push_back(0.02);
      sensitivity.pinched.data.push_back(i % 20 == 0 ? 0.9 * own : std::nan(""));
      influence.share.data.push_back(own);
      if (t > derivatives.reached) continue;
      derivatives.lower.data.push_back(3 * own);
      derivatives.upper.data.push_back(4 * own);
    }
  }
  for (Grid* grid :
       {&sensitivity.first.lower, &sensitivity.first.upper, &sensitivity.total.lower, &sensitivity.total.upper,
        &sensitivity.firstSampled, &sensitivity.totalSampled, &sensitivity.firstError, &sensitivity.totalError,
        &sensitivity.pinched, &influence.share, &derivatives.lower, &derivatives.upper})
    grid->extents = {grid->data.size() / (outputs * quantities), outputs, quantities};
  return results;
}

}  // namespace gamut::example
