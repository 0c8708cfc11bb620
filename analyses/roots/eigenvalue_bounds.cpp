// In the coordinates y of x = Φ y, in which K and M are nearly diagonal. How D_i is bounded: with T its eigenvectors,
// nearly, TᵀD_iT lies between the ends of its discs (S. Gershgorin), so D_i + T diag(n) Tᵀ ⪰ −ε for n the parts of them
// below zero, and ε what rounding and the discs' radii leave.
#include "analyses/roots/eigenvalue_bounds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "analyses/flow/flow.hpp"
#include "analyses/roots/root_family.hpp"
#include "scalars/algebra/decompositions.hpp"
#include "scalars/algebra/linear_system.hpp"
#include "scalars/algebra/triangle.hpp"
#include "scalars/algebra/verified_algebra.hpp"
#include "scalars/eigen.hpp"
#include "scalars/evaluation/evaluate.hpp"
#include "scalars/program/differentiation.hpp"
#include "scalars/program/recorder.hpp"
#include "scalars/recorded.hpp"

namespace gamut {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;
using Intervals = Eigen::Matrix<Interval, Eigen::Dynamic, Eigen::Dynamic>;

Intervals exactly(const Matrix& m) {
  return m.unaryExpr([](double x) { return Interval(x); });
}

/// Symmetric: its lower triangle.
class Symmetric {
 public:
  explicit Symmetric(int size) : Symmetric(size, std::vector<Interval>(size * (size + 1) / 2, Interval(0.0))) {}
  Symmetric(int size, std::vector<Interval> entries) : size_(size), entries_(std::move(entries)) {}

  int size() const { return size_; }
  std::span<const Interval> entries() const { return entries_; }
  Interval& operator()(int i, int j) { return entries_[triangleEntry(i, j)]; }
  const Interval& operator()(int i, int j) const { return entries_[triangleEntry(i, j)]; }

  bool isZero() const {
    return std::ranges::all_of(entries_, [](const Interval& x) { return x.lower() == 0 && x.upper() == 0; });
  }
  bool isKnown() const {
    return std::ranges::all_of(entries_, [](const Interval& x) { return isBounded(x) && !isEmpty(x); });
  }
  void set(int entry, const Interval& value) { entries_[entry] = value; }
  void add(const Interval& factor, const Symmetric& other) {
    for (std::size_t k = 0; k < entries_.size(); ++k) entries_[k] += factor * other.entries_[k];
  }
  Matrix middle() const {
    Matrix m(size_, size_);
    for (int i = 0; i < size_; ++i)
      for (int j = 0; j < size_; ++j) m(i, j) = midpoint((*this)(i, j));
    return m;
  }
  Intervals whole() const {
    Intervals m(size_, size_);
    for (int i = 0; i < size_; ++i)
      for (int j = 0; j < size_; ++j) m(i, j) = (*this)(i, j);
    return m;
  }

 private:
  int size_;
  std::vector<Interval> entries_;
};

/// TᵀAT
Symmetric congruent(const Matrix& t, const Symmetric& a) {
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = t;
  return Symmetric(static_cast<int>(t.cols()),
                   gamut::congruent<Interval>(a.entries(), {rows.data(), static_cast<std::size_t>(rows.size())},
                                              a.size(), static_cast<int>(t.cols())));
}

Symmetric unity(int n) {
  Symmetric one(n);
  for (int i = 0; i < n; ++i) one(i, i) = Interval(1.0);
  return one;
}

/// Each disc.
std::vector<Interval> discsOf(const Symmetric& a) {
  std::vector<Interval> discs;
  for (int i = 0; i < a.size(); ++i) {
    Interval radius(0.0);
    for (int j = 0; j < a.size(); ++j)
      if (j != i) radius += Interval(magnitude(a(i, j)));
    discs.push_back(a(i, i) + Interval(-radius.upper(), radius.upper()));
  }
  return discs;
}

Matrix eigenvectorsOf(const Symmetric& a) { return symmetricEigenvectorsOf(a.middle()); }

/// How many eigenvalues are certainly above zero: of TᵀAT those of so many rows, which alone are positive definite, and
/// so is A on the columns of T that belong to them (A. L. Cauchy).
int positives(const Symmetric& a) {
  const std::vector<Interval> discs = discsOf(congruent(eigenvectorsOf(a), a));
  return static_cast<int>(std::ranges::count_if(discs, [](const Interval& disc) { return disc.lower() > 0; }));
}

/// ‖A‖ at most.
double normOf(const Symmetric& a) {
  double most = 0;
  for (int i = 0; i < a.size(); ++i) {
    Interval sum(0.0);
    for (int j = 0; j < a.size(); ++j) sum += Interval(magnitude(a(i, j)));
    most = std::max(most, sum.upper());
  }
  return most;
}

Symmetric minusUnity(Symmetric a) {
  for (int i = 0; i < a.size(); ++i) a(i, i) -= Interval(1.0);
  return a;
}

/// −below ⪯ D ⪯ above, both of which are positive semidefinite.
struct LoewnerBounds {
  Symmetric below, above;
  double sizeBelow = 0, sizeAbove = 0;  // traces, nearly
};

/// Nothing where T is not nearly orthogonal.
std::optional<LoewnerBounds> loewnerBounds(const Symmetric& d) {
  const int n = d.size();
  const Matrix t = eigenvectorsOf(d);
  const Symmetric gram = congruent(t, unity(n)), image = congruent(t, d);
  const double off = normOf(minusUnity(gram));  // of TTᵀ too
  if (!(off < 0.5)) return {};
  const std::vector<Interval> discs = discsOf(image);
  double nothing = 0;
  for (const Interval& disc : discs) nothing = std::max(nothing, n * 0x1p-50 * magnitude(disc));
  LoewnerBounds bounds{Symmetric(n), Symmetric(n)};
  for (const bool isBelow : {true, false}) {
    Vector parts(n);
    for (int i = 0; i < n; ++i) parts[i] = std::max(0.0, isBelow ? -discs[i].lower() : discs[i].upper());
    Symmetric own(n), raised(n);
    raised.add(Interval(isBelow ? 1.0 : -1.0), image);
    for (int k = 0; k < n; ++k) {
      if (!(parts[k] > nothing)) continue;  // ε holds it
      for (int i = 0; i < n; ++i)
        for (int j = 0; j <= i; ++j) {
          own(i, j) += Interval(t(i, k)) * Interval(parts[k]) * Interval(t(j, k));
          raised(i, j) += gram(i, k) * Interval(parts[k]) * gram(k, j);  // Tᵀ(T diag Tᵀ)T
        }
    }
    double least = 0;
    for (const Interval& disc : discsOf(raised)) least = std::min(least, disc.lower());
    const double epsilon = (Interval(-least) / (Interval(1.0) - Interval(off))).upper();
    for (int i = 0; i < n; ++i) own(i, i) += Interval(epsilon);
    (isBelow ? bounds.sizeBelow : bounds.sizeAbove) = own.middle().trace();
    (isBelow ? bounds.below : bounds.above) = std::move(own);
  }
  return bounds;
}

/// The most that an eigenvalue of a positive semidefinite matrix can be.
double largestOf(const Symmetric& a) {
  const Matrix t = eigenvectorsOf(a);
  const double off = normOf(minusUnity(congruent(t, unity(a.size()))));
  double most = 0;
  for (const Interval& disc : discsOf(congruent(t, a))) most = std::max(most, disc.upper());
  return off < 1 ? (Interval(most) / (Interval(1.0) - Interval(off))).upper() : std::numeric_limits<double>::infinity();
}

bool isZero(const Program& program, int output) {
  const Node& node = program.nodes()[program.outputNodes()[output]];
  return node.op == Op::constant && program.constants()[node.a].lower() == 0 &&
         program.constants()[node.a].upper() == 0;
}

/// M = Lᵀ diag(d) L of its lower triangle, L with ones on its diagonal and row by row, eliminated from the last row to
/// the first: what hangs on outer joints is left out of inner ones, so that polynomials see what cancels.
template <class S>
struct Eliminated {
  std::vector<S> pivots, lower;

