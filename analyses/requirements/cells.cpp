// Parts come from bisections of [-1,1], or are hulls of bins of a joint distribution: these may overlap a model's part
// without being nested; then its polynomial stays that of its own part.
#include "analyses/requirements/cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "analyses/flow/embedding.hpp"
#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/work.hpp"
#include "scalars/elementary/rounding.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

double Cell::bytes() const {
  double bytes = sizeof(Cell) + 24.0 * static_cast<double>(chords_.size() + moments_.size());
  for (const Local& local : locals_) {
    bytes += sizeof(Local) + 16.0 * static_cast<double>(local.part.centre.size());
    for (const std::vector<double>& c : local.c) bytes += 48.0 + sizeof(double) * static_cast<double>(c.size());
  }
  return bytes;
}

Cells::Cells(const FlowModels& models, CellQuestion question) : models_(models), question_(std::move(question)) {
  if (question_.from > question_.until || question_.until >= models_.at.size())
    throw std::invalid_argument("the models do not reach to the end of the window");
  for (std::size_t row = question_.from; row <= question_.until; ++row)
    if (models_.at[row].empty() || (row > question_.from && models_.over[row].empty()))
      throw std::invalid_argument("there are no models of some time of the window");
}

const Cells::Tables& Cells::tablesOf(const FlowSnapshot& snapshot) const {
  std::unique_ptr<Tables>& found = tables_[snapshot.monomials.get()];
  if (found) return *found;
  const Monomials& m = *snapshot.monomials;
  found = std::make_unique<Tables>(Tables{PolynomialRange(snapshot.monomials), {}, {}, {}});
  for (int g = 0; g < m.count(); ++g) {
    bool isEven = true;
    int linear = -1;
    std::vector<int> symbols;
    for (int l = 0; l < models_.symbols; ++l) {
      isEven = isEven && m.exponent(g, l) % 2 == 0;
      if (m.linear(l) == g) linear = l;
      if (m.exponent(g, l) > 0) symbols.push_back(l);
    }
    found->isEven.push_back(isEven ? 1 : 0);
    found->linear.push_back(linear);
    found->symbols.push_back(std::move(symbols));
  }
  return *found;
}

std::unique_ptr<Cell> Cells::whole() {
  auto cell = std::make_unique<Cell>();
  cell->part_ = {std::vector<double>(models_.symbols, 0.0), std::vector<double>(models_.symbols, 1.0)};
  std::map<const FlowSnapshot*, std::size_t> places;
  const auto placeOf = [&](const FlowSnapshot& snapshot) {
    const auto [found, isNew] = places.try_emplace(&snapshot, cell->locals_.size());
    if (isNew) {
      Cell::Local local{&snapshot, snapshot.part, {}, {}, {}};
      for (const int margin : question_.margins) {
        local.c.push_back(snapshot.outputs[margin].c);
        local.radius.push_back(snapshot.outputs[margin].radius);
      }
      cell->locals_.push_back(std::move(local));
    }
    return found->second;
  };
  for (std::size_t row = question_.from; row <= question_.until; ++row) {
    Cell::Moment moment;
    for (const auto& snapshot : models_.at[row]) moment.snapshots.push_back(placeOf(*snapshot));
    cell->moments_.push_back(std::move(moment));
    if (row == question_.from) continue;
    for (const FlowChord& chord : models_.over[row])
      cell->chords_.push_back({&chord, placeOf(*chord.before), placeOf(*chord.behind)});
  }
  decide(*cell);
  return cell;
}

/// Σ over monomials of their least and greatest values; sums of N coefficients are off by N u Σ|c|.
Interval Cells::rangeOf(const Cell::Local& local, std::size_t margin) const {
  const Interval& bound = local.of->outputs[question_.margins[margin]].bound;
  const std::vector<double>& c = local.c[margin];
  if (c.empty()) return bound;
  const Tables& tables = tablesOf(*local.of);
  double down = 0, up = 0, norm = std::fabs(c[0]);
  Work::count(Work::cellTerm, static_cast<double>(c.size()) + 40);
  for (std::size_t g = 1; g < c.size(); ++g) {
    const bool isEven = tables.isEven[g] != 0;
    const double size = std::fabs(c[g]);
    norm += size;
    if (!isEven || c[g] < 0) down += size;
    if (!isEven || c[g] > 0) up += size;
  }
  const double rest = (local.radius[margin] + static_cast<double>(c.size() + 2) * bounds::unit * norm) * bounds::up;
  return intersection(Interval(subDown(c[0], (down * bounds::up + rest) * bounds::up),
                               addUp(c[0], (up * bounds::up + rest) * bounds::up)),
                      bound);
}

