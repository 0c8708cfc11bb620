// Of undamped modes by the eigenvectors of their pencil (analyses/roots/eigenvalue_bounds.hpp), of others by the
// families of eigenpairs that are proved with the machine (mechanics/rest.hpp).
#include "studies/analyses/modes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <list>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "analyses/flow/flow.hpp"
#include "analyses/roots/eigenvalue_bounds.hpp"
#include "mechanics/rest.hpp"
#include "scalars/program/recorder.hpp"
#include "scalars/recorded.hpp"
#include "studies/analyses/found_positions.hpp"
#include "studies/analysis.hpp"
#include "studies/running/context.hpp"
#include "studies/settings.hpp"
#include "studies/words.hpp"

namespace gamut {
namespace {

std::vector<Field> fieldsOf(ModesResult& m) {
  constexpr std::string_view shape = "/modes/number", coordinate = "/modes/coordinate";
  return m.fieldsAnd(
      {{"coordinates", &m.coordinates, unit::none, "names of those that loops leave free, with commas"},
       {"coordinate", &m.coordinate, unit::one, "their numbers, from 1", {coordinate}},
       {"number", &m.number, unit::one, "of the shapes, from 1", {shape}},
       {"mode", &m.mode, unit::one, "whose it is, 1 the slowest", {shape}},
       {"first", &m.first, unit::one, "of the modes that it is not told apart from, itself among them", {shape}},
       {"last", &m.last, unit::one, "likewise", {shape}},
       {"reference", &m.reference, unit::one, "number of the coordinate that is 1 in its shape", {shape}},
       {"frequency_lower",
        &m.slowest,
        "Hz",
        "proved bound of its undamped frequency, for all values in the intervals",
        {shape}},
       {"frequency_upper", &m.fastest, "Hz", "upper bound", {shape}},
       {"lower",
        &m.lower,
        unit::none,
        "proved bound of the real part of the coordinate in its shape, for all values in the intervals, rad or m by "
        "the reference's rad or m",
        {shape, coordinate}},
       {"upper", &m.upper, unit::none, "upper bound", {shape, coordinate}},
       {"imaginary_lower", &m.imaginaryLower, unit::none, "likewise of the imaginary part", {shape, coordinate}},
       {"imaginary_upper", &m.imaginaryUpper, unit::none, "upper bound", {shape, coordinate}}});
}

/// Bounds of a mode.
struct Shape {
  int number, first, last, reference;  // from 0; the latter of free coordinates
  Interval frequency;
  std::vector<Interval> real, imaginary;
};

/// Coordinates that loops leave free.
std::vector<int> freeOf(const RestRows& rows) {
  std::vector<int> all;
  for (int i = 0; i < rows.coordinates; ++i)
    if (std::ranges::find(rows.dependents, i) == rows.dependents.end()) all.push_back(i);
  return all;
}

/// √M_ii of free coordinates, so that |φ_i| √M_ii has no unit.
std::vector<double> weightsOf(const Rest& rest, const std::vector<int>& free) {
  const std::vector<double> inertias = rest.ownInertias();
  std::vector<double> all;
  for (const int i : free) all.push_back(std::sqrt(std::max(inertias[i], 0.0)));
  // What has none of its own, as a crank that drives all there is through a loop, comes last.
  const double least = std::max(std::ranges::max(all) * 1e-9, 1e-300);
  for (double& each : all) each = std::max(each, least);
  return all;
}

/// The first of the greatest, but for rounding.
int greatestOf(const std::vector<double>& sizes) {
  constexpr double rounding = 1e-6;
  const double most = std::ranges::max(sizes);
  return static_cast<int>(std::ranges::find_if(sizes, [&](double x) { return x >= (1 - rounding) * most; }) -
                          sizes.begin());
}

/// Of a cluster, a row for each coordinate.
using Rows = std::vector<std::vector<double>>;

/// So many coordinates as rows have entries, each the one that moves most in what those before it leave free; rising.
std::vector<int> referencesOf(Rows rows) {
  const auto product = [](const std::vector<double>& a, const std::vector<double>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
  };
  std::vector<int> references;
  for (std::size_t c = 0; c < rows.front().size(); ++c) {
    std::vector<double> sizes;
    for (const std::vector<double>& row : rows) sizes.push_back(std::sqrt(product(row, row)));
    references.push_back(greatestOf(sizes));
    const std::vector<double> along = rows[references.back()];
    const double square = product(along, along);
    for (std::vector<double>& row : rows) {
      const double share = product(row, along) / square;
      for (std::size_t i = 0; i < row.size(); ++i) row[i] -= share * along[i];
    }
  }
  std::ranges::sort(references);
  return references;
}

class UndampedShapes {
 public:
  UndampedShapes(const Machine& machine, const std::atomic<bool>* cancelled)
      : machine_(machine), vibration_(*machine.rest->vibration()), cancelled_(cancelled) {
    weights_ = weightsOf(*machine.rest, freeOf(machine.rest->rows()));
  }

