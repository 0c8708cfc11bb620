#include "analyses/roots/all_roots.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "analyses/roots/root_equations.hpp"

namespace gamut {
namespace {

using Why = UndecidedRoots::Why;

bool isWithin(const Box& a, const Box& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!isSubset(a[i], b[i])) return false;
  return true;
}

bool isApart(const Box& a, const Box& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (isDisjoint(a[i], b[i])) return true;
  return false;
}

/// Not farther from each other than one of them is wide.
bool areNear(const Box& a, const Box& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::max(a[i].lower(), b[i].lower()) - std::min(a[i].upper(), b[i].upper()) >
        std::max(width(a[i]), width(b[i])))
      return false;
  return true;
}

Box hullOf(Box a, const Box& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = hull(a[i], b[i]);
  return a;
}

Box commonOf(Box a, const Box& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = intersection(a[i], b[i]);
  return a;
}

/// Sets of numbers that were joined.
class Joined {
 public:
  explicit Joined(std::size_t count) : of_(count) { std::iota(of_.begin(), of_.end(), std::size_t{0}); }
  std::size_t first(std::size_t i) {
    while (of_[i] != i) i = of_[i] = of_[of_[i]];
    return i;
  }
  void join(std::size_t i, std::size_t j) {
    const std::size_t a = first(i), b = first(j);
    of_[std::max(a, b)] = std::min(a, b);
  }
  /// In the order of their first numbers.
  std::vector<std::vector<std::size_t>> sets() {
    std::map<std::size_t, std::vector<std::size_t>> sets;
    for (std::size_t i = 0; i < of_.size(); ++i) sets[first(i)].push_back(i);
    std::vector<std::vector<std::size_t>> all;
    for (auto& [_, set] : sets) all.push_back(std::move(set));
    return all;
  }

 private:
  std::vector<std::size_t> of_;
};

std::vector<double> unitsOf(const Box& region) {
  std::vector<double> units;
  for (const Interval& x : region) units.push_back(std::max({width(x), 0x1p-40 * magnitude(x), 0x1p-900}));
  return units;
}

class Searcher {
 public:
  Searcher(const Program& f, const Box& region, const Box& parameters, const RootSearch& search)
      : equations_(f, parameters, search.time, unitsOf(region), search.also),
        region_(region),
        parameters_(parameters),
        search_(search),
        units_(unitsOf(region)),
        n_(f.states()) {
    for (const int l : equations_.wide()) widest_.push_back(parameters[l]);
    finest_ = 0;
  }

  AllRoots find() {
    parts_.push_back({widest_});
    adopt(0);
    put({region_, 0, 0, 0});
    while (std::optional<Cell> cell = next()) {
      const bool isCancelled = search_.cancelled != nullptr && search_.cancelled->load(std::memory_order_relaxed);
      if (isCancelled || cells_ + extra() >= search_.mostCells) {
        leave(std::move(*cell), isCancelled ? Why::cancelled : Why::work);
        continue;
      }
      ++cells_;
      look(std::move(*cell));
    }
    return result();
  }

 private:
  struct Cell {
    Box x;
    std::size_t q;  // among parts_
    int cuts, parameterCuts;
  };
  /// A root that could not be proved for all of a part of the parameters, and what it is alone in for their middle.
  struct Failure {
    std::vector<double> c;
    Box alone;
  };
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  /// A part of the parameters that are wide, which is cut in the same two halves for all cells, so that what is proved
  /// of a half is for all of them.
  struct ParameterPart {
    Box box;
    std::size_t whole = none, lowerHalf = none;  // what it is half of; the upper half is the next
    bool isKnown = false;                        // whether one of these, or of what it is half of, was known before
    std::vector<std::size_t> proofs = {};        // for all of it
    std::vector<Failure> failures = {};
  };
  struct Proof : RootEquations::Proof {
    Box q;
    std::size_t part;
  };
  struct Left {
    Box x, q;
    Why why;
    std::size_t part = none;  // of the parameters, q
  };

  std::size_t extra() const { return proofCells_; }

  /// The proofs that hold for all of a part.
  std::vector<std::size_t> proofsFor(std::size_t q) const {
    std::vector<std::size_t> proofs;
    for (; q != none; q = parts_[q].whole)
      proofs.insert(proofs.end(), parts_[q].proofs.begin(), parts_[q].proofs.end());
    return proofs;
  }