Cells::Outcome Cells::outcomeOf(const std::vector<Interval>& margins) const {
  bool isMet = true;
  for (std::size_t i = 0; i < margins.size(); ++i) {
    const bool isStrict = question_.isStrict[i] != 0;
    if (isStrict ? margins[i].upper() <= 0 : margins[i].upper() < 0) return Outcome::violated;
    isMet = isMet && (isStrict ? margins[i].lower() > 0 : margins[i].lower() >= 0);
  }
  return isMet ? Outcome::met : Outcome::open;
}

Cells::Outcome Cells::outcomeOf(const Cell& cell, const Cell::Chord& chord) const {
  std::vector<Interval> margins;
  for (std::size_t i = 0; i < question_.margins.size(); ++i) {
    const std::size_t of = at(question_.margins[i]);
    const Interval ends = hull(cell.locals_[chord.before].range[i], cell.locals_[chord.behind].range[i]);
    margins.push_back(intersection(ends + chord.of->sag[of], chord.of->bound[of]));
  }
  return outcomeOf(margins);
}

/// Always: met if it is at every time, violated if at one output time, or all of a chord, it is nowhere met.
/// Eventually: the other way round. What is decided of a cell is of its halves.
void Cells::decide(Cell& cell) {
  for (Cell::Local& local : cell.locals_) {
    local.range.clear();
    for (std::size_t i = 0; i < question_.margins.size(); ++i) {
      const Interval range = rangeOf(local, i);
      local.range.push_back(isTight_ ? tightRangeOf(local, i, range) : range);
    }
  }
  const bool isAlways = question_.when == CellQuestion::When::always;
  const Outcome throughout = isAlways ? Outcome::met : Outcome::violated;
  const Outcome once = isAlways ? Outcome::violated : Outcome::met;
  const bool isOneMoment = question_.from == question_.until;
  bool isThroughout = true;
  constexpr double infinite = std::numeric_limits<double>::infinity();
  double least = isAlways ? infinite : -infinite;
  std::vector<Cell::Moment> moments;
  for (Cell::Moment& moment : cell.moments_) {
    bool isOnce = !moment.snapshots.empty(), isOver = true;
    for (const std::size_t place : moment.snapshots) {
      const Outcome outcome = outcomeOf(cell.locals_[place].range);
      for (const Interval& margin : cell.locals_[place].range)
        least = isAlways ? std::min(least, margin.lower()) : std::max(least, margin.lower());
      isOnce = isOnce && outcome == once;
      isOver = isOver && outcome == throughout;
    }
    if (isOnce) {
      cell.verdict_ = isAlways ? Cell::Verdict::violated : Cell::Verdict::met;
      return;
    }
    if (isOver) continue;
    if (isOneMoment) isThroughout = false;
    moments.push_back(std::move(moment));
  }
  bool isOnceBetween = false;
  std::erase_if(cell.chords_, [&](const Cell::Chord& chord) {
    const Outcome outcome = outcomeOf(cell, chord);
    isOnceBetween =
        isOnceBetween || (outcome == once && !models_.areAlternatives && isInside(cell.part_, chord.of->part));
    return outcome == throughout;
  });
  if (isOnceBetween) {
    cell.verdict_ = isAlways ? Cell::Verdict::violated : Cell::Verdict::met;
    return;
  }
  cell.moments_ = std::move(moments);
  cell.least_ = least;
  if (cell.chords_.empty() && isThroughout) {
    cell.verdict_ = isAlways ? Cell::Verdict::met : Cell::Verdict::violated;
    return;
  }
  dropUnused(cell);
}

void Cells::dropUnused(Cell& cell) const {
  std::vector<std::size_t> place(cell.locals_.size(), cell.locals_.size());
  std::vector<Cell::Local> used;
  const auto use = [&](std::size_t& local) {
    if (place[local] == cell.locals_.size()) {
      place[local] = used.size();
      used.push_back(std::move(cell.locals_[local]));
    }
    local = place[local];
  };
  for (Cell::Chord& chord : cell.chords_) use(chord.before), use(chord.behind);
  for (Cell::Moment& moment : cell.moments_)
    for (std::size_t& local : moment.snapshots) use(local);
  cell.locals_ = std::move(used);
}

