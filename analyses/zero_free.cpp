// The earliest part of time and box that is not proved is halved, where that helps most, until it is proved, or so
// early a part cannot be. Time and box are closed, and so are parts: where all that begin before a time are proved, it
// is too.
#include "analyses/zero_free.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

#include "analyses/flow/outputs/plain_outputs.hpp"
#include "analyses/work.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "scalars/program/angles.hpp"
#include "scalars/program/differentiation.hpp"
#include "scalars/program/recorder.hpp"
#include "scalars/program/time_given.hpp"

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

/// Values over parts of time and box.
class ValuesOverParts {
 public:
  explicit ValuesOverParts(const Program& g) : g_(g), plain_(g) {
    std::vector<int> denominators;
    for (const int angle : halfAnglesOf(g)) denominators.push_back(denominatorOf(g, angle));
    if (!denominators.empty()) denominators_.emplace(Recorder(g).finish(denominators));
    // Across a jump no derivative tells anything; across a kink those of both sides do, together (Lebourg 1975).
    const bool jumps = std::ranges::any_of(g.nodes(), [](const Node& node) { return node.op == Op::sign; });
    if (!jumps) withSlopes_.emplace(reverseDifferentiated(withTimeGiven(g), true));
  }

  /// By plain intervals. Valid until the next call.
  const std::vector<Interval>& plainly(double begin, double end, const Box& box) {
    Work::count(Work::boundedNode, static_cast<double>(g_.nodes().size()));
    const auto parameters = box.begin() + g_.states();
    plain_.setParameters(std::vector<Interval>(parameters, box.end()));
    values_ = plain_(Interval(begin, end), std::vector<Interval>(box.begin(), parameters));
    return values_;
  }

  /// The least that the output may be: as the mean value form about the middle knows it, too.
  double lowest(double begin, double end, const Box& box, std::size_t output) {
    const double plain = lowerOf(plainly(begin, end, box)[output]);
    if (plain > 0 || !withSlopes_ || mayTurnOver(begin, end, box)) return plain;
    Box middle = box;
    for (Interval& each : middle) each = Interval(midpoint(each));
    const double time = midpoint(Interval(begin, end));
    Interval value = plainly(time, time, middle)[output];
    if (isEmpty(value)) return plain;
    const std::vector<Interval> slopes = slopesOver(begin, end, box, output);
    for (std::size_t i = 0; i < slopes.size(); ++i) {
      const Interval away = i < box.size() ? box[i] - middle[i] : Interval(begin, end) - Interval(time);
      if (!isThin(away)) value = value + slopes[i] * away;
    }
    return std::max(plain, lowerOf(value));
  }

  /// Of the output by states, parameters and, last, time; nothing where none are known.
  std::vector<Interval> slopesOver(double begin, double end, const Box& box, std::size_t output) {
    if (!withSlopes_) return {};
    Work::count(Work::boundedNode, static_cast<double>(withSlopes_->tape().operations()));
    const auto ofStates = box.begin() + g_.states();
    std::vector<Interval> given(ofStates, box.end());
    given.emplace_back(begin, end);
    withSlopes_->setParameters(given);
    const std::vector<Interval> all = (*withSlopes_)(Interval(0.0), std::vector<Interval>(box.begin(), ofStates));
    const auto own = static_cast<std::size_t>(g_.outputs()), states = static_cast<std::size_t>(g_.states());
    const auto from = [&](std::size_t at) { return all.begin() + static_cast<std::ptrdiff_t>(at); };
    std::vector<Interval> slopes(from(own + output * states), from(own + (output + 1) * states));
    const std::size_t first = own + own * states + output * given.size();
    slopes.insert(slopes.end(), from(first), from(first + given.size()));
    return slopes;
  }

  /// Whether the output is known to have a value all over these, and to jump nowhere.
  bool isContinuousOver(double begin, double end, const Box& box, std::size_t output) {
    if (!withSlopes_ || mayTurnOver(begin, end, box)) return false;
    if (!defined_) defined_.emplace(g_);
    const auto parameters = box.begin() + g_.states();
    return isBounded(defined_->over(static_cast<int>(output), Interval(begin, end), {box.begin(), parameters},
                                    {parameters, box.end()}));
  }

  /// Whether an angle of two coordinates may jump by a whole turn.
  bool mayTurnOver(double begin, double end, const Box& box) {
    if (!denominators_) return false;
    const auto parameters = box.begin() + g_.states();
    denominators_->setParameters(std::vector<Interval>(parameters, box.end()));
    return !std::ranges::all_of((*denominators_)(Interval(begin, end), std::vector<Interval>(box.begin(), parameters)),
                                [](const Interval& d) { return d.lower() > 0; });
  }

  static double lowerOf(const Interval& value) {
    return isEmpty(value) || std::isnan(value.lower()) ? -std::numeric_limits<double>::infinity() : value.lower();
  }

