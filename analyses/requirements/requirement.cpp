// What boxes about the nominal values and the distributions of the margins say, whatever the number of quantities; and
// three searches over the same cells: where most probability is undecided, where the deviations are least, where the
// values are most possible. Each takes the cell that matters most, and bisects it unless it is decided.
#include "analyses/requirements/requirement.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "analyses/requirements/cube.hpp"
#include "analyses/requirements/joint_probability.hpp"
#include "analyses/requirements/nominal_boxes.hpp"
#include "analyses/work.hpp"
#include "scalars/elementary/rounding.hpp"

namespace gamut {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

class Examiner {
 public:
  Examiner(const FlowModels& models, const CellQuestion& question, const std::vector<CellQuantity>& quantities,
           const RequirementOptions& options)
      : models_(models),
        question_(withBesides(models, question, quantities)),
        cells_(models, question_),
        quantities_(quantities),
        options_(options),
        boxes_(models, cells_, quantities) {
    below_.resize(quantities.size());
    isPlain_ = options.masses == nullptr || options.masses->isPlain();
    deviate_.assign(quantities.size(), 1);
  }

  RequirementFinding find() {
    lookForViolation();
    if (finding_.isAlwaysMet) {
      finding_.met = finding_.factor = 1;
      finding_.probability = Interval(1.0);
      finding_.violationPossibility = Interval(0.0);
      return std::move(finding_);
    }
    findShares();
    if (finding_.met == 0) lookForWhatIsMet();
    measureDeviations();
    measurePossibility();
    return std::move(finding_);
  }

  double factor(const std::vector<char>& deviate) {
    deviate_ = deviate;
    measureDeviations();
    return finding_.factor;
  }

  /// A box of a greater factor holds that of a lesser one, so what holds in one violates the requirement in all that
  /// are greater.
  Interval factorAlone(std::size_t quantity) {
    deviate_.assign(quantities_.size(), 0);
    deviate_[quantity] = 1;
    const auto refuted = [&](double factor) {
      const std::optional<std::vector<double>> values = boxes_.violationIn(within(factor));
      return values ? std::optional(shareOf(quantity, (*values)[quantity])) : std::nullopt;
    };
    if (const std::optional<double> alone = refuted(0)) return {0.0, *alone};
    measureDeviations();
    const double met = finding_.factor;
    for (double beyond = 0.25 * options_.factorGap; met < 1 && !(workLeft() < 0); beyond *= 4) {
      if (const std::optional<double> above = refuted(std::min(1.0, met + beyond))) return {met, std::max(met, *above)};
      if (met + beyond >= 1) break;
    }
    return {met, 1.0};
  }

 private:
  struct Entry {
    double key;
    std::size_t number;  // so that the order depends on nothing else
    std::unique_ptr<Cell> cell;
    bool operator<(const Entry& other) const { return key != other.key ? key < other.key : number > other.number; }
  };

  /// Takes cells by falling key until `take` says that it is enough. `take` sees those that are decided, or fine
  /// enough, or that may not be bisected any more.
  template <class Key, class Take>
  void search(const Key& keyOf, const Take& take) {
    std::vector<Entry> heap;
    std::size_t number = 0, count = 0;
    double bytes = 0;
    const double least = workLeft() - workLeft() / std::max(searchesLeft_--, 1);
    const auto push = [&](std::unique_ptr<Cell> cell) {
      bytes += cell->bytes();
      const double key = keyOf(*cell);
      heap.push_back({key, number++, std::move(cell)});
      std::push_heap(heap.begin(), heap.end());
    };
    push(cells_.whole());
    while (!heap.empty()) {
      std::pop_heap(heap.begin(), heap.end());
      const std::unique_ptr<Cell> cell = std::move(heap.back().cell);
      heap.pop_back();
      bytes -= cell->bytes();
      ++count;
      const bool isCancelled = options_.cancelled != nullptr && *options_.cancelled;
      std::vector<std::unique_ptr<Cell>> halves;
      const bool mayGoOn =
          !isCancelled && count < options_.mostCells && bytes < options_.mostBytes && !(workLeft() < least);
      if (cell->verdict() == Cell::Verdict::open && mayGoOn && !isFineEnough_(*cell)) halves = cells_.halves(*cell);
      if (!halves.empty()) {
        for (std::unique_ptr<Cell>& half : halves) push(std::move(half));
        continue;
      }
      if (!take(*cell)) break;
    }
    finding_.cells += count;
  }

