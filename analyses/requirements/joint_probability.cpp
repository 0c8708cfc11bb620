#include "analyses/requirements/joint_probability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "analyses/flow/error_bounds.hpp"
#include "scalars/elementary/rounding.hpp"
#include "scalars/index.hpp"

namespace gamut {
namespace {

using detail::at;

/// A part of the joint distribution, what is known of where it lies, and of its probability: so much is met, and so
/// much violated, at least.
struct Weighed {
  JointMasses::Part part;
  std::unique_ptr<Cell> cell;
  double mass = 0, met = 0, violated = 0;
  double open() const { return mass - met - violated; }
  bool operator<(const Weighed& other) const { return open() < other.open(); }
};

class Weighing {
 public:
  Weighing(Cells& cells, const JointMasses& masses) : cells_(cells), masses_(masses) {}

  Interval operator()(double gap, const std::atomic<bool>* cancelled) {
    constexpr std::size_t most = 2500;
    constexpr double mostWork = 1e9;  // bytes of cells, all in all, and what takes as long
    std::vector<Weighed> waiting;
    const auto push = [&](JointMasses::Part part, const Cell& from) {
      Weighed piece = weighed(std::move(part), from);
      open_ += piece.open();
      waiting.push_back(std::move(piece));
      std::push_heap(waiting.begin(), waiting.end());
    };
    push(masses_.whole(), *cells_.whole());
    while (!waiting.empty()) {
      std::pop_heap(waiting.begin(), waiting.end());
      const Weighed piece = std::move(waiting.back());
      waiting.pop_back();
      std::vector<JointMasses::Part> halves;
      const bool isEnough =
          open_ <= gap || waiting.size() >= most || work_ > mostWork || (cancelled != nullptr && *cancelled);
      if (piece.cell->verdict() == Cell::Verdict::open && !isEnough)
        for (const int symbol : cells_.symbolsOf(*piece.cell))
          if (halves = masses_.halves(piece.part, symbol); halves.size() > 1) break;
      if (halves.size() > 1) {
        open_ -= piece.open();
        for (JointMasses::Part& half : halves) push(std::move(half), *piece.cell);
        continue;
      }
      met_ = addDown(met_, piece.met);
      violated_ = addDown(violated_, piece.violated);
    }
    const double met = std::clamp(met_, 0.0, 1.0);
    return {met, std::max(met, std::min(1.0, subUp(1.0, violated_)))};
  }

 private:
  Weighed weighed(JointMasses::Part part, const Cell& from) {
    Weighed piece{std::move(part), nullptr};
    piece.cell = cells_.within(from, JointMasses::boxOf(piece.part));
    work_ += piece.cell->bytes() + 1e3 * static_cast<double>(masses_.boxesIn(piece.part));
    piece.mass = masses_.massOf(piece.part);
    const double certain = std::max(0.0, subDown(piece.mass, addUp(masses_.error(), masses_.roundings())));
    switch (piece.cell->verdict()) {
      case Cell::Verdict::met:
        piece.met = certain;
        break;
      case Cell::Verdict::violated:
        piece.violated = certain;
        break;
      case Cell::Verdict::open: {
        const CellPlanes planes = cells_.planes(*piece.cell);
        piece.met = beyond(piece.part, planes.met, planes.metAbove, true);
        piece.violated = beyond(piece.part, planes.violated, planes.violatedBelow, false);
      }
    }
    return piece;
  }

  /// The probability that slope·η + constant > 0, or < 0, at least.
  double beyond(const JointMasses::Part& part, const std::vector<double>& slope, double constant, bool isAbove) const {
    double size = 0;
    std::vector<std::vector<double>> f;
    for (const double s : slope) f.push_back({0, s}), size += std::fabs(s);
    if (!(size > bounds::tiny) || !std::isfinite(size) || !std::isfinite(constant) ||
        std::fabs(constant) > 0x1p40 * size)
      return 0;
    constexpr double steps = 256;
    const double step = std::ldexp(1.0, std::ilogb(2 * size / steps));
    const GridSum sum = masses_.sumOf(part, f, {}, Interval(constant), step);
    const GridMasses& side = isAbove ? sum.sum.below : sum.sum.above;
    double probability = 0;
    for (std::size_t i = 0; i < side.mass.size(); ++i) {
      const long value = side.first + static_cast<long>(i);
      if (isAbove ? value > 0 : value < 0) probability += std::max(0.0, side.mass[i]);
    }
    return std::max(0.0, subDown(probability, addUp(sum.error, masses_.roundings())));
  }

  Cells& cells_;
  const JointMasses& masses_;
  double met_ = 0, violated_ = 0;  // rounded down
  double open_ = 0, work_ = 0;
};

}  // namespace

Interval probabilityOf(Cells& cells, const JointMasses& masses, double gap, const std::atomic<bool>* cancelled) {
  return Weighing(cells, masses)(gap, cancelled);
}

}  // namespace gamut