  // Cells of few cuts first, in heaps of some cuts each: what is hard to settle holds up nothing else. In a heap the
  // last first, which keeps it small.
  void put(Cell cell) {
    const std::size_t heap = cell.parameterCuts + cell.cuts / (8 * n_);
    if (heaps_.size() <= heap) heaps_.resize(heap + 1);
    heaps_[heap].push_back(std::move(cell));
    finest_ = std::min(finest_, heap);
  }
  std::optional<Cell> next() {
    for (; finest_ < heaps_.size(); ++finest_)
      if (!heaps_[finest_].empty()) {
        Cell cell = std::move(heaps_[finest_].back());
        heaps_[finest_].pop_back();
        return cell;
      }
    return {};
  }

  /// What proved roots leave of a cell: sides that stick out of the box in which one is alone; false where that is
  /// nothing. Of two such sides one goes among the cells.
  bool trim(Cell& cell) {
    for (bool isTrimmed = true; isTrimmed;) {
      isTrimmed = false;
      for (const std::size_t k : proofsFor(cell.q)) {
        const Box& alone = proofs_[k].alone;
        if (isApart(cell.x, alone)) continue;
        int outside = -1, count = 0;
        for (int i = 0; i < n_; ++i)
          if (!isSubset(cell.x[i], alone[i])) outside = i, ++count;
        if (count == 0) return false;
        if (count > 1) continue;
        const Interval x = cell.x[outside], inner = alone[outside];
        if (x.upper() <= inner.lower() || inner.upper() <= x.lower()) continue;  // it meets but the edge
        const bool below = x.lower() < inner.lower(), above = inner.upper() < x.upper();
        if (below && above) {
          Cell other = cell;
          other.x[outside] = Interval(inner.upper(), x.upper());
          put(std::move(other));
        }
        cell.x[outside] = below ? Interval(x.lower(), inner.lower()) : Interval(inner.upper(), x.upper());
        isTrimmed = true;
      }
    }
    return true;
  }

  void look(Cell cell) {
    constexpr int rounds = 12;
    constexpr double little = 0.8;  // of a width
    bool isTame = false;
    for (int round = 0; round < rounds; ++round) {
      if (!trim(cell)) return;
      const Box before = cell.x;
      if (!equations_.contract(cell.x, parts_[cell.q].box)) return;
      isTame = equations_.isTame();
      if (isTame && !equations_.step(cell.x, parts_[cell.q].box)) return;
      bool isGained = false;
      for (int i = 0; i < n_; ++i) isGained = isGained || width(cell.x[i]) < little * width(before[i]);
      if (!isGained) break;
    }
    if (!trim(cell)) return;
    if (isTame) {
      const std::vector<double> spread = equations_.spread();
      const std::vector<double> xScore = scoresOf(cell, true), qScore = scoresOf(cell, false);
      const bool isRounding = equations_.isRounding();
      const Attempt attempt = attemptProof(cell, spread);
      if (attempt == Attempt::proved) return put(std::move(cell));
      if (isRounding) return leave(std::move(cell), Why::narrow);
      if (cutAtProofs(cell)) return;
      if (attempt == Attempt::parameters && cutParameters(cell, qScore)) return;
      cut(std::move(cell), xScore, qScore);
    } else {
      std::vector<double> xScore, qScore;
      for (int i = 0; i < n_; ++i) xScore.push_back(width(cell.x[i]) / units_[i]);
      for (std::size_t l = 0; l < widest_.size(); ++l)
        qScore.push_back(0x1p-6 * width(parts_[cell.q].box[l]) / width(widest_[l]));
      cut(std::move(cell), xScore, qScore);
    }
  }

  /// How much of what F varies by is by each state, or parameter: a share of each output's, summed.
  std::vector<double> scoresOf(const Cell& cell, bool ofStates) const {
    const Box& q = parts_[cell.q].box;
    const int size = n_ + static_cast<int>(q.size());
    std::vector<double> scores(ofStates ? n_ : q.size(), 0.0);
    for (int i = 0; i < n_; ++i) {
      std::vector<double> by;
      double sum = 0;
      for (int j = 0; j < size; ++j) {
        const double w = width(j < n_ ? cell.x[j] : q[j - n_]);
        const double most = w == 0 ? 0 : magnitude(equations_.slope(i, j)) * w;
        by.push_back(most);
        if (std::isfinite(most)) sum += most;
      }
      const double rest = std::max(width(equations_.range(i)) - sum, 0.0);  // where derivatives are not bounded
      for (double& each : by)
        if (!std::isfinite(each)) sum += each = std::isfinite(rest) ? rest : 1e300;
      if (!(sum > 0)) continue;
      for (std::size_t j = 0; j < scores.size(); ++j) scores[j] += by[ofStates ? j : j + n_] / sum;
    }
    return scores;
  }