  Eliminated(std::vector<S> m, int f) : pivots(f, S(0.0)), lower(f * f, S(0.0)) {
    for (int k = f; k-- > 0;) {
      pivots[k] = m[triangleEntry(k, k)];
      lower[k * f + k] = S(1.0);
      for (int i = 0; i < k; ++i) lower[k * f + i] = m[triangleEntry(k, i)] / pivots[k];
      for (int i = 0; i < k; ++i)
        for (int j = 0; j <= i; ++j)
          m[triangleEntry(i, j)] = m[triangleEntry(i, j)] - lower[k * f + i] * m[triangleEntry(k, j)];
    }
  }
};

/// The pencil along its root, whatever the box.
struct Pencil {
  Program pencil, root;
  int n, f = 0, quantities, triangle;
  Matrix basis;
  Box open;
  EigenvalueBounds::Open openAt;
  bool isUnit = false;  // M is 1
  // Of parameters and what is open.
  Program slopes;          // total derivatives of entries that are not nothing
  std::vector<int> which;  // of these, by quantities, K then M
  Program pivots;          // of M, eliminated from the last row to the first

  Pencil(const Program& itsPencil, const Program& itsRoot, const std::vector<double>& itsBasis, Box itsOpen,
         EigenvalueBounds::Open itsOpenAt)
      : pencil(itsPencil),
        root(itsRoot),
        n(pencil.states()),
        quantities(pencil.parameters()),
        triangle((pencil.outputs() - n) / 2),
        open(std::move(itsOpen)),
        openAt(std::move(itsOpenAt)) {
    while (f * (f + 1) / 2 < triangle) ++f;
    basis =
        Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(itsBasis.data(), f, f);
    recordSlopes();
    recordPivots();
  }

  Symmetric modal(const Symmetric& a) const { return congruent(basis, a); }

  void recordSlopes() {
    std::vector<int> by, nodes;
    for (int i = 0; i < quantities; ++i) by.push_back(n + i);
    std::vector<int> first(pencil.outputNodes().begin(), pencil.outputNodes().begin() + n);
    const Program rows = Recorder(pencil).finish(first), slopesOfRows = forwardDifferentiated(rows, true),
                  along = alongDerivatives(pencil, by);
    const int outputs = pencil.outputs();
    const Program all =
        record(0, root.parameters(), quantities * 2 * triangle, [&](auto, const auto&, const auto& p, auto& y) {
          const std::vector<Recorded> own(p.begin(), p.begin() + quantities),
              v = evaluate<Recorded>(root, {}, {p.begin(), p.end()}),
              slopesAt = evaluate<Recorded>(slopesOfRows, v, own);
          std::vector<Recorded> held(slopesAt.begin() + n, slopesAt.begin() + n + n * n), x = v;
          for (int i = 0; i < quantities; ++i) {
            std::vector<Recorded> right;
            for (int k = 0; k < n; ++k) right.push_back(-slopesAt[n + n * n + k * quantities + i]);
            if (!std::ranges::all_of(right, [](const Recorded& r) { return isKnownZero(r); }))
              LinearSystem<Recorded>(MatrixKind::general, n, held).solve(right);
            x.insert(x.end(), right.begin(), right.end());
          }
          const std::vector<Recorded> derivatives = evaluate<Recorded>(along, x, own);
          for (int i = 0; i < quantities; ++i)
            for (int k = 0; k < 2 * triangle; ++k) y[i * 2 * triangle + k] = derivatives[outputs * (1 + i) + n + k];
        });
    for (int o = 0; o < all.outputs(); ++o)
      if (!isZero(all, o)) {
        which.push_back(o);
        nodes.push_back(all.outputNodes()[o]);
      }
    if (!nodes.empty()) slopes = Recorder(all).finish(nodes);
  }

  void recordPivots() {
    pivots = record(0, root.parameters(), f, [&](auto, const auto&, const auto& p, auto& y) {
      const std::vector<Recorded> own(p.begin(), p.begin() + quantities),
          all = evaluate<Recorded>(pencil, evaluate<Recorded>(root, {}, {p.begin(), p.end()}), own);
      std::ranges::copy(Eliminated<Recorded>({all.end() - triangle, all.end()}, f).pivots, y.begin());
    });
  }
  /// M then is positive definite for all of these parameters (J. J. Sylvester).
  bool arePivotsPositive(const Box& parameters) const {
    const Box found = encloseImage(pivots, 0.0, withOpen(parameters), {}, degreeFor(parameters), nullptr, narrow())[0];
    return std::ranges::all_of(found, [](const Interval& pivot) { return isBounded(pivot) && pivot.lower() > 0; });
  }

  /// The same eigenvalues by a pencil whose M is 1 for all parameters: of √d L x in place of x.
  Pencil withUnitMass(const Box& parameters) const {
    const Program unit = record(n, quantities, pencil.outputs(), [&](auto, const auto& x, const auto& p, auto& y) {
      const std::vector<Recorded> all = evaluate<Recorded>(pencil, {x.begin(), x.end()}, {p.begin(), p.end()});
      const std::span<const Recorded> k(&all[n], triangle);
      const Eliminated<Recorded> mass({all.end() - triangle, all.end()}, f);
      std::vector<std::vector<Recorded>> columns;  // of L⁻¹ d^-½
      for (int j = 0; j < f; ++j) {
        std::vector<Recorded>& column = columns.emplace_back(f, Recorded(0.0));
        column[j] = Recorded(1.0) / sqrt(mass.pivots[j]);
        for (int i = j + 1; i < f; ++i)
          for (int l = j; l < i; ++l) column[i] = column[i] - mass.lower[i * f + l] * column[l];
      }
      std::ranges::copy(std::span<const Recorded>(all).first(n), y.begin());
      for (int i = 0; i < f; ++i) {
        const std::vector<Recorded> image = times<Recorded>(k, columns[i]);
        for (int j = 0; j <= i; ++j) {
          Recorded sum(0.0);
          for (int l = 0; l < f; ++l) sum = sum + columns[j][l] * image[l];
          y[n + triangleEntry(i, j)] = sum;
          y[n + triangle + triangleEntry(i, j)] = Recorded(i == j ? 1.0 : 0.0);
        }
      }
    });
    std::vector<double> middle;
    for (const Interval& each : withOpen(parameters)) middle.push_back(midpoint(each));
    const std::vector<double> own(middle.begin(), middle.begin() + quantities),
        all = evaluate<double>(pencil, evaluate<double>(root, {}, middle), own);
    const Eliminated<double> mass({all.end() - triangle, all.end()}, f);
    std::vector<double> itsBasis;
    for (int i = 0; i < f; ++i)
      for (int j = 0; j < f; ++j) {
        double sum = 0;
        for (int l = 0; l <= i; ++l) sum += mass.lower[i * f + l] * basis(l, j);
        itsBasis.push_back(std::sqrt(mass.pivots[i]) * sum);
      }
    Pencil other(unit, root, itsBasis, open, openAt);
    other.isUnit = true;
    return other;
  }

  /// Of parameters in a box, and all that is open there.
  Box withOpen(const Box& parameters) const {
    Box box = parameters;
    box.insert(box.end(), open.begin(), open.end());
    return box;
  }
  std::vector<int> narrow() const {
    std::vector<int> numbers;
    for (std::size_t i = 0; i < open.size(); ++i) numbers.push_back(quantities + static_cast<int>(i));
    return numbers;
  }
};

}  // namespace

/// A piece of the box.
struct EigenvalueBounds::Piece {
  const Pencil& pencil;
  const int f, quantities;
  Box parameters;
  bool hasSlopes = false;  // otherwise nothing is known
  double stiffnessSize = 1;
  bool isMassPositive = false;  // by these
  // dK/dp_i, dM/dp_i over the piece, as the basis sees them, and how they are bounded
  std::vector<Symmetric> stiffness, mass;
  std::vector<LoewnerBounds> ofStiffness, ofMass;

