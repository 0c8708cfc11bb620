// Branch and bound over a polygon's box; on each part the mean value form meets the polygon by the derivative's middle.
#include "analyses/flow/polygons/polygon_range.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "analyses/work.hpp"
#include "scalars/index.hpp"
#include "scalars/program/recorder.hpp"

namespace gamut {

using detail::at;

namespace {

constexpr double unknownBound = std::numeric_limits<double>::infinity();

bool isSmooth(const Program& g) {
  return std::ranges::none_of(g.nodes(),
                              [](const Node& node) { return !isSmooth(node.op) || isOneSided(domainOf(node.op)); });
}

}  // namespace

bool hasWidth(const Interval& parameter) { return width(parameter) > 0x1p-44 * magnitude(parameter); }

Program withTimeAsState(const Program& f) {
  Recorder recorder(f.states() + 1, f.parameters());
  std::vector<int> instead(f.nodes().size(), -1), outputs;
  instead[f.states() + f.parameters()] = recorder.state(f.states());
  const std::vector<int> here = recorder.append(f, {}, instead);
  for (const int output : f.outputNodes()) outputs.push_back(here[output]);
  return recorder.finish(outputs);
}

std::vector<char> widthsOf(const Box& parameters) {
  std::vector<char> result;
  for (const Interval& parameter : parameters) result.push_back(static_cast<char>(hasWidth(parameter)));
  return result;
}

Program withAllDerivatives(const Program& f, const std::vector<char>& isWide) {
  const Program timed = withTimeAsState(f), all = timed.differentiated(true);
  const int m = f.outputs(), n = timed.states(), k = f.parameters();
  std::vector<int> outputs(all.outputNodes().begin(), all.outputNodes().begin() + m + m * n);
  for (int i = 0; i < m; ++i)
    for (int p = 0; p < k; ++p)
      if (isWide[p] != 0) outputs.push_back(all.outputNodes()[m + m * n + i * k + p]);
  return Recorder(all).finish(outputs);
}

PolygonRange::PolygonRange(const Program& g, const Box& parameters)
    : states_(at(g.states())), parameters_(parameters), plain_(g) {
  const std::vector<char> isWide = widthsOf(parameters);
  Box middle = parameters;
  std::vector<double> centre;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    centre.push_back(midpoint(parameters[p]));
    if (isWide[p] == 0) continue;
    radius_.push_back(radius(parameters[p]));
    middle[p] = Interval(centre.back());
  }
  for (const int node : g.outputNodes()) {
    const Program own = Recorder(g).finish({node});
    std::optional<Smooth>& output = outputs_.emplace_back();
    if (!isSmooth(own)) continue;
    const Program full = withAllDerivatives(own, isWide);
    output.emplace(Smooth{Evaluator<Interval>(full), Evaluator<Interval>(own), Evaluator<double>(full)});
    output->full.setParameters(parameters);
    output->middle.setParameters(middle);
    output->numbers.setParameters(centre);
  }
  found_.resize(2 + states_ + radius_.size());
  numbers_.resize(found_.size());
}

Interval PolygonRange::over(int o, const std::vector<PolygonPlace>& places, const Interval& t, double tolerance,
                            int most) {
  output_ = o;
  const double upper = greatest(1, places, t, tolerance, most);
  if (!std::isfinite(upper)) return Interval::entire();
  const double lower = -greatest(-1, places, t, tolerance, most);
  return std::isfinite(lower) && lower <= upper ? Interval(lower, upper) : Interval::entire();
}

/// About; not of what has kinks, jumps or roots.
double PolygonRange::sample(double sign, const std::vector<double>& X, const std::vector<PolygonPlace>& places,
                            double t) {
  if (!outputs_[output_]) return -unknownBound;
  std::vector<double> place(states_ + 1, t);
  for (std::size_t b = 0; b < places.size(); ++b)
    for (std::size_t k : {0U, 1U})
      if (places[b].states[k] >= 0) place[places[b].states[k]] = X[2 * b + k] * places[b].unit[k];
  outputs_[output_]->numbers(t, place, numbers_);
  double value = sign * numbers_[0];
  for (std::size_t p = 0; p < radius_.size(); ++p) value += std::fabs(numbers_[2 + states_ + p]) * radius_[p];
  return std::isfinite(value) ? value : -unknownBound;
}

