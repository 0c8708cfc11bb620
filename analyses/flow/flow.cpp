// Follows the pieces of a box through time, earliest first, so that at any moment the earliest piece says how far the
// whole box is proved. Threads share the queue; every thread collects hulls of its own, joined at the end.
#include "analyses/flow/flow.hpp"

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <exception>
#include <limits>
#include <mutex>
#include <new>
#include <queue>
#include <stdexcept>
#include <thread>

#include "analyses/flow/embedding.hpp"
#include "analyses/flow/outputs.hpp"
#include "analyses/flow/polynomial_range.hpp"
#include "analyses/flow/step.hpp"
#include "analyses/workers.hpp"
#include "scalars/elementary/rounding.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

namespace {

void join(std::vector<Interval>& into, const std::vector<Interval>& from) {
  if (into.empty()) {
    into = from;
    return;
  }
  for (std::size_t i = 0; i < into.size(); ++i) into[i] = hull(into[i], from[i]);
}

/// Both hold; where nothing is left (no value is defined), `into` stays.
void narrow(std::vector<Interval>& into, const std::vector<Interval>& other) {
  for (std::size_t i = 0; i < into.size(); ++i)
    if (const Interval both = intersection(into[i], other[i]); !isEmpty(both)) into[i] = both;
}

/// A set of monomials and the degree of the frame over it.
struct Layout {
  std::shared_ptr<const Monomials> monomials;
  int frameDegree;
  bool expanded = false;  // with one more symbol a state, for the remainder
};

/// Monomials for `symbols` uncertain quantities and the remainder of n states in symbols of its own, to second order at
/// least; null where there would be too many.
std::shared_ptr<const Monomials> expandedMonomials(int symbols, int n) {
  static constexpr int degreeOfThin[] = {0, 8, 6, 5, 4, 3, 3};
  int degree = 0, weight = 1;
  if (symbols == 0) {
    degree = n <= 6 ? degreeOfThin[n] : 2;
  } else {
    degree = symbols == 1 ? 12 : symbols == 2 ? 8 : 4;
    weight = degree / 2;
  }
  // ξ alone, ξ·ζ up to grade `degree - weight`, ζ·ζ: an upper bound on the count before it is built.
  if (symbols + n > 12) return nullptr;
  std::vector<int> weights(at(symbols), 1);
  weights.resize(at(symbols + n), weight);
  auto monomials = std::make_shared<const Monomials>(weights, degree);
  return monomials->count() <= 300 ? monomials : nullptr;
}

constexpr double expandedAt = 1e-6;  // a remainder, relative to its state, that a linear term cannot carry much further

/// One sub-box on its way, with what is known at its last boundary.
struct Piece {
  FlowSet set;
  std::size_t layout = 0;                          // which monomials it uses
  std::size_t next = 0;                            // index of its next output time
  std::vector<Interval> last, over;                // states at set.t; states since the last output time
  std::vector<Interval> lastOutputs, overOutputs;  // likewise for the outputs
};

struct Later {
  bool operator()(const Piece& a, const Piece& b) const { return a.set.t > b.set.t; }
};

enum class Journey { goesOn, ended, cancelled };

/// Everything that pieces contributed at the output times.
struct Collected {
  std::vector<std::vector<Interval>> states, statesOver, outputs, outputsOver;
  std::vector<std::vector<std::vector<Interval>>> cuts;
  std::vector<std::vector<double>> radii;  // greatest remainder of a piece, [time][state]
  long steps = 0;
  double cpu = 0, cutCpu = 0;
  Collected(std::size_t times, std::size_t levels)
      : states(times),
        statesOver(times),
        outputs(times),
        outputsOver(times),
        cuts(levels, std::vector<std::vector<Interval>>(times)),
        radii(times) {}
};

}  // namespace

struct Flow::Parts {
  Program motion;          // f
  Program differentiated;  // f and ∂f/∂x
  Program outputs;         // g
  FlowOptions options;
};

