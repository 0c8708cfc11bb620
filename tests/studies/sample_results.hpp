// Results with something in every field, for tests of files and summaries.
#pragma once

#include <limits>

#include "studies/analyses/derivatives.hpp"
#include "studies/analyses/equilibria.hpp"
#include "studies/analyses/modes.hpp"
#include "studies/analyses/postures.hpp"
#include "studies/analyses/witness.hpp"
#include "studies/analyses/workspace.hpp"
#include "studies/results/results.hpp"

namespace gamut {

/// A grid of distinct numbers: base + 10 time + output.
inline Table sampleGrid(std::size_t times, std::size_t outputs, double base) {
  Table grid(times, outputs);
  for (std::size_t i = 0; i < times; ++i)
    for (std::size_t j = 0; j < outputs; ++j) grid(i, j) = base + 10 * static_cast<double>(i) + static_cast<double>(j);
  return grid;
}

inline Bounds sampleBounds(std::size_t times, std::size_t outputs, double base, double width) {
  Bounds bounds;
  bounds.lower = sampleGrid(times, outputs, base);
  bounds.upper = sampleGrid(times, outputs, base + width);
  return bounds;
}

/// Three times, two outputs; the last enclosure is missing, one overestimation cannot be told.
inline Results sampleResults() {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  Results r;
  r.studyText = "[study]\ntitle = \"α\"\n";
  r.studyFile = "sample.toml";
  r.title = "A sample with an α";
  r.analysis = "dynamics";
  r.seed = 0xFFFFFFFFFFFFFFFFU;
  r.assembly = "pin: coupler.angle = -0.5 rad";
  r.version = "9.8.7";
  r.host = "somewhere";
  r.date = "2024-02-29T12:00:00Z";
  r.libraries = {{"HDF5", "1.10"}, {"SUNDIALS", "6.4"}};
  r.costs = {{"advice", 0.5}};
  r.extensions = {{256, "9.8.8", "elsewhere", "2024-03-01T12:00:00Z", 2.5, 60, 1e9}};
  r.uncertain = {{"first angle", "shoulder.angle", "rad", 0.9, 1.0, 1.1, "uniform", "triangular"}};
  r.uncertain[0].inconsistency = 0.001;
  r.shapes = {{"first angle", ShapeKind::distribution, "lower", 0.9, "rad"},
              {"first angle", ShapeKind::membership, "apex", 1.0, "rad"}};
  r.outputs = {{"tip height", "tip.position.z", "m"}, {"energy", "energy", "J"}};
  r.horizon = 0.02;
  r.time = {0, 0.01, 0.02};
  r.interval.present = true;
  r.interval.reached = 0.01;
  r.interval.why = "the enclosure became wider than 1e6";
  r.interval.at = sampleBounds(3, 2, 0.1, 1);
  r.interval.at.lower(2, 0) = r.interval.at.upper(2, 0) = nan;
  r.interval.at.lower(2, 1) = r.interval.at.upper(2, 1) = nan;
  r.interval.over = sampleBounds(3, 2, -19.95, 60);
  r.interval.tightness = 1.25;
  r.interval.shortfall = "at 0.01 s tip may be 1.25 times as wide as necessary: bisection is switched off";
  r.interval.advice = "interval.split = true";
  r.interval.pieces = 4;
  r.interval.steps = 123456789012;
  r.interval.cpu = 0.25;
  r.stochastic.present = true;
  r.stochastic.plan = Placement::sobol;
  r.stochastic.samples = 4096;
  r.stochastic.corners = 3;
  r.stochastic.alphaCorners = 18;
  r.stochastic.alphaPoints = 12;
  r.stochastic.integrated = 1000;
  r.stochastic.stopped = "the run was interrupted";
  r.stochastic.relativeTolerance = 1e-10;
  r.stochastic.absoluteTolerance = 1e-12;
  r.stochastic.packWidth = 64;
  r.stochastic.reached = 0.02;
  r.stochastic.envelope = sampleBounds(3, 2, 0.35, 0.5);
  r.stochastic.mean = sampleGrid(3, 2, 0.6);
  r.stochastic.deviation = sampleGrid(3, 2, 0.01);
  r.stochastic.probabilities = {0.05, 0.95};
  r.stochastic.quantiles = {sampleGrid(3, 2, 0.4), sampleGrid(3, 2, 0.8)};
  r.stochastic.error = sampleGrid(3, 2, 1e-12);
  r.stochastic.resolution = sampleGrid(3, 2, 1e-4);
  r.stochastic.meanError = sampleGrid(3, 2, 0.002);
  r.stochastic.meanError(1, 1) = nan;
  r.stochastic.deviationError = sampleGrid(3, 2, 0.001);
  r.stochastic.quantileLower = {sampleGrid(3, 2, 0.39), sampleGrid(3, 2, 0.79)};
  r.stochastic.quantileUpper = {sampleGrid(3, 2, 0.41), sampleGrid(3, 2, 0.81)};
  r.stochastic.covered = 0.99;
  r.stochastic.failures = 2;
  r.stochastic.failed = {{17, 0.01, "its steps became too short"}, {4098, 0, "it took too long"}};
  r.stochastic.convergence = {true, {64, 128}, {0.5, 0.6, 0.75, 1}, {0.2, nan, 0.1, 0.05}};
  r.stochastic.cpu = 1.5;
  r.stochastic.extremes = {true, {4130, 4131}, {0.91, 1.05}};
  r.stochastic.switching = {true, {0, 1, 2}, {4131, 4131, 4131}, {0, 0, 0}, {0, 0.003, 0.008}, {1.05, 0.91, 1.05}};
  r.stochastic.kept = {true, 4e6, 64, 2048, {0, 64, 4117}, {0.9, 0.95, 1.0}, {0, 4117}, {}};
  for (int i = 0; i < 12; ++i) r.stochastic.kept.motions.push_back(0.35 + i);
  r.stochastic.kept.motions.back() = nan;
  r.fuzzy.present = true;
  r.fuzzy.reached = 0.01;
  r.fuzzy.alpha = {0, 0.5, 1};
  r.fuzzy.outer = {sampleBounds(3, 2, 0.1, 1), sampleBounds(3, 2, 0.3, 0.6), sampleBounds(3, 2, 0.6, 0)};
  r.fuzzy.inner = {sampleBounds(3, 2, 0.2, 0.8), sampleBounds(3, 2, 0.4, 0.4), sampleBounds(3, 2, 0.6, 0)};
  r.fuzzy.cpu = 0.125;
  r.fuzzy.transformation = {true,
                            "extended",
                            {0},
                            {0.25},
                            Grid({3, 2}, {0, 0.1, 0.2, 0.3, nan, 0.5}),
                            Grid({3, 2}, {0, 0.01, 0.02, 0, nan, 0.01})};
  r.fuzzy.influence = {true, {0, 0.02}, Grid({2, 2, 1}, {0.5, nan, 1, 0.25})};
  r.comparison.present = true;
  r.comparison.verdict = Agreement::incomplete;
  r.comparison.why = "the run was interrupted";
  r.comparison.overestimation = sampleGrid(3, 2, 2);
  r.comparison.overestimation(0, 1) = nan;
  r.comparison.excess = sampleGrid(3, 2, 0.5);
  r.comparison.maximum = 13;
  r.comparison.median = 2.5;
  r.comparison.maximumOf = {12, nan};
  r.comparison.disputed = {{17, 1, 0, 0.09, 0.1, 1.1, 0.01, 1e-9, Decider::inDoubles, true, 2, {0.01, 0.25}},
                           {4098, 0, 1, 1.2, 1.1, 2.1, 0, 1e-9, Decider::unresolved, false, -1, {0, 0}}};
  r.margins = {{0, "tip.position.z", true, "0.5 m", "m", false, 0, 0, true},
               {1, "energy", true, "0 J", "J", true, 1, 0, true}};
  r.requirements.present = true;
  r.requirements.reached = 0.01;
  r.requirements.cpu = 0.5;
  r.requirements.why = "the enclosure is not tight enough to tell";
  r.requirements.stopped = "the run was interrupted";
  r.requirements.resize(2);
  RequirementResult& met = r.requirements[0];
  met.name = "energy kept";
  met.statement = "always energy > 0 J";
  met.until = 0.02;
  met.margin = 1;
  met.word = Decision::met;
  met.met = met.factor = met.probabilityLower = 1;
  met.violationMost = 0;
  met.violation = {nan};
  met.aloneLower = met.aloneUpper = {1};
  RequirementResult& partly = r.requirements[1];
  partly.name = "clearance";
  partly.statement = "eventually tip.position.z >= 0.5 m";
  partly.isAlways = false;
  partly.from = 0.005;
  partly.until = 0.01;
  partly.word = Decision::partly;
  partly.why = "the enclosure is not tight enough to tell";
  partly.met = 0.5;
  partly.violated = 0.25;
  partly.factor = 0.75;
  partly.violation = {0.95};
  partly.aloneLower = {0.25};
  partly.aloneUpper = {0.5};
  partly.violationSample = 17;
  partly.violationTime = 0.01;
  partly.violationLower = -0.25;
  partly.violationUpper = -0.125;
  partly.probabilityLower = 0.5;
  partly.probabilityUpper = 0.625;
  partly.samples = 4096;
  partly.violating = 1536;
  partly.shareLower = 0.6;
  partly.shareUpper = 0.65;
  partly.worstSample = 17;
  partly.worstTime = 0.01;
  partly.worstMargin = -0.2;
  partly.advice = "interval.tightness = 1.005";
  partly.metUntil = 0.0075;
  partly.estimate = {1024, 640, 380, 0.59, 0.66, 0.625};
  partly.violationLeast = 0.25;
  partly.violationMost = 0.5;
  r.requirements.cells = {{0, 0, Decision::met, {-1}, {1}},
                          {1, 1, Decision::violated, {-1}, {-0.5}},
                          {2, 1, Decision::open, {-0.5}, {0}},
                          {3, 1, Decision::met, {0}, {1}}};
  DistributionResult& d = r.distribution;
  d.present = true;
  d.wanted = 0.005;
  d.gap = 1;
  d.why = "the enclosure is not tight enough, or the outputs depend on too many quantities together";
  d.cpu = 0.125;
  d.band = 0.02;
  d.time = {0.01};
  d.point = {0, 1, 2};
  d.value = Grid({1, 2, 3}, {-1, 2, nan, 0.5, 0.75, 1});
  d.lower = Grid({1, 2, 3}, {0, 1, nan, 0, 0.25, 0.5});
  d.upper = Grid({1, 2, 3}, {0, 1, nan, 0.25, 0.75, 0.875});
  d.sampled = Grid({1, 2, 3}, {nan, nan, nan, 0, 0.375, 0.75});
  d.gaps = Grid({1, 2}, {1, 0.75});
  d.excess = Grid({1, 2}, {nan, 0.0078125});
  SensitivityResult& s = r.sensitivity;
  s.present = true;
  s.time = {0.005, 0.01};
  s.mean.lower = Grid({2, 2}, {1, 2, nan, 0.5});
  s.mean.upper = Grid({2, 2}, {1.5, 2, nan, 0.625});
  s.deviation.lower = Grid({2, 2}, {0.25, 0, nan, 0.125});
  s.deviation.upper = Grid({2, 2}, {0.25, 0.5, nan, 0.125});
  s.first.lower = s.total.lower = Grid({2, 2, 1}, {0.5, 0, nan, 0.25});
  s.first.upper = s.total.upper = Grid({2, 2, 1}, {0.75, 1, nan, 0.5});
  s.pinched = Grid({2, 2, 1}, {0.5, nan, 0.125, 1});
  s.samples = 256;
  s.firstSampled = s.totalSampled = Grid({2, 2, 1}, {0.625, nan, nan, 0.5});
  s.firstError = s.totalError = Grid({2, 2, 1}, {0.03125, nan, nan, 0.25});
  DerivativeResult& derivatives = r.of<DerivativeResult>();
  derivatives.present = true;
  derivatives.reached = 0.01;
  derivatives.why = derivatives.stopped = "the run was interrupted";
  derivatives.cpu = 0.75;
  derivatives.time = {0, 0.01};
  derivatives.lower = Grid({2, 2, 1}, {1, nan, -2, 0.25});
  derivatives.upper = Grid({2, 2, 1}, {1.5, nan, -1, 0.5});
  EquilibriaResult& equilibria = r.of<EquilibriaResult>();
  equilibria.present = true;
  equilibria.why = "1 part of the region is not settled";
  equilibria.cpu = 0.0625;
  equilibria.coordinates = "hinge.angle, slide.displacement";
  equilibria.units = "deg, mm";
  equilibria.coordinate = {1, 2};
  equilibria.number = {1, 2, 3};
  equilibria.lower = Grid({3, 2}, {-1, 0, 0, 0.5, 1, 0.25});
  equilibria.upper = Grid({3, 2}, {-0.5, 0, 0.25, 0.75, 1, 0.5});
  equilibria.stability = {1, -1, 0};
  equilibria.open = 1;
  ModesResult& modes = r.of<ModesResult>();
  modes.present = true;
  modes.cpu = 0.125;
  modes.coordinates = "hinge.angle, slide.displacement";
  modes.coordinate = {1, 2};
  modes.number = {1, 2};
  modes.mode = {1, 3};
  modes.first = {1, 2};
  modes.last = {1, 3};
  modes.reference = {2, 1};
  modes.slowest = {0.5, 2};
  modes.fastest = {0.75, 2};
  modes.lower = Grid({2, 2}, {-0.5, 1, 1, 0});
  modes.upper = Grid({2, 2}, {-0.25, 1, 1, 0});
  modes.imaginaryLower = Grid({2, 2}, {0.125, 0, 0, 0});
  modes.imaginaryUpper = Grid({2, 2}, {0.25, 0, 0, 0});
  PosturesResult& postures = r.of<PosturesResult>();
  postures.present = true;
  postures.why = "1 part of the region is not settled";
  postures.cpu = 0.125;
  postures.goal = "tool at target";
  postures.coordinates = "hinge.angle, slide.displacement";
  postures.units = "rad, m";
  postures.coordinate = {1, 2};
  postures.number = {1, 2};
  postures.lower = Grid({2, 2}, {-1, 0, 0, 0.5});
  postures.upper = Grid({2, 2}, {-0.5, 0, 0.25, 0.75});
  postures.always = {1, 0};
  postures.open = 1;
  WitnessResult& witness = r.of<WitnessResult>();
  witness.present = true;
  witness.reached = 0.5;
  witness.cpu = 0.0625;
  witness.number = {0, 18};
  witness.apart = Grid({2, 2}, {1e-9, 2e-9, 3e-9, 4e-9});
  witness.error = Grid({2, 2}, {1e-8, 2e-8, 3e-8, 4e-8});
  witness.size = {0.5, 0.25};
  WorkspaceResult& workspace = r.of<WorkspaceResult>();
  workspace.present = true;
  workspace.cpu = 0.25;
  workspace.first = "angle";
  workspace.second = "height";
  workspace.firstUnit = "rad";
  workspace.secondUnit = "m";
  workspace.from = {0, 0.5};
  workspace.to = {0.5, 1};
  workspace.besideFrom = {-1, 0, 1};
  workspace.besideTo = {0, 1, 2};
  workspace.reached = Grid({2, 3}, {-1, 0, 1, 1, 1, -1});
  workspace.least = 1.5;
  workspace.most = 2;
  SurrogateResult& polynomials = r.surrogate;
  polynomials.present = true;
  polynomials.centre = {1};
  polynomials.half = {0.25};
  polynomials.part = {0, 1};
  polynomials.term = {0, 1, 2};
  polynomials.number = {0, 1, 2, 3};
  polynomials.row = {0, 2};
  polynomials.firstTerm = {0, 0};
  polynomials.partCentre = {0, 0};
  polynomials.partHalf = {1, 1};
  polynomials.exponent = {0, 1, 2};
  polynomials.first = {0, 3, 3, 4};
  polynomials.count = {3, 0, 1, 0};
  polynomials.radius = {1e-9, nan, 0.5, nan};
  polynomials.coefficient = {1, -2, 0.5, 7};
  r.picture.present = r.picture.places.present = true;
  r.picture.why = "the enclosure became wider than 1e6";
  r.picture.directions = {{"x", 0}, {"y", 0}, {"z", -9.81}};
  r.picture.points = {{"inertial", true, true}, {"tip", false, false}};
  r.picture.parts = {{"hinge", "revolute", PartKind::joint, 0, 0, 1, 0, 0},
                     {"rod", "link", PartKind::rigid, 0, 1, 0, 0, 0},
                     {"bob", "mass", PartKind::mass, 1, 1, 0, 0, 0.25}};
  r.picture.axes = {{"hinge.axis", 0}};
  r.picture.places = {true,
                      {0, 0.02},
                      {0, 0, 0, 0, 0.3, -0.4, 0, 0, 0, 0, 0.4, -0.3},
                      {1, 0, 0, 1, 0, 0},
                      {0, 3},
                      std::vector<double>(24, 0.125),
                      {0, 0, 0, 0, 0.2, -0.5, 0, 0, 0, nan, nan, nan},
                      {0, 0, 0, 0, 0.4, -0.3, 0, 0, 0, nan, nan, nan},
                      std::vector<double>(12, 0.01),
                      {-1, 0, 1}};
  r.picture.profiles = {{"road", 1, 0.5, {-0.1, 0, 0.1, nan, 0, 0.2}}};
  r.limits = {1800, 8e9, 1200, 5e9, 18};
  r.cpu = 2.25;
  r.memory = 1.5e9;
  r.stopped = "the run was interrupted";
  return r;
}

}  // namespace gamut
