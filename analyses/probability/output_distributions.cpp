#include "analyses/probability/output_distributions.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analyses/shared_indices.hpp"
#include "analyses/work.hpp"

namespace gamut {

OutputDistributions::OutputDistributions(std::vector<std::size_t> rows, std::vector<char> nothing,
                                         OutputDistributionsOptions options)
    : rows_(std::move(rows)),
      nothing_(std::move(nothing)),
      options_(std::move(options)),
      found_(rows_.size() * nothing_.size()),
      tried_(found_.size()) {}

void OutputDistributions::find(TightenedSurrogate& surrogate, ModelMasses& masses) {
  const double coarse = 16 * options_.gap;
  constexpr double first = 1.0 / 8;
  boundAll(surrogate, masses, first, coarse, coarse);
  tighten(surrogate);
  do boundAll(surrogate, masses, 1, coarse, options_.gap);
  while (tighten(surrogate));
  for (std::size_t i = 0; i < found_.size(); ++i)
    isLimited_ = isLimited_ || (found_[i].gap > options_.gap && tried_[i].isLimited);
}

double OutputDistributions::leftByErrors(const TightenedSurrogate& surrogate, std::size_t i) const {
  constexpr double part = 0.05, density = 2.5;  // about, of an output that is 1 wide
  const std::size_t k = i % outputs();
  const auto* parts = surrogate.partsAt(rows_[i / outputs()]);
  if (parts == nullptr) return 0;
  Interval all = Interval::empty();
  double off = 0;
  for (const SurrogatePart& each : *parts) {
    const OutputModel& model = each.outputs[k];
    all = hull(all, model.bound);
    double varies = model.c.empty() ? width(model.bound) : 0;
    for (std::size_t g = 1; g < model.c.size(); ++g) varies += std::fabs(model.c[g]);
    const double radius = model.c.empty() ? varies : model.radius;
    if (radius > surrogate.negligible(k) && radius > part * options_.gap * varies) off = std::max(off, radius);
  }
  return off > 0 ? density * 2 * off / width(all) : 0;
}

bool OutputDistributions::isVague(const TightenedSurrogate& surrogate) const {
  constexpr double mostly = 0.3;
  for (std::size_t i = 0; i < found_.size(); ++i) {
    if (surrogate.partsAt(rows_[i / outputs()]) == nullptr) return true;
    if (nothing_[i % outputs()] != 0) continue;
    const DistributionBounds& bounds = found_[i];
    const double left = leftByErrors(surrogate, i);
    if (left > 0 && (bounds.value.empty() || (left > mostly * bounds.gap && bounds.gap > options_.gap))) return true;
  }
  return false;
}

/// By tighter flows, as long as they cost no more than half of what may still be done. Bounds are to be found again.
bool OutputDistributions::tighten(TightenedSurrogate& surrogate) {
  double forFlows = 0.5 * options_.workLeft();
  bool isTighter = false;
  while (surrogate.mayTighten() && isVague(surrogate) && !isCancelled()) {
    const std::uint64_t counted = Work::counted();
    if (!surrogate.tighten(forFlows)) break;
    forFlows -= static_cast<double>(Work::counted() - counted);
    isTighter = true;
  }
  if (isTighter) std::ranges::fill(tried_, Tried{});
  return isTighter;
}

/// Those that are wider than the coarsest of these gaps to it, then those that are wider than half of it to that, and
/// so on, the widest first, until so much of the work that is left for bounds is done.
void OutputDistributions::boundAll(const TightenedSurrogate& surrogate, ModelMasses& masses, double share,
                                   double coarsest, double finest) {
  if (surrogate.isNone()) return;
  const JointMasses& joint = masses.in(surrogate->symbols, surrogate->quantities);
  constexpr double forOthers = 0.2, hardly = 1e-3;
  const double all = share * (1 - forOthers) * options_.workLeft(), least = options_.workLeft() - all;
  for (double gap = coarsest; !isCancelled(); gap = std::max(0.5 * gap, finest)) {
    std::vector<std::size_t> open;
    constexpr double hopeless = 2;  // as many times all there is
    for (std::size_t i = 0; i < found_.size(); ++i)
      if (found_[i].gap > gap && tried_[i].mayHelp && leftByErrors(surrogate, i) < hopeless) open.push_back(i);
    std::ranges::stable_sort(open, std::greater<>(), [&](std::size_t i) { return found_[i].gap; });
    // Some together, as many however many threads there are; what they leave, those behind them have.
    constexpr std::size_t together = 8;
    constexpr double more = 4;  // than each would have of what is left: most take less
    double left = options_.workLeft() - least;
    for (std::size_t done = 0; done < open.size() && left > hardly * all; left = options_.workLeft() - least) {
      const std::size_t count = std::min(together, open.size() - done);
      const double each =
          std::min(left / static_cast<double>(count), more * left / static_cast<double>(open.size() - done));
      boundThese(std::span(open).subspan(done, count), surrogate, joint, gap, each);
      done += count;
    }
    if (gap <= finest && (open.empty() || gap > options_.gap || !(left > hardly * all))) break;
  }
}

/// To that gap, each with so much work at most.
void OutputDistributions::boundThese(std::span<const std::size_t> these, const TightenedSurrogate& surrogate,
                                     const JointMasses& masses, double gap, double work) {
  DistributionOptions options;
  options.gap = gap;
  options.cancelled = options_.cancelled;
  options.mostWork = work;
  options.mostCells = mostCells();
  std::atomic<std::size_t> done{0};
  const auto find = [&] {
    return [&](std::size_t number) {
      const std::size_t i = these[number], output = i % outputs();
      Tried& tried = tried_[i];
      const auto* parts = surrogate.partsAt(rows_[i / outputs()]);
      if (parts == nullptr) {
        tried.mayHelp = false;
        return;
      }
      DistributionOptions own = options;
      own.negligible = surrogate.negligible(output);
      DistributionBounds bounds = boundDistribution(*parts, output, masses, own);
      constexpr double hardlyMore = 1.5;
      const bool isFinest = gap <= options_.gap;
      tried.isLimited = bounds.isLimited;
      tried.mayHelp = !isFinest || (bounds.isLimited && work > hardlyMore * tried.work);
      tried.work = isFinest ? work : 0;
      constexpr double nearlyAll = 0.6;
      if (!bounds.value.empty() && (found_[i].value.empty() || bounds.gap < found_[i].gap))
        found_[i] = std::move(bounds);
      if (!found_[i].value.empty() && leftByErrors(surrogate, i) > nearlyAll * found_[i].gap)
        tried.isLimited = tried.mayHelp = false;  // finer cells would know hardly more
      if (options_.progress) options_.progress(static_cast<double>(++done) / static_cast<double>(these.size()));
    };
  };
  forEachShared(options_.communicator, options_.jobs, these.size(), options_.cancelled, find,
                [&](Archive& all, std::size_t number) {
                  DistributionBounds& bounds = found_[these[number]];
                  Tried& tried = tried_[these[number]];
                  all(bounds.value, bounds.lower, bounds.upper, bounds.gap, bounds.isLimited, tried.work,
                      tried.isLimited, tried.mayHelp);
                });
}

std::size_t OutputDistributions::mostCells() const {
  constexpr std::size_t cells = 10240, fewest = 64;  // of all together; of one
  return std::clamp(cells / found_.size(), fewest, mostOfFew);
}

}  // namespace gamut