  /// The root that is known for a part of the parameters, unless it is for what that is half of.
  void adopt(std::size_t part) {
    const std::size_t whole = parts_[part].whole;
    if (!search_.known || (whole != none && parts_[whole].isKnown)) {
      parts_[part].isKnown = whole != none && parts_[whole].isKnown;
      return;
    }
    const Box root = search_.known(allParameters(parts_[part].box));
    if (root.empty()) return;
    const std::size_t before = equations_.evaluations();
    std::optional<RootEquations::Proof> proof = equations_.adopt(root, parts_[part].box);
    proofCells_ += equations_.evaluations() - before;
    if (!proof) return;
    parts_[part].isKnown = true;
    parts_[part].proofs.push_back(proofs_.size());
    proofs_.push_back({std::move(*proof), parts_[part].box, part});
  }

  enum class Attempt { proved, failed, parameters };

  /// About an approximate root in or near the cell, if it is not known already.
  Attempt attemptProof(const Cell& cell, const std::vector<double>& spread) {
    std::vector<double> middle, reach;
    for (int i = 0; i < n_; ++i) {
      middle.push_back(midpoint(cell.x[i]));
      reach.push_back(1.5 * width(cell.x[i]) + (std::isfinite(spread[i]) ? spread[i] : 0) + 0x1p-44 * units_[i]);
    }
    const Box q = parts_[cell.q].box;
    const std::optional<std::vector<double>> c = equations_.approximate(middle, q, reach);
    if (!c) return Attempt::failed;
    const Box at(c->begin(), c->end());
    for (const std::size_t k : proofsFor(cell.q))
      if (isWithin(at, proofs_[k].alone)) return Attempt::failed;
    for (const Failure& failure : parts_[cell.q].failures)
      if (isNear(failure.c, *c)) return afterFailure(cell, failure);
    const std::size_t before = equations_.evaluations();
    std::optional<RootEquations::Proof> proof = equations_.prove(*c, q);
    Failure failure{*c, {}};
    if (!proof && !q.empty()) {
      Box thin;
      for (const Interval& each : q) thin.emplace_back(midpoint(each));
      if (std::optional<RootEquations::Proof> ofMiddle = equations_.prove(*c, thin))
        failure.alone = std::move(ofMiddle->alone);
    }
    proofCells_ += equations_.evaluations() - before;
    if (proof) {
      parts_[cell.q].proofs.push_back(proofs_.size());
      proofs_.push_back({std::move(*proof), q, cell.q});
      return Attempt::proved;
    }
    std::vector<Failure>& failures = parts_[cell.q].failures;
    constexpr std::size_t most = 64;
    if (failures.size() == most) failures.erase(failures.begin());
    failures.push_back(failure);
    return afterFailure(cell, failure);
  }

  bool isNear(const std::vector<double>& a, const std::vector<double>& b) const {
    for (int i = 0; i < n_; ++i)
      if (!(std::abs(a[i] - b[i]) <= 0x1p-40 * (units_[i] + std::abs(a[i])))) return false;
    return true;
  }

  /// Cutting states does not help where a root is alone for the parameters' middle in all of the cell.
  static Attempt afterFailure(const Cell& cell, const Failure& failure) {
    return !failure.alone.empty() && isWithin(cell.x, failure.alone) ? Attempt::parameters : Attempt::failed;
  }