/// One call of Flow::enclose.
class FlowRun {
 public:
  FlowRun(const Program& f, const Program& differentiated, const Program& g, const FlowOptions& options, const Box& box,
          double horizon, const std::vector<double>& outputTimes, const std::vector<Box>& levels, double tighter)
      : motion_(f),
        differentiated_(differentiated),
        outputProgram_(g),
        options_(options),
        box_(box),
        levels_(levels),
        embedding_(box),
        horizon_(horizon) {
    times_.push_back(0.0);
    for (double time : outputTimes)
      if (time > times_.back()) times_.push_back(time);
    if (horizon > times_.back()) times_.push_back(horizon);
    int exponent = 0;
    std::frexp(horizon, &exponent);
    quantum_ = std::ldexp(1.0, exponent - 53);  // one unit in the last place of the horizon: sums of steps are exact
    std::vector<int> degrees = degreeLadder(embedding_.symbols);
    if (options.degree >= 0 && embedding_.symbols > 0) degrees = {options.degree};
    for (int degree : degrees) {
      requireThat(embedding_.symbols == 0 || degree >= 1,
                  "uncertain quantities need polynomials of degree one at least");
      layouts_.push_back({std::make_shared<const Monomials>(std::vector<int>(at(embedding_.symbols), 1), degree),
                          options.frameDegree >= 0 ? std::min(options.frameDegree, degree)
                                                   : automaticFrameDegree(embedding_.symbols, degree)});
    }
    degrees_ = layouts_.size();
    if (auto expanded = options.degree < 0 ? expandedMonomials(embedding_.symbols, f.states()) : nullptr) {
      const int frame =
          std::min(expanded->degree(), embedding_.symbols == 0 ? 1 : expanded->weight(embedding_.symbols));
      layouts_.push_back({std::move(expanded), frame, true});
    }
    // Bisection is cheap for one symbol and dear for several: with these, begin loosely.
    const double patience = std::pow(20.0, std::clamp(embedding_.symbols - 1, 0, 3));
    splitDefect_ = bisectsForWidth() ? options.splitDefect * patience * embedding_.widest / tighter
                                     : std::numeric_limits<double>::infinity();
    mostPieces_ = options.maxPieces;
    tolerance_ = options.tolerance > 0 ? options.tolerance : embedding_.symbols == 0 ? 1e-15 : 1e-14;
  }

  /// The greatest share of the remainder in a width, and whether all was proved: is it worth trying a tighter
  /// threshold?
  bool isLoose(const Tube& tube) const {
    if (embedding_.symbols == 0 || !options_.split || !bisectsForWidth() || tube.wasStopped() ||
        pieces_ >= mostPieces_ || !ended_.empty())
      return false;
    return tube.reached() < horizon_ || looseness_ > 0.005;
  }

  /// Both are proved, so their intersection is; the one that reaches further goes on alone. Costs add up.
  static Tube meet(Tube a, Tube b) {
    if (b.reached_ < a.reached_ || (b.reached_ == a.reached_ && b.reachedTimes() < a.reachedTimes())) std::swap(a, b);
    const auto cross = [](std::vector<std::vector<Interval>>& into, const std::vector<std::vector<Interval>>& other) {
      for (std::size_t row = 0; row < std::min(into.size(), other.size()); ++row)
        for (std::size_t i = 0; i < into[row].size(); ++i) into[row][i] = intersection(into[row][i], other[row][i]);
    };
    cross(b.states_, a.states_);
    cross(b.statesOver_, a.statesOver_);
    cross(b.outputs_, a.outputs_);
    cross(b.outputsOver_, a.outputsOver_);
    for (std::size_t level = 0; level < b.cuts_.size(); ++level) cross(b.cuts_[level], a.cuts_[level]);
    if (a.wasStopped() && !b.why_.empty()) b.why_ = a.why_;
    b.steps_ += a.steps_;
    b.cpu_ += a.cpu_;
    b.cutCpu_ += a.cutCpu_;
    return b;
  }

  double looseness() const { return looseness_; }

  /// Halving one of many symbols narrows the box by little: those are bisected only where a step fails otherwise.
  bool bisectsForWidth() const { return embedding_.symbols <= 8; }

  /// Intersects the cuts of this level, and of all inside it, with a flow over the level's own box.
  static void tighten(Tube& tube, std::size_t level, const Tube& own) {
    const auto& better = own.outputs_.empty() || own.outputs_[0].empty() ? own.states_ : own.outputs_;
    for (std::size_t inner = level; inner < tube.cuts_.size(); ++inner)
      for (std::size_t row = 0; row < std::min(tube.cuts_[inner].size(), better.size()); ++row)
        for (std::size_t i = 0; i < better[row].size(); ++i)
          tube.cuts_[inner][row][i] = intersection(tube.cuts_[inner][row][i], better[row][i]);
    tube.cutCpu_ += own.cpu_;
    tube.steps_ += own.steps_;
  }

