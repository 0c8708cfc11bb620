// Samples where the enclosure's polynomials tell that outputs are extreme: of several quantities in which an output
// turns, neither corners nor any number of samples of a plan come near that, and what is guaranteed would seem wide.
#include <algorithm>
#include <cmath>
#include <functional>

#include "studies/running/flow_of_study.hpp"
#include "studies/running/units.hpp"

namespace gamut {
namespace {

struct Candidate {
  double missing = 0;  // to the corners, of what these span
  const std::vector<double>* values = nullptr;
};

double widthAt(const Envelope& sampled, std::size_t row, std::size_t output) {
  return sampled.upper(row, output) - sampled.lower(row, output);
}

/// At a time; what hardly varies beside other times counts as a thousandth of the widest.
double widthOf(const Envelope& sampled, const std::vector<double>& widest, std::size_t row, std::size_t output) {
  constexpr double hardly = 1e-3;
  return std::max(widthAt(sampled, row, output), hardly * widest[output]);
}

/// Those beyond the corners by more than is worth a sample, the farthest first. However many samples there are beside
/// the corners, they are the same.
std::vector<Candidate> candidatesOf(const Study& study, const Enclosure& enclosure, const EnsembleRun& ensemble) {
  constexpr double hardly = 1e-3, noise = 1e-9;  // of what corners span; of the output itself
  const Envelope sampled = ensemble.cornerEnvelope();
  const std::vector<int> outputs = plainOutputs(study);
  std::vector<double> widest(study.outputs.size(), 0.0);
  for (std::size_t row = 0; row < study.times.size(); ++row)
    for (std::size_t o = 0; o < widest.size(); ++o) widest[o] = std::fmax(widest[o], widthAt(sampled, row, o));
  std::vector<Candidate> candidates;
  const auto add = [&](double missing, double width, double value, const std::vector<double>& values) {
    if (!values.empty() && missing > hardly * width && missing > noise * std::fabs(value))
      candidates.push_back({missing / width, &values});
  };
  for (std::size_t row = 0; row < enclosure.extremes.size(); ++row)
    for (const int output : outputs) {
      const auto o = static_cast<std::size_t>(output);
      if (o >= enclosure.extremes[row].size()) continue;
      const OutputExtremes& extremes = enclosure.extremes[row][o];
      const double width = widthOf(sampled, widest, row, o);
      add(sampled.lower(row, o) - extremes.least, width, extremes.least, extremes.leastAt);
      add(extremes.greatest - sampled.upper(row, o), width, extremes.greatest, extremes.greatestAt);
    }
  std::ranges::stable_sort(candidates, std::greater<>(), &Candidate::missing);
  for (const std::vector<OutputExtremes>& level : enclosure.levelExtremes)  // hardly any sample is where these are
    for (const int output : outputs)
      for (const auto& values :
           {&level[static_cast<std::size_t>(output)].leastAt, &level[static_cast<std::size_t>(output)].greatestAt})
        if (!values->empty()) candidates.push_back({0, values});
  return candidates;
}

}  // namespace

std::vector<std::size_t> rowsOfExtremes(const Study& study) {
  constexpr std::size_t mostCandidates = 8192;
  std::vector<std::size_t> rows;
  if (!study.asksFor<StochasticResult>() || study.uncertain.empty()) return rows;
  const std::size_t times = study.times.size(), both = 2 * std::max<std::size_t>(study.outputs.size(), 1),
                    every = std::max<std::size_t>(1, (times * both + mostCandidates - 1) / mostCandidates);
  for (std::size_t row = (times - 1) % every; row < times; row += every) rows.push_back(row);  // the last among them
  return rows;
}

std::vector<std::vector<double>> extremePoints(const Study& study, const Enclosure& enclosure,
                                               const SampledMotion& samples) {
  constexpr double alike = 0.05;  // of half the ranges: of what turns there little is lost
  constexpr std::size_t mostOfAll = 256, mostOfLevels = 1024;
  const UncertainMotion& motion = samples.motion;
  std::vector<std::vector<double>> points;
  for (const Candidate& candidate : candidatesOf(study, enclosure, *samples.ensemble)) {
    if (points.size() == (candidate.missing > 0 ? mostOfAll : mostOfAll + mostOfLevels)) {
      if (candidate.missing > 0) continue;
      break;
    }
    std::vector<double> values;
    for (std::size_t q = 0; q < motion.uncertain.size(); ++q)
      values.push_back(study.uncertain[q].varies ? motion.uncertain[q].nominal : (*candidate.values)[motion.slot[q]]);
    const auto isAlike = [&](const std::vector<double>& other) {
      for (std::size_t q = 0; q < values.size(); ++q)
        if (std::fabs(values[q] - other[q]) > 0.5 * alike * width(motion.uncertain[q].range)) return false;
      return true;
    };
    if (std::ranges::none_of(points, isAlike)) points.push_back(std::move(values));
  }
  return points;
}

}  // namespace gamut
