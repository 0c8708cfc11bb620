// Outputs that are looser than the states they are computed from: of which no polynomial can be proved (a root that may
// come to zero), or which have a kink within the piece. How loose those are, about, which quantity would help most if
// it were halved, and their bounds over parts of the piece: at one time these cost no more than the outputs do.
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "analyses/flow/journey.hpp"
#include "analyses/flow/series/error_bounds.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

namespace {

constexpr double roughly = 1e-2;  // ranges of polynomials over parts of pieces

bool isLoose(const Interval& bound, const Interval& core, double aim) {
  return width(bound) - width(core) > aim * width(core);
}

}  // namespace

/// What values span at least that lie somewhere in such intervals.
class FlowFollower::Reached {
 public:
  void add(const Interval& value) {
    if (isEmpty(value)) return;
    lowest_ = std::min(lowest_, value.upper());
    highest_ = std::max(highest_, value.lower());
  }
  void add(const Reached& other) { addSpan(other.lowest_, other.highest_); }
  void addSpan(double lowest, double highest) {
    lowest_ = std::min(lowest_, lowest);
    highest_ = std::max(highest_, highest);
  }
  /// A point where all may be the same; empty of none.
  Interval span() const {
    if (lowest_ <= highest_) return {lowest_, highest_};
    return std::isfinite(lowest_) ? Interval(0.5 * lowest_ + 0.5 * highest_) : Interval::empty();
  }

 private:
  double lowest_ = std::numeric_limits<double>::infinity(), highest_ = -lowest_;
};

/// An output by plain intervals at these ξ, with or without what remainders add; empty where they know nothing.
Interval FlowFollower::valueAt(int output, const Box& place, bool hasRest) {
  std::vector<Interval> states, parameters;
  for (int i = 0; i < task_.motion.states(); ++i) {
    states.push_back(tool_->range(&point_.p[at(i * monomialCount_)], place, roughly));
    if (hasRest) states.back() += inflated(Interval(point_.low[at(i)]), point_.radius[at(i)]);
  }
  for (const Embedded& e : parameters_)
    parameters.push_back(e.symbol < 0 ? rangeOf(e) : Interval(e.centre) + Interval(e.half) * place[at(e.symbol)]);
  const Interval value = outputs_->overBox(output, Interval(at_), states, parameters);
  return isCommon(value) ? value : Interval::empty();
}

/// What an output spans at least, by what it is at some ξ: in the middle, beside it along every axis, at the two
/// corners to which it falls and rises from there, and where its polynomial is extreme.
FlowFollower::Reached FlowFollower::reachedBy(int output) {
  constexpr double beside = 0.5;
  Reached reached;
  const auto look = [&](const std::vector<double>& xi) {
    const Interval value = valueAt(output, Box(xi.begin(), xi.end()));
    reached.add(value);
    return midpoint(value);
  };
  std::vector<double> xi(at(symbols_), 0.0), least = xi, greatest = xi;
  look(xi);
  for (std::size_t l = 0; l < xi.size(); ++l) {
    xi[l] = -beside;
    const double below = look(xi);
    xi[l] = beside;
    const double above = look(xi);
    greatest[l] = above < below ? -1 : 1;
    least[l] = -greatest[l];
    xi[l] = 0;
  }
  look(least);
  look(greatest);
  if (std::isfinite(outputs_->radius(output))) {
    (*outputRange_)(outputs_->polynomial(output), whole_, roughly);
    for (const auto* extreme : {&outputRange_->least(), &outputRange_->greatest()}) look(extreme->xi);
  }
  return reached;
}

/// Of each symbol, by which share these outputs were narrower if it were known, as plain intervals tell, together.
std::vector<double> FlowFollower::ifKnown(const std::vector<int>& outputs) {
  std::vector<double> narrower(at(symbols_), 0.0);
  for (const int o : outputs) {
    const double whole = width(valueAt(o, whole_));
    for (std::size_t l = 0; l < narrower.size(); ++l) {
      Box place = whole_;
      place[l] = Interval(0.0);
      const double left = width(valueAt(o, place));
      if (left < whole) narrower[l] += std::isfinite(whole) ? (whole - left) / whole : 1;
    }
  }
  return narrower;
}