  double workLeft() const { return options_.mostWork - static_cast<double>(Work::counted() - began_); }

  /// The values of a quantity in a cell.
  Interval valuesOf(std::size_t quantity, const Cell& cell) const {
    const FlowSymbol& of = models_.components[quantities_[quantity].component];
    const Interval& range = quantities_[quantity].uncertain->range;
    if (of.symbol < 0) return range;
    const double centre = cell.part().centre[of.symbol], half = cell.part().half[of.symbol];
    return intersection(hull(valueAt(of, centre - half), valueAt(of, centre + half)), range);
  }

  static Interval valueAt(const FlowSymbol& of, double xi) {
    return Interval(of.centre) + Interval(of.half) * Interval(xi);
  }

  /// Its probability: between the distribution functions of its ends. Where cells' do not add up, the volume.
  Interval massOf(const Cell& cell) {
    if (!isPlain_) return volumeOf(cell);
    Interval mass(1.0);
    for (std::size_t q = 0; q < quantities_.size(); ++q) {
      const FlowSymbol& of = models_.components[quantities_[q].component];
      if (of.symbol < 0) continue;
      const double centre = cell.part().centre[of.symbol], half = cell.part().half[of.symbol];
      mass = mass * intersection(belowOf(q, centre + half) - belowOf(q, centre - half), Interval(0.0, 1.0));
    }
    return mass;
  }

  /// Of a quantity at an end of a cell; found once.
  Interval belowOf(std::size_t quantity, double xi) {
    if (xi == -1) return Interval(0.0);
    if (xi == 1) return Interval(1.0);
    const auto [found, isNew] = below_[quantity].try_emplace(xi);
    if (!isNew) return found->second;
    const FlowSymbol& of = models_.components[quantities_[quantity].component];
    return found->second = quantities_[quantity].uncertain->distribution.enclosedBelow(
               Interval(of.centre) + Interval(of.half) * Interval(xi));
  }

  double volumeOf(const Cell& cell) const {  // of [-1,1]^k, as a share: exact unless it underflows
    double volume = 1;
    for (const double half : cell.part().half) volume *= half;
    return volume;
  }

  /// Of every quantity.
  template <class Values>
  std::vector<Interval> valuesOfAll(const Values& of) const {
    std::vector<Interval> values;
    for (std::size_t q = 0; q < quantities_.size(); ++q) values.push_back(of(q, *quantities_[q].uncertain));
    return values;
  }

  // ---- Violation ----------------------------------------------------------------------------------------------------

  /// Where margins are least first; if none of the cells is left open, the requirement is met everywhere.
  void lookForViolation() {
    const std::vector<Interval> all = valuesOfAll([](std::size_t, const Uncertain& u) { return u.range; });
    if (boxes_.isMet(all)) {
      finding_.isAlwaysMet = true;
      return;
    }
    if (std::optional<std::vector<double>> violation = boxes_.violationIn(all)) {
      finding_.violating = std::move(*violation);
      return;
    }
    bool isMet = true;
    isFineEnough_ = [](const Cell&) { return false; };
    search([](const Cell& cell) { return cell.verdict() == Cell::Verdict::violated ? infinite : -cell.least(); },
           [&](const Cell& cell) {
             if (cell.verdict() == Cell::Verdict::met) return true;
             isMet = false;
             const std::vector<double> values = insideOf(cell);
             if (values.empty()) return true;  // nothing but what the box was rounded by
             (cell.verdict() == Cell::Verdict::violated ? finding_.violating : finding_.doubtful) = values;
             return false;
           });
    finding_.isAlwaysMet = isMet;
  }

  /// Where margins are greatest first; if all of the cells are violated, it never is.
  void lookForWhatIsMet() {
    bool isViolated = true;
    isFineEnough_ = [](const Cell&) { return false; };
    search([](const Cell& cell) { return cell.verdict() == Cell::Verdict::met ? infinite : cell.least(); },
           [&](const Cell& cell) { return isViolated = cell.verdict() == Cell::Verdict::violated; });
    finding_.isNeverMet = isViolated;
    if (!isViolated) return;
    finding_.violated = 1;
    finding_.probability = Interval(0.0);
  }

