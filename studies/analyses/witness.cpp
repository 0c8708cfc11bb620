// Each sample four times: by either solver at the study's tolerance and at a hundredth of it. The latter two are
// compared; what the former two differ from them by bounds their errors with a factor of some ten to spare.
#include "studies/analyses/witness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "analyses/samples/implicit_witness.hpp"
#include "analyses/samples/sampling.hpp"
#include "analyses/samples/witness.hpp"
#include "mechanics/assembly.hpp"
#include "mechanics/balance.hpp"
#include "mechanics/description/refusal.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "studies/analysis.hpp"
#include "studies/running/context.hpp"
#include "studies/running/sampled_study.hpp"
#include "studies/settings.hpp"
#include "studies/words.hpp"

namespace gamut {
namespace {

constexpr double tighter = 100, rounding = 0x1p-40;

std::vector<Field> fieldsOf(WitnessResult& w) {
  using namespace dimension;
  constexpr std::string_view sample = "/witness/number";
  return w.fieldsAnd(
      {{"number", &w.number, unit::one, "of the samples, as in /stochastic; that of the centre last", {sample}},
       {"apart",
        &w.apart,
        unit::none,
        "how far both motions are apart at any output time, in the output's unit",
        {sample, output}},
       {"error", &w.error, unit::none, "of both together, measured at a hundred times the tolerance", {sample, output}},
       {"size", &w.size, unit::ofOutput, "greatest amount of the output in these motions", {output}}});
}

/// The greatest difference of each output.
void widen(std::span<double> by, const std::vector<double>& a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) by[i % by.size()] = std::max(by[i % by.size()], std::abs(a[i] - b[i]));
}

/// One motion by both solvers.
class Followers {
 public:
  Followers(const Run& run, const Motion& motion)
      : balance_(run.study.mechanism, run.machine.freeParameters),
        explicit_(motion),
        start_(run.machine.alongCourses(startOf(run.study, balance_))),
        tolerance_(run.study.ensemble.tolerance) {
    const Study& study = run.study;
    implicit_.r = run.machine.alongCourses(balance_.rows);
    implicit_.g = run.machine.alongCourses(
        balance_.outputs(study.mechanism, run.machine.freeParameters, outputExpressions(study)));
    implicit_.isAlgebraic = balance_.isAlgebraic;
    implicit_.times = explicit_.times;
    bySolved_.emplace(explicit_, study.ensemble.method, run.watch.stop());
    byBalance_.emplace(implicit_, run.watch.stop());
  }

  /// Returns why it does not come to the end, or nothing.
  std::string compare(const std::vector<double>& start, std::span<double> apart, std::span<double> error,
                      std::vector<double>& size) {
    const auto parameters = start.begin() + explicit_.f.states();
    const std::vector<double> x(start.begin(), parameters), p(parameters, start.end());
    Evaluator<double> first(start_);
    first.setParameters(p);
    const std::vector<double> y = first(0.0, x);
    const std::size_t numbers = explicit_.times.size() * explicit_.outputs();
    std::vector<std::vector<double>> solved, balanced;
    for (const Tolerance& tolerance : {tolerance_, tolerance_.tightened(tighter)}) {
      solved.emplace_back(numbers);
      balanced.emplace_back(numbers);
      const Integration one = bySolved_->integrate(start, tolerance, solved.back());
      if (!one.why.empty()) return fmt::format("ends at {}: {}", reachedText(one.reached), one.why);
      const Integration other = byBalance_->integrate(y, p, tolerance, balanced.back());
      if (!other.why.empty()) return fmt::format("ends at {} in balance: {}", reachedText(other.reached), other.why);
    }
    std::vector<double> second(apart.size(), 0.0);
    std::ranges::fill(apart, 0.0);
    std::ranges::fill(error, 0.0);
    widen(apart, solved[1], balanced[1]);
    widen(error, solved[0], solved[1]);
    widen(second, balanced[0], balanced[1]);
    for (std::size_t i = 0; i < error.size(); ++i) error[i] += second[i];
    widen(size, solved[1], std::vector<double>(numbers, 0.0));
    return {};
  }

 private:
  /// y at the start of a motion, of the numbers that machines take.
  static Program startOf(const Study& study, const Balance& balance) {
    return recordedOf(study, nullptr, balance.size(), [&](const Assembly<Recorded>& assembly) {
      std::vector<Recorded> y(balance.size(), Recorded(0.0));
      auto next = y.begin();
      for (const std::vector<std::string>* names : {&balance.coordinates, &balance.ownStates, &balance.rates}) {
        if (names == &balance.rates) next = y.end() - static_cast<std::ptrdiff_t>(names->size());
        for (const std::string& name : *names) *next++ = assembly.output(name);
      }
      return y;
    });
  }