  /// Of a mode, from 0, and of all that it is not told apart from; none where they are not apart from what does not
  /// oscillate.
  std::vector<Shape> with(int mode) {
    std::vector<Shape> all;
    if (const Found* found = foundWith(vibration_.unstable + mode))
      for (int k = found->of.first; k <= found->of.last; ++k) all.push_back(shapeOf(*found, k));
    return all;
  }

 private:
  using Cluster = EigenvalueBounds::Cluster;
  struct Found {
    Cluster of;
    std::vector<int> references;
    std::vector<Interval> basis;
  };

  Shape shapeOf(const Found& found, int k) const {
    const Box parameters(machine_.box.begin() + static_cast<std::ptrdiff_t>(machine_.states), machine_.box.end());
    const int below = vibration_.unstable, column = k - found.of.first, size = found.of.size();
    Shape shape{k - below, found.of.first - below, found.of.last - below, found.references[column], {}, {}, {}};
    shape.frequency = sqrt(machine_.vibrations->ranges({k}, parameters)[0]) / (Interval(2.0) * pi());
    for (int i = 0; i < vibration_.size; ++i) {
      shape.real.push_back(found.basis[i * size + column]);
      shape.imaginary.emplace_back(0.0);
    }
    return shape;
  }

  Rows rowsOf(const Cluster& of) const {
    const int f = vibration_.size;
    Rows rows(f);
    for (int i = 0; i < f; ++i)
      for (int j = of.first; j <= of.last; ++j) rows[i].push_back(weights_[i] * vibration_.basis[i * f + j]);
    return rows;
  }

  bool isOpen(int k) const {
    return k >= vibration_.unstable && k < vibration_.size &&
           std::ranges::none_of(found_, [&](const Found& each) { return k >= each.of.first && k <= each.of.last; });
  }

  /// Alone, or with its nearest neighbours that are not apart from it, as many as it takes.
  const Found* foundWith(int k) {
    for (const Found& each : found_)
      if (k >= each.of.first && k <= each.of.last) return &each;
    for (std::optional<Cluster> of = Cluster{k, k}; of; of = larger(*of)) {
      const std::vector<int> references = referencesOf(rowsOf(*of));
      if (std::optional<std::vector<Interval>> basis =
              machine_.vibrations->basisOf(*of, references, vibration_.unstable, cancelled_))
        return &found_.emplace_back(*of, references, std::move(*basis));
      if (cancelled_ != nullptr && *cancelled_) return nullptr;
    }
    return nullptr;
  }

  /// With the neighbour whose frequency is nearer.
  std::optional<Cluster> larger(Cluster of) const {
    const auto ratio = [&](int upper) { return vibration_.squares[upper] / vibration_.squares[upper - 1]; };
    const bool hasLower = isOpen(of.first - 1), hasUpper = isOpen(of.last + 1);
    if (!hasLower && !hasUpper) return {};
    if (hasLower && (!hasUpper || ratio(of.first) <= ratio(of.last + 1)))
      --of.first;
    else
      ++of.last;
    return of;
  }