  /// Values of a quantity that are certainly in the cell, and certainly meant.
  Interval insideOf(std::size_t quantity, const Cell& cell) const {
    const FlowSymbol& of = models_.components[quantities_[quantity].component];
    const Interval meant = quantities_[quantity].uncertain->inside();
    if (of.symbol < 0) return meant;
    const double centre = cell.part().centre[of.symbol], half = cell.part().half[of.symbol];
    const double lower = valueAt(of, centre - half).upper(), upper = valueAt(of, centre + half).lower();
    return lower <= upper ? intersection(Interval(lower, upper), meant) : Interval::empty();
  }

  /// Such values of all; none where there are none.
  std::vector<double> insideOf(const Cell& cell) const {
    std::vector<double> values;
    for (std::size_t q = 0; q < quantities_.size(); ++q) {
      const Interval inside = insideOf(q, cell);
      if (isEmpty(inside)) return {};
      values.push_back(midpoint(inside));
    }
    return values;
  }

  // ---- Probability --------------------------------------------------------------------------------------------------

  /// What of an open cell's probability planes decide. Where its quantities are independent, so are
  /// w_i = 2 (F(q_i) - F(a_i)) / (F(b_i) - F(a_i)) - 1, uniform on [-1,1], with a_i and b_i its ends. Where the density
  /// is monotone, w - η is concave or convex in η and zero at both ends, hence nowhere more than twice what it is in
  /// the middle: |w_i - η_i| ≤ δ_i = 2 |w_i(0)|. So Σ s_i η_i > c where Σ s_i w_i > c + Σ |s_i| δ_i.
  struct Decided {
    double met = 0, violated = 0;              // shares of the cell's probability, at least
    double metVolume = 0, violatedVolume = 0;  // of its volume
    bool isFine = false;                       // what is left is not made less by bisection
  };
  Decided decidedOf(const Cell& cell) {
    Decided decided;
    const CellPlanes planes = cells_.planes(cell);
    const auto metBeyond = [&](double bend) {  // not met: Σ a w <= -metAbove + bend, at most
      return planes.met.empty()
                 ? 0.0
                 : std::max(0.0, subDown(1.0, partOfCube(planes.met, addUp(-planes.metAbove, bend)).upper()));
    };
    const auto violatedBeyond = [&](double bend) {
      return planes.violated.empty() ? 0.0 : partOfCube(planes.violated, subDown(-planes.violatedBelow, bend)).lower();
    };
    constexpr double mostly = 0.85;
    decided.metVolume = metBeyond(0);
    decided.violatedVolume = violatedBeyond(0);
    if (!isPlain_) {
      decided.met = decided.metVolume, decided.violated = decided.violatedVolume;
      return decided;
    }
    std::vector<double> bend(models_.symbols, 0.0);
    for (std::size_t q = 0; q < quantities_.size(); ++q) {
      const FlowSymbol& of = models_.components[quantities_[q].component];
      if (of.symbol < 0) continue;
      const Distribution& distribution = quantities_[q].uncertain->distribution;
      const double centre = cell.part().centre[of.symbol], half = cell.part().half[of.symbol];
      if (!distribution.isMonotone(valuesOf(q, cell))) return decided;
      const Interval low = belowOf(q, centre - half), high = belowOf(q, centre + half);
      const Interval middle = 2.0 * (belowOf(q, centre) - low) / (high - low) - Interval(1.0);
      if (isEmpty(middle) || !isBounded(middle)) return decided;
      // By rounding the cell reaches beyond the interval, where F rests, by s of its half-width: w - η' is bent to one
      // side with η' the same on what is left, |η' - η| <= s, and concave functions are d(x) >= max d (1 - |x|)/2.
      const Interval ends(valueAt(of, centre - half).lower(), valueAt(of, centre + half).upper());
      const Interval& range = quantities_[q].uncertain->range;
      const double beyond = std::max({subUp(range.lower(), ends.lower()), subUp(ends.upper(), range.upper()), 0.0});
      const Interval s = Interval(beyond) / (Interval(of.half) * Interval(half));
      if (!(s.upper() < 0.5)) return decided;
      bend[of.symbol] = std::min(2.0, (2.0 * (abs(middle) + s) / (Interval(1.0) - s) + s).upper());
    }
    const auto bendOf = [&](const std::vector<double>& slope) {
      Interval sum(0.0);
      for (std::size_t l = 0; l < slope.size(); ++l) sum = sum + abs(Interval(slope[l])) * Interval(bend[l]);
      return sum.upper();
    };
    decided.met = metBeyond(bendOf(planes.met));
    decided.violated = violatedBeyond(bendOf(planes.violated));
    const double band =
        planes.violatedBelow - planes.metAbove + bendOf(planes.met) + bendOf(planes.violated);  // of what is open
    decided.isFine = !planes.met.empty() && !planes.violated.empty() && planes.rest > mostly * band;
    return decided;
  }