  Piece(const Pencil& itsPencil, Box itsParameters)
      : pencil(itsPencil), f(pencil.f), quantities(pencil.quantities), parameters(std::move(itsParameters)) {
    hasSlopes = findSlopes();
    stiffnessSize = std::max(at(middleOf(parameters)).stiffness.middle().cwiseAbs().trace(), 0x1p-1000);
    isMassPositive = hasSlopes && findMassPositive();
  }

  /// Nonzero total derivatives of the pencil's entries by each parameter: their range over the piece.
  bool findSlopes() {
    Box ranges;
    if (!pencil.which.empty()) {
      const int degree = pencil.isUnit ? degreeFor(parameters) : 2;  // much cancels in what is eliminated
      ranges = encloseImage(pencil.slopes, 0.0, pencil.withOpen(parameters), {}, degree, nullptr, pencil.narrow())[0];
    }
    stiffness.assign(quantities, Symmetric(f));
    mass = stiffness;
    for (std::size_t o = 0; o < pencil.which.size(); ++o) {
      if (!isBounded(ranges[o]) || isEmpty(ranges[o])) return false;
      const int i = pencil.which[o] / (2 * pencil.triangle), entry = pencil.which[o] % (2 * pencil.triangle);
      (entry < pencil.triangle ? stiffness : mass)[i].set(entry % pencil.triangle, ranges[o]);
    }
    for (int i = 0; i < quantities; ++i) {
      for (Symmetric* each : {&stiffness[i], &mass[i]}) *each = pencil.modal(*each);
      const std::optional<LoewnerBounds> k = loewnerBounds(stiffness[i]), m = loewnerBounds(mass[i]);
      if (!k || !m) return false;
      ofStiffness.push_back(*k);
      ofMass.push_back(*m);
    }
    return true;
  }

  std::vector<Interval> ranges(const std::vector<int>& numbers, const Box& part) const;
  Beside beside(const Program& near, const Program& shapes, const std::vector<int>& numbers,
                const std::vector<Interval>& ranges) const;

  struct At;

  /// What is bounded of each mode all over the piece, one number after the other: c; s and g = xᵀ M x; left, (K − c M)
  /// x, and resisted, M x; K − c M. K and M as the basis sees them.
  struct Residuals {
    const Interval* first;
    int f;

    const Interval& c() const { return first[0]; }
    const Interval& s() const { return first[1]; }
    const Interval& g() const { return first[2]; }
    const Interval& left(int i) const { return first[3 + i]; }
    const Interval& resisted(int i) const { return first[3 + f + i]; }
    const Interval* pencil() const { return first + 3 + 2 * f; }
  };
  int residualsOfMode() const { return 3 + 2 * f + pencil.triangle; }
  Program residualsOf(const Program& near, const Program& shapes, std::size_t from, std::size_t to) const;
  Box allResiduals(const Program& near, const Program& shapes, std::size_t modes) const;
  struct Spread;
  Spread spreadAt(double c0, const At& middle) const;
  std::optional<double> apartBy(int k, const Residuals& own, const Spread& spread, double delta, double off) const;
  std::optional<double> radiusOf(int k, const Residuals& own, const At& middle) const;

  struct Turned;
  struct Expansion;
  class Residual;
  /// B over a part of the piece, where it is proved; what more there is to know.
  struct Basis {
    std::optional<Intervals> all;
    bool isTight = false, isLoose = false, isHopeless = false;  // what is left over: next to nothing, or most of it
    int mover = -1;
  };
  Turned turnedOn(const Box& part) const;
  struct Off;
  struct Beheaded;
  static std::optional<Off> offOfMany(const Turned& turned, const Expansion& y, const Interval& between);
  std::optional<Off> offOfOne(const Turned& turned, const Expansion& y, const Interval& range) const;
  static std::optional<double> movedBy(const Turned& turned, const Expansion& y);
  static int moverOf(const Turned& turned, const Expansion& y);
  static bool isMet(const Turned& turned, const Cluster& cluster);
  /// `known`: of one eigenvalue its range on the part, of more what the others leave them.
  Basis basisOn(const Box& part, const Cluster& cluster, const std::vector<int>& references,
                const Interval& known) const;
  /// The pencil is linear in the quantities: what is known of slopes on the piece is as good on its parts.
  bool isLinear() const {
    const auto isKnown = [](const Symmetric& each) {
      return std::ranges::all_of(each.entries(), [](const Interval& x) { return width(x) <= 0x1p-40 * magnitude(x); });
    };
    return hasSlopes && std::ranges::all_of(stiffness, isKnown) && std::ranges::all_of(mass, isKnown);
  }

  /// By how much a quantity moves K and M, about, of what they are in the middle.
  double movedBy(int i) const {
    const double wide = width(parameters[i]);
    if (!hasSlopes) return wide / std::max(magnitude(parameters[i]), 0x1p-1000);
    return wide * ((ofStiffness[i].sizeBelow + ofStiffness[i].sizeAbove) / stiffnessSize +
                   (ofMass[i].sizeBelow + ofMass[i].sizeAbove) / f);
  }
  double moved() const {
    double sum = 0;
    for (int i = 0; i < quantities; ++i) sum += movedBy(i);
    return hasSlopes ? sum : std::numeric_limits<double>::infinity();
  }
  int mover() const {
    int mover = 0;
    for (int i = 1; i < quantities; ++i)
      if (movedBy(i) > movedBy(mover)) mover = i;
    return mover;
  }

  /// K and M at thin parameters.
  struct At {
    Symmetric stiffness, mass;
  };
  At at(const std::vector<double>& anchor) const {
    const Box own(anchor.begin(), anchor.end()), left = pencil.openAt(own);
    Box all = own;
    all.insert(all.end(), left.begin(), left.end());
    const Box v = evaluate<Interval>(pencil.root, {}, all, Interval(0.0)),
              entries = evaluate<Interval>(pencil.pencil, v, own, Interval(0.0));
    const auto first = entries.begin() + pencil.n, second = first + pencil.triangle;
    return {pencil.modal(Symmetric(f, {first, second})), pencil.modal(Symmetric(f, {second, entries.end()}))};
  }

  static std::vector<double> middleOf(const Box& part) {
    std::vector<double> anchor;
    for (const Interval& each : part) anchor.push_back(midpoint(each));
    return anchor;
  }

  /// Of D_i at σ > 0.
  LoewnerBounds slopeBounds(int i, double sigma) const {
    LoewnerBounds bounds = ofStiffness[i];
    if (mass[i].isZero()) return bounds;
    if (stiffness[i].isZero()) {
      bounds = {Symmetric(f), Symmetric(f)};
      bounds.below.add(Interval(sigma), ofMass[i].above);
      bounds.above.add(Interval(sigma), ofMass[i].below);
      bounds.sizeBelow = sigma * ofMass[i].sizeAbove;
      bounds.sizeAbove = sigma * ofMass[i].sizeBelow;
      return bounds;
    }
    Symmetric d = stiffness[i];
    d.add(Interval(-sigma), mass[i]);
    std::optional<LoewnerBounds> own = loewnerBounds(d);
    if (own) return *own;
    bounds.below.add(Interval(sigma), ofMass[i].above);  // of the two apart
    bounds.above.add(Interval(sigma), ofMass[i].below);
    return bounds;
  }

  /// What is at least (or at most) there all over a part of the box: this beside the value at a corner.
  struct Bound {
    std::vector<double> corner;
    Symmetric loss;
  };
  template <class Bounds>  // of quantity i
  Bound boundOn(const Box& part, bool isLower, const Bounds& boundsOf) const {
    Bound bound{middleOf(part), Symmetric(f)};
    for (int i = 0; i < quantities; ++i) {
      if (isThin(part[i])) continue;
      const LoewnerBounds of = boundsOf(i);
      const bool isBelow = of.sizeBelow <= of.sizeAbove;
      bound.corner[i] = isBelow == isLower ? part[i].lower() : part[i].upper();
      const Interval wide(width(part[i]));
      bound.loss.add(isLower ? -wide : wide, isBelow ? of.below : of.above);
    }
    return bound;
  }

