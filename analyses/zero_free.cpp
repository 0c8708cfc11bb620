// The earliest part of time and box that is not proved is halved, where that helps most, until it is proved, or so
// early a part cannot be. Time and box are closed, and so are parts: where all that begin before a time are proved, it
// is too.
#include "analyses/zero_free.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include "analyses/work.hpp"
#include "scalars/evaluation/evaluator.hpp"

namespace gamut {
namespace {

struct OpenPart {
  double begin, end;  // s
  Box box;
  std::size_t number;  // of those that begin at one time the first comes first

  friend bool operator<(const OpenPart& a, const OpenPart& b) {  // of the queue's: the last comes first
    return a.begin != b.begin ? a.begin > b.begin : a.number > b.number;
  }
};

class ZeroFreeSearch {
 public:
  ZeroFreeSearch(const Program& g, double horizon) : g_(g), evaluate_(g), horizon_(horizon) {}

  ZeroFree find(const Box& box, const std::atomic<bool>* cancelled) {
    constexpr int slices = 64;
    constexpr std::size_t most = 1024;  // parts that are halved
    constexpr double close = 0x1p-24;   // of the horizon
    for (int i = 0; i < slices; ++i)
      add(horizon_ * i / slices, i + 1 == slices ? horizon_ : horizon_ * (i + 1) / slices, box);
    for (std::size_t halved = 0; !parts_.empty(); ++halved) {
      const OpenPart part = parts_.top();
      const int first = firstOpen(part);
      if (first < 0) {
        parts_.pop();
        continue;
      }
      const bool isStopped = cancelled != nullptr && cancelled->load(std::memory_order_relaxed);
      const bool isDone =
          halved == most || isStopped || part.begin >= ended_ - close * horizon_ || !isHalved(part, first);
      if (isDone) return {part.begin > 0 ? part.begin : -1, first};
    }
    return {horizon_, -1};
  }

 private:
  void add(double begin, double end, Box box) { parts_.push({begin, end, std::move(box), count_++}); }

  /// The values over a part.
  const std::vector<Interval>& valuesOf(double begin, double end, const Box& box) {
    Work::count(Work::boundedNode, static_cast<double>(g_.nodes().size()));
    const auto parameters = box.begin() + g_.states();
    evaluate_.setParameters(std::vector<Interval>(parameters, box.end()));
    values_ = evaluate_(Interval(begin, end), std::vector<Interval>(box.begin(), parameters));
    return values_;
  }
  static double lowest(const Interval& value) {
    return isEmpty(value) || std::isnan(value.lower()) ? -std::numeric_limits<double>::infinity() : value.lower();
  }
  /// The output that is not proved to be above zero; -1: all are.
  int firstOpen(const OpenPart& part) {
    const std::vector<Interval>& values = valuesOf(part.begin, part.end, part.box);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!(lowest(values[i]) > 0)) return static_cast<int>(i);
    return -1;
  }

  /// False where no half of it is any different.
  bool isHalved(const OpenPart& part, int output) {
    const auto o = static_cast<std::size_t>(output);
    Box middle = part.box;
    for (Interval& each : middle) each = Interval(midpoint(each));
    const Interval there = valuesOf(part.end, part.end, middle)[o];
    if (!isEmpty(there) && there.upper() <= 0) ended_ = std::min(ended_, part.end);
    const auto lower = [&](double begin, double end, const Box& box) { return lowest(valuesOf(begin, end, box)[o]); };
    constexpr double shortest = 0x1p-40;  // of the horizon
    const double mid = 0.5 * (part.begin + part.end);
    const std::size_t time = part.box.size(), none = time + 1;
    const double own = lower(part.begin, part.end, part.box);
    double best = own;
    std::size_t by = none;
    if (part.end - part.begin > shortest * horizon_) by = time, best = lower(part.begin, mid, part.box);
    for (std::size_t i = 0; i < part.box.size(); ++i) {
      const double centre = midpoint(part.box[i]);
      if (!(part.box[i].lower() < centre && centre < part.box[i].upper())) continue;
      Box half = part.box;
      half[i] = Interval(part.box[i].lower(), centre);
      double least = lower(part.begin, part.end, half);
      half[i] = Interval(centre, part.box[i].upper());
      least = std::min(least, lower(part.begin, part.end, half));
      if (least > best) best = least, by = i;
    }
    if (by == none) return false;
    const OpenPart whole = part;
    parts_.pop();
    if (by == time) {
      add(whole.begin, mid, whole.box);
      add(mid, whole.end, whole.box);
      return true;
    }
    Box half = whole.box;
    const double centre = midpoint(whole.box[by]);
    half[by] = Interval(whole.box[by].lower(), centre);
    add(whole.begin, whole.end, half);
    half[by] = Interval(centre, whole.box[by].upper());
    add(whole.begin, whole.end, std::move(half));
    return true;
  }

  const Program& g_;
  Evaluator<Interval> evaluate_;
  double horizon_;
  std::vector<Interval> values_;
  std::priority_queue<OpenPart> parts_;
  std::size_t count_ = 0;
  double ended_ = std::numeric_limits<double>::infinity();  // s: there one is zero or less, for some values
};

}  // namespace

ZeroFree zeroFree(const Program& g, const Box& box, double horizon, const std::atomic<bool>* cancelled) {
  if (g.outputs() == 0) return {horizon, -1};
  return ZeroFreeSearch(g, horizon).find(box, cancelled);
}

}  // namespace gamut