  /// By the distributions of the margins, which say most of many quantities; by planes through cells, which say most of
  /// few that matter together. The shares of the box's volume are probabilities of evenly distributed values.
  void findShares() {
    const auto& masses = [&]() -> const JointMasses& {
      if (options_.masses != nullptr) return *options_.masses;
      return ownMasses_.emplace(massesOf([](const Uncertain& u) { return u.distribution; }));
    }();
    const Interval byMargins = marginsProbability(masses);
    const bool areEven = isPlain_ && std::ranges::all_of(quantities_, [](const CellQuantity& quantity) {
                           const Uncertain& u = *quantity.uncertain;
                           return u.distribution.name() == "uniform" && isEqual(u.distribution.support(), u.range);
                         });
    Interval volume = byMargins;
    if (!areEven)
      volume = marginsProbability(massesOf([](const Uncertain& u) { return Distribution::uniform(u.range); }));
    const double widest = std::max(width(volume), isPlain_ ? width(byMargins) : 0.0);
    constexpr int few = 3;  // symbols: of these cells are cheap, and planes through them all but exact
    if (widest > options_.gap || models_.symbols <= few) weigh();
    finding_.met = std::max(finding_.met, volume.lower());
    finding_.violated = std::max(finding_.violated, std::max(0.0, subDown(1.0, volume.upper())));
    // Cells that are bisections of the box do not add up where the quantities are not independent.
    if (!isPlain_) finding_.probability = Interval(0.0, 1.0);
    if (const Interval both = intersection(finding_.probability, byMargins); !isEmpty(both))
      finding_.probability = both;
  }

  template <class DistributionOf>
  JointMasses massesOf(const DistributionOf& of) const {
    std::vector<FlowSymbol> symbols;
    std::vector<Uncertain> all;
    std::vector<const Uncertain*> uncertain;
    for (const CellQuantity& quantity : quantities_) {
      symbols.push_back(models_.components[quantity.component]);
      all.push_back(*quantity.uncertain);
      all.back().distribution = of(all.back());
    }
    for (const Uncertain& u : all) uncertain.push_back(&u);
    return {models_.symbols, symbols, uncertain};
  }

  Interval marginsProbability(const JointMasses& masses) {
    constexpr double share = 0.4, unlimited = 1.2e9;  // of the work
    const double work = std::isinf(options_.mostWork) ? unlimited : share * workLeft();
    return probabilityOf(cells_, masses, options_.gap, work, options_.cancelled);
  }