  Tube run() {
    queue_.push(start());
    failedAt_ = std::numeric_limits<double>::infinity();
    const int jobs = std::max(1, options_.jobs);
    std::vector<Collected> collected(at(jobs), Collected(times_.size(), levels_.size()));
    std::vector<std::jthread> threads;
    for (int i = 1; i < jobs; ++i) threads.emplace_back([this, &collected, i] { work(collected[at(i)]); });
    work(collected[0]);
    threads.clear();  // joins
    if (error_) std::rethrow_exception(error_);
    return gather(collected);
  }

 private:
  Piece start() const {
    Piece piece;
    FlowSet& s = piece.set;
    const Monomials& monomials = *layouts_[0].monomials;
    const int n = motion_.states(), N = monomials.count(), NJ = monomials.countUpTo(layouts_[0].frameDegree);
    s.p.assign(at(n * N), 0.0);
    s.C.assign(at(NJ * n * n), 0.0);
    s.R.assign(at(n), 0.0);
    s.W.assign(at(n), 0.0);
    for (int i = 0; i < n; ++i) {
      const Embedded& e = embedding_.components[at(i)];
      s.p[at(i * N)] = e.centre;
      if (e.symbol >= 0) s.p[at(i * N + monomials.linear(e.symbol))] = e.half;
      s.R[at(i)] = e.radius;
      s.C[at(i * n + i)] = 1.0;
    }
    s.parameters.assign(embedding_.components.begin() + n, embedding_.components.end());
    s.centre.assign(at(embedding_.symbols), 0.0);
    s.half.assign(at(embedding_.symbols), 1.0);
    return piece;
  }