/// A part of the piece at one time, written in symbols of its own.
struct FlowFollower::Part {
  std::vector<double> p, rounding;  // [state][monomial]; what of each state was rounded
  std::vector<Embedded> parameters;
  std::vector<double> middle, half;   // of ξ
  std::vector<Interval> bounds = {};  // of the outputs that are looked at
  std::vector<Reached> reached = {};  // by them
};

FlowFollower::Part FlowFollower::wholePart() const {
  return {point_.p, std::vector<double>(point_.radius.size(), 0.0), parameters_, std::vector<double>(at(symbols_), 0.0),
          std::vector<double>(at(symbols_), 1.0)};
}

/// That with ξ_symbol = `middle` + ξ'/2 of it.
FlowFollower::Part FlowFollower::halfOf(const Part& part, int symbol, double middle) const {
  Part half = part;
  const auto N = at(monomialCount_);
  for (std::size_t i = 0; i < part.rounding.size(); ++i) {
    const double* p = &part.p[i * N];
    tool_->range.substitute(symbol, middle, 0.5, p, &half.p[i * N]);
    double norm = 0;
    for (std::size_t g = 0; g < N; ++g) norm += std::fabs(p[g]);
    if (norm > 0)
      half.rounding[i] = (part.rounding[i] + tool_->range.shiftError() * norm * bounds::up) * bounds::up + bounds::tiny;
  }
  halve(half.parameters, symbol, middle);
  halve(half.middle, half.half, symbol, middle);
  return half;
}

/// What these outputs are wherever ξ is in the part, and what they reach there at least. The directions of remainders
/// are polynomials over all of the piece, and so hold over its parts. Leaves the outputs' polynomials those of the
/// part.
void FlowFollower::lookOver(const FlowPiece& piece, const std::vector<int>& outputs, Part& part) {
  FlowPoint point = point_;
  point.p = part.p;
  std::vector<Interval> states;
  for (std::size_t i = 0; i < part.rounding.size(); ++i) {
    for (double* bound : {&point.radius[i], &point.loose[i]}) *bound = (*bound + part.rounding[i]) * bounds::up;
    states.push_back(tool_->range(&point.p[i * at(monomialCount_)], whole_, roughly) +
                     inflated(Interval(point.low[i]), point.radius[i]));
  }
  outputs_->evaluate(at_, point, piece.set.R, part.parameters);
  const Box parameters = rangesOf(part.parameters);
  part.reached.assign(outputs.size(), {});
  for (std::size_t k = 0; k < outputs.size(); ++k) {
    const int o = outputs[k];
    Interval bound = outputs_->overBox(o, Interval(at_), states, parameters);
    part.reached[k].add(valueAt(o, Box(part.middle.begin(), part.middle.end())));
    if (std::isfinite(outputs_->radius(o))) {
      const Interval range = (*outputRange_)(outputs_->polynomial(o), whole_, roughly);
      bound = intersection(bound, inflated(range, outputs_->radius(o)));
      for (const auto* extreme : {&outputRange_->least(), &outputRange_->greatest()}) {
        Box xi(part.middle.begin(), part.middle.end());
        for (std::size_t l = 0; l < xi.size(); ++l) xi[l] = Interval(part.middle[l] + part.half[l] * extreme->xi[l]);
        part.reached[k].add(valueAt(o, xi));
      }
    }
    part.bounds[k] = intersection(part.bounds[k], bound);
  }
}

/// The piece in parts, as few as tell the bounds of some outputs.
class FlowFollower::Parts {
 public:
  Parts(FlowFollower& follower, const FlowPiece& piece, const std::vector<int>& outputs,
        const std::vector<Interval>& bounds)
      : f_(follower), piece_(piece), outputs_(outputs), promise_(follower.ifKnown(outputs)) {
    parts_.push_back(f_.wholePart());
    constexpr double hardly = 1e-3;
    for (const int o : outputs) {
      parts_[0].bounds.push_back(bounds[at(o)]);
      least_.push_back(hardly * width(bounds[at(o)]));
    }
    double sum = 0;
    for (const double along : promise_) sum += along;
    constexpr double guessed = 0.1;
    for (double& along : promise_) along = sum > 0 ? guessed * along / sum : guessed;
  }