  /// At a side of a box in which a proved root is alone, where the cell is not much larger.
  bool cutAtProofs(const Cell& cell) {
    constexpr double much = 8;
    for (const std::size_t k : proofsFor(cell.q)) {
      const Box& alone = proofs_[k].alone;
      int at = -1;
      double face = 0, largest = 0;
      bool meets = true;
      for (int i = 0; i < n_ && meets; ++i) {
        const Interval x = cell.x[i], inner = alone[i];
        meets = x.lower() < inner.upper() && inner.lower() < x.upper() && width(x) < much * width(inner);
        const double whole = std::max(width(x), 0x1p-1000);
        if (const double below = (inner.lower() - x.lower()) / whole; below > largest)
          largest = below, at = i, face = inner.lower();
        if (const double above = (x.upper() - inner.upper()) / whole; above > largest)
          largest = above, at = i, face = inner.upper();
      }
      if (!meets || at < 0) continue;
      Cell lower = cell, upper = cell;
      lower.x[at] = Interval(cell.x[at].lower(), face);
      upper.x[at] = Interval(face, cell.x[at].upper());
      ++lower.cuts, ++upper.cuts;
      put(std::move(lower));
      put(std::move(upper));
      return true;
    }
    return false;
  }

  bool canBeCut(const Interval& x, double resolution) const {
    const double middle = midpoint(x);
    return width(x) > resolution && x.lower() < middle && middle < x.upper();
  }
  bool canCutState(const Cell& cell, int i) const { return canBeCut(cell.x[i], search_.resolution * units_[i]); }
  bool canCutParameter(const Cell& cell, std::size_t l) const {
    return canBeCut(parts_[cell.q].box[l], search_.parameterResolution * width(widest_[l]));
  }

  bool cutParameters(const Cell& cell, const std::vector<double>& scores) {
    std::optional<std::size_t> best;
    for (std::size_t l = 0; l < scores.size(); ++l)
      if (canCutParameter(cell, l) && (!best || scores[l] > scores[*best])) best = l;
    if (!best) return false;
    cutParameter(cell, *best);
    return true;
  }

  void cutParameter(const Cell& cell, std::size_t l) {
    if (parts_[cell.q].lowerHalf == none) {
      const Box whole = parts_[cell.q].box;
      const auto [lower, upper] = bisect(whole[l]);
      parts_[cell.q].lowerHalf = parts_.size();
      for (const Interval& half : {lower, upper}) {
        parts_.push_back({whole, cell.q});
        parts_.back().box[l] = half;
        adopt(parts_.size() - 1);
      }
    }
    const std::size_t lower = parts_[cell.q].lowerHalf;
    for (const std::size_t half : {lower, lower + 1}) put({cell.x, half, cell.cuts, cell.parameterCuts + 1});
  }

  /// Where F varies most; if that is by a parameter that is as narrow as parameters become, states would be cut in
  /// vain, unless one makes up much of what some outputs vary by.
  void cut(Cell cell, const std::vector<double>& xScore, const std::vector<double>& qScore) {
    int state = -1;
    for (int i = 0; i < n_; ++i)
      if (canCutState(cell, i) && (state < 0 || xScore[i] > xScore[state])) state = i;
    const auto parameter = std::ranges::max_element(qScore);
    if (parameter != qScore.end() && (state < 0 || *parameter > xScore[state])) {
      const auto l = static_cast<std::size_t>(parameter - qScore.begin());
      if (canCutParameter(cell, l)) return cutParameter(cell, l);
      if (cutParameters(cell, qScore)) return;
      constexpr double much = 0.5;  // of one output, or of several together
      if (state < 0 || xScore[state] < much) return leave(std::move(cell), Why::narrow);
    }
    if (state < 0) return leave(std::move(cell), Why::narrow);
    const auto [lower, upper] = bisect(cell.x[state]);
    ++cell.cuts;
    Cell other = cell;
    cell.x[state] = lower;
    other.x[state] = upper;
    put(std::move(other));
    put(std::move(cell));
  }

  void leave(Cell cell, Why why) { left_.push_back({std::move(cell.x), parts_[cell.q].box, why, cell.q}); }

  enum class Relation { same, different, unknown };

  /// Of two proofs whose parameters meet: all_roots.hpp says why one p is enough.
  Relation relationOf(const Proof& a, const Proof& b) {
    const auto decided = [&](const Box& rootA, const Box& rootB) {
      if (isApart(rootA, rootB)) return Relation::different;
      if (isWithin(rootA, b.alone) || isWithin(rootB, a.alone)) return Relation::same;
      return Relation::unknown;
    };
    const Relation known = decided(a.root, b.root);
    if (known != Relation::unknown) return known;
    Box p;
    for (const Interval& each : commonOf(a.q, b.q)) p.emplace_back(midpoint(each));
    const Box rootA = a.rootAt(p), rootB = b.rootAt(p);
    const Relation there = decided(rootA, rootB);
    return there != Relation::unknown ? there : decided(thinRoot(rootA, p), thinRoot(rootB, p));
  }