  const Machine& machine_;
  const RestVibration& vibration_;
  const std::atomic<bool>* cancelled_;
  std::vector<double> weights_;
  std::list<Found> found_;
};

/// Of modes that something damps: φ_i/φ_r of w = [Re φ; Im φ; Re s; Im s].
std::vector<Shape> dampedShapes(const Machine& machine, const std::atomic<bool>* cancelled) {
  const Rest& rest = *machine.rest;
  const std::vector<int> free = freeOf(rest.rows());
  const std::vector<double> weights = weightsOf(rest, free);
  const int size = rest.rows().size, f = static_cast<int>(free.size()), perMode = 1 + 2 * f;
  std::vector<Shape> shapes;
  for (const DampedMode& mode : rest.damped()) {
    std::vector<double> moved;
    for (int i = 0; i < f; ++i)
      moved.push_back(weights[i] * std::hypot(mode.nominal[free[i]], mode.nominal[size + free[i]]));
    shapes.push_back({mode.number, mode.number, mode.number, greatestOf(moved), {}, {}, {}});
  }
  const int open = static_cast<int>(machine.states), given = static_cast<int>(machine.freeParameters.size());
  const Program all = record(
      0, open + given, perMode * static_cast<int>(shapes.size()), [&](auto, const auto&, const auto& p, auto& y) {
        const std::span<const Recorded> numbers(p);
        for (std::size_t k = 0; k < shapes.size(); ++k) {
          const std::vector<Recorded> w = rest.dampedAt(k, numbers.first(open), numbers.subspan(open));
          const auto at = y.begin() + perMode * static_cast<std::ptrdiff_t>(k);
          const auto real = [&](int i) { return w[free[i]]; };
          const auto imaginary = [&](int i) { return w[size + free[i]]; };
          const Recorded re = real(shapes[k].reference), im = imaginary(shapes[k].reference),
                         square = sqr(re) + sqr(im);
          at[0] = sqrt(sqr(w[2 * size]) + sqr(w[2 * size + 1])) / (Recorded(2.0) * constant<Recorded>(pi()));
          for (int i = 0; i < f; ++i) {
            at[1 + i] = (real(i) * re + imaginary(i) * im) / square;
            at[1 + f + i] = (imaginary(i) * re - real(i) * im) / square;
          }
        }
      });
  const std::vector<Box> found = encloseImage(all, 0.0, machine.box, {}, -1, cancelled, machine.remainders);
  if (found.empty()) return {};
  const Box& bounds = found.front();
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    const auto at = bounds.begin() + perMode * static_cast<std::ptrdiff_t>(k);
    shapes[k].frequency = at[0];
    shapes[k].real.assign(at + 1, at + 1 + f);
    shapes[k].imaginary.assign(at + 1 + f, at + perMode);
    shapes[k].real[shapes[k].reference] = Interval(1.0);
    shapes[k].imaginary[shapes[k].reference] = Interval(0.0);
  }
  return shapes;
}

/// Of wanted modes, and of those that they are not told apart from; none of what is not proved.
std::map<int, std::optional<Shape>> shapesOf(const Machine& machine, const std::atomic<bool>* cancelled) {
  std::map<int, std::optional<Shape>> all;
  if (machine.rest->vibration()) {
    UndampedShapes undamped(machine, cancelled);
    for (const int mode : machine.rest->vibration()->modes) {
      all.try_emplace(mode);
      for (Shape& shape : undamped.with(mode)) all.insert_or_assign(shape.number, std::move(shape));
    }
  } else {
    for (const DampedMode& mode : machine.rest->damped()) all.try_emplace(mode.number);
    for (Shape& shape : dampedShapes(machine, cancelled)) all[shape.number] = std::move(shape);
  }
  return all;
}

bool isProved(const Shape& shape) {
  const auto isKnown = [](const Interval& each) { return isBounded(each) && !isEmpty(each); };
  return isKnown(shape.frequency) && std::ranges::all_of(shape.real, isKnown) &&
         std::ranges::all_of(shape.imaginary, isKnown);
}

void take(const std::vector<Shape>& shapes, std::size_t coordinates, ModesResult& result) {
  for (Grid* grid : {&result.lower, &result.upper, &result.imaginaryLower, &result.imaginaryUpper})
    *grid = Grid({shapes.size(), coordinates});
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    const Shape& own = shapes[k];
    result.number.push_back(static_cast<double>(k + 1));
    result.mode.push_back(own.number + 1);
    result.first.push_back(own.first + 1);
    result.last.push_back(own.last + 1);
    result.reference.push_back(own.reference + 1);
    result.slowest.push_back(own.frequency.lower());
    result.fastest.push_back(own.frequency.upper());
    for (std::size_t i = 0; i < coordinates; ++i) {
      result.lower(k, i) = own.real[i].lower();
      result.upper(k, i) = own.real[i].upper();
      result.imaginaryLower(k, i) = own.imaginary[i].lower();
      result.imaginaryUpper(k, i) = own.imaginary[i].upper();
    }
  }
}