/// sign·y is no greater for X in the part and in the polygons; unknownBound: that is not known.
double PolygonRange::bound(double sign, const Part& part, const std::vector<PolygonPlace>& places, const Interval& t) {
  const Interval sided(sign);
  std::vector<Interval> place(states_ + 1, t), middle(states_ + 1, Interval(midpoint(t)));
  for (std::size_t b = 0; b < places.size(); ++b)
    for (std::size_t k : {0U, 1U}) {
      if (places[b].states[k] < 0) continue;
      place[places[b].states[k]] = part[2 * b + k] * Interval(places[b].unit[k]);
      middle[places[b].states[k]] = Interval(midpoint(part[2 * b + k])) * Interval(places[b].unit[k]);
    }
  if (!outputs_[output_]) {
    place.pop_back();
    const Interval value = sided * plain_.over(output_, t, place, parameters_);
    return isCommon(value) ? value.upper() : unknownBound;
  }
  Smooth& output = *outputs_[output_];
  Work::count(Work::boundedNode, 40);
  output.full(t, place, found_);
  double least = unknownBound;
  if (isCommon(found_[0])) least = (sided * found_[0]).upper();
  for (const Interval& value : found_)
    if (!isCommon(value)) return least;
  std::array<Interval, 1> value;
  output.middle(middle.back(), middle, value);
  const Interval byTime = found_[1 + states_] * (t - middle.back());
  Interval all = sided * value[0] + Interval(magnitude(byTime));
  for (std::size_t p = 0; p < radius_.size(); ++p)
    all += Interval(magnitude(found_[2 + states_ + p])) * Interval(radius_[p]);
  for (std::size_t b = 0; b < places.size(); ++b) {
    PlaneVector along{}, centre{};
    Interval within(0);
    for (std::size_t k : {0U, 1U}) {
      if (places[b].states[k] < 0) continue;
      const Interval slope = sided * found_[1 + at(places[b].states[k])] * Interval(places[b].unit[k]);
      centre[k] = midpoint(part[2 * b + k]);
      const Interval away = part[2 * b + k] - Interval(centre[k]);
      along[k] = midpoint(slope);
      all += (slope - Interval(along[k])) * away;
      within += Interval(along[k]) * away;
    }
    const double reach = places[b].polygon->reach(along);
    if (std::isfinite(reach)) {
      const Interval cut = Interval(reach) - dot(enclosed(along), enclosed(centre));
      all += Interval(std::min(cut.upper(), within.upper()));
    } else {
      all += within;
    }
  }
  return isCommon(all) ? std::min(least, all.upper()) : least;
}

double PolygonRange::greatest(double sign, const std::vector<PolygonPlace>& places, const Interval& t, double tolerance,
                              int most) {
  struct Bounded {
    Part part;
    double bound;
    bool operator<(const Bounded& other) const { return bound < other.bound; }
  };
  const double moment = midpoint(t);
  Part whole;
  std::vector<double> X;  // of the greatest value that was met
  for (const PolygonPlace& place : places)
    for (const Interval& component : place.polygon->box()) {
      whole.push_back(component);
      X.push_back(midpoint(component));
    }
  double greatest = -unknownBound, least = unknownBound;
  for (std::size_t b = 0; b < places.size(); ++b) {
    std::vector<double> best = X;
    for (std::size_t i = 0; i < places[b].polygon->sides().size(); ++i) {
      const PlaneVector corner = places[b].polygon->corner(i);
      X[2 * b] = corner[0];
      X[2 * b + 1] = corner[1];
      const double value = sample(sign, X, places, moment);
      if (value > greatest) greatest = value, best = X;
      if (std::isfinite(value)) least = std::min(least, value);
    }
    X = std::move(best);
  }
  const double first = bound(sign, whole, places, t);
  std::priority_queue<Bounded> parts;
  parts.push({whole, first});
  for (int count = 1; count < most && !parts.empty(); count += 2) {
    const Bounded top = parts.top();
    const double wanted = greatest + tolerance * (greatest - least);
    if (top.bound <= wanted || (!outputs_[output_] && !std::isfinite(top.bound))) break;
    std::size_t widest = 0;
    for (std::size_t i = 1; i < whole.size(); ++i)
      if (width(top.part[i]) * width(whole[widest]) > width(top.part[widest]) * width(whole[i])) widest = i;
    const Halves halves = bisect(top.part[widest]);
    if (!(width(halves.lower) < width(top.part[widest]))) break;
    parts.pop();
    for (const Interval& half : {halves.lower, halves.upper}) {
      Part part = top.part;
      part[widest] = half;
      const std::size_t b = widest / 2;
      if (places[b].polygon->isAway({part[2 * b], part[2 * b + 1]})) continue;
      parts.push({part, std::min(top.bound, bound(sign, part, places, t))});
      std::vector<double> centre;
      for (const Interval& component : part) centre.push_back(midpoint(component));
      bool isInside = true;
      for (std::size_t k = 0; k < places.size(); ++k)
        isInside = isInside && places[k].polygon->holds({centre[2 * k], centre[2 * k + 1]});
      if (isInside) greatest = std::max(greatest, sample(sign, centre, places, moment));
    }
  }
  return parts.empty() ? first : parts.top().bound;
}

}  // namespace gamut