  /// P(met) ≥ Σ lower masses of what is met, ≤ 1 - Σ lower masses of what is violated.
  void weigh() {
    double met = 0, violated = 0;  // rounded down
    double undecided = 0;          // of all cells that wait, about
    struct Waiting {
      Decided decided;
      double undecided;
    };
    std::map<const Cell*, Waiting> waiting;  // open cells
    isFineEnough_ = [&](const Cell& cell) {
      if (undecided <= options_.gap || waiting[&cell].decided.isFine) return true;
      undecided -= waiting[&cell].undecided;
      return false;
    };
    search(
        [&](const Cell& cell) {
          if (cell.verdict() != Cell::Verdict::open) return infinite;  // what is decided is counted at once
          const double mass = massOf(cell).upper();
          const Decided share = decidedOf(cell);
          waiting[&cell] = {share, mass * (1 - share.met - share.violated)};
          undecided += waiting[&cell].undecided;
          return waiting[&cell].undecided;
        },
        [&](const Cell& cell) {
          const Interval mass = massOf(cell);
          if (cell.verdict() == Cell::Verdict::met) {
            met = addDown(met, mass.lower());
            finding_.met = addDown(finding_.met, volumeOf(cell));
          } else if (cell.verdict() == Cell::Verdict::violated) {
            violated = addDown(violated, mass.lower());
            finding_.violated = addDown(finding_.violated, volumeOf(cell));
            if (finding_.violating.empty()) finding_.violating = insideOf(cell);
          } else {
            const Decided share = waiting[&cell].decided;
            met = addDown(met, mulDown(mass.lower(), share.met));
            violated = addDown(violated, mulDown(mass.lower(), share.violated));
            finding_.met = addDown(finding_.met, mulDown(volumeOf(cell), share.metVolume));
            finding_.violated = addDown(finding_.violated, mulDown(volumeOf(cell), share.violatedVolume));
          }
          return true;
        });
    finding_.probability = Interval(met, std::max(met, subUp(1.0, violated)));
  }

  // ---- Deviations ---------------------------------------------------------------------------------------------------

  /// The least factor of a box about the nominal values that has a point in common with these: rounded down.
  double factorOf(std::size_t quantity, const Interval& values) const {
    const Uncertain& u = *quantities_[quantity].uncertain;
    if (contains(values, u.nominal)) return 0;
    const bool isAbove = values.lower() > u.nominal;
    const Interval distance = isAbove ? Interval(values.lower()) - u.nominal : u.nominal - Interval(values.upper());
    const Interval whole = isAbove ? Interval(u.range.upper()) - u.nominal : u.nominal - Interval(u.range.lower());
    return std::clamp((distance / whole).lower(), 0.0, 1.0);
  }

  double factorOf(const Cell& cell) const {
    double factor = 0;
    for (std::size_t q = 0; q < quantities_.size(); ++q)
      if (deviate_[q] != 0) factor = std::max(factor, factorOf(q, valuesOf(q, cell)));
    return factor;
  }

  /// The greatest over what the cell covers.
  double farthestOf(const Cell& cell) const {
    double factor = 0;
    for (std::size_t q = 0; q < quantities_.size(); ++q) {
      const Interval values = valuesOf(q, cell);
      if (deviate_[q] != 0)
        factor = std::max({factor, factorOf(q, Interval(values.lower())), factorOf(q, Interval(values.upper()))});
    }
    return factor;
  }

  /// How far a value is from the nominal one, as a share of the deviation to that side: rounded up.
  double shareOf(std::size_t quantity, double value) const {
    const Uncertain& u = *quantities_[quantity].uncertain;
    if (value == u.nominal) return 0;
    const double end = value > u.nominal ? u.range.upper() : u.range.lower();
    return std::clamp(((Interval(value) - u.nominal) / (Interval(end) - u.nominal)).upper(), 0.0, 1.0);
  }

  /// The values of all quantities, of which those that count deviate so many times less.
  std::vector<Interval> within(double factor) const {
    return valuesOfAll([&](std::size_t q, const Uncertain& u) {
      const Interval nominal(u.nominal);
      return deviate_[q] == 0 || factor == 1 ? u.range
                                             : intersection(nominal + Interval(factor) * (u.range - nominal), u.range);
    });
  }

  /// Of the boxes about the nominal values; if cells may say more, of these besides.
  void measureDeviations() {
    if (boxes_.isMet(within(1))) {
      finding_.factor = 1;
      return;
    }
    double met = 0, open = 1;
    for (int i = 0; i < boxes_.patience() && open - met > 0.25 * options_.factorGap; ++i)
      (boxes_.isMet(within(0.5 * (met + open))) ? met : open) = 0.5 * (met + open);
    if (open - met <= options_.factorGap && boxes_.violationIn(within(open))) {
      finding_.factor = met;
      return;
    }
    searchDeviations();
    finding_.factor = std::max(finding_.factor, met);
  }

