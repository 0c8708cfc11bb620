// What the file says of probabilities.
#include "studies/results/probability.hpp"

#include "studies/words.hpp"

namespace gamut {
namespace {

constexpr std::string_view times = "/distribution/time", points = "/distribution/point";

std::vector<Field> fieldsOf(DistributionResult& d) {
  using namespace dimension;
  return d.fieldsAnd(
      {{"cpu", &d.cpu, unit::second, "CPU time, that of sensitivities and of flows for both included"},
       {"wanted", &d.wanted, unit::one, "gap between the bounds that was aimed at", allowed::share},
       {"gap", &d.gap, unit::one, "the greatest that was left; NaN if nothing is known of some", allowed::share},
       {"band", &d.band, unit::one,
        "half the 95 % band of Dvoretzky, Kiefer and Wolfowitz about the share of samples; 0 unless all samples "
        "arrived and are independent"},
       {"time", &d.time, unit::second, "output times of which distributions are bounded", {times}},
       {"point", &d.point, unit::none, "numbers of values", {points}, allowed::count},
       {"value", &d.value, unit::ofOutput, "values, rising; behind the last NaN", {times, output, points}},
       {"lower",
        &d.lower,
        unit::one,
        "proved bound of the probability that the output is not above the value; between two values it is at least "
        "that of the lower one and at most the upper bound of the higher one",
        {times, output, points}},
       {"upper", &d.upper, unit::one, "upper bound", {times, output, points}},
       {"sampled",
        &d.sampled,
        unit::one,
        "share of the samples that is not above the value, from a histogram",
        {times, output, points}},
       {"gaps", &d.gaps, unit::one, "greatest distance of the bounds, between the values too", {times, output}},
       {"excess",
        &d.excess,
        unit::one,
        "by how much the share of samples leaves the bounds, at most",
        {times, output}}});
}

std::vector<Field> fieldsOf(SensitivityResult& s) {
  using namespace dimension;
  constexpr std::string_view when = "/sensitivity/time";
  return s.fieldsAnd(
      {{"time", &s.time, unit::second, "output times of which sensitivities are bounded", {when}},
       {"mean_lower", &s.mean.lower, unit::ofOutput, "proved bound of the mean", {when, output}},
       {"mean_upper", &s.mean.upper, unit::ofOutput, "upper bound", {when, output}},
       {"deviation_lower", &s.deviation.lower, unit::ofOutput, "of the standard deviation", {when, output}},
       {"deviation_upper", &s.deviation.upper, unit::ofOutput, "upper bound", {when, output}},
       {"first_lower",
        &s.first.lower,
        unit::one,
        "proved bound of the Sobol' index: the share of the variance that would vanish on average if the quantity were "
        "known",
        {when, output, quantity}},
       {"first_upper", &s.first.upper, unit::one, "upper bound", {when, output, quantity}},
       {"total_lower",
        &s.total.lower,
        unit::one,
        "of the total Sobol' index: the share that would stay on average if all other quantities were known",
        {when, output, quantity}},
       {"total_upper", &s.total.upper, unit::one, "upper bound", {when, output, quantity}},
       {"pinched",
        &s.pinched,
        unit::one,
        "share by which the enclosure of the output narrows where the quantity has its nominal value alone; NaN but at "
        "the times of distributions",
        {when, output, quantity}},
       {"samples", &s.samples, unit::none,
        "independent samples of the polynomials, in each of two sets and one more a quantity, that estimate the "
        "indices besides",
        allowed::count},
       {"first_sampled",
        &s.firstSampled,
        unit::one,
        "estimate of the Sobol' index (Saltelli)",
        {when, output, quantity}},
       {"first_error",
        &s.firstError,
        unit::one,
        "half the width of its 95 % confidence interval",
        {when, output, quantity}},
       {"total_sampled", &s.totalSampled, unit::one, "estimate of the total index (Jansen)", {when, output, quantity}},
       {"total_error",
        &s.totalError,
        unit::one,
        "half the width of its 95 % confidence interval",
        {when, output, quantity}}});
}

}  // namespace

std::string DistributionResult::amount() const {
  return "at " + countText(static_cast<long long>(time.size()), "time");
}

void DistributionResult::describe(std::vector<Group>& groups) {
  groups.push_back(groupOf("/distribution", "how probable values of the outputs are, proved", *this, fieldsOf));
  groups.back().inJson = {{"value", ""}, {"lower", ""}, {"upper", ""}, {"sampled", ""}, {"gaps", "gap"}};
  groups.back().makesSense = [this](std::size_t) { return areShares(lower, upper) && areShares(sampled); };
}

void SensitivityResult::describe(std::vector<Group>& groups) {
  groups.push_back(groupOf("/sensitivity", "whose doing the outputs' variance is, proved", *this, fieldsOf));
  groups.back().inJson = {{"first", "indices/*/first"},
                          {"total", "indices/*/total"},
                          {"pinched", "indices/*/pinched"},
                          {"first_sampled", "indices/*/first_sampled/0"},
                          {"first_error", "indices/*/first_sampled/1"},
                          {"total_sampled", "indices/*/total_sampled/0"},
                          {"total_error", "indices/*/total_sampled/1"}};
  groups.back().makesSense = [this](std::size_t) {
    return areShares(first.lower, first.upper) && areShares(total.lower, total.upper) && areShares(pinched);
  };
}

}  // namespace gamut