  bool findMassPositive() const {
    const Bound bound = boundOn(parameters, true, [&](int i) { return ofMass[i]; });
    Symmetric least = at(bound.corner).mass;
    least.add(Interval(1.0), bound.loss);
    return least.isKnown() && positives(least) == f;
  }

  /// A number that λ is not below (or above) anywhere; nothing where none is proved. `atCorner`: at(), kept.
  template <class AtCorner>
  std::optional<double> end(int number, const Box& part, bool isLower, const AtCorner& atCorner) const {
    const At& centre = atCorner(middleOf(part));
    if (!centre.stiffness.isKnown() || !centre.mass.isKnown()) return {};
    double sigma = pencilValuesOf(centre.stiffness.middle(), centre.mass.middle())[number], largest = 0;
    const auto boundAt = [&](double at) { return boundOn(part, isLower, [&](int i) { return slopeBounds(i, at); }); };
    constexpr int rounds = 4;
    for (int round = 0; round < rounds; ++round) {
      if (!(sigma > 0)) return isLower ? std::optional(0.0) : std::nullopt;
      const Bound bound = boundAt(sigma);
      const At& there = atCorner(bound.corner);
      if (!bound.loss.isKnown() || !there.stiffness.isKnown() || !there.mass.isKnown()) return {};
      const Vector all = pencilValuesOf(there.stiffness.middle() + bound.loss.middle(), there.mass.middle());
      if (!all.array().isFinite().all()) return {};
      const double before = std::exchange(sigma, all[number]);
      largest = all.cwiseAbs().maxCoeff();
      if (std::abs(sigma - before) <= f * 0x1p-52 * largest) break;
    }
    constexpr int tries = 40;
    double off = f * 0x1p-52 * largest;
    for (int i = 0; i < tries; ++i, off *= 4) {
      const double tried = isLower ? sigma - off : sigma + off;
      if (!(tried > 0)) return isLower ? std::optional(0.0) : std::nullopt;
      const Bound bound = boundAt(tried);
      const At& there = atCorner(bound.corner);
      const Interval sign(isLower ? 1.0 : -1.0);
      Symmetric of(f);
      of.add(sign, there.stiffness);
      of.add(-sign * Interval(tried), there.mass);
      of.add(sign, bound.loss);
      // below: of K − σM at most `number` are negative; above: at least number + 1
      if (of.isKnown() && positives(of) >= (isLower ? f - number : number + 1)) return tried;
    }
    return {};
  }
};

std::vector<Interval> EigenvalueBounds::Piece::ranges(const std::vector<int>& numbers, const Box& part) const {
  std::map<std::vector<double>, At> corners;
  const auto atCorner = [&](const std::vector<double>& corner) -> const At& {
    const auto found = corners.find(corner);
    return found != corners.end() ? found->second : corners.emplace(corner, at(corner)).first->second;
  };
  std::vector<Interval> ranges(numbers.size(), Interval::entire());
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const std::optional<double> lower = end(numbers[k], part, true, atCorner),
                                upper = end(numbers[k], part, false, atCorner);
    if (lower && upper) ranges[k] = Interval(*lower, *upper);
  }
  return ranges;
}

/// Of modes from `from` on; what stands of each is in Residuals.
Program EigenvalueBounds::Piece::residualsOf(const Program& near, const Program& shapes, std::size_t from,
                                             std::size_t to) const {
  const int triangle = pencil.triangle, perMode = residualsOfMode();
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> basis = pencil.basis;
  return record(0, pencil.root.parameters(), static_cast<int>(to - from) * perMode,
                [&](auto, const auto&, const auto& p, auto& y) {
                  const std::vector<Recorded> own(p.begin(), p.begin() + quantities),
                      all = evaluate<Recorded>(pencil.pencil, evaluate<Recorded>(pencil.root, {}, {p.begin(), p.end()}),
                                               own),
                      c = evaluate<Recorded>(near, {}, own), vectors = evaluate<Recorded>(shapes, {}, own);
                  const std::span<const Recorded> entries = std::span<const Recorded>(all).subspan(pencil.n);
                  const std::span<const double> phi(basis.data(), basis.size());
                  const std::vector<Recorded> modalStiffness = congruent<Recorded>(entries.first(triangle), phi, f, f),
                                              modalMass = congruent<Recorded>(entries.last(triangle), phi, f, f);
                  for (std::size_t w = from; w < to; ++w) {
                    const int first = static_cast<int>(w - from) * perMode;
                    const std::span<const Recorded> x = std::span<const Recorded>(vectors).subspan(w * f, f);
                    const std::vector<Recorded> held = times<Recorded>(modalStiffness, x),
                                                resisted = times<Recorded>(modalMass, x);
                    Recorded s(0.0), g(0.0);
                    for (int i = 0; i < f; ++i) {
                      const Recorded left = held[i] - c[w] * resisted[i];
                      s = s + x[i] * left;
                      g = g + x[i] * resisted[i];
                      y[first + 3 + i] = left;
                      y[first + 3 + f + i] = resisted[i];
                    }
                    for (int i = 0; i < triangle; ++i)
                      y[first + 3 + 2 * f + i] = modalStiffness[i] - c[w] * modalMass[i];
                    y[first] = c[w];
                    y[first + 1] = s;
                    y[first + 2] = g;
                  }
                });
}

/// Of so many modes, over the piece.
Box EigenvalueBounds::Piece::allResiduals(const Program& near, const Program& shapes, std::size_t modes) const {
  const Box box = pencil.withOpen(parameters);
  constexpr std::size_t together = 16384;  // numbers: all have room, whatever the number of modes
  const std::size_t atOnce = std::max<std::size_t>(1, together / static_cast<std::size_t>(residualsOfMode()));
  Box found;
  for (std::size_t w = 0; w < modes; w += atOnce) {
    const Program own = residualsOf(near, shapes, w, std::min(w + atOnce, modes));
    const Box image = encloseImage(own, 0.0, box, {}, degreeFor(parameters), nullptr, pencil.narrow())[0];
    found.insert(found.end(), image.begin(), image.end());
  }
  return found;
}

/// K − c0 M in the middle, by how much quantities change it at most, and M with its own.
struct EigenvalueBounds::Piece::Spread {
  Symmetric middle, pencil, mass;
};

EigenvalueBounds::Piece::Spread EigenvalueBounds::Piece::spreadAt(double c0, const At& middle) const {
  Spread spread{middle.stiffness, Symmetric(f), Symmetric(f)};
  spread.middle.add(Interval(-c0), middle.mass);
  for (int i = 0; i < quantities; ++i) {
    if (isThin(parameters[i])) continue;
    const LoewnerBounds bounds = slopeBounds(i, c0);
    const Interval radius(magnitude(parameters[i] - Interval(midpoint(parameters[i]))));
    spread.pencil.add(radius, bounds.below);
    spread.pencil.add(radius, bounds.above);
    spread.mass.add(radius, ofMass[i].below);
    spread.mass.add(radius, ofMass[i].above);
  }
  spread.mass.add(Interval(1.0), middle.mass);
  return spread;
}