  /// The symbol of which halves narrow the outputs most; -1 if none does.
  int halveAll() {
    constexpr double hardly = 0.995;
    int best = -1;
    double least = hardly * static_cast<double>(outputs_.size());
    for (int l = 0; l < f_.symbols_; ++l) {
      std::vector<Part> halves = halvesOf(parts_[0], l);
      double left = 0;
      for (std::size_t k = 0; k < outputs_.size(); ++k)
        left += width(hull(halves[0].bounds[k], halves[1].bounds[k])) / width(parts_[0].bounds[k]);
      promise_[at(l)] += std::max(0.0, static_cast<double>(outputs_.size()) - left);
      if (!(left < least)) continue;
      least = left;
      best = l;
    }
    return best;
  }

  /// Into so many parts at most, until bounds are no more than so wide beside what is reached at least, by the piece,
  /// which grows on the way, or by all of the box (`known`). How many times something was put in half.
  int part(int most, double aim, std::vector<Reached>& reached, std::vector<Reached> known) {
    constexpr int inVain = 12;
    constexpr double helps = 0.9, settled = 0.25;  // an angle falls from all of the circle at once, part by part
    double before = std::numeric_limits<double>::infinity();
    int count = 0;
    for (int since = 0; count < most; ++count) {
      const auto [part, output, excess, all] = loosest(known);
      if (!(excess > aim)) break;
      if (all < helps * before) {
        before = all;
        since = 0;
      } else if (++since == inVain) {
        break;
      }
      const double whole = width(parts_[part].bounds[output]);
      std::vector<Part> halves = halvesOf(parts_[part], symbolFor(parts_[part]));
      if (std::min(width(halves[0].bounds[output]), width(halves[1].bounds[output])) < settled * whole) since = 0;
      for (const Part& half : halves)
        for (std::size_t k = 0; k < outputs_.size(); ++k)
          for (Reached* of : {&reached[k], &known[k]}) of->add(half.reached[k]);
      parts_[part] = std::move(halves[0]);
      parts_.push_back(std::move(halves[1]));
    }
    return count;
  }

  /// What the k-th output is over all parts.
  Interval hullOf(std::size_t k) const {
    Interval all = Interval::empty();
    for (const Part& part : parts_) all = hull(all, part.bounds[k]);
    return all;
  }

 private:
  struct Loosest {
    std::size_t part = 0, output = 0;
    double excess = 0, all = 0;  // of this output at one end; of all outputs at both
  };

  Loosest loosest(const std::vector<Reached>& reached) const {
    Loosest found;
    for (std::size_t k = 0; k < outputs_.size(); ++k) {
      const Interval core = reached[k].span();
      const double scale = std::max(width(core), least_[k]);
      std::size_t lowest = 0, highest = 0;
      for (std::size_t i = 1; i < parts_.size(); ++i) {
        if (parts_[i].bounds[k].lower() < parts_[lowest].bounds[k].lower()) lowest = i;
        if (parts_[i].bounds[k].upper() > parts_[highest].bounds[k].upper()) highest = i;
      }
      const double below = (core.lower() - parts_[lowest].bounds[k].lower()) / scale,
                   above = (parts_[highest].bounds[k].upper() - core.upper()) / scale;
      found.all += std::max(below, 0.0) + std::max(above, 0.0);
      if (below > found.excess) found.part = lowest, found.output = k, found.excess = below;
      if (above > found.excess) found.part = highest, found.output = k, found.excess = above;
    }
    return found;
  }

  int symbolFor(const Part& part) const {
    std::size_t best = 0;
    for (std::size_t l = 1; l < promise_.size(); ++l)
      if (promise_[l] * part.half[l] > promise_[best] * part.half[best]) best = l;
    return static_cast<int>(best);
  }

  std::vector<Part> halvesOf(const Part& part, int symbol) const {
    std::vector<Part> halves;
    for (const double middle : {-0.5, 0.5}) {
      Part half = f_.halfOf(part, symbol, middle);
      f_.lookOver(piece_, outputs_, half);
      halves.push_back(std::move(half));
    }
    return halves;
  }

