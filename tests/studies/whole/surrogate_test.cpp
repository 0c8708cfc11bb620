// What the results keep of the outputs, evaluated: against integration, and against the bounds of probabilities.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "analyses/samples/ensemble.hpp"
#include "analyses/samples/sampling.hpp"
#include "analyses/surrogate/surrogate_evaluator.hpp"
#include "studies/machine.hpp"
#include "studies/results/results_file.hpp"
#include "studies/running/run.hpp"
#include "tests/studies/sample_study.hpp"
#include "tests/studies/temporary_folder.hpp"

namespace gamut {
namespace {

struct Sampled {
  std::vector<double> values, outputs, errors;
};

std::vector<std::size_t> rowsOf(const Results& results) {
  std::vector<std::size_t> rows;
  for (const double row : results.surrogate.row)
    if (rows.empty() || static_cast<double>(rows.back()) < row) rows.push_back(static_cast<std::size_t>(row));
  return rows;
}

Sampled sampled(const Study& study, const Results& results, std::size_t count, const std::vector<std::size_t>& rows,
                const std::vector<std::size_t>& outputs) {
  const SurrogateEvaluator evaluator(results.surrogate, rows, outputs);
  const std::size_t n = study.uncertain.size(), cells = rows.size() * outputs.size();
  std::vector<Uncertain> uncertain;
  for (const UncertainQuantity& quantity : study.uncertain) uncertain.push_back(quantity.uncertain);
  Sampling sampling(Plan::random, n, count, 11);
  Sampled all{std::vector<double>(count * n), std::vector<double>(count * cells), std::vector<double>(count * cells)};
  for (std::size_t i = 0; i < count; ++i) {
    const std::vector<double> values = sampling.values(i, uncertain);
    std::ranges::copy(values, all.values.begin() + static_cast<std::ptrdiff_t>(i * n));
    evaluator.settle(std::span(all.values).subspan(i * n, n));
  }
  evaluator.evaluate(all.values, all.outputs, all.errors);
  return all;
}

/// 100 samples of 7 outputs at 301 times: none is farther off than its error and what CVODE at 1e-12 is off by, which
/// is measured by CVODE at 1e-13.
TEST(Surrogates, AreAsGoodAsTheySay) {
  const Study study = readStudy(GAMUT_SOURCE_DIR "/studies/examples/double_pendulum/study.toml");
  TemporaryFolder folder;
  writeResults(run(study), folder.path("r.h5"));
  const Results results = readResults(folder.path("r.h5"));
  const std::vector<std::size_t> rows = rowsOf(results);
  ASSERT_EQ(rows.size(), study.times.size());
  std::vector<std::size_t> outputs;
  for (std::size_t o = 0; o < results.requirements.front().margin; ++o) outputs.push_back(o);
  constexpr std::size_t count = 100;
  const Sampled all = sampled(study, results, count, rows, outputs);
  const Machine machine(study);
  EnsembleOptions fine = study.ensemble, finer = fine;
  fine.tolerance = {1e-12, 1e-12};
  finer.tolerance = {1e-13, 1e-13};
  std::size_t checked = 0;
  double greatest = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::vector<double> values(
        all.values.begin() + static_cast<std::ptrdiff_t>(i * study.uncertain.size()),
        all.values.begin() + static_cast<std::ptrdiff_t>((i + 1) * study.uncertain.size()));
    const SampleBlock one = integrateValues(machine.motion, fine, values),
                      other = integrateValues(machine.motion, finer, values);
    for (std::size_t r = 0; r < rows.size(); ++r)
      for (std::size_t k = 0; k < outputs.size(); ++k) {
        const std::size_t at = (i * rows.size() + r) * outputs.size() + k;
        const double truth = other(0, rows[r], outputs[k]);
        const double measured = 4 * std::fabs(one(0, rows[r], outputs[k]) - truth) + 1e-13 * (1 + std::fabs(truth));
        ASSERT_LE(std::fabs(all.outputs[at] - truth), all.errors[at] + measured) << i << " " << r << " " << k;
        greatest = std::max(greatest, all.errors[at]);
        ++checked;
      }
  }
  EXPECT_GE(checked, 10000U);
  EXPECT_LT(greatest, 1e-3);
}

/// The pendulum of sampleStudy with four quantities, at its last output time.
Study fourQuantities() {
  std::string text = sampleStudyWith("[[output]]\nname = \"angle\"", R"([[uncertain]]
name = "length"
quantity = "rod.length"
interval = "± 2 %"
distribution = { type = "triangular" }
[[uncertain]]
name = "gravity"
quantity = "gravity.z"
interval = "± 0.5 %"
[[uncertain]]
name = "rate"
quantity = "hinge.rate"
interval = "± 10 %"
distribution = { type = "normal", deviation = "0.02 rad/s" }
[[output]]
name = "angle")");
  return readStudyText(text + "[distribution]\ntimes = [0.5]\n", "s.toml");
}

/// The shares of 200000 samples leave the bounds by no more than their band.
TEST(Surrogates, AgreeWithBoundsOfProbabilities) {
  const Study study = fourQuantities();
  const Results results = run(study);
  ASSERT_TRUE(results.surrogate.present);
  EXPECT_LE(results.distribution.gap, 0.005);
  constexpr std::size_t count = 200000;
  for (std::size_t output = 0; output < 2; ++output) {
    Sampled all = sampled(study, results, count, {5}, {output});
    std::ranges::sort(all.outputs);
    const double error = *std::ranges::max_element(all.errors);
    const double band = std::sqrt(std::log(2 / 1e-9) / (2.0 * count));
    const DistributionResult& d = results.distribution;
    const std::span<const double> values = d.values(0, output);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto share = [&](double value) {
        return static_cast<double>(std::ranges::upper_bound(all.outputs, value) - all.outputs.begin()) / count;
      };
      EXPECT_LE(d.lower(0, output, i), share(values[i] + error) + band) << values[i];
      EXPECT_GE(d.upper(0, output, i), share(values[i] - error) - band) << values[i];
    }
  }
}