  void searchDeviations() {
    finding_.factor = 1;
    isFineEnough_ = [&](const Cell& cell) { return farthestOf(cell) - factorOf(cell) < options_.factorGap; };
    search([&](const Cell& cell) { return -factorOf(cell); },
           [&](const Cell& cell) {
             if (cell.verdict() == Cell::Verdict::met) return true;
             finding_.factor = factorOf(cell);
             return false;
           });
  }

  // ---- Possibility --------------------------------------------------------------------------------------------------

  /// An upper bound of the membership at a value: of a degree above it the value lies outside the cut.
  static double degreeAtMost(const Membership& membership, double value) {
    if (contains(membership.core(), value)) return 1;
    const double degree = membership(value);
    for (double more = 0x1p-50; degree + more < 1; more *= 2)
      if (!contains(membership.cut(degree + more), value)) return degree + more;
    return 1;
  }

  /// The most possible values of a cell.
  Interval membershipOf(const Cell& cell) const {
    double least = 1, most = 1;
    for (std::size_t q = 0; q < quantities_.size(); ++q) {
      const Membership& membership = quantities_[q].uncertain->membership;
      const Interval values = valuesOf(q, cell);
      if (!isEmpty(intersection(values, membership.core()))) continue;
      const double nearest = values.lower() > membership.core().upper() ? values.lower() : values.upper();
      least = std::min(least, std::max(0.0, membership(nearest)));
      most = std::min(most, degreeAtMost(membership, nearest));
    }
    return {std::min(least, most), most};
  }

  /// The degree of values that violate it, on the way from the nominal ones through the middle of a cell; 0 if none do.
  double degreeBeyond(const Cell& cell) {
    for (const double way : {1.0, 1.003, 1.01, 1.03, 1.1, 1.3, 2.0}) {
      std::vector<double> xi(models_.symbols, 0.0);
      double degree = 1;
      for (std::size_t q = 0; q < quantities_.size(); ++q) {
        const FlowSymbol& of = models_.components[quantities_[q].component];
        const Uncertain& u = *quantities_[q].uncertain;
        if (of.symbol < 0) continue;
        const double wanted = u.nominal + way * (midpoint(valuesOf(q, cell)) - u.nominal);
        const Interval inside = u.inside();
        if (isEmpty(inside)) return 0;
        xi[of.symbol] =
            std::clamp((std::clamp(wanted, inside.lower(), inside.upper()) - of.centre) / of.half, -1.0, 1.0);
        const Interval value = Interval(of.centre) + Interval(of.half) * Interval(xi[of.symbol]);
        if (!isSubset(value, u.range)) return 0;
        degree = std::min({degree, u.membership(value.lower()), u.membership(value.upper())});
      }
      if (degree == 0) return 0;
      if (cells_.verdictAt(xi) == Cell::Verdict::violated) return degree;
    }
    return 0;
  }

  /// The degree of the most possible values of a cell that are certainly meant.
  double degreeInside(const Cell& cell) const {
    double degree = 1;
    for (std::size_t q = 0; q < quantities_.size(); ++q) {
      const Uncertain& u = *quantities_[q].uncertain;
      const Interval values = insideOf(q, cell);
      if (!isEmpty(intersection(values, u.membership.core()))) continue;
      degree = std::min(degree, std::max(u.membership(values.lower()), u.membership(values.upper())));
    }
    return degree;
  }

  /// min t-norm over quantities that do not interact (Zadeh 1978): the possibility of a violation is that of the most
  /// possible values for which it is violated. No more than a level of which all values meet it; if cells may say more,
  /// by these besides.
  void measurePossibility() {
    constexpr double fine = 0.002;
    const auto cut = [&](double level) {
      return valuesOfAll([&](std::size_t, const Uncertain& u) { return u.membership.cut(level); });
    };
    if (boxes_.isMet(cut(0))) {
      finding_.violationPossibility = Interval(0.0);
      return;
    }
    double violated = 0, met = 1, open = 0;  // degrees: violated, met, neither is known
    const auto look = [&](double level) {
      const std::optional<std::vector<double>> violation = boxes_.violationIn(cut(level));
      if (violation) violated = std::max(violated, degreeOf(*violation));
    };
    if (boxes_.isMet(cut(1))) {
      for (int i = 0; i < boxes_.patience() && met - open > 0.25 * fine; ++i)
        (boxes_.isMet(cut(0.5 * (met + open))) ? met : open) = 0.5 * (met + open);
    } else {
      open = 1;
    }
    // Next to the least that is not met margins are next to zero.
    for (double back = 0; back < 1 && open - back >= 0 && violated == 0; back = back > 0 ? 4 * back : 0.125 * fine)
      look(open - back);
    if (met - violated > fine) {
      searchPossibility();
      met = std::min(met, finding_.violationPossibility.upper());
      violated = std::max(violated, finding_.violationPossibility.lower());
    }
    finding_.violationPossibility = Interval(std::min(violated, met), met);
  }