std::vector<int> Cells::symbolsOf(const Cell& cell) const {
  std::vector<double> weight(models_.symbols, 0.0);
  // What no bisection makes less: radii, and how far outputs leave their chords.
  std::vector<double> sag(cell.locals_.size() * question_.margins.size(), 0.0);
  for (const Cell::Chord& chord : cell.chords_)
    for (const std::size_t place : {chord.before, chord.behind})
      for (std::size_t i = 0; i < question_.margins.size(); ++i)
        if (const Interval& by = chord.of->sag[question_.margins[i]]; isBounded(by)) {
          double& most = sag[place * question_.margins.size() + i];
          most = std::max(most, 0.5 * width(by));
        }
  for (std::size_t place = 0; place < cell.locals_.size(); ++place)
    for (std::size_t i = 0; i < question_.margins.size(); ++i) {
      const Cell::Local& local = cell.locals_[place];
      const Tables& tables = tablesOf(*local.of);
      std::vector<double> mass(weight.size(), 0.0);
      Work::count(Work::cellTerm, static_cast<double>(local.c[i].size()) + 40);
      double all = local.radius[i] + sag[place * question_.margins.size() + i];
      for (std::size_t g = 1; g < local.c[i].size(); ++g) {
        const double size = std::fabs(local.c[i][g]);
        all += size;
        for (const int l : tables.symbols[g]) mass[l] += size;
      }
      for (std::size_t l = 0; l < mass.size() && all > 0 && std::isfinite(all); ++l)
        weight[l] = std::max(weight[l], mass[l] / all);
    }
  // A part that only some models cover is bisected towards these.
  for (const Cell::Local& local : cell.locals_)
    for (std::size_t l = 0; l < weight.size(); ++l)
      if (local.part.half[l] < cell.part_.half[l]) weight[l] += 1;
  constexpr double hardly = 0.1, finest = 0x1p-40;
  for (const int l : question_.besides) weight[l] = 0;
  std::vector<int> symbols;
  for (int l = 0; l < models_.symbols; ++l)
    if (weight[l] > hardly && cell.part_.half[l] > finest) symbols.push_back(l);
  std::ranges::stable_sort(symbols, [&](int a, int b) { return weight[a] > weight[b]; });
  return symbols;
}

std::vector<std::unique_ptr<Cell>> Cells::halves(const Cell& cell) {
  const std::vector<int> symbols = symbolsOf(cell);
  std::vector<std::unique_ptr<Cell>> both;
  if (symbols.empty()) return both;
  for (const double side : {-0.5, 0.5}) {
    FlowPart half = cell.part_;
    halve(half.centre, half.half, symbols.front(), side);
    both.push_back(within(cell, half));
  }
  return both;
}

/// η_l = middle + half·η from now on.
void Cells::narrow(Cell::Local& local, int l, double middle, double half) const {
  const PolynomialRange& tables = tablesOf(*local.of).range;
  for (std::size_t i = 0; i < local.c.size(); ++i) {
    if (local.c[i].empty()) continue;
    Work::count(Work::cellTerm, static_cast<double>(local.c[i].size()));
    std::vector<double> moved(local.c[i].size());
    double norm = 0;
    for (const double c : local.c[i]) norm += std::fabs(c);
    tables.substitute(l, middle, half, local.c[i].data(), moved.data(), static_cast<int>(moved.size()));
    local.c[i] = std::move(moved);
    local.radius[i] = (local.radius[i] + tables.shiftError() * norm * bounds::up) * bounds::up + bounds::tiny;
  }
}

