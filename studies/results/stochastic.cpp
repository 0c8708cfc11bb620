// What the file says of the samples, together and one by one.
#include "studies/results/stochastic.hpp"

#include <fmt/format.h>

#include <utility>

#include "studies/words.hpp"

namespace gamut {
namespace {

std::vector<Field> fieldsOfPlan(StochasticResult& r) {
  return {{"plan", Choice::of(r.plan), unit::none, "how the samples were placed"},
          {"samples", &r.samples, unit::none, "samples of the plan, which count in the statistics", allowed::count},
          {"corners", &r.corners, unit::none, "corners of the uncertain box, sampled besides", allowed::count},
          {"alpha_corners", &r.alphaCorners, unit::none, "corners of the alpha-cuts, sampled besides", allowed::count},
          {"alpha_points", &r.alphaPoints, unit::none,
           "points of the transformation inside the alpha-cuts, sampled besides", allowed::count},
          {"integrated", &r.integrated, unit::none,
           "how many of samples, corners, centre, points and extremes were followed", allowed::count},
          {"failures", &r.failures, unit::none, "how many of these did not arrive at the horizon", allowed::count},
          {"relative_tolerance", &r.relativeTolerance, unit::one, "of the integration; 0 where nothing is integrated"},
          {"absolute_tolerance", &r.absoluteTolerance, unit::none, "likewise, in the unit of each state"},
          {"pack_width",
           &r.packWidth,
           unit::none,
           "samples of one number / `pack_width`, rounded down, were integrated together, in common steps; corners and "
           "centre, counted from the first corner, likewise; points from the first that looks for turns, and from the "
           "first behind these; extremes from the first",
           {1, allowed::count.greatest}}};
}

std::vector<Field> fieldsOf(StochasticResult& r) {
  using namespace dimension;
  std::vector<Field> own = fieldsOfPlan(r);
  const std::vector<Field> statistics = {
      {"envelope",
       &r.envelope,
       unit::ofOutput,
       "least and greatest of all samples, corners, centre, points and extremes; like all that samples say, NaN beyond "
       "`reached`",
       {time, output}},
      {"mean", &r.mean, unit::ofOutput, "mean of the samples", {time, output}},
      {"mean_error",
       &r.meanError,
       unit::ofOutput,
       "half the 95 % confidence interval of the mean of all motions, from 16 independent batches of samples; NaN "
       "where none holds",
       {time, output}},
      {"deviation", &r.deviation, unit::ofOutput, "standard deviation of the samples", {time, output}},
      {"deviation_error", &r.deviationError, unit::ofOutput, "likewise, of the standard deviation", {time, output}},
      {"error", &r.error, unit::ofOutput, "measured error of the integration of samples", {time, output}},
      {"probability", &r.probabilities, unit::one, "probabilities of the quantiles", {probability}, allowed::share},
      {"quantiles",
       &r.quantiles,
       unit::ofOutput,
       "quantiles of the samples, from a histogram",
       {probability, time, output}},
      {"quantile_lower",
       &r.quantileLower,
       unit::ofOutput,
       "lower end of the 95 % confidence interval of the quantile of all motions: for the plan random from the order "
       "of the samples, otherwise from 16 independent batches; NaN where none holds",
       {probability, time, output}},
      {"quantile_upper", &r.quantileUpper, unit::ofOutput, "upper end", {probability, time, output}},
      {"covered", &r.covered, unit::one,
       "share of all motions that lies, in each output at each time, between the least and the greatest sample with a "
       "confidence of 95 % (Wilks); 0 unless all samples arrived and are independent",
       allowed::share},
      {"resolution",
       &r.resolution,
       unit::ofOutput,
       "no quantile is farther than this from that of the samples themselves",
       {time, output}}};
  own.insert(own.end(), statistics.begin(), statistics.end());
  return r.fieldsAnd(std::move(own));
}

std::vector<Field> fieldsOfFailed(FailedSampleResult& f) {
  return {{"number", &f.number, unit::none, "number of the sample, as of disputed ones", allowed::count},
          {"reached", &f.reached, unit::second, "how far it came"},
          {"why", &f.why, unit::none, "why no farther"}};
}

std::vector<Field> fieldsOfConvergence(ConvergenceResult& c) {
  constexpr std::string_view samples = "/stochastic/convergence/samples";
  return {{"samples", &c.samples, unit::none, "so many of the first samples of the plan", {samples}, allowed::count},
          {"spanned",
           &c.spanned,
           unit::one,
           "share of the envelope of all that these span, averaged over time",
           {samples, dimension::output}},
          {"mean_error",
           &c.meanError,
           unit::one,
           "half the 95 % confidence interval of the mean, in standard deviations, averaged over time; NaN where none "
           "holds",
           {samples, dimension::output}}};
}

std::vector<Field> fieldsOfExtremes(ExtremeSamples& e) {
  constexpr std::string_view number = "/stochastic/extremes/number";
  return {{"number", &e.number, unit::none, "number of the sample, as of disputed ones", {number}, allowed::count},
          {"values", &e.values, unit::ofQuantity, "of the uncertain quantities", {number, dimension::quantity}}};
}

std::vector<Field> fieldsOfSwitching(SwitchingResult& s) {
  constexpr std::string_view entry = "/stochastic/switching/entry";
  return {{"entry", &s.entry, unit::none, "its number", {entry}, allowed::count},
          {"number", &s.number, unit::none, "number of the sample, as of disputed ones", {entry}, allowed::count},
          {"quantity", &s.quantity, unit::none, "number of the uncertain quantity", {entry}, allowed::count},
          {"from",
           &s.from,
           unit::second,
           "from when on it has the value; the first of each is 0",
           {entry},
           {0, allowed::finite.greatest}},
          {"value", &s.value, unit::none, "in the unit of the quantity", {entry}, allowed::finite}};
}

std::vector<Field> fieldsOfKept(KeptSamples& k) {
  using namespace dimension;
  return {
      {"storage", &k.storage, unit::byte, "that values and motions may take"},
      {"values_every", &k.valuesEvery, unit::none,
       "`values` are of every so manyth sample by number, and of the centre; 0: of none", allowed::count},
      {"motions_every", &k.motionsEvery, unit::none, "`motions` likewise", allowed::count},
      {"number",
       &k.number,
       unit::none,
       "of the samples whose values are kept, counted as those of disputed samples",
       {sample},
       allowed::count},
      noise({"values", &k.values, unit::ofQuantity, "of the uncertain quantities", {sample, quantity}}),
      {"motion_number", &k.motionNumber, unit::none, "of the samples whose motions are kept", {motion}, allowed::count},
      noise({"motions",
             &k.motions,
             unit::ofOutput,
             "outputs of these samples, as they count in the statistics; NaN where a sample did not arrive",
             {motion, time, output}})};
}

}  // namespace

std::string KeptSamples::text() const {
  const auto some = [](std::int64_t every) {
    return every == 0 ? std::string("none") : every == 1 ? std::string("all") : fmt::format("one in {}", every);
  };
  return fmt::format("values of {}, motions of {}", some(valuesEvery), some(motionsEvery));
}

std::string StochasticResult::nameOf(std::int64_t number) const {
  const std::int64_t corner = number - samples;
  if (!present || corner < 0 || number >= planned()) return fmt::format("sample {}", number);
  if (number == centre()) return "the centre";
  if (number >= firstExtreme()) return fmt::format("extreme {}", number - firstExtreme());
  if (number > centre()) return fmt::format("point {} of the alpha-cuts", number - centre() - 1);
  return corner < corners ? fmt::format("corner {}", corner)
                          : fmt::format("corner {} of the alpha-cuts", corner - corners);
}

std::string StochasticResult::title() const {
  return integrated < planned() ? fmt::format("{} of {}", integrated, countText(planned(), "sample"))
                                : countText(samples, "sample");
}

std::string StochasticResult::amount() const {
  const std::string tolerances = relativeTolerance > 0
                                     ? fmt::format(", tolerances {} relative, {} absolute",
                                                   numberText(relativeTolerance), numberText(absoluteTolerance))
                                     : "";
  return fmt::format("plan {}, {}{}{}{}", wordOf(plan),
                     countText(corners + alphaCorners, "corner") +
                         (alphaPoints > 0 ? ", " + countText(alphaPoints, "point") + " of alpha-cuts" : "") +
                         (extremes.number.empty() ? "" : ", " + countText(planned() - firstExtreme(), "extreme")),
                     tolerances, stopped.empty() ? "" : "; not all were taken: " + stopped,
                     kept.present ? "; in the results: " + kept.text() : "");
}

void StochasticResult::describe(std::vector<Group>& groups) {
  groups.push_back(groupOf("/stochastic", "what is probable: samples of every output", *this, fieldsOf));
  groups.back().inJson = {{"envelope", ""},
                          {"error", ""},
                          {"resolution", ""},
                          {"quantiles", "quantiles/*/value"},
                          {"quantile", "quantiles/*/interval"}};
  groups.push_back(listOf("/stochastic/failed", "samples that did not arrive, the first thousand of them",
                          "/stochastic/failed/number", failed, fieldsOfFailed));
  groups.push_back(
      groupOf("/stochastic/convergence", "what fewer samples would have said", convergence, fieldsOfConvergence));
  groups.push_back(groupOf("/stochastic/extremes",
                           "points where the proved models of outputs tell that these are extreme, and worst courses "
                           "of what varies in time, sampled besides",
                           extremes, fieldsOfExtremes));
  groups.push_back(groupOf("/stochastic/switching", "the worst courses, which switch from value to value", switching,
                           fieldsOfSwitching));
  groups.push_back(groupOf("/stochastic/kept", "samples one by one, as far as they are kept", kept, fieldsOfKept));
}

}  // namespace gamut