class ModesAnalysis final : public AnalysisOf<ModesAnalysis, ModesResult> {
 public:
  std::string_view section() const override { return "modes"; }
  std::string_view meaning() const override { return "shapes of modes at rest"; }
  void describe(Settings& s) override {
    s.flag(
        {"shapes", "whether shapes of modes are enclosed too, of those whose frequency or damping ratio is an output",
         "false"},
        isAsked_);
  }
  bool isAsked() const override { return isAsked_; }
  std::optional<Refusal> refusal(const Study& study) const override {
    if (!isAsked_) return {};
    if (study.analysis != Study::Analysis::equilibria)
      return Refusal{"shapes", "modes are those at rest, where analysis = \"equilibria\"", "no such key"};
    for (const WantedOutput& output : study.outputs)
      for (const std::string& name : output.expression.names())
        if (name.starts_with("frequency.") || name.starts_with("damping.")) return {};
    return Refusal{"shapes", "no output is of a mode, so there is none to tell the shape of", "an output frequency.1"};
  }

  void find(Run& run, const Results& /*before*/, ModesResult& result) const {
    const Machine& machine = run.machine;
    const RestRows& rows = machine.rest->rows();
    std::vector<std::string> names;
    for (const int i : freeOf(rows)) {
      names.push_back(rows.names[i]);
      result.coordinate.push_back(static_cast<double>(names.size()));
    }
    result.coordinates = fmt::format("{}", fmt::join(names, ", "));
    std::vector<Shape> shapes;
    std::vector<int> unproved;
    for (const auto& [number, shape] : shapesOf(machine, run.watch.stop()))
      if (shape && isProved(*shape))
        shapes.push_back(*shape);
      else
        unproved.push_back(number + 1);
    take(shapes, names.size(), result);
    if (!unproved.empty() && !*run.watch.stop())
      result.why = fmt::format("{} {} not enclosed: narrower intervals may settle {}",
                               unproved.size() == 1 ? "the shape of mode" : "the shapes of modes",
                               fmt::format("{} {}", fmt::join(unproved, ", "), unproved.size() == 1 ? "is" : "are"),
                               unproved.size() == 1 ? "it" : "them");
  }

 private:
  bool isAsked_ = false;
};

}  // namespace

std::vector<std::string> ModesResult::names() const {
  std::vector<std::string> all;
  for (std::size_t from = 0; from < coordinates.size();) {
    const std::size_t to = std::min(coordinates.find(", ", from), coordinates.size());
    all.push_back(coordinates.substr(from, to - from));
    from = to + 2;
  }
  return all;
}

std::string ModesResult::nameOf(std::size_t k) const {
  const std::string frequency = inUnit(rangeText(slowest[k], fastest[k], 6), "Hz");
  if (first[k] == last[k]) return fmt::format("mode {}, {}", mode[k], frequency);
  return fmt::format("mode {} of {} to {}, which are not told apart, {}", mode[k], first[k], last[k], frequency);
}

std::string ModesResult::boundsOf(std::size_t k, std::size_t i) const {
  constexpr int digits = 6;
  const auto text = [&](const Grid& least, const Grid& most) {
    const double from = least(k, i), to = most(k, i);
    return from == to ? numberText(from, digits) : rangeText(from, to, digits);
  };
  const bool isReal = imaginaryLower(k, i) == 0 && imaginaryUpper(k, i) == 0;
  return text(lower, upper) + (isReal ? "" : " + " + text(imaginaryLower, imaginaryUpper) + " i");
}

std::vector<std::string> ModesResult::told() const {
  std::vector<std::string> lines;
  const std::vector<std::string> all = names();
  for (std::size_t k = 0; k < number.size(); ++k) {
    std::string line = nameOf(k) + ":";
    for (std::size_t i = 0; i < all.size(); ++i)
      line += fmt::format("{} {} {}", i == 0 ? "" : ",", all[i], boundsOf(k, i));
    lines.push_back(std::move(line));
  }
  return lines;
}

void ModesResult::describe(std::vector<Group>& groups) {
  groups.push_back(groupOf("/modes", "shapes of modes at rest, proved", *this, fieldsOf));
  std::map<std::string_view, std::string_view>& keys = groups.back().inJson;
  keys = {{"coordinate", ""}, {"number", ""}};
  for (const std::string_view bound :
       {"lower", "upper", "frequency_lower", "frequency_upper", "imaginary_lower", "imaginary_upper"})
    keys[bound] = bound;
  groups.back().makesSense = [this](std::size_t) {
    return areOrdered(lower, upper) && areOrdered(imaginaryLower, imaginaryUpper);
  };
}

std::unique_ptr<FurtherAnalysis> modesAnalysis() { return std::make_unique<ModesAnalysis>(); }

}  // namespace gamut