std::unique_ptr<Cell> Cells::within(const Cell& cell, const FlowPart& part) {
  auto found = std::make_unique<Cell>();
  found->part_ = part;
  constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::vector<std::size_t> place;
  for (const Cell::Local& local : cell.locals_) {
    if (!meet(local.part, part)) {
      place.push_back(none);
      continue;
    }
    place.push_back(found->locals_.size());
    found->locals_.push_back(local);
    Cell::Local& own = found->locals_.back();
    for (std::size_t l = 0; l < part.half.size(); ++l) {
      double centre = part.centre[l], half = part.half[l];
      if (isTight_) {  // what both have in common: multiples of 2^-n as their ends are
        const double lower = std::max(centre - half, own.part.centre[l] - own.part.half[l]);
        const double upper = std::min(centre + half, own.part.centre[l] + own.part.half[l]);
        centre = 0.5 * (lower + upper), half = 0.5 * (upper - lower);
      }
      const double apart = centre - own.part.centre[l];
      if (own.part.half[l] <= half || std::fabs(apart) > own.part.half[l] - half) continue;
      narrow(own, static_cast<int>(l), apart / own.part.half[l], half / own.part.half[l]);
      own.part.centre[l] = centre;
      own.part.half[l] = half;
    }
  }
  for (const Cell::Chord& chord : cell.chords_)
    if (meet(chord.of->part, found->part_))
      found->chords_.push_back({chord.of, place[chord.before], place[chord.behind]});
  for (const Cell::Moment& moment : cell.moments_) {
    Cell::Moment own;
    for (const std::size_t local : moment.snapshots)
      if (place[local] != none) own.snapshots.push_back(place[local]);
    found->moments_.push_back(std::move(own));
  }
  decide(*found);
  return found;
}

std::unique_ptr<Cell> Cells::tightlyWithin(const Cell& cell, const FlowPart& part) {
  isTight_ = true;
  std::unique_ptr<Cell> found = within(cell, part);
  isTight_ = false;
  return found;
}

/// Only where that may decide more.
Interval Cells::tightRangeOf(const Cell::Local& local, std::size_t margin, const Interval& known) const {
  constexpr double tolerance = 1e-3;
  if (local.c[margin].empty() || known.lower() > 0 || known.upper() < 0) return known;
  const Tables& tables = tablesOf(*local.of);
  std::vector<double> c = local.c[margin];
  c.resize(local.of->monomials->count(), 0.0);
  const Box whole(at(local.of->monomials->symbols()), Interval(-1.0, 1.0));
  const double radius = local.radius[margin];
  return intersection(tables.range(c.data(), whole, tolerance) + Interval(-radius, radius), known);
}

/// Along each axis at its ends and some places between them, until nothing becomes less.
std::vector<double> Cells::lowestPoint(const Cell::Local& local, std::size_t margin) const {
  constexpr int sweeps = 6, places = 8;
  const std::vector<double>& c = local.c[margin];
  const Monomials& m = *local.of->monomials;
  const Tables& tables = tablesOf(*local.of);
  std::vector<double> eta(models_.symbols, 0.0);
  bool isChanged = true;
  for (int sweep = 0; sweep < sweeps && isChanged; ++sweep) {
    isChanged = false;
    for (int l = 0; l < models_.symbols; ++l) {
      std::vector<double> f(at(m.degree()) + 1, 0.0);  // in this symbol, all others as they are
      for (std::size_t g = 1; g < c.size(); ++g) {
        const int power = m.exponent(static_cast<int>(g), l);
        if (power == 0 || c[g] == 0) continue;
        double term = c[g];
        for (const int other : tables.symbols[g])
          for (int n = m.exponent(static_cast<int>(g), other); other != l && n > 0; --n) term *= eta[other];
        f[power] += term;
      }
      const auto valueAt = [&](double x) {
        double value = 0;
        for (std::size_t n = f.size(); n-- > 0;) value = value * x + f[n];
        return value;
      };
      double least = valueAt(eta[l]);
      for (int i = 0; i <= places; ++i) {
        const double x = -1 + 2.0 * i / places, value = valueAt(x);
        if (!(value < least)) continue;
        least = value, eta[l] = x, isChanged = true;
      }
    }
  }
  std::vector<double> xi(eta.size());
  for (std::size_t l = 0; l < xi.size(); ++l) xi[l] = local.part.centre[l] + local.part.half[l] * eta[l];
  return xi;
}

std::vector<std::vector<double>> Cells::lowestPoints(const Cell& cell) {
  constexpr std::size_t most = 3;
  struct Place {
    double least;
    std::size_t local, margin;
  };
  std::vector<Place> places;
  const bool isAlways = question_.when == CellQuestion::When::always;
  for (std::size_t i = 0; i < question_.margins.size(); ++i) {
    std::optional<Place> lowest;  // of the margin: at all times it must be, or at the one where it is highest
    const auto include = [&](std::size_t place) {
      const Cell::Local& local = cell.locals_[place];
      const double least = local.range[i].lower();
      if (!local.c[i].empty() && (!lowest || (isAlways ? least < lowest->least : least > lowest->least)))
        lowest = Place{least, place, i};
    };
    for (const Cell::Moment& moment : cell.moments_)
      for (const std::size_t place : moment.snapshots) include(place);
    if (!lowest)
      for (const Cell::Chord& chord : cell.chords_) include(chord.before);
    if (lowest) places.push_back(*lowest);
  }
  std::ranges::stable_sort(places, {}, &Place::least);
  std::vector<std::vector<double>> points;
  for (std::size_t i = 0; i < std::min(most, places.size()); ++i)
    points.push_back(lowestPoint(cell.locals_[places[i].local], places[i].margin));
  return points;
}