/// bᵀ |B_J⁻¹| b at most, c + δ being off from c0 by `off` at most; nothing where B_J is not proved to have k negative
/// eigenvalues.
std::optional<double> EigenvalueBounds::Piece::apartBy(int k, const Residuals& own, const Spread& spread, double delta,
                                                       double off) const {
  Symmetric all = spread.pencil;
  all.add(Interval(off), spread.mass);
  // Free of units, without row k.
  Matrix d = Matrix::Zero(f, f - 1);
  for (int j = 0, column = 0; j < f; ++j) {
    if (j == k) continue;
    const double there = midpoint(spread.middle(j, j));
    if (there == 0 || (there < 0) != (j < k)) return {};
    d(j, column++) = 1 / std::sqrt(std::abs(there));
  }
  Symmetric rest = congruent(d, spread.middle);
  double q = f > 1 ? largestOf(congruent(d, all)) : 0.0;
  for (int i = 0; i < f - 1; ++i) rest(i, i) -= Interval(midpoint(rest(i, i)) < 0 ? -1.0 : 1.0);
  q = (Interval(q) + Interval(normOf(rest))).upper();
  // Or by what polynomials know of the entries at c, which move with it.
  if (const Symmetric atC(f, {own.pencil(), own.pencil() + pencil.triangle}); f > 1 && atC.isKnown()) {
    Symmetric entries = congruent(d, atC);
    for (int i = 0; i < f - 1; ++i) entries(i, i) -= Interval(i < k ? -1.0 : 1.0);
    q = std::min(
        q, (Interval(normOf(entries)) + Interval(delta) * Interval(largestOf(congruent(d, spread.mass)))).upper());
  }
  if (!(q < 1)) return {};
  Interval square(0.0);
  for (int j = 0, column = 0; j < f; ++j) {
    if (j == k) continue;
    square += sqr((Interval(magnitude(own.left(j))) + Interval(delta) * Interval(magnitude(own.resisted(j)))) *
                  Interval(d(j, column++)));
  }
  return (square / (Interval(1.0) - Interval(q))).upper();
}

/// δ, by which λ_k differs from c at most; nothing where none is proved.
std::optional<double> EigenvalueBounds::Piece::radiusOf(int k, const Residuals& own, const At& middle) const {
  if (!isBounded(own.c()) || !isBounded(own.s()) || !(own.g().lower() > 0)) return {};
  const double c0 = midpoint(own.c());
  const Spread spread = spreadAt(c0, middle);
  double delta = magnitude(own.s()) / own.g().lower();
  constexpr int rounds = 6;
  for (int round = 0; round < rounds; ++round) {
    const double off = (Interval(magnitude(own.c() - Interval(c0))) + Interval(delta)).upper();
    const std::optional<double> apart = apartBy(k, own, spread, delta, off);
    if (!apart) return {};
    const double needed = ((Interval(magnitude(own.s())) + Interval(*apart)) / Interval(own.g().lower())).upper();
    if (needed < delta || (needed == 0 && delta == 0)) return delta;
    delta = 1.01 * needed + 1e-300;
  }
  return {};
}

/// With S = [x, e_j for all others j], x_k = 1, the pencil at σ = c + δ is s = xᵀBx beside b_j = (Bx)_j and B_J, B
/// without row and column k. Where B_J is regular and has k negative eigenvalues for all p, λ_k < σ where s − bᵀB_J⁻¹b
/// < 0, and λ_k > σ where that is above 0 (E. V. Haynsworth). B_J = D^½ (±1 + F) D^½ with ‖F‖ ≤ q < 1 has the signs of
/// D, and |bᵀB_J⁻¹b| ≤ Σ b_j²/d_j/(1 − q).
EigenvalueBounds::Beside EigenvalueBounds::Piece::beside(const Program& near, const Program& shapes,
                                                         const std::vector<int>& numbers,
                                                         const std::vector<Interval>& ranges) const {
  const Box found = allResiduals(near, shapes, numbers.size());
  const At middle = at(middleOf(parameters));
  Beside result{{}, ranges};
  for (std::size_t w = 0; w < numbers.size(); ++w) {
    const Residuals own{&found[w * residualsOfMode()], f};
    Interval off = ranges[w] - own.c();
    if (const std::optional<double> delta = radiusOf(numbers[w], own, middle)) {
      off = intersection(off, Interval(-*delta, *delta));
      result.ranges[w] = intersection(ranges[w], own.c() + off);
    }
    result.off.push_back(off);
  }
  return result;
}

/// The pencil about the middle of a part, in coordinates y of its own eigenvectors T, nearly, and what it changes by.
struct EigenvalueBounds::Piece::Turned {
  Matrix t;
  Intervals stiffness, mass;
  std::vector<Intervals> byStiffness, byMass;  // of quantities that are wide
  std::vector<bool> movesMass;
  std::vector<double> radii;  // of these
  std::vector<int> which;
  Symmetric massSpread;           // M is off from that in the middle by no more, both ways
  bool isMiddlePositive = false;  // M in the middle
  double leastMass = 0;           // of M all over the part
};

/// By how much a vector is off.
struct EigenvalueBounds::Piece::Off {
  double norm = std::numeric_limits<double>::infinity();
  std::vector<double> each;  // component by component, or none

  /// |v e| at most.
  double along(const Eigen::Matrix<Interval, 1, Eigen::Dynamic>& v) const {
    Interval square(0.0), sum(0.0);
    for (Eigen::Index j = 0; j < v.size(); ++j) {
      const Interval size(magnitude(v[j]));
      square += sqr(size);
      if (!each.empty()) sum += size * Interval(each[j]);
    }
    const double whole = std::isfinite(norm) ? (sqrt(square) * Interval(norm)).upper() : norm;
    return each.empty() ? whole : std::min(whole, sum.upper());
  }
};

/// Y(p) ≈ E + Σ t_i Y_i and Λ(p) ≈ diag(λ) + Σ t_i L_i, the first powers of K Y = M Y Λ (Rayleigh & Schrödinger), t_i
/// by how much quantity i differs from the middle; L_i symmetric, since Y stays nearly orthogonal in M.
struct EigenvalueBounds::Piece::Expansion {
  Cluster of;
  Vector lambda;
  std::vector<Matrix> vectors, squares;

  Expansion(const Turned& turned, const Cluster& cluster) : of(cluster), lambda(cluster.size()) {
    const auto f = turned.stiffness.rows();
    const Vector all = turned.stiffness.diagonal().unaryExpr([](const Interval& x) { return midpoint(x); });
    const int m = of.size();
    lambda = all.segment(of.first, m);
    for (std::size_t i = 0; i < turned.radii.size(); ++i) {
      Matrix y(f, m), l(m, m);
      for (int c = 0; c < m; ++c)
        for (int j = 0; j < f; ++j) {
          const double k = midpoint(turned.byStiffness[i](j, of.first + c)),
                       inertia = midpoint(turned.byMass[i](j, of.first + c));
          const bool isOwn = j >= of.first && j <= of.last;
          y(j, c) = isOwn ? (m > 1 ? -0.5 * inertia : 0.0) : (k - lambda[c] * inertia) / (lambda[c] - all[j]);
          if (isOwn) l(j - of.first, c) = k - 0.5 * (all[j] + lambda[c]) * inertia;
        }
      vectors.push_back(std::move(y));
      squares.emplace_back(l.selfadjointView<Eigen::Lower>());
    }
  }
};

EigenvalueBounds::Piece::Turned EigenvalueBounds::Piece::turnedOn(const Box& part) const {
  const At middle = at(middleOf(part));
  Turned turned{{}, {}, {}, {}, {}, {}, {}, {}, Symmetric(f)};
  turned.t = pencilPairsOf(middle.stiffness.middle(), middle.mass.middle()).vectors;
  const auto seen = [&](const Symmetric& each) { return congruent(turned.t, each); };
  const Symmetric inertia = seen(middle.mass);
  turned.stiffness = seen(middle.stiffness).whole();
  turned.mass = inertia.whole();
  Symmetric moved(f);
  for (int i = 0; i < quantities; ++i) {
    if (isThin(part[i])) continue;
    const Interval radius(magnitude(part[i] - Interval(midpoint(part[i]))));
    turned.which.push_back(i);
    turned.radii.push_back(radius.upper());
    turned.byStiffness.push_back(seen(stiffness[i]).whole());
    turned.byMass.push_back(seen(mass[i]).whole());
    turned.movesMass.push_back(!mass[i].isZero());
    moved.add(radius, ofMass[i].below);
    moved.add(radius, ofMass[i].above);
  }
  turned.massSpread = seen(moved);
  turned.isMiddlePositive = normOf(minusUnity(inertia)) < 1;
  turned.leastMass = (Interval(1.0) - Interval(normOf(minusUnity(inertia))) -
                      Interval(moved.isZero() ? 0.0 : largestOf(turned.massSpread)))
                         .lower();
  return turned;
}