  /// Of a root box of a proof for these parameters, for a single one of them.
  Box thinRoot(Box root, const Box& p) {
    constexpr int most = 20;
    for (int k = 0; k < most; ++k) {
      const Box before = root;
      if (!equations_.contract(root, p) || !equations_.isTame() || !equations_.step(root, p)) return before;
      bool isGained = false;
      for (int i = 0; i < n_; ++i) isGained = isGained || width(root[i]) < 0.9 * width(before[i]);
      if (!isGained) break;
    }
    return root;
  }

  /// Whether these parts of the parameters leave nothing of one.
  bool cover(const std::vector<char>& isPart, std::size_t part) const {
    if (isPart[part] != 0) return true;
    const std::size_t lower = parts_[part].lowerHalf;
    return lower != none && cover(isPart, lower) && cover(isPart, lower + 1);
  }

  Box allParameters(const Box& q) const {
    Box all = parameters_;
    for (std::size_t l = 0; l < q.size(); ++l) all[equations_.wide()[l]] = q[l];
    return all;
  }

  AllRoots result() {
    AllRoots roots;
    std::vector<std::pair<std::size_t, std::size_t>> different;
    Joined joined(proofs_.size());
    for (std::size_t j = 0; j < proofs_.size(); ++j)
      for (std::size_t i = 0; i < j; ++i) {
        if (isApart(proofs_[i].q, proofs_[j].q)) continue;
        const Relation relation = relationOf(proofs_[i], proofs_[j]);
        if (relation == Relation::same) joined.join(i, j);
        if (relation == Relation::different) different.emplace_back(i, j);
        if (relation == Relation::unknown)
          left_.push_back(
              {hullOf(proofs_[i].root, proofs_[j].root), commonOf(proofs_[i].q, proofs_[j].q), Why::narrow});
      }
    std::vector<char> isTwofold(proofs_.size(), 0);  // two roots of one p are of one branch: round a double root
    for (const auto& [i, j] : different)
      if (joined.first(i) == joined.first(j)) isTwofold[joined.first(i)] = 1;
    for (const std::vector<std::size_t>& set : joined.sets()) {
      RootBranch branch;
      std::vector<char> isPart(parts_.size(), 0);
      bool isInside = true, isOutside = true;
      for (const std::size_t k : set) {
        const Proof& proof = proofs_[k];
        branch.root = branch.parts.empty() ? proof.root : hullOf(branch.root, proof.root);
        branch.alone = branch.parts.empty() ? proof.alone : commonOf(branch.alone, proof.alone);
        branch.parts.push_back({allParameters(proof.q), proof.root, proof.alone});
        isPart[proof.part] = 1;
        isInside = isInside && isWithin(proof.root, region_);
        isOutside = isOutside && isApart(proof.root, region_);
      }
      if (isOutside) continue;
      const bool isEverywhere = isTwofold[set.front()] == 0 && cover(isPart, 0);
      if (!isEverywhere || !isWithin(branch.root, branch.alone)) branch.alone.clear();
      (!isInside ? roots.border : isEverywhere ? roots.families : roots.partial).push_back(std::move(branch));
    }
    for (std::vector<RootBranch>* list : {&roots.families, &roots.border, &roots.partial})
      std::ranges::stable_sort(*list, [](const RootBranch& a, const RootBranch& b) {
        return std::ranges::lexicographical_compare(a.root, b.root, {}, midpoint, midpoint);
      });
    tellUndecided(roots);
    for (std::size_t k = 0; k < roots.families.size(); ++k)
      if (roots.families[k].alone.empty()) roots.families[k].alone = aloneAmong(roots, k);
    roots.cells = cells_ + extra();
    return roots;
  }