/// Nothing where the polynomial does not cover the cell, or there is none.
std::optional<Cells::Form> Cells::formOf(const Cell& cell, std::size_t place, std::size_t margin) const {
  const Cell::Local& local = cell.locals_[place];
  const std::vector<double>& c = local.c[margin];
  if (c.empty() || !isInside(cell.part_, local.part)) return std::nullopt;
  Work::count(Work::cellTerm, static_cast<double>(c.size()) + 40);
  const Tables& tables = tablesOf(*local.of);
  Form form{c[0], 0, 0, local.radius[margin], std::vector<double>(models_.symbols, 0.0)};
  double norm = std::fabs(c[0]);
  for (std::size_t g = 1; g < c.size(); ++g) {
    norm += std::fabs(c[g]);
    const int linear = tables.linear[g];
    if (linear >= 0 && std::ranges::find(question_.besides, linear) == question_.besides.end()) {
      form.slope[linear] = c[g];
      continue;
    }
    const bool isEven = tables.isEven[g] != 0;
    if (!isEven || c[g] < 0) form.down += std::fabs(c[g]);
    if (!isEven || c[g] > 0) form.up += std::fabs(c[g]);
  }
  // All that is computed with the form is off by no more than so many roundings of its numbers.
  const double rest =
      (local.radius[margin] + static_cast<double>(2 * c.size() + 16) * 4 * bounds::unit * norm) * bounds::up +
      bounds::tiny;
  form.down = (form.down + rest) * bounds::up;
  form.up = (form.up + rest) * bounds::up;
  return form;
}

/// A margin's form, and between what it is without its slope.
struct Cells::Bounded {
  Form form;
  double from, to;

  double slopes() const {
    double sum = 0;
    for (const double slope : form.slope) sum += std::fabs(slope);
    return sum;
  }
};

/// Of a margin with a sag; nothing where the form is not known.
std::optional<Cells::Bounded> Cells::boundedOf(const Cell& cell, std::size_t local, std::size_t margin,
                                               const Interval& sag, CellPlanes& planes) const {
  const std::optional<Form> form = formOf(cell, local, margin);
  if (!form || !isBounded(sag)) return std::nullopt;
  planes.rest = std::max(planes.rest, 2 * form->radius + width(sag));
  return Bounded{*form, subDown(form->constant, subUp(form->down, sag.lower())),
                 addUp(form->constant, addUp(form->up, sag.upper()))};
}

/// A plane below all margins (sign 1), or above all (-1): of several that must all be above zero, the least is above
/// slope·η + min_j (constant_j - down_j - Σ|slope_j - slope|), with the slope of the one that comes lowest.
std::pair<std::vector<double>, double> Cells::planeBeside(const std::vector<Bounded>& margins, int sign) {
  const auto extreme = [&](const Bounded& b) { return sign > 0 ? b.from - b.slopes() : -b.to - b.slopes(); };
  const std::vector<double>& slope = std::ranges::min_element(margins, {}, extreme)->form.slope;
  double least = std::numeric_limits<double>::infinity();
  for (const Bounded& b : margins) {
    double apart = 0;
    for (std::size_t l = 0; l < slope.size(); ++l) apart += std::fabs(b.form.slope[l] - slope[l]);
    least = std::min(least, subDown(sign > 0 ? b.from : -b.to, apart * bounds::up));
  }
  return {slope, sign * least};
}