/// Estimates by samples that have one quantity of others (Saltelli et al., Computer Physics Communications 181, 2010;
/// Jansen, ibid. 117, 1999), in 20 batches whose scatter tells their standard errors, lie within six of these.
TEST(Surrogates, AgreeWithBoundsOfSobolIndices) {
  const Study study = fourQuantities();
  const Results results = run(study);
  constexpr std::size_t batches = 20, count = 5000, n = 4;
  const SurrogateEvaluator evaluator(results.surrogate, {5}, {1});
  const Sampled a = sampled(study, results, batches * count, {5}, {1});
  std::vector<double> b = a.values;  // those of other samples, independent of `a` one by one
  std::rotate(b.begin(), b.begin() + n * 17, b.end());
  const auto outputsOf = [&](const std::vector<double>& values) {
    std::vector<double> outputs(batches * count), errors(outputs.size());
    evaluator.evaluate(values, outputs, errors);
    return outputs;
  };
  const std::vector<double> ofB = outputsOf(b);
  const SensitivityResult& s = results.sensitivity;
  const std::size_t cell = (s.time.size() - 1) * 2 + 1;
  const double mean = 0.5 * (s.mean.lower.data[cell] + s.mean.upper.data[cell]);
  for (std::size_t q = 0; q < n; ++q) {
    std::vector<double> mixed = a.values;
    for (std::size_t i = q; i < mixed.size(); i += n) mixed[i] = b[i];
    const std::vector<double> ofMixed = outputsOf(mixed);
    std::vector<double> first, total;
    for (std::size_t batch = 0; batch < batches; ++batch) {
      double all = 0, firstSum = 0, totalSum = 0;
      for (std::size_t i = batch * count; i < (batch + 1) * count; ++i) {
        const double x = a.outputs[i] - mean, y = ofB[i] - mean, z = ofMixed[i] - mean;
        all += 0.5 * (x * x + y * y);
        firstSum += y * (z - x);
        totalSum += 0.5 * (x - z) * (x - z);
      }
      first.push_back(firstSum / all);
      total.push_back(totalSum / all);
    }
    const auto expectMeets = [&](double lower, double upper, const std::vector<double>& estimates) {
      double middle = 0, square = 0;
      for (const double x : estimates) middle += x / batches;
      for (const double x : estimates) square += (x - middle) * (x - middle) / (batches - 1);
      const double error = 6 * std::sqrt(square / batches);
      EXPECT_LE(lower, middle + error) << q;
      EXPECT_GE(upper, middle - error) << q;
      EXPECT_LE(upper - lower, 0.01) << q;
    };
    expectMeets(s.first.lower.data[cell * n + q], s.first.upper.data[cell * n + q], first);
    expectMeets(s.total.lower.data[cell * n + q], s.total.upper.data[cell * n + q], total);
    // And the estimates that the results hold, within three times their intervals.
    const std::size_t i = cell * n + q;
    EXPECT_LE(s.first.lower.data[i], s.firstSampled.data[i] + 3 * s.firstError.data[i]) << q;
    EXPECT_GE(s.first.upper.data[i], s.firstSampled.data[i] - 3 * s.firstError.data[i]) << q;
    EXPECT_LE(s.total.lower.data[i], s.totalSampled.data[i] + 3 * s.totalError.data[i]) << q;
    EXPECT_GE(s.total.upper.data[i], s.totalSampled.data[i] - 3 * s.totalError.data[i]) << q;
    EXPECT_LT(s.firstError.data[i] + s.totalError.data[i], 0.1) << q;
  }
}

TEST(Surrogates, AreNotOfTimesThatAreNotKept) {
  std::string text = sampleStudy + "[distribution]\ntimes = [0.2]\nstorage = 6e-7\n";
  const Study study = readStudyText(text, "s.toml");
  const Results results = run(study);
  ASSERT_TRUE(results.surrogate.present);
  const std::vector<std::size_t> rows = rowsOf(results);
  EXPECT_LT(rows.size(), 6U);
  EXPECT_EQ(rows.back(), 5U);
  EXPECT_NE(std::ranges::find(rows, 2U), rows.end());
  EXPECT_THROW(SurrogateEvaluator(results.surrogate, {0}, {0}), std::invalid_argument);
  SurrogateEvaluator(results.surrogate, rows, {0, 1});
  PackedSurrogate wrong = results.surrogate;
  wrong.first.back() = 1e9;
  EXPECT_THROW(SurrogateEvaluator(wrong, rows, {0, 1}), std::invalid_argument);
}

}  // namespace
}  // namespace gamut