 private:
  const Program& g_;
  Evaluator<Interval> plain_;
  std::optional<Evaluator<Interval>> withSlopes_, denominators_;  // none where nothing is known of slopes; no angles
  std::optional<PlainOutputs> defined_;                           // where it is first asked for
  std::vector<Interval> values_;
};

class ZeroFreeSearch {
 public:
  ZeroFreeSearch(const Program& g, double horizon) : values_(g), horizon_(horizon) {}

  ZeroFree find(const Box& box, const std::atomic<bool>* cancelled) {
    constexpr std::size_t most = 1024;  // parts that are halved
    constexpr double close = 0x1p-24;   // of the horizon
    box_ = box;
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
      const bool isReached = part.begin >= zeroBy_ - close * horizon_;
      const bool isDone = halved == most || isStopped || isReached || !isHalved(part, static_cast<std::size_t>(first));
      if (!isDone) continue;
      if (!isStopped && zero_ != first) lookForZero(part);
      const double until = part.begin > 0 ? part.begin : -1;
      if (isStopped) return {until, first, ZeroFree::End::cancelled, -1};
      const bool isOfZero = isZeroKnown() && (isReached || zero_ == first);
      return isOfZero ? ZeroFree{until, zero_, ZeroFree::End::zero, zeroBy_}
                      : ZeroFree{until, first, ZeroFree::End::open, -1};
    }
    return {horizon_, -1, ZeroFree::End::horizon};
  }

 private:
  void add(double begin, double end, Box box) { parts_.push({begin, end, std::move(box), count_++}); }

  /// The output that is not proved to be above zero; -1: all are.
  int firstOpen(const OpenPart& part) {
    const std::vector<Interval> plain = values_.plainly(part.begin, part.end, part.box);
    for (std::size_t i = 0; i < plain.size(); ++i)
      if (!(ValuesOverParts::lowerOf(plain[i]) > 0) && !(values_.lowest(part.begin, part.end, part.box, i) > 0))
        return static_cast<int>(i);
    return -1;
  }

  bool isZeroKnown() const { return zeroBy_ < std::numeric_limits<double>::infinity(); }

  /// Of the outputs, with these values at this moment: the first that has one not above zero, none where none has;
  /// whether all are above.
  struct Moment {
    std::optional<std::size_t> zero;
    bool areAbove = true;
  };
  Moment momentAt(double time, const Box& values) {
    Moment moment;
    const std::vector<Interval>& found = values_.plainly(time, time, values);
    for (std::size_t i = 0; i < found.size(); ++i) {
      moment.areAbove = moment.areAbove && ValuesOverParts::lowerOf(found[i]) > 0;
      if (!moment.zero && found[i].upper() <= 0) moment.zero = i;
    }
    return moment;
  }

  /// Where an output is not above zero with these values, and was at the start, it was zero in between, unless it
  /// jumped or had no value: halving tells when, to where that is known.
  void noteWhereZero(double time, const Box& values) {
    constexpr int halvings = 24;
    if (!(time < zeroBy_)) return;
    std::optional<std::size_t> last = momentAt(time, values).zero;
    if (!last) return;
    const Moment start = momentAt(0, values);
    if (start.zero) return noteStartAtZero(values, *start.zero);
    double above = 0, by = time;
    bool isClose = start.areAbove;
    for (int i = 0; i < halvings && isClose; ++i) {
      const double middle = 0.5 * (above + by);
      const Moment there = momentAt(middle, values);
      isClose = there.zero || there.areAbove;
      if (there.zero)
        by = middle, last = there.zero;
      else if (isClose)
        above = middle;
    }
    if (!start.areAbove || !values_.isContinuousOver(above, by, values, *last)) return;
    zeroBy_ = by;
    zero_ = static_cast<int>(*last);
  }

  /// It was zero for values on the way there from the box's middle, if it is above zero with these.
  void noteStartAtZero(const Box& values, std::size_t output) {
    const Box middle = middleOf(box_);
    Box way = values;
    for (std::size_t i = 0; i < way.size(); ++i) way[i] = hull(values[i], middle[i]);
    if (!momentAt(0, middle).areAbove || !values_.isContinuousOver(0, 0, way, output)) return;
    zeroBy_ = 0;
    zero_ = static_cast<int>(output);
  }

  static Box middleOf(Box box) {
    for (Interval& each : box) each = Interval(midpoint(each));
    return box;
  }

  /// Of a part that stayed open its corners, of the whole box corners and middle at some times from there on.
  void lookForZero(const OpenPart& part) {
    const double before = zeroBy_;
    for (const double time : {0.5 * (part.begin + part.end), part.end})
      forEachCorner(part.box, [&](const Box& corner) { noteWhereZero(time, corner); });
    for (int i = 1; i <= slices; ++i) {
      const double time = horizon_ * i / slices;
      if (!(time > part.begin) || zeroBy_ < before) continue;
      noteWhereZero(time, middleOf(box_));
      forEachCorner(box_, [&](const Box& corner) { noteWhereZero(time, corner); });
    }
  }

  template <class Visit>
  static void forEachCorner(const Box& box, const Visit& visit) {
    constexpr std::size_t most = 6;  // quantities of which both ends are looked at
    std::vector<std::size_t> wide;
    for (std::size_t i = 0; i < box.size() && wide.size() < most; ++i)
      if (!isThin(box[i])) wide.push_back(i);
    Box corner = middleOf(box);
    for (std::size_t number = 0; number < std::size_t{1} << wide.size(); ++number) {
      for (std::size_t k = 0; k < wide.size(); ++k) {
        const Interval& range = box[wide[k]];
        corner[wide[k]] = Interval((number >> k & 1) != 0 ? range.upper() : range.lower());
      }
      visit(corner);
    }
  }

  /// Its number in the box, or one more for time; one more still where nothing of it can be halved.
  std::size_t whatToHalve(const OpenPart& part, std::size_t output) {
    constexpr double shortest = 0x1p-40;  // of the horizon
    const std::size_t time = part.box.size();
    const auto canBeHalved = [&](std::size_t i) {
      if (i == time) return part.end - part.begin > shortest * horizon_;
      const double centre = midpoint(part.box[i]);
      return part.box[i].lower() < centre && centre < part.box[i].upper();
    };
    const auto greatest = [&](const auto& of) {
      std::size_t by = time + 1;
      double most = 0;
      for (std::size_t i = 0; i <= time; ++i)
        if (const double own = canBeHalved(i) ? of(i) : 0; own > most) most = own, by = i;
      return by;
    };
    const auto widthOf = [&](std::size_t i) { return i == time ? part.end - part.begin : width(part.box[i]); };
    const std::vector<Interval> slopes = values_.slopesOver(part.begin, part.end, part.box, output);
    const auto isKnown = [](const Interval& slope) { return isBounded(slope); };
    if (!slopes.empty() && std::ranges::all_of(slopes, isKnown))
      if (const std::size_t by = greatest([&](std::size_t i) { return magnitude(slopes[i]) * widthOf(i); }); by <= time)
        return by;
    // Where slopes have no bounds, what raises plain intervals' bound most, else what is left of most.
    const double own = ValuesOverParts::lowerOf(values_.plainly(part.begin, part.end, part.box)[output]);
    const auto raises = [&](std::size_t i) {
      const auto lower = [&](double begin, double end, const Box& box) {
        return ValuesOverParts::lowerOf(values_.plainly(begin, end, box)[output]);
      };
      if (i == time) return lower(part.begin, 0.5 * (part.begin + part.end), part.box) - own;
      const auto [below, above] = halvesOf(part.box, i);
      return std::min(lower(part.begin, part.end, below), lower(part.begin, part.end, above)) - own;
    };
    if (const std::size_t by = std::isfinite(own) ? greatest(raises) : time + 1; by <= time) return by;
    return greatest([&](std::size_t i) { return widthOf(i) / (i == time ? horizon_ / slices : width(box_[i])); });
  }

  static std::pair<Box, Box> halvesOf(const Box& box, std::size_t i) {
    std::pair<Box, Box> halves{box, box};
    const double centre = midpoint(box[i]);
    halves.first[i] = Interval(box[i].lower(), centre);
    halves.second[i] = Interval(centre, box[i].upper());
    return halves;
  }

  /// False where there is nothing that can be.
  bool isHalved(const OpenPart& part, std::size_t output) {
    noteWhereZero(part.end, middleOf(part.box));
    const std::size_t by = whatToHalve(part, output), time = part.box.size();
    if (by > time) return false;
    const OpenPart whole = part;
    parts_.pop();
    if (by == time) {
      const double mid = 0.5 * (whole.begin + whole.end);
      add(whole.begin, mid, whole.box);
      add(mid, whole.end, whole.box);
    } else {
      auto [below, above] = halvesOf(whole.box, by);
      add(whole.begin, whole.end, std::move(below));
      add(whole.begin, whole.end, std::move(above));
    }
    return true;
  }

  static constexpr int slices = 64;  // of the horizon, to begin with
  ValuesOverParts values_;
  double horizon_;
  Box box_;
  std::priority_queue<OpenPart> parts_;
  std::size_t count_ = 0;
  double zeroBy_ = std::numeric_limits<double>::infinity();  // s: until then output `zero_` is, for some values
  int zero_ = -1;
};

}  // namespace

ZeroFree zeroFree(const Program& g, const Box& box, double horizon, const std::atomic<bool>* cancelled) {
  if (g.outputs() == 0) return {horizon, -1, ZeroFree::End::horizon};
  return ZeroFreeSearch(g, horizon).find(box, cancelled);
}

}  // namespace gamut