/// Of all chords; nothing unless a form of each is known.
std::vector<Cells::Bounded> Cells::throughout(const Cell& cell, CellPlanes& planes) const {
  std::vector<Bounded> all;
  bool isKnown = question_.when == CellQuestion::When::always || question_.margins.size() == 1;
  const auto include = [&](std::size_t local, std::size_t margin, const Interval& sag) {
    const std::optional<Bounded> bounded = boundedOf(cell, local, margin, sag, planes);
    isKnown = isKnown && bounded;
    if (bounded) all.push_back(*bounded);
  };
  for (std::size_t i = 0; i < question_.margins.size(); ++i) {
    for (const Cell::Chord& chord : cell.chords_)
      for (const std::size_t local : {chord.before, chord.behind})
        include(local, i, chord.of->sag[question_.margins[i]]);
    if (question_.from == question_.until)
      for (const Cell::Moment& moment : cell.moments_)
        for (const std::size_t local : moment.snapshots) include(local, i, Interval(0.0));
  }
  return isKnown ? all : std::vector<Bounded>();
}

CellPlanes Cells::planes(const Cell& cell) const {
  const bool isAlways = question_.when == CellQuestion::When::always;
  CellPlanes planes;
  if (const std::vector<Bounded> all = throughout(cell, planes); !all.empty()) {
    if (isAlways)
      std::tie(planes.met, planes.metAbove) = planeBeside(all, 1);
    else
      std::tie(planes.violated, planes.violatedBelow) = planeBeside(all, -1);
  }
  // Once: the output time that decides most.
  double best = -std::numeric_limits<double>::infinity();
  for (const Cell::Moment& moment : cell.moments_) {
    if (moment.snapshots.size() != 1) continue;
    std::vector<Bounded> margins;
    for (std::size_t i = 0; i < question_.margins.size(); ++i)
      if (const auto bounded = boundedOf(cell, moment.snapshots[0], i, Interval(0.0), planes))
        margins.push_back(*bounded);
    if (margins.size() != question_.margins.size()) continue;
    for (std::size_t i = 0; i < margins.size() && isAlways; ++i)
      if (-margins[i].to > best) {
        best = -margins[i].to;
        planes.violated = margins[i].form.slope;
        planes.violatedBelow = margins[i].to;
      }
    if (isAlways) continue;
    if (auto [slope, constant] = planeBeside(margins, 1); constant > best) {
      best = planes.metAbove = constant;
      planes.met = std::move(slope);
    }
  }
  return planes;
}

/// The place is known to 8 roundings, about a number up to 1: a distance from a centre and its quotient by a half-width
/// make three. In a part of half-width h these are 8 u/h of its own η, and the way there, (ξ - centre)/h, adds two of a
/// number up to 1; so what holds within 16 u/h of it, as far as the part goes, holds at the place itself, in whichever
/// of two parts that meet there it lies.
Cell::Verdict Cells::verdictAt(const std::vector<double>& xi) {
  constexpr double off = 8 * bounds::unit;
  const auto cell = whole();
  const auto isBeside = [&](std::size_t l) {
    return std::ranges::find(question_.besides, static_cast<int>(l)) != question_.besides.end();
  };
  for (std::size_t l = 0; l < xi.size() && cell->verdict_ == Cell::Verdict::open; ++l) {
    if (isBeside(l)) continue;
    const double lower = std::max(xi[l] - off, -1.0), upper = std::min(xi[l] + off, 1.0);
    cell->part_.centre[l] = 0.5 * (lower + upper);
    cell->part_.half[l] = 0.5 * (upper - lower);
  }
  if (cell->verdict_ != Cell::Verdict::open) return cell->verdict_;
  const auto covers = [&](const FlowPart& part) {
    for (std::size_t l = 0; l < xi.size(); ++l)
      if (!isBeside(l) && std::fabs(xi[l] - part.centre[l]) > part.half[l] + off) return false;
    return true;
  };
  for (Cell::Local& local : cell->locals_) {
    if (!covers(local.part)) continue;
    for (int l = 0; l < models_.symbols; ++l) {
      if (isBeside(at(l))) continue;
      const double half = local.part.half[l], middle = (xi[l] - local.part.centre[l]) / half;
      const double lower = std::max(middle - 2 * off / half, -1.0), upper = std::min(middle + 2 * off / half, 1.0);
      narrow(local, l, 0.5 * (lower + upper), 0.5 * (upper - lower) + off);
    }
  }
  std::erase_if(cell->chords_, [&](const Cell::Chord& chord) { return !covers(chord.of->part); });
  for (Cell::Moment& moment : cell->moments_)
    std::erase_if(moment.snapshots, [&](std::size_t local) { return !covers(cell->locals_[local].of->part); });
  decide(*cell);
  return cell->verdict_;
}

}  // namespace gamut