  FlowFollower& f_;
  const FlowPiece& piece_;
  const std::vector<int>& outputs_;
  std::vector<double> promise_;  // of every symbol, what halving it does
  std::vector<double> least_;    // of outputs, what they vary by for excess to be a share of it
  std::vector<Part> parts_;
};

/// Of those that were enclosed last, in these bounds: which plain intervals alone bound, or looser than was asked for.
std::vector<int> FlowFollower::looseOutputs(const std::vector<Interval>& bounds) const {
  std::vector<int> loose;
  if (outputs_ == nullptr || symbols_ == 0 || signs_ > 0) return loose;
  const bool knowsMore = knowsMoreByBoxes();
  for (int o = 0; o < outputs_->count(); ++o)
    if (isBounded(bounds[at(o)]) &&
        (!std::isfinite(outputs_->radius(o)) || (knowsMore && isLoose(bounds[at(o)], outputCore_[at(o)], task_.aim()))))
      loose.push_back(o);
  return loose;
}

/// At an output time, of what was enclosed last, in these bounds, which parts of the piece narrow: which symbol is to
/// be halved for outputs that are loose, of the first such times each, later of fewer and fewer.
void FlowFollower::lookAtLoose(FlowPiece& piece, std::size_t row, std::vector<Interval>& bounds) {
  constexpr std::size_t denselyHalved = 8;
  constexpr int firstParts = 64, partsOfRow = 8, mostParts = 256;
  collected_.unproved[row].resize(bounds.size());
  std::vector<int> loose;
  std::vector<Reached> reached, known;
  const Box middle(at(symbols_), Interval(0.0));
  std::vector<Interval> certain = outputCore_;
  for (const int o : looseOutputs(bounds)) {
    const Reached found = reachedBy(o);
    const Interval core = intersection(found.span(), bounds[at(o)]);
    certain[at(o)] = core;
    // Of an angle that starts have on both sides of ±π all of the circle is left, whatever is halved.
    if (outputs_->hasAngles() && width(bounds[at(o)]) > 6.28 && width(core) > 3.14) continue;
    if (!std::isfinite(outputs_->radius(o))) collected_.unproved[row][at(o)] = 1;
    if (isEmpty(core)) continue;
    if (width(core) > 0) outputCore_[at(o)] = core;
    Reached ofAll = found;
    if (row < task_.reached.size()) ofAll.addSpan(task_.reached[row][at(o)].lower(), task_.reached[row][at(o)].upper());
    if (!isLoose(hull(ofAll.span(), bounds[at(o)]), ofAll.span(), 0.5 * task_.aim())) continue;
    // Where states are as loose, parts of the piece are in vain.
    constexpr double asLoose = 0.5;
    const double rest = width(valueAt(o, middle, true)) - width(valueAt(o, middle));
    if (rest > std::max(task_.aim() * width(core), asLoose * (width(bounds[at(o)]) - width(core)))) continue;
    loose.push_back(o);
    reached.push_back(found);
    known.push_back(ofAll);
  }
  joinHulls(collected_.reached[row], certain);
  if (loose.empty()) return;
  const std::size_t before = piece.looseRows++;
  piece.mayPart = std::min(piece.mayPart + (before == 0 ? firstParts : partsOfRow), mostParts);
  Parts parts(*this, piece, loose, bounds);
  const bool isLookedAt = before % std::bit_floor(1 + before / denselyHalved) == 0;
  if (isLookedAt && task_.options.split) {
    const int best = parts.halveAll();
    const bool isOfBox = best >= 0 && best < task_.embedding.symbols;  // else one of a remainder's own
    if (isOfBox && !task_.isLast) ++collected_.narrowing[at(best)];
  }
  joinHulls(collected_.outputsOfWhole[row], bounds);
  piece.mayPart -= parts.part(piece.mayPart, 0.5 * task_.aim(), reached, std::move(known));
  for (std::size_t k = 0; k < loose.size(); ++k) {
    Interval& bound = bounds[at(loose[k])];
    bound = intersection(bound, parts.hullOf(k));
    if (const Interval core = intersection(reached[k].span(), bound); width(core) > 0) outputCore_[at(loose[k])] = core;
  }
  outputs_->evaluate(at_, point_, piece.set.R, parameters_);
}

}  // namespace gamut