/// ‖K Y − M Y Λ‖ in Frobenius' norm, at most: powers of t up to the third.
class EigenvalueBounds::Piece::Residual {
 public:
  Residual(const Turned& turned, const Expansion& y)
      : turned_(turned),
        first_(y.of.first),
        lambda_(exactly(y.lambda.asDiagonal())),
        sum_(Intervals::Constant(turned.t.rows(), y.of.size(), Interval(0.0))) {
    for (std::size_t i = 0; i < turned.radii.size(); ++i) {
      vectors_.push_back(exactly(y.vectors[i]));
      squares_.push_back(exactly(y.squares[i]));
      scaled_.push_back(vectors_[i] * lambda_);
    }
    add(Interval(1.0), own(turned.stiffness) - own(turned.mass) * lambda_);
    for (std::size_t i = 0; i < vectors_.size(); ++i) {
      add(Interval(turned.radii[i]), firstPower(i));
      for (std::size_t l = 0; l <= i; ++l) addHigher(i, l);
    }
  }

  const Interval& at(Eigen::Index row) const { return sum_(row, 0); }
  double norm() const {
    Interval square(0.0);
    for (Eigen::Index k = 0; k < sum_.size(); ++k) square += sqr(sum_(k));
    return sqrt(square).upper();
  }

 private:
  Intervals own(const Intervals& a) const { return a.middleCols(first_, lambda_.cols()); }
  void add(const Interval& factor, const Intervals& term) {
    for (Eigen::Index k = 0; k < term.size(); ++k) sum_(k) += factor * Interval(magnitude(term(k)));
  }
  Intervals firstPower(std::size_t i) const {
    Intervals term = own(turned_.byStiffness[i]) + turned_.stiffness * vectors_[i] - turned_.mass * scaled_[i] -
                     own(turned_.mass) * squares_[i];
    if (turned_.movesMass[i]) term -= own(turned_.byMass[i]) * lambda_;
    return term;
  }
  Intervals secondPower(std::size_t i, std::size_t l) const {
    Intervals term = turned_.byStiffness[i] * vectors_[l] - turned_.mass * Intervals(vectors_[i] * squares_[l]);
    if (turned_.movesMass[i]) term -= turned_.byMass[i] * scaled_[l] + own(turned_.byMass[i]) * squares_[l];
    return term;
  }
  /// t_i t_l, and these with any other.
  void addHigher(std::size_t i, std::size_t l) {
    const Interval both = Interval(turned_.radii[i]) * Interval(turned_.radii[l]);
    add(both, i == l ? secondPower(i, i) : Intervals(secondPower(i, l) + secondPower(l, i)));
    if (!turned_.movesMass[i] && !turned_.movesMass[l]) return;
    for (std::size_t k = 0; k < vectors_.size(); ++k) {
      Intervals third = turned_.byMass[i] * Intervals(vectors_[l] * squares_[k]);
      if (i != l) third += turned_.byMass[l] * Intervals(vectors_[i] * squares_[k]);
      add(both * Interval(turned_.radii[k]), third);
    }
  }

  const Turned& turned_;
  int first_;
  Intervals lambda_, sum_;
  std::vector<Intervals> vectors_, squares_, scaled_;
};

/// By how much eigenvalues of Λ move at most: −B_i ⪯ L_i ⪯ A_i, so Λ differs by no more than Σ r_i (A_i + B_i).
std::optional<double> EigenvalueBounds::Piece::movedBy(const Turned& turned, const Expansion& y) {
  const int m = y.of.size();
  Symmetric sum(m);
  for (std::size_t i = 0; i < turned.radii.size(); ++i) {
    Symmetric l(m);
    for (int c = 0; c < m; ++c)
      for (int d = 0; d <= c; ++d) l(c, d) = Interval(y.squares[i](c, d));
    const std::optional<LoewnerBounds> bounds = loewnerBounds(l);
    if (!bounds) return {};
    sum.add(Interval(turned.radii[i]), bounds->below);
    sum.add(Interval(turned.radii[i]), bounds->above);
  }
  return sum.isZero() ? 0.0 : largestOf(sum);
}

/// By how much the eigenvectors' span leaves Y at most. With U the others' eigenvectors, orthonormal in M, and all of
/// their λ at least g from those of Λ: from Uᵀ(K Y − M Y Λ) = Λ_U A − A Λ, A = Uᵀ M Y, follows ‖A‖ ≤ ‖K Y − M Y Λ‖/(√μ
/// g) (C. Davis & W. M. Kahan, SIAM J. Numer. Anal. 7, 1970), and Y − U A lies in the span, ‖U A‖ ≤ ‖A‖/√μ, M ≥ μ.
/// Nothing where no such g is proved. `between`: of the others' λ, the least above and the greatest below.
std::optional<EigenvalueBounds::Piece::Off> EigenvalueBounds::Piece::offOfMany(const Turned& turned, const Expansion& y,
                                                                               const Interval& between) {
  if (!(turned.leastMass > 0)) return {};
  if (y.of.size() == turned.t.rows()) return Off{0.0, {}};
  const std::optional<double> moved = movedBy(turned, y);
  if (!moved) return {};
  const Interval own = Interval(y.lambda.minCoeff(), y.lambda.maxCoeff()) + Interval(-*moved, *moved);
  double apart = std::numeric_limits<double>::infinity();
  if (std::isfinite(between.lower())) apart = (Interval(own.lower()) - Interval(between.lower())).lower();
  if (std::isfinite(between.upper()))
    apart = std::min(apart, (Interval(between.upper()) - Interval(own.upper())).lower());
  if (!(apart > 0)) return {};
  return Off{(Interval(Residual(turned, y).norm()) / (Interval(turned.leastMass) * Interval(apart))).upper(), {}};
}

/// (K − λ M) beside what is diag(Δ) in the middle, all over the part and for all of λ's range: by D^½ (±1 + F) D^½ with
/// ‖F‖ ≤ q, D = |Δ|, row and column k left out.
struct EigenvalueBounds::Piece::Beheaded {
  std::vector<double> scale;  // D^-½, as it was rounded: what follows is of these very numbers; 0 of k
  double q = std::numeric_limits<double>::infinity();

  Beheaded(const Piece& piece, const Turned& turned, int k, double lambda, double range) {
    const int f = piece.f;
    Matrix d = Matrix::Zero(f, std::max(f - 1, 0));
    Symmetric middle(f), moved(f), mass = turned.massSpread;
    for (int i = 0; i < f; ++i)
      for (int j = 0; j <= i; ++j) {
        middle(i, j) = turned.stiffness(i, j) - Interval(lambda) * turned.mass(i, j);
        mass(i, j) += turned.mass(i, j);
      }
    for (int j = 0, column = 0; j < f; ++j) {
      scale.push_back(j == k ? 0.0 : 1 / std::sqrt(std::abs(midpoint(middle(j, j)))));
      if (j != k) d(j, column++) = scale.back();
    }
    if (!d.allFinite() || !turned.isMiddlePositive)
      return;  // M lies between 0 and that in the middle and what it moves
    for (std::size_t i = 0; i < turned.radii.size(); ++i) {
      const LoewnerBounds bounds = piece.slopeBounds(turned.which[i], lambda);
      moved.add(Interval(turned.radii[i]), bounds.below);
      moved.add(Interval(turned.radii[i]), bounds.above);
    }
    if (f == 1) q = 0;
    if (f == 1) return;
    Symmetric rest = congruent(d, middle);
    for (int i = 0; i < f - 1; ++i) rest(i, i) -= Interval(midpoint(rest(i, i)) < 0 ? -1.0 : 1.0);
    q = (Interval(normOf(rest)) + Interval(largestOf(congruent(d, congruent(turned.t, moved)))) +
         Interval(range) * Interval(largestOf(congruent(d, mass))))
            .upper();
  }
};