  /// A thread: takes the earliest piece, follows it for a slice of time, puts it back.
  void work(Collected& collected) {
    const double began = threadCpuSeconds();
    try {
      Worker worker(*this, collected);
      for (;;) {
        Piece piece;
        double sliceEnd = 0;
        {
          std::unique_lock lock(mutex_);
          wake_.wait(lock, [&] { return stop_ || !queue_.empty() || busy_ == 0; });
          if (stop_ || queue_.empty()) break;
          piece = queue_.top();
          queue_.pop();
          if (piece.set.t >= failedAt_) continue;  // beyond what can be proved for the whole box
          ++busy_;
          sliceEnd = std::min(horizon_, piece.set.t + horizon_ / 64);
          report(piece.set.t);
        }
        const Journey journey = worker.followWhilePossible(piece, sliceEnd);
        {
          const std::lock_guard lock(mutex_);
          --busy_;
          if (journey == Journey::cancelled) {
            unfinished_ = std::min(unfinished_, piece.set.t);
            stop_ = true;
          } else if (journey == Journey::goesOn && piece.set.t < horizon_) {
            queue_.push(std::move(piece));
          }
        }
        wake_.notify_all();
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      error_ = std::current_exception();
      stop_ = true;
    }
    wake_.notify_all();
    collected.cpu += threadCpuSeconds() - began - collected.cutCpu;
  }

  void report(double earliest) {  // the queue's order makes `earliest` the earliest of all waiting pieces
    if (options_.progress) options_.progress(earliest / horizon_);
  }

  void fail(double t, const std::string& why) {
    const std::lock_guard lock(mutex_);
    if (t < failedAt_) {
      failedAt_ = t;
      why_ = why;
    }
  }

  bool mayBisect(const Piece& piece) {
    bool isTimeToProbe = false;
    {
      const std::lock_guard lock(mutex_);
      if (!options_.split || pieces_ >= mostPieces_) return false;
      ++pieces_;
      isTimeToProbe = embedding_.symbols > 0 && pieces_ >= nextProbe_ && ended_.empty();
      if (isTimeToProbe) nextProbe_ = 2 * pieces_;
    }
    if (isTimeToProbe) probe(piece);
    return true;
  }

  /// Where bisection goes on and on: one start of the piece, followed alone. If not even that gets far beyond the
  /// piece, no bisection of the box does, and only as many pieces again are worth their while.
  void probe(const Piece& piece) {
    Box start = box_;
    for (std::size_t i = 0; i < start.size(); ++i)
      if (const Embedded& e = embedding_.components[i]; e.symbol >= 0)
        start[i] = std::clamp(e.centre + e.half * piece.set.centre[at(e.symbol)], box_[i].lower(), box_[i].upper());
    FlowOptions options;
    options.order = options_.order;
    options.split = false;
    options.maxWidth = options_.maxWidth;
    options.cancelled = options_.cancelled;
    options.stateNames = options_.stateNames;
    const Program none =
        record(motion_.states(), motion_.parameters(), 0, [](const auto&, const auto&, const auto&, auto&) {});
    const double horizon = std::min(horizon_, 1.5 * piece.set.t);
    if (!(horizon > 0)) return;
    const Tube alone = FlowRun(motion_, differentiated_, none, options, start, horizon, {}, {}, 1.0).run();
    if (alone.reached() >= horizon || alone.wasStopped()) return;
    const std::lock_guard lock(mutex_);
    ended_ = "one start of the box by itself: " + alone.why();
    mostPieces_ = std::min(mostPieces_, 2 * pieces_);
  }

  void add(Piece piece) {
    {
      const std::lock_guard lock(mutex_);
      queue_.push(std::move(piece));
    }
    wake_.notify_one();
  }

  /// g over start values in plain intervals: exactly what is known exactly.
  std::vector<Interval> outputsAtStart(const Box& box) const {
    Evaluator<Interval> g(outputProgram_);
    const auto states = box.begin() + motion_.states();
    g.setParameters(std::vector<Interval>(states, box.end()));
    return g(Interval(0.0), std::vector<Interval>(box.begin(), states));
  }

  Tube gather(std::vector<Collected>& collected);

  /// A thread's workspace, and the journey of one piece.
  class Worker {
   public:
    Worker(FlowRun& run, Collected& collected) : run_(run), collected_(collected), tools_(run.layouts_.size()) {}

    /// What ends within a step leaves the piece at the step's start; what the step had given already is proved.
    Journey followWhilePossible(Piece& piece, double end) {
      try {
        return follow(piece, end);
      } catch (const Cancelled&) {
      } catch (const std::bad_alloc&) {
        run_.outOfMemory_ = true;
      }
      return Journey::cancelled;
    }

   private:
    /// Advances `piece` to `end` or to its failure.
    Journey follow(Piece& piece, double end) {
      while (piece.set.t < end) {
        if (run_.options_.cancelled != nullptr && run_.options_.cancelled->load(std::memory_order_relaxed))
          return Journey::cancelled;
        use(piece);
        const bool uncertain = symbols_ > 0;
        StepOutcome outcome =
            tool_->stepper.certify(piece.set, run_.horizon_, run_.quantum_, uncertain ? run_.splitDefect_ : 0.0);
        if (outcome != StepOutcome::stepped && uncertain) {
          if (piece.layout + 1 < run_.degrees_) {
            changeLayout(piece, piece.layout + 1);
            continue;
          }
          const bool futile = outcome == StepOutcome::failed && tool_->stepper.isRemainderDominant(piece.set);
          const int symbol = tool_->stepper.worstSymbol();
          // Centres of pieces are exact: fifty bisections of one symbol is as far as that goes.
          const bool tooFine = symbol < run_.embedding_.symbols && piece.set.half[at(symbol)] < 0x1p-50;
          if (!futile && !tooFine && run_.mayBisect(piece)) {
            Piece other = piece;
            other.set = tool_->stepper.bisect(piece.set, symbol, tool_->range);
            run_.add(std::move(other));
            continue;
          }
          if (outcome == StepOutcome::splitWanted) outcome = StepOutcome::stepped;  // certified all the same
        }
        if (outcome == StepOutcome::failed) {
          run_.fail(piece.set.t, tool_->stepper.why());
          return Journey::ended;
        }
        if (!record(piece)) return Journey::ended;
        tool_->stepper.advance(piece.set);
        ++collected_.steps;
        if (!expand(piece)) lowerDegree(piece);
      }
      return Journey::goesOn;
    }

    /// The workspace of one layout.
    struct Tools {
      FlowStepper stepper;
      PolynomialRange range;
      std::unique_ptr<FlowOutputs> outputs;
      std::unique_ptr<FlowOutputChords> chords;
    };

    void use(const Piece& piece) {
      std::unique_ptr<Tools>& tools = tools_[piece.layout];
      if (!tools) {
        const Layout& layout = run_.layouts_[piece.layout];
        const FlowOptions& options = run_.options_;
        tools = std::make_unique<Tools>(Tools{FlowStepper(run_.differentiated_, layout.monomials, layout.frameDegree,
                                                          options.order, run_.tolerance_, options.cancelled),
                                              PolynomialRange(layout.monomials), nullptr, nullptr});
        tools->stepper.setStateNames(options.stateNames);
        if (run_.outputProgram_.outputs() > 0) {
          tools->outputs = std::make_unique<FlowOutputs>(run_.outputProgram_, layout.monomials, options.cancelled);
          tools->chords = std::make_unique<FlowOutputChords>(run_.outputProgram_, layout.monomials, options.order,
                                                             options.cancelled);
        }
      }
      tool_ = tools.get();
      outputs_ = tool_->outputs.get();
      monomialCount_ = run_.layouts_[piece.layout].monomials->count();
      symbols_ = run_.layouts_[piece.layout].monomials->symbols();
      whole_.assign(at(symbols_), Interval(-1.0, 1.0));
    }

    void changeLayout(Piece& piece, std::size_t to) {
      const Layout& from = run_.layouts_[piece.layout];
      changeDegree(piece.set, *from.monomials, from.frameDegree, *run_.layouts_[to].monomials,
                   run_.layouts_[to].frameDegree);
      piece.layout = to;
    }

    /// Gives the remainder symbols of its own once it has grown to what a linear term cannot carry.
    bool expand(Piece& piece) {
      const std::size_t expanded = run_.layouts_.size() - 1;
      if (!run_.layouts_[expanded].expanded || piece.layout == expanded) return false;
      // Where ξ can be bisected, doing so early keeps the remainder small; symbols for it would only be bisected too.
      if (run_.embedding_.symbols > 0 && run_.options_.split) return false;
      const Layout& from = run_.layouts_[piece.layout];
      if (!(tool_->stepper.relativeRemainder(piece.set) > expandedAt)) return false;
      if (!expandRemainder(piece.set, *from.monomials, from.frameDegree, *run_.layouts_[expanded].monomials,
                           run_.layouts_[expanded].frameDegree))
        return false;
      piece.layout = expanded;
      return true;
    }

    /// Back to a lower degree where the highest grades have become too small to matter.
    void lowerDegree(Piece& piece) {
      if (piece.layout == 0 || piece.layout >= run_.degrees_) return;
      const Monomials& now = *run_.layouts_[piece.layout].monomials;
      const double dropped =
          relativeMass(piece.set, now, run_.layouts_[piece.layout - 1].monomials->degree(), now.degree());
      if (dropped < 1e-4 * run_.splitDefect_) changeLayout(piece, piece.layout - 1);
    }

    /// Enclosures of states and outputs at one time of the step.
    void enclose(const Piece& piece, double tau, std::vector<Interval>& states, std::vector<Interval>& outputs) {
      tool_->stepper.evaluate(piece.set, tau, point_);
      const int N = monomialCount_;
      states.resize(at(run_.motion_.states()));
      for (int i = 0; i < run_.motion_.states(); ++i)
        states[at(i)] = inflated(tool_->range(&point_.p[at(i * N)], whole_), point_.radius[at(i)]);
      outputs.clear();
      if (!outputs_) return;
      outputs_->evaluate(piece.set.t + tau, point_, piece.set.R, piece.set.parameters);
      for (int o = 0; o < outputs_->count(); ++o)
        outputs.push_back(std::isfinite(outputs_->radius(o))
                              ? inflated(tool_->range(outputs_->polynomial(o), whole_), outputs_->radius(o))
                              : Interval::entire());
    }

    void encloseLevels(const Piece& piece, std::size_t row) {
      if (run_.levels_.empty()) return;
      const double began = threadCpuSeconds();
      const int N = monomialCount_;
      for (std::size_t level = 0; level < run_.levels_.size(); ++level) {
        Box xi = whole_;
        if (!restrictTo(run_.levels_[level], run_.embedding_, piece.set.centre, piece.set.half, xi)) break;
        std::vector<Interval> cut;
        if (outputs_) {
          for (int o = 0; o < outputs_->count(); ++o)
            cut.push_back(std::isfinite(outputs_->radius(o))
                              ? inflated(tool_->range(outputs_->polynomial(o), xi), outputs_->radius(o))
                              : Interval::entire());
        } else {
          for (int i = 0; i < run_.motion_.states(); ++i)
            cut.push_back(inflated(tool_->range(&point_.p[at(i * N)], xi), point_.radius[at(i)]));
        }
        join(collected_.cuts[level][row], cut);
      }
      collected_.cutCpu += threadCpuSeconds() - began;
    }

    /// Adds what the step that was just certified contributes to the tube; false if the piece has grown too wide.
    bool record(Piece& piece) {
      const std::vector<double>& times = run_.times_;
      const double t0 = piece.set.t, t1 = t0 + tool_->stepper.h();
      if (piece.last.empty()) {  // the start
        enclose(piece, 0.0, piece.last, piece.lastOutputs);
        for (std::size_t i = 0; i < piece.last.size(); ++i) piece.last[i] = intersection(piece.last[i], run_.box_[i]);
        join(collected_.states[0], piece.last);
        join(collected_.statesOver[0], piece.last);
        join(collected_.outputs[0], piece.lastOutputs);
        join(collected_.outputsOver[0], piece.lastOutputs);
        encloseLevels(piece, 0);
        piece.over = piece.last;
        piece.overOutputs = piece.lastOutputs;
        piece.next = 1;
      }
      std::vector<Interval> end, endOutputs;
      double from = t0;
      bool chordsKnown = false;
      const auto segment =
          [&](double to) {  // from `from` to `to`: the chord's hull and how far a motion leaves a chord
            tool_->stepper.sag(from - t0, to - t0, sag_);
            for (std::size_t i = 0; i < end.size(); ++i)
              piece.over[i] = hull(piece.over[i], hull(piece.last[i], end[i]) + sag_[i]);
            if (outputs_) {
              if (!chordsKnown) tool_->chords->load(tool_->stepper, piece.set);
              chordsKnown = true;
              tool_->chords->sag(from - t0, to - t0, sag_);
              for (std::size_t i = 0; i < endOutputs.size(); ++i)
                piece.overOutputs[i] = hull(piece.overOutputs[i], hull(piece.lastOutputs[i], endOutputs[i]) + sag_[i]);
            }
            piece.last = end;
            piece.lastOutputs = endOutputs;
            from = to;
          };
      for (; piece.next < times.size() && times[piece.next] <= t1; ++piece.next) {
        enclose(piece, times[piece.next] - t0, end, endOutputs);  // an exact difference: docs/flow.md, "Time"
        encloseLevels(piece, piece.next);
        segment(times[piece.next]);
        join(collected_.states[piece.next], end);
        std::vector<double>& radii = collected_.radii[piece.next];
        radii.resize(end.size(), 0.0);
        for (std::size_t i = 0; i < end.size(); ++i) radii[i] = std::max(radii[i], point_.radius[i]);
        join(collected_.outputs[piece.next], endOutputs);
        join(collected_.statesOver[piece.next], piece.over);
        join(collected_.outputsOver[piece.next], piece.overOutputs);
        piece.over = end;
        piece.overOutputs = endOutputs;
      }
      if (from < t1) {
        enclose(piece, t1 - t0, end, endOutputs);
        segment(t1);
      }
      for (std::size_t i = 0; i < piece.last.size(); ++i)
        if (!(width(piece.last[i]) <= run_.options_.maxWidth)) {
          run_.fail(t1, tool_->stepper.nameOf(static_cast<int>(i)) + " has become wider than the limit of " +
                            toString(run_.options_.maxWidth));
          return false;
        }
      return true;
    }

    FlowRun& run_;
    Collected& collected_;
    std::vector<std::unique_ptr<Tools>> tools_;  // one a layout, made when first needed
    Tools* tool_ = nullptr;                      // of the piece at hand, as are the next two
    FlowOutputs* outputs_ = nullptr;
    int monomialCount_ = 0, symbols_ = 0;
    FlowPoint point_;
    Box whole_;
    std::vector<Interval> sag_;
  };

  const Program& motion_;
  const Program& differentiated_;
  const Program& outputProgram_;
  const FlowOptions& options_;
  const Box& box_;
  const std::vector<Box>& levels_;
  Embedding embedding_;
  double horizon_, quantum_ = 0, tolerance_ = 0, splitDefect_ = 0;
  std::vector<Layout> layouts_;  // degrees rising, then the expanded one
  std::size_t degrees_ = 0;      // how many are not expanded
  std::vector<double> times_;

  std::mutex mutex_;
  std::condition_variable wake_;
  std::priority_queue<Piece, std::vector<Piece>, Later> queue_;
  int busy_ = 0, pieces_ = 1, mostPieces_ = 1, nextProbe_ = 16;
  std::string ended_;  // what a probe found
  double looseness_ = 0;
  bool stop_ = false;
  std::atomic<bool> outOfMemory_{false};
  double failedAt_ = 0, unfinished_ = std::numeric_limits<double>::infinity();
  std::string why_;
  std::exception_ptr error_;
};

Tube FlowRun::gather(std::vector<Collected>& collected) {
  Tube tube;
  tube.times_ = times_;
  tube.reached_ = std::min(horizon_, failedAt_);
  if (!why_.empty()) tube.why_ = "at " + toString(failedAt_) + " s " + why_ + (ended_.empty() ? "" : "; " + ended_);
  double earliest = unfinished_;
  if (!queue_.empty()) earliest = std::min(earliest, queue_.top().set.t);
  if (stop_ && earliest < tube.reached_) {
    tube.reached_ = earliest;
    tube.why_ = outOfMemory_ ? Tube::outOfMemory : Tube::interrupted;
  }
  std::size_t rows = 0;
  while (rows < times_.size() && times_[rows] <= tube.reached_ && (rows > 0 || tube.reached_ > 0)) ++rows;
  const auto merge = [&](auto member, std::vector<std::vector<Interval>>& into) {
    into.resize(rows);
    for (std::size_t row = 0; row < rows; ++row)
      for (Collected& part : collected)
        if (!(part.*member)[row].empty()) join(into[row], (part.*member)[row]);
  };
  merge(&Collected::states, tube.states_);
  merge(&Collected::statesOver, tube.statesOver_);
  merge(&Collected::outputs, tube.outputs_);
  merge(&Collected::outputsOver, tube.outputsOver_);
  if (rows == 0) {  // not even one step: the start itself is known
    tube.states_ = tube.statesOver_ = {std::vector<Interval>(box_.begin(), box_.begin() + motion_.states())};
    tube.outputs_ = tube.outputsOver_ = {std::vector<Interval>(at(outputProgram_.outputs()), Interval::entire())};
    rows = 1;
    for (auto& part : collected)
      for (auto& level : part.cuts) level[0] = tube.outputs_[0].empty() ? tube.states_[0] : tube.outputs_[0];
  }
  narrow(tube.outputs_[0], outputsAtStart(box_));
  tube.outputsOver_[0] = tube.outputs_[0];
  tube.cuts_.assign(levels_.size(), std::vector<std::vector<Interval>>(rows));
  for (std::size_t level = 0; level < levels_.size(); ++level)
    for (std::size_t row = 0; row < rows; ++row) {
      std::vector<Interval>& cut = tube.cuts_[level][row];
      for (Collected& part : collected)
        if (!part.cuts[level][row].empty()) join(cut, part.cuts[level][row]);
      // Nested boxes have nested ranges, so the bound of the level outside holds here too.
      const std::vector<Interval>& outside = level > 0                      ? tube.cuts_[level - 1][row]
                                             : outputProgram_.outputs() > 0 ? tube.outputs_[row]
                                                                            : tube.states_[row];
      for (std::size_t i = 0; i < cut.size(); ++i) cut[i] = intersection(cut[i], outside[i]);
      if (row == 0) narrow(cut, outputProgram_.outputs() > 0 ? outputsAtStart(levels_[level]) : levels_[level]);
    }
  for (std::size_t row = 1; row < rows; ++row)
    for (std::size_t i = 0; i < tube.states_[row].size(); ++i)
      for (const Collected& part : collected) {
        if (part.radii[row].empty()) continue;
        const double remainder = 2 * part.radii[row][i], rest = width(tube.states_[row][i]) - remainder;
        if (remainder > 1e-12 * magnitude(tube.states_[row][i])) looseness_ = std::max(looseness_, remainder / rest);
      }
  tube.pieces_ = pieces_;
  for (const Collected& part : collected) {
    tube.steps_ += part.steps;
    tube.cpu_ += part.cpu;
    tube.cutCpu_ += part.cutCpu;
  }
  return tube;
}

const std::vector<Interval>& Tube::at(double time) const {
  if (!(time >= 0 && time <= reached_) || states_.empty())
    throw std::out_of_range("the tube is proved for times from 0 s to " + toString(reached_) + " s only");
  const auto found = std::lower_bound(times_.begin(), times_.end(), time);
  const auto row = static_cast<std::size_t>(found - times_.begin());
  if (row >= states_.size())
    throw std::out_of_range("the tube ended at " + toString(reached_) + " s, inside an output interval");
  return times_[row] == time ? states_[row] : statesOver_[row];
}

Flow::Flow(Program f, FlowOptions options) {
  Program none = record(f.states(), f.parameters(), 0, [](const auto&, const auto&, const auto&, auto&) {});
  *this = Flow(std::move(f), std::move(none), std::move(options));
}

Flow::Flow(Program f, Program g, FlowOptions options) {
  requireThat(f.states() > 0 && f.outputs() == f.states(),
              "a flow needs one derivative for each of its states (and at least one state)");
  requireThat(g.states() == f.states() && g.parameters() == f.parameters(),
              "the outputs of a flow need its states and its parameters");
  requireThat(options.order >= 4 && options.order <= 30, "the order of a flow must be 4 to 30");
  requireThat(options.degree >= -1 && options.degree <= 40,
              "the degree of a flow's polynomials must be 0 to 40 (-1: automatic)");
  requireThat(options.maxPieces >= 1, "a flow needs at least one piece");
  requireThat(options.tolerance >= 0 && options.splitDefect >= 0, "tolerances must not be negative");
  Program differentiated = f.differentiated();
  parts_ =
      std::make_unique<const Parts>(Parts{std::move(f), std::move(differentiated), std::move(g), std::move(options)});
}

Flow::~Flow() = default;
Flow::Flow(Flow&&) noexcept = default;
Flow& Flow::operator=(Flow&&) noexcept = default;

Tube Flow::enclose(const Box& box, double horizon, const std::vector<double>& outputTimes,
                   const std::vector<Box>& levels) const {
  const Parts& parts = *parts_;
  requireThat(box.size() == at(parts.motion.states() + parts.motion.parameters()),
              "the box needs " + std::to_string(parts.motion.states()) + " initial values and " +
                  std::to_string(parts.motion.parameters()) + " parameters, not " + std::to_string(box.size()) +
                  " numbers");
  requireThat(horizon > 0 && std::isfinite(horizon), "the horizon must be a positive number of seconds");
  for (std::size_t i = 0; i < outputTimes.size(); ++i)
    requireThat(outputTimes[i] >= 0 && outputTimes[i] <= horizon && (i == 0 || outputTimes[i] >= outputTimes[i - 1]),
                "output times must rise from 0 to the horizon");
  requireNested(box, levels);
  requireNearest();
  FlowOptions options = parts.options;
  double furthest = 0;  // runs and threads report one at a time; what they report must not go back
  if (parts.options.progress)
    options.progress = [&](double fraction) { parts.options.progress(furthest = std::max(furthest, fraction)); };
  // Splitting acts too late where the remainder has grown already: where it shows in the result, once more and earlier.
  const auto repeat = [&](const Box& whole, const std::vector<Box>& inside, double& looseness) {
    Tube best;
    for (double tighter : {1.0, 30.0, 1000.0, 30000.0}) {
      FlowRun run(parts.motion, parts.differentiated, parts.outputs, options, whole, horizon, outputTimes, inside,
                  tighter);
      Tube tube = run.run();
      const bool again = run.isLoose(tube);
      looseness = run.looseness();
      best = tighter == 1.0 ? std::move(tube) : FlowRun::meet(std::move(best), std::move(tube));
      if (!again) break;
    }
    return best;
  };
  const Embedding uncertain(box);
  double looseness = 0, unused = 0;
  Tube tube = repeat(box, levels, looseness);
  // A remainder that is small for the whole box is not for a much smaller level: that one gets a flow of its own.
  for (std::size_t level = 0; level < levels.size() && !tube.wasStopped(); ++level) {
    double share = 0;
    for (std::size_t i = 0; i < box.size(); ++i)
      if (uncertain.components[i].symbol >= 0) share = std::max(share, width(levels[level][i]) / width(box[i]));
    if (looseness > 0.01 * share) FlowRun::tighten(tube, level, repeat(levels[level], {}, unused));
  }
  return tube;
}

}  // namespace gamut