  /// Of values, at least.
  double degreeOf(const std::vector<double>& values) const {
    double degree = 1;
    for (std::size_t q = 0; q < quantities_.size(); ++q)
      if (models_.components[quantities_[q].component].symbol >= 0)
        degree = std::min(degree, quantities_[q].uncertain->membership(values[q]));
    return degree;
  }

  void searchPossibility() {
    constexpr double fine = 0.002;
    double least = 0, most = 0;
    int patience = 20;  // for one near which it is certainly violated
    isFineEnough_ = [&](const Cell& cell) {
      double lowest = 1;  // over the cell: of its farther ends
      for (std::size_t q = 0; q < quantities_.size(); ++q) {
        const Interval values = valuesOf(q, cell);
        const Membership& membership = quantities_[q].uncertain->membership;
        lowest = std::min({lowest, membership(values.lower()), membership(values.upper())});
      }
      return membershipOf(cell).upper() - lowest < fine;
    };
    search([&](const Cell& cell) { return membershipOf(cell).upper(); },
           [&](const Cell& cell) {
             if (cell.verdict() == Cell::Verdict::met) return true;
             most = std::max(most, membershipOf(cell).upper());  // the first one's
             least = cell.verdict() == Cell::Verdict::violated && !insideOf(cell).empty() ? degreeInside(cell)
                                                                                          : degreeBeyond(cell);
             return least == 0 && --patience > 0;
           });
    finding_.violationPossibility = Interval(std::min(least, most), most);
  }

  const FlowModels& models_;
  const CellQuestion question_;
  Cells cells_;
  const std::vector<CellQuantity>& quantities_;
  const RequirementOptions& options_;
  NominalBoxes boxes_;
  std::optional<JointMasses> ownMasses_;
  bool isPlain_ = true;                            // all independent, of known distributions
  std::vector<char> deviate_;                      // of the quantities: those that count in a factor
  std::vector<std::map<double, Interval>> below_;  // of each quantity: its distribution function by ξ
  std::function<bool(const Cell&)> isFineEnough_;
  const std::uint64_t began_ = Work::counted();
  int searchesLeft_ = 4;
  RequirementFinding finding_;
};

}  // namespace

CellQuestion withBesides(const FlowModels& models, CellQuestion question, const std::vector<CellQuantity>& quantities) {
  std::vector<char> isOwned(models.symbols, 0);
  for (const CellQuantity& quantity : quantities)
    if (const int symbol = models.components[quantity.component].symbol; symbol >= 0) isOwned[symbol] = 1;
  for (int l = 0; l < models.symbols; ++l)
    if (isOwned[l] == 0) question.besides.push_back(l);
  // At one moment both ask for the same.
  if (question.from == question.until) question.when = CellQuestion::When::always;
  return question;
}

RequirementFinding examine(const FlowModels& models, const CellQuestion& question,
                           const std::vector<CellQuantity>& quantities, const RequirementOptions& options) {
  return Examiner(models, question, quantities, options).find();
}

double guaranteedFactor(const FlowModels& models, const CellQuestion& question,
                        const std::vector<CellQuantity>& quantities, const std::vector<char>& deviate,
                        const RequirementOptions& options) {
  return Examiner(models, question, quantities, options).factor(deviate);
}

Interval factorAlone(const FlowModels& models, const CellQuestion& question,
                     const std::vector<CellQuantity>& quantities, std::size_t quantity,
                     const RequirementOptions& options) {
  return Examiner(models, question, quantities, options).factorAlone(quantity);
}

}  // namespace gamut