/// By how much the eigenvector x, x_k = 1, of one eigenvalue λ leaves Y at most: with B = K − λ M and e = x − Y from
/// B x = 0, without row and column k, B_J e_J = −(B Y)_J, so |e_j| √D_j ≤ n_j + q ‖n‖/(1 − q), n_j = |(B Y)_j|/√D_j;
/// B_J is regular, so that λ is simple. (B Y)_J = (K Y − M Y Λ)_J − δ (M Y)_J, and δ = λ − Λ is bounded by λ's range
/// at first, then by row k. Nothing where q is no less than 1.
std::optional<EigenvalueBounds::Piece::Off> EigenvalueBounds::Piece::offOfOne(const Turned& turned, const Expansion& y,
                                                                              const Interval& range) const {
  if (!isBounded(range)) return {};
  const int k = y.of.first;
  const double lambda = y.lambda[0], reach = magnitude(range - Interval(lambda));
  const Beheaded rest(*this, turned, k, lambda, reach);
  if (!(rest.q < 1)) return {};
  const Residual residual(turned, y);
  // |M Y|, |B| of row k and |Λ − λ| at most.
  std::vector<Interval> inertia, row;
  Interval moved(0.0);
  for (int j = 0; j < f; ++j) {
    inertia.emplace_back(magnitude(turned.mass(j, k)));
    row.emplace_back(magnitude(turned.stiffness(k, j) - Interval(lambda) * turned.mass(k, j)));
    row.back() += Interval(reach) * Interval(magnitude(turned.mass(k, j)));
  }
  Interval own(0.0);  // by how much (M Y)_k changes
  for (std::size_t i = 0; i < turned.radii.size(); ++i) {
    const Interval radius(turned.radii[i]);
    const Intervals vector = exactly(y.vectors[i]), first = turned.byMass[i].col(k) + turned.mass * vector;
    moved += radius * Interval(std::abs(y.squares[i](0, 0)));
    for (int j = 0; j < f; ++j) {
      Interval more(magnitude(first(j)));
      if (turned.movesMass[i])
        for (std::size_t l = 0; l < turned.radii.size(); ++l)
          more += Interval(turned.radii[l]) *
                  Interval(magnitude((turned.byMass[i].row(j) * exactly(y.vectors[l])).value()));
      inertia[j] += radius * more;
      if (j == k) own += radius * more;
      row[j] += radius * Interval(magnitude(turned.byStiffness[i](k, j) - Interval(lambda) * turned.byMass[i](k, j))) +
                radius * Interval(reach) * Interval(magnitude(turned.byMass[i](k, j)));
    }
  }
  const Interval least = Interval(turned.mass(k, k).lower()) - Interval(own.upper());
  Interval delta(magnitude(range - (Interval(lambda) + Interval(-moved.upper(), moved.upper()))));
  Off off;
  constexpr int rounds = 3;
  for (int round = 0; round < rounds; ++round) {
    std::vector<Interval> n(f, Interval(0.0));
    Interval square(0.0);
    for (int j = 0; j < f; ++j) {
      if (j == k) continue;
      n[j] = (Interval(residual.at(j).upper()) + delta * inertia[j]) * Interval(rest.scale[j]);
      square += sqr(n[j]);
    }
    const Interval others = Interval(rest.q) * sqrt(square) / (Interval(1.0) - Interval(rest.q));
    off.each.assign(f, 0.0);
    Interval back(residual.at(k).upper());
    for (int j = 0; j < f; ++j) {
      if (j == k) continue;
      off.each[j] = ((n[j] + others) * Interval(rest.scale[j])).upper();
      back += row[j] * Interval(off.each[j]);
    }
    if (!(least.lower() > 0)) break;
    delta = Interval(std::min(delta.upper(), (back / least).upper()));
  }
  return off;
}

/// Of Φ T Y the basis that is the identity in the references: B = B_0 + (W − B_0 W_R) Y (W_R Y)⁻¹, W = Φ T.
EigenvalueBounds::Piece::Basis EigenvalueBounds::Piece::basisOn(const Box& part, const Cluster& cluster,
                                                                const std::vector<int>& references,
                                                                const Interval& known) const {
  const Turned turned = turnedOn(part);
  Basis basis;
  if (!turned.t.allFinite()) return basis;
  const Expansion y(turned, cluster);
  basis.mover = moverOf(turned, y);
  const std::optional<Off> off = cluster.size() == 1 ? offOfOne(turned, y, known) : offOfMany(turned, y, known);
  basis.isHopeless = isMet(turned, cluster);
  if (!off) return basis;
  const int m = cluster.size();
  const Intervals w = exactly(pencil.basis) * exactly(turned.t);
  Intervals seen(m, f);
  for (int r = 0; r < m; ++r) seen.row(r) = w.row(references[r]);
  // v Y over the part, and what is left over of it.
  double spread = 0, loss = 0;
  const auto along = [&](const Intervals& v) {
    Intervals sum = v.middleCols(cluster.first, m);
    for (std::size_t i = 0; i < turned.radii.size(); ++i)
      sum += Interval(-turned.radii[i], turned.radii[i]) * Intervals(v * exactly(y.vectors[i]));
    for (int row = 0; row < v.rows(); ++row) {
      const double left = off->along(v.row(row));
      for (int c = 0; c < m; ++c) {
        spread = std::max(spread, 0.5 * width(sum(row, c)));
        sum(row, c) += Interval(-left, left);
        loss = std::max(loss, left);
      }
    }
    return sum;
  };
  const Verified<Intervals> inverse = verifiedInverse(along(seen));
  if (!inverse) return basis;
  const auto middle = [](const Intervals& a) {
    return Matrix(a.unaryExpr([](const Interval& x) { return midpoint(x); }));
  };
  const Matrix b = middle(w.middleCols(cluster.first, m)) *
                   solved(middle(seen.middleCols(cluster.first, m)), Matrix::Identity(m, m));
  spread = loss = 0;
  Intervals all = exactly(b) + along(w - exactly(b) * seen) * *inverse;
  for (int r = 0; r < m; ++r)
    for (int c = 0; c < m; ++c) all(references[r], c) = Interval(r == c ? 1.0 : 0.0);
  basis.all = std::move(all);
  basis.isTight = loss <= 0.1 * spread || loss <= 1e-12;
  basis.isLoose = !basis.isTight && loss > spread;
  return basis;
}

/// The quantity that moves Y and Λ most.
int EigenvalueBounds::Piece::moverOf(const Turned& turned, const Expansion& y) {
  int mover = -1;
  double most = 0;
  const double size = std::max(y.lambda.cwiseAbs().maxCoeff(), 0x1p-1000);
  for (std::size_t i = 0; i < turned.radii.size(); ++i) {
    const double by = turned.radii[i] * (y.vectors[i].norm() + y.squares[i].norm() / size);
    if (!(by > most)) continue;
    most = by;
    mover = turned.which[i];
  }
  return mover;
}

/// Whether eigenvalues of a cluster meet others in the middle, to rounding.
bool EigenvalueBounds::Piece::isMet(const Turned& turned, const Cluster& cluster) {
  constexpr double nothing = 1e-9;
  const auto square = [&](int i) { return midpoint(turned.stiffness(i, i)); };
  const auto meet = [&](int i) { return !(square(i + 1) - square(i) > nothing * std::abs(square(i + 1))); };
  return (cluster.first > 0 && meet(cluster.first - 1)) || (cluster.last + 1 < turned.t.rows() && meet(cluster.last));
}

struct EigenvalueBounds::Parts {
  Pencil pencil;
  std::optional<Pencil> unit;  // where slopes of M do not tell that it is positive
  std::unique_ptr<const Piece> whole;
  std::vector<std::unique_ptr<const Piece>> pieces;  // of the latter
  bool isKnown = false;