  Balance balance_;
  Motion explicit_;
  ImplicitMotion implicit_;
  Program start_;
  Tolerance tolerance_;
  std::optional<Witness> bySolved_;
  std::optional<ImplicitWitness> byBalance_;
};

class WitnessAnalysis final : public AnalysisOf<WitnessAnalysis, WitnessResult> {
 public:
  std::string_view section() const override { return "witness"; }
  std::string_view meaning() const override { return "samples followed once more by other equations"; }
  void describe(Settings& s) override {
    s.whole(
        {"samples",
         "how many, the nominal motion among them, are followed once more by SUNDIALS IDA: forces and multipliers of "
         "loops in balance, nothing solved beforehand; in dynamics where nothing jumps",
         "0"},
        0, 1000, samples_);
  }
  bool isAsked() const override { return samples_ > 0; }
  std::optional<Refusal> refusal(const Study& study) const override {
    if (!isAsked()) return {};
    if (!study.moves() || study.isMotionGiven())
      return Refusal{"samples", "nothing is integrated that a witness could follow", "no such key"};
    if (!study.asksFor<StochasticResult>())
      return Refusal{"samples", "there are no samples to follow", "\"stochastic\" in study.compare"};
    try {
      Balance::checkFit(study.mechanism);
    } catch (const UnfitPart& unfit) {
      return Refusal{"samples", unfit.problem() + ", which no witness follows", unfit.expected()};
    }
    return {};
  }

  void find(Run& run, const Results& before, WitnessResult& result) const try {
    const UncertainMotion& motion = run.machine.motion;
    const EnsembleOptions options =
        ensembleOptions(run.machine, before, static_cast<std::size_t>(before.stochastic.samples));
    Sampling sampling(options.plan, run.study.uncertain.size(), options.samples, options.seed);
    sampling.correlate(motion.dependence.copulas);
    Followers followers(run, motion.motion);
    const std::size_t outputs = run.study.outputs.size(),
                      count = std::min(static_cast<std::size_t>(samples_), sampling.samples() + 1);
    std::vector<double> apart, error;
    result.size.assign(outputs, 0.0);
    for (std::size_t k = 0; k < count; ++k) {
      const std::int64_t number = k + 1 == count ? before.stochastic.centre() : static_cast<std::int64_t>(k);
      std::vector<double> itsApart(outputs), itsError(outputs);
      const std::string why =
          followers.compare(k + 1 == count ? motion.nominal : motion.start(sampling.values(k, motion.uncertain)),
                            itsApart, itsError, result.size);
      if (*run.watch.stop()) break;
      if (why.empty()) {
        result.number.push_back(static_cast<double>(number));
        apart.insert(apart.end(), itsApart.begin(), itsApart.end());
        error.insert(error.end(), itsError.begin(), itsError.end());
      } else if (result.why.empty()) {
        result.why = fmt::format("{} {}", before.stochastic.nameOf(number), why);
      }
    }
    result.reached = result.number.empty() ? 0 : run.study.horizon;
    result.apart = Grid({result.number.size(), outputs}, std::move(apart));
    result.error = Grid({result.number.size(), outputs}, std::move(error));
    if (const auto found = result.unexplained()) {
      const auto [k, i] = *found;
      result.why =
          fmt::format("{} differs by {} of '{}' from itself in balance, which errors of {} do not explain",
                      before.stochastic.nameOf(static_cast<std::int64_t>(result.number[k])),
                      numberText(result.apart(k, i)), run.study.outputs[i].name, numberText(result.error(k, i)));
    }
  } catch (const UnfitPart& unfit) {
    result.why = unfit.problem() + ", which no witness follows";
  }

 private:
  int samples_ = 0;
};

}  // namespace

bool WitnessResult::agrees(std::size_t sample, std::size_t output) const {
  return apart(sample, output) <= error(sample, output) + rounding * size[output];
}

std::optional<std::pair<std::size_t, std::size_t>> WitnessResult::unexplained() const {
  for (std::size_t k = 0; k < number.size(); ++k)
    for (std::size_t i = 0; i < size.size(); ++i)
      if (!agrees(k, i)) return std::pair{k, i};
  return std::nullopt;
}

std::string WitnessResult::unfinished() const {
  return unexplained() ? "differences from themselves in balance are more than errors explain"
                       : FurtherPart::unfinished();
}

std::string WitnessResult::title() const { return "samples by other equations"; }

std::vector<std::string> WitnessResult::told() const {
  if (number.empty()) return {};
  double part = 0, ofErrors = 0;
  for (std::size_t k = 0; k < number.size(); ++k)
    for (std::size_t i = 0; i < size.size(); ++i) {
      if (!(size[i] > 0)) continue;
      part = std::max(part, apart(k, i) / size[i]);
      ofErrors = std::max(ofErrors, error(k, i) / size[i]);
    }
  return {
      fmt::format("{}, followed by forces and multipliers in balance (IDA), {} by {} of outputs' amounts at most; "
                  "errors of both are {} at most",
                  countText(number.size(), "sample"), number.size() == 1 ? "differs" : "differ", atMostText(part),
                  atMostText(ofErrors))};
}

void WitnessResult::describe(std::vector<Group>& groups) {
  groups.push_back(groupOf("/witness", "samples followed once more by other equations", *this, fieldsOf));
}

std::unique_ptr<FurtherAnalysis> witnessAnalysis() { return std::make_unique<WitnessAnalysis>(); }

}  // namespace gamut