  /// A part of the region that holds all roots of a family, but none of others or undecided ones: there it is alone.
  Box aloneAmong(const AllRoots& roots, std::size_t family) const {
    const Box& root = roots.families[family].root;
    Box alone = region_;
    const auto keepsOut = [&](const Box& other) {
      if (isApart(other, alone)) return true;
      int at = -1;
      double widest = 0, low = 0, high = 0;
      for (int i = 0; i < n_; ++i) {
        const double above = other[i].lower() - root[i].upper(), below = root[i].lower() - other[i].upper();
        if (std::max(above, below) / units_[i] <= widest) continue;
        widest = std::max(above, below) / units_[i];
        at = i;
        low = above > below ? alone[i].lower() : midpoint(Interval(other[i].upper(), root[i].lower()));
        high = above > below ? midpoint(Interval(root[i].upper(), other[i].lower())) : alone[i].upper();
      }
      if (at < 0) return false;
      alone[at] = Interval(low, high);
      return isApart(other, alone) && isWithin(root, alone);
    };
    for (const auto* list : {&roots.families, &roots.border, &roots.partial})
      for (const RootBranch& other : *list)
        if (&other != &roots.families[family] && !keepsOut(other.root)) return {};
    for (const UndecidedRoots& other : roots.undecided)
      if (!keepsOut(other.states)) return {};
    return alone;
  }

  /// Those that lie together, in little of the region, as one.
  void tellUndecided(AllRoots& roots) {
    std::vector<Left> left;
    for (Left& each : left_) {
      bool isKnown = false;
      for (const std::size_t k : proofsFor(each.part)) isKnown = isKnown || isWithin(each.x, proofs_[k].alone);
      if (!isKnown) left.push_back(std::move(each));
    }
    constexpr std::size_t most = 2000;
    while (left.size() > most) {  // two that were left one after the other have been cut from one, mostly
      std::vector<Left> half;
      for (std::size_t k = 0; k < left.size(); ++k)
        if (k % 2 == 0)
          half.push_back(std::move(left[k]));
        else
          half.back() = {hullOf(half.back().x, left[k].x), hullOf(half.back().q, left[k].q),
                         std::max(half.back().why, left[k].why)};
      left = std::move(half);
    }
    Joined joined(left.size());
    for (std::size_t j = 0; j < left.size(); ++j)
      for (std::size_t i = 0; i < j; ++i)
        if (areNear(left[i].x, left[j].x) && areNear(left[i].q, left[j].q)) joined.join(i, j);
    std::vector<Left> together;
    for (const std::vector<std::size_t>& set : joined.sets()) {
      Left all = left[set.front()];
      for (const std::size_t k : set) {
        all.x = hullOf(all.x, left[k].x);
        all.q = hullOf(all.q, left[k].q);
        all.why = std::max(all.why, left[k].why);
      }
      bool isLittle = true;
      for (int i = 0; i < n_; ++i) isLittle = isLittle && width(all.x[i]) <= 0x1p-6 * units_[i];
      if (isLittle)
        together.push_back(std::move(all));
      else
        for (const std::size_t k : set) together.push_back(left[k]);
    }
    left = std::move(together);
    for (Left& each : left) roots.undecided.push_back({std::move(each.x), allParameters(each.q), each.why});
  }

  RootEquations equations_;
  Box region_, parameters_, widest_;  // widest_: all of the parameters that are wide
  RootSearch search_;
  std::vector<double> units_;
  int n_;
  std::vector<ParameterPart> parts_;
  std::vector<std::vector<Cell>> heaps_;
  std::size_t finest_, cells_ = 0, proofCells_ = 0;
  std::vector<Proof> proofs_;
  std::vector<Left> left_;
};

void requireCount(const char* what, int expected, std::size_t given) {
  if (given != static_cast<std::size_t>(expected))
    throw std::invalid_argument("roots: the equations have " + std::to_string(expected) + ' ' + what + ", not " +
                                std::to_string(given));
}

}  // namespace

AllRoots allRoots(const Program& f, const Box& region, const Box& parameters, const RootSearch& search) {
  if (f.states() == 0) throw std::invalid_argument("roots: the equations have no unknown");
  if (f.outputs() != f.states())
    throw std::invalid_argument("roots: " + std::to_string(f.outputs()) + " equations for " +
                                std::to_string(f.states()) + " unknowns");
  requireCount("unknowns", f.states(), region.size());
  requireCount("parameters", f.parameters(), parameters.size());
  if (search.also != nullptr && (search.also->states() != f.states() || search.also->parameters() != f.parameters()))
    throw std::invalid_argument("roots: what holds at them besides is of other unknowns, or parameters");
  for (const Box& box : {region, parameters})
    for (const Interval& each : box)
      if (!isCommon(each)) throw std::invalid_argument("roots: " + toString(each) + " is not bounded");
  return Searcher(f, region, parameters, search).find();
}

}  // namespace gamut