  Parts(Pencil itsPencil, const Box& parameters) : pencil(std::move(itsPencil)) {
    whole = std::make_unique<const Piece>(pencil, parameters);
    isKnown = whole->isMassPositive;
    if (isKnown || !whole->hasSlopes || !pencil.arePivotsPositive(parameters)) return;
    unit.emplace(pencil.withUnitMass(parameters));
    divide(parameters);
    isKnown = std::ranges::all_of(pieces, [](const auto& piece) { return piece->isMassPositive; });
  }

  static std::array<Box, 2> halvesOf(const Box& box, int by) {
    std::array<Box, 2> halves{box, box};
    const double middle = midpoint(box[by]);
    halves[0][by] = Interval(box[by].lower(), middle);
    halves[1][by] = Interval(middle, box[by].upper());
    return halves;
  }
  static double mostPieces(const Pencil& of, double atMost) {
    constexpr double cost = 1024;  // f² a piece, in all
    return std::clamp(cost / static_cast<double>(of.f * of.f), 1.0, atMost);
  }

  /// Each time the piece that quantities move most, by the one that does.
  void divide(const Box& parameters) {
    constexpr double few = 32;  // each by polynomials of high degree
    pieces.push_back(std::make_unique<const Piece>(*unit, parameters));
    while (static_cast<double>(pieces.size()) < mostPieces(*unit, few)) {
      auto& open = *std::ranges::max_element(pieces, {}, [](const auto& piece) { return piece->moved(); });
      const int by = open->mover();
      if (isThin(open->parameters[by])) break;
      std::array<Box, 2> halves = halvesOf(open->parameters, by);
      open = std::make_unique<const Piece>(*unit, std::move(halves[0]));
      pieces.push_back(std::make_unique<const Piece>(*unit, std::move(halves[1])));
    }
  }
};

EigenvalueBounds::EigenvalueBounds(const Program& pencil, const Program& root, const std::vector<double>& basis,
                                   const Box& parameters, const Box& open, const Open& openAt)
    : parts_(std::make_unique<const Parts>(Pencil(pencil, root, basis, open, openAt), parameters)) {}

EigenvalueBounds::~EigenvalueBounds() = default;

std::vector<Interval> EigenvalueBounds::ranges(const std::vector<int>& numbers, const Box& part) const {
  std::vector<Interval> ranges(numbers.size(), Interval::entire());
  if (!parts_->isKnown) return ranges;
  if (parts_->pieces.empty()) return parts_->whole->ranges(numbers, part);
  std::ranges::fill(ranges, Interval::empty());
  for (const auto& piece : parts_->pieces) {
    Box own;
    for (std::size_t i = 0; i < part.size(); ++i) own.push_back(intersection(part[i], piece->parameters[i]));
    if (std::ranges::any_of(own, [](const Interval& each) { return isEmpty(each); })) continue;
    const std::vector<Interval> found = piece->ranges(numbers, own);
    for (std::size_t k = 0; k < ranges.size(); ++k) ranges[k] = hull(ranges[k], found[k]);
  }
  return ranges;
}

EigenvalueBounds::Beside EigenvalueBounds::beside(const Program& near, const Program& shapes,
                                                  const std::vector<int>& numbers,
                                                  const std::vector<Interval>& ranges) const {
  const std::size_t count = numbers.size();
  if (!parts_->isKnown) return {std::vector<Interval>(count, Interval::entire()), ranges};
  Beside result = parts_->whole->beside(near, shapes, numbers, ranges);
  constexpr double most = 0.1;  // of an eigenvalue's range
  const auto isClose = [&](const Beside& found, std::size_t k) {
    return width(found.off[k]) <= most * width(ranges[k]);
  };
  std::vector<std::size_t> open;
  for (std::size_t k = 0; k < count; ++k)
    if (!isClose(result, k)) open.push_back(k);
  if (open.empty() || parts_->pieces.empty()) return result;
  // On pieces, each halved by the quantity that moves the pencil most as long as there are few.
  Beside all{std::vector<Interval>(count, Interval::empty()), std::vector<Interval>(count, Interval::empty())};
  std::deque<Box> left{parts_->whole->parameters};
  const double mostTried = Parts::mostPieces(parts_->pencil, 128);
  for (double tried = 0; !left.empty(); ++tried) {
    const Piece piece(parts_->pencil, left.front());
    left.pop_front();
    const Beside own =
        tried == 0 ? result : piece.beside(near, shapes, numbers, this->ranges(numbers, piece.parameters));
    const int by = piece.mover();
    if (tried + static_cast<double>(left.size()) < mostTried && !isThin(piece.parameters[by]) &&
        !std::ranges::all_of(open, [&](std::size_t k) { return isClose(own, k); })) {
      for (Box& half : Parts::halvesOf(piece.parameters, by)) left.push_back(std::move(half));
      continue;
    }
    for (const std::size_t k : open) {
      all.off[k] = hull(all.off[k], own.off[k]);
      all.ranges[k] = hull(all.ranges[k], own.ranges[k]);
    }
  }
  for (const std::size_t k : open) {
    result.off[k] = intersection(result.off[k], all.off[k]);
    result.ranges[k] = intersection(result.ranges[k], all.ranges[k]);
  }
  return result;
}

/// Between these are those of the cluster, over a part: the greatest of the others below and the least above.
Interval EigenvalueBounds::roomOf(const Cluster& cluster, const Box& part, int negatives) const {
  const int f = parts_->pencil.f;
  constexpr double infinite = std::numeric_limits<double>::infinity();
  double below = -infinite, above = infinite;
  if (cluster.first > negatives) below = ranges({cluster.first - 1}, part)[0].upper();
  if (cluster.first == negatives && negatives > 0) below = 0;
  if (cluster.last + 1 < f) above = ranges({cluster.last + 1}, part)[0].lower();
  return below <= above ? Interval(below, above) : Interval(0.0);
}

std::optional<std::vector<Interval>> EigenvalueBounds::basisOf(const Cluster& cluster,
                                                               const std::vector<int>& references, int negatives,
                                                               const std::atomic<bool>* cancelled) const {
  if (!parts_->isKnown) return {};
  const Piece& whole = *parts_->whole;
  const bool isLinear = whole.isLinear();
  const double size = whole.f, wide = whole.quantities, cost = size * size * cluster.size() * (1 + wide * wide);
  const double most = isLinear ? std::clamp(2e7 / cost, 1.0, 2048.0) : Parts::mostPieces(parts_->pencil, 256);
  double tried = 0, refined = 0;
  std::optional<Intervals> all;
  std::vector<Box> open{whole.parameters};
  while (!open.empty()) {
    const Box part = std::move(open.back());
    open.pop_back();
    if (cancelled != nullptr && *cancelled) return {};
    std::optional<Piece> fresh;
    if (!isLinear && tried > 0) fresh.emplace(parts_->pencil, part);
    const Piece& piece = fresh ? *fresh : whole;
    const Piece::Basis own = piece.hasSlopes ? piece.basisOn(part, cluster, references,
                                                             cluster.size() == 1 ? ranges({cluster.first}, part)[0]
                                                                                 : roomOf(cluster, part, negatives))
                                             : Piece::Basis{{}, false, false, false, piece.mover()};
    const bool isInVain = own.isTight || refined >= (own.isLoose ? most / 4 : most / 16);
    const bool mayRefine = own.mover >= 0 && tried < most && !(own.all && isInVain);
    if (!own.all && (own.isHopeless || !mayRefine)) return {};
    ++tried;
    if (mayRefine) {
      refined += own.all ? 1 : 0;
      for (Box& half : Parts::halvesOf(part, own.mover)) open.push_back(std::move(half));
      continue;
    }
    for (Eigen::Index k = 0; all && k < all->size(); ++k) (*all)(k) = hull((*all)(k), (*own.all)(k));
    if (!all) all = own.all;
  }
  std::vector<Interval> rows;
  for (Eigen::Index i = 0; i < all->rows(); ++i)
    for (Eigen::Index c = 0; c < all->cols(); ++c) rows.push_back((*all)(i, c));
  return rows;
}

}  // namespace gamut
