// Along a solution that stays in X on [0, h], an output whose derivatives up to the k-th are continuous there is
// y(t) = Σ_{i<k} y_i t^i + y_k(θ) t^k, with y_i its Taylor coefficients at 0 and y_k(θ) the k-th at some time θ
// (Taylor, Lagrange's remainder): not below zero where y_i ≥ 0 at the start and y_k ≥ 0 on all of X and [0, h].
#include "analyses/requirements/start.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "scalars/evaluation/series.hpp"
#include "scalars/program/recorder.hpp"

namespace gamut {

namespace {

constexpr int highest = 4;  // derivative that is looked at

class Start {
 public:
  Start(const Program& f, const Program& g, const std::vector<int>& outputs)
      : program_(both(f, g, outputs)),
        n_(f.states()),
        outputs_(static_cast<int>(outputs.size())),
        series_(program_, highest + 1) {}

  /// Of each output its coefficients over this box at these times, 0 to `highest`; nothing where some operation comes
  /// to the edge of where it is smooth. The box's parameters are those of all that follows.
  std::optional<std::vector<std::vector<Interval>>> coefficients(const Interval& time, const Box& box) {
    if (!solve(time, box)) return std::nullopt;
    std::vector<std::vector<Interval>> found(outputs_);
    for (int o = 0; o < outputs_; ++o)
      for (int i = 0; i <= highest; ++i) found[o].push_back(series_.at(program_.outputNodes()[n_ + o], i));
    return found;
  }

  /// Where all solutions from the box are during [0, h]: a box B with X₀ + [0, h] f([0, h], B) ⊂ B holds them (Picard).
  std::optional<Box> duringStep(const Box& start, double h) {
    constexpr int attempts = 12;
    const Interval time(0.0, h);
    Box box = start;
    for (int attempt = 0; attempt < attempts; ++attempt) {
      if (!solve(time, box)) return std::nullopt;
      Box image = start;
      bool isInside = true;
      for (int i = 0; i < n_; ++i) {
        image[i] = start[i] + time * series_.at(program_.outputNodes()[i], 0);
        if (!isBounded(image[i])) return std::nullopt;
        isInside = isInside && isSubset(image[i], box[i]);
      }
      if (isInside) return image;
      for (int i = 0; i < n_; ++i) {
        const Interval all = hull(box[i], image[i]);
        constexpr double tiny = std::numeric_limits<double>::min();
        const Interval more = all - all;  // NOLINT(misc-redundant-expression): both ends of its width
        box[i] = all + 0.1 * more + Interval(-tiny, tiny);
      }
    }
    return std::nullopt;
  }

 private:
  static Program both(const Program& f, const Program& g, const std::vector<int>& outputs) {
    Recorder recorder(f.states(), f.parameters());
    std::vector<int> nodes;
    const std::vector<int> motion = recorder.append(f);
    for (const int node : f.outputNodes()) nodes.push_back(motion[node]);
    const std::vector<int> margins = recorder.append(g);
    for (const int output : outputs) nodes.push_back(margins[g.outputNodes()[output]]);
    return recorder.finish(nodes);
  }

  /// False where it is not smooth, or not defined, for all that the box holds.
  bool solve(const Interval& time, const Box& box) {
    const std::vector<Interval> x(box.begin(), box.begin() + n_), p(box.begin() + n_, box.end());
    series_.setParameters(p);
    series_.solve(time, x);
    for (const Node& node : program_.nodes()) {
      if (isOneSided(domainOf(node.op)))
        if (!(series_.at(node.a, 0).lower() > 0)) return false;
      if (!isSmooth(node.op) || domainOf(node.op) == Domain::nonzero)
        if (contains(series_.at(node.a, 0), 0.0)) return false;
    }
    return true;
  }

  Program program_;
  int n_, outputs_;
  Series<Interval> series_;
};

/// What a part of the box means.
Box boxOf(const FlowModels& models, const FlowPart& part, Box box) {
  for (std::size_t i = 0; i < box.size(); ++i) {
    const FlowSymbol& of = models.components[i];
    if (of.symbol < 0) continue;
    const Interval xi = Interval(part.centre[of.symbol]) + Interval(-1.0, 1.0) * part.half[of.symbol];
    const Interval own = intersection(Interval(of.centre) + Interval(of.half) * xi, box[i]);
    if (!isEmpty(own)) box[i] = own;
  }
  return box;
}

/// Whether the output is not below zero; then its bound says so.
bool narrow(Interval& bound, const std::vector<Interval>& atStart, const std::vector<Interval>& throughout) {
  for (int k = 0; k <= highest; ++k) {
    if (throughout[k].lower() >= 0) {
      const Interval both = intersection(bound, Interval(0.0, std::numeric_limits<double>::infinity()));
      if (!isEmpty(both)) bound = both;
      return true;
    }
    if (!(atStart[k].lower() >= 0)) return false;
  }
  return false;
}

}  // namespace

std::shared_ptr<const FlowModels> sharpenedAtStart(const std::shared_ptr<const FlowModels>& models, const Program& f,
                                                   const Program& g, const std::vector<int>& outputs, const Box& box) {
  if (!models || models->at.size() < 2 || models->components.size() != box.size() || models->areAlternatives)
    return models;
  Start start(f, g, outputs);
  auto sharpened = std::make_shared<FlowModels>(*models);
  for (auto& snapshot : sharpened->at[0]) {
    const auto known = start.coefficients(Interval(0.0), boxOf(*models, snapshot->part, box));
    if (!known) continue;
    auto own = std::make_shared<FlowSnapshot>(*snapshot);
    for (std::size_t o = 0; o < outputs.size(); ++o) {
      const Interval both = intersection(own->outputs[o].bound, (*known)[o][0]);
      if (!isEmpty(both)) own->outputs[o].bound = both;
    }
    snapshot = std::move(own);
  }
  constexpr int most = 64;  // chords: others keep their bounds
  int count = 0;
  bool isProved = true;  // of the row before, somewhere: else nothing is to be hoped for behind it
  for (std::size_t row = 1; row < sharpened->over.size() && isProved; ++row) {
    isProved = false;
    for (FlowChord& chord : sharpened->over[row]) {
      const bool isOpen = std::ranges::any_of(chord.bound, [](const Interval& bound) { return bound.lower() < 0; });
      if (!isOpen || ++count > most) continue;
      const Box own = boxOf(*models, chord.part, box);
      const double h = chord.behind->time;
      const auto atStart = start.coefficients(Interval(0.0), own);
      const auto during = start.duringStep(own, h);
      if (!atStart || !during) continue;
      const auto throughout = start.coefficients(Interval(0.0, h), *during);
      if (!throughout) continue;
      for (std::size_t o = 0; o < outputs.size(); ++o)
        isProved = narrow(chord.bound[o], (*atStart)[o], (*throughout)[o]) || isProved;
    }
  }
  return sharpened;
}

}  // namespace gamut
