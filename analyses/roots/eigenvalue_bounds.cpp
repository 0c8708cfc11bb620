// In the coordinates y of x = Φ y, in which K and M are nearly diagonal. How D_i is bounded: with T its eigenvectors,
// nearly, TᵀD_iT lies between the ends of its discs (S. Gershgorin), so D_i + T diag(n) Tᵀ ⪰ −ε for n the parts of them
// below zero, and ε what rounding and the discs' radii leave.
#include "analyses/roots/eigenvalue_bounds.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "analyses/flow/flow.hpp"
#include "analyses/roots/root_family.hpp"
#include "scalars/algebra/linear_system.hpp"
#include "scalars/algebra/triangle.hpp"
#include "scalars/evaluation/evaluate.hpp"
#include "scalars/program/differentiation.hpp"
#include "scalars/program/recorder.hpp"
#include "scalars/recorded.hpp"

namespace gamut {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

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

Matrix eigenvectorsOf(const Symmetric& a) { return Eigen::SelfAdjointEigenSolver<Matrix>(a.middle()).eigenvectors(); }

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

}  // namespace

struct EigenvalueBounds::Parts {
  Program pencil, root;
  int n, f = 0, quantities, triangle;
  Matrix basis;
  Box parameters, open;
  Open openAt;
  bool isKnown = false;
  // dK/dp_i, dM/dp_i over the box, as the basis sees them, and how they are bounded
  std::vector<Symmetric> stiffness, mass;
  std::vector<LoewnerBounds> ofStiffness, ofMass;

  Parts(const Program& itsPencil, const Program& itsRoot, const std::vector<double>& itsBasis, Box itsParameters,
        Box itsOpen, Open itsOpenAt)
      : pencil(itsPencil),
        root(itsRoot),
        n(pencil.states()),
        quantities(pencil.parameters()),
        triangle((pencil.outputs() - n) / 2),
        parameters(std::move(itsParameters)),
        open(std::move(itsOpen)),
        openAt(std::move(itsOpenAt)) {
    while (f * (f + 1) / 2 < triangle) ++f;
    basis =
        Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(itsBasis.data(), f, f);
    isKnown = findSlopes();
    if (isKnown) isKnown = isMassPositive();
  }

  Symmetric modal(const Symmetric& a) const { return congruent(basis, a); }

  /// Nonzero total derivatives of the pencil's entries by each parameter: their range over the box.
  bool findSlopes() {
    std::vector<int> by, nodes, which;
    for (int i = 0; i < quantities; ++i) by.push_back(n + i);
    std::vector<int> first(pencil.outputNodes().begin(), pencil.outputNodes().begin() + n);
    const Program rows = Recorder(pencil).finish(first), slopesOfRows = forwardDifferentiated(rows, true),
                  along = alongDerivatives(pencil, by);
    const int outputs = pencil.outputs();
    const Program all =
        record(0, root.parameters(), quantities * 2 * triangle, [&](auto, const auto&, const auto& p, auto& y) {
          const std::vector<Recorded> own(p.begin(), p.begin() + quantities),
              v = evaluate<Recorded>(root, {}, {p.begin(), p.end()}), slopes = evaluate<Recorded>(slopesOfRows, v, own);
          std::vector<Recorded> held(slopes.begin() + n, slopes.begin() + n + n * n), x = v;
          for (int i = 0; i < quantities; ++i) {
            std::vector<Recorded> right;
            for (int k = 0; k < n; ++k) right.push_back(-slopes[n + n * n + k * quantities + i]);
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
    Box box = parameters;
    box.insert(box.end(), open.begin(), open.end());
    std::vector<int> narrow;
    for (std::size_t i = parameters.size(); i < box.size(); ++i) narrow.push_back(static_cast<int>(i));
    Box ranges;
    if (!nodes.empty()) {
      constexpr int degree = 2;
      ranges = encloseImage(Recorder(all).finish(nodes), 0.0, box, {}, degree, nullptr, narrow)[0];
    }
    stiffness.assign(quantities, Symmetric(f));
    mass = stiffness;
    for (std::size_t o = 0; o < which.size(); ++o) {
      if (!isBounded(ranges[o]) || isEmpty(ranges[o])) return false;
      const int i = which[o] / (2 * triangle), entry = which[o] % (2 * triangle);
      (entry < triangle ? stiffness : mass)[i].set(entry % triangle, ranges[o]);
    }
    for (int i = 0; i < quantities; ++i) {
      for (Symmetric* each : {&stiffness[i], &mass[i]}) *each = modal(*each);
      const std::optional<LoewnerBounds> k = loewnerBounds(stiffness[i]), m = loewnerBounds(mass[i]);
      if (!k || !m) return false;
      ofStiffness.push_back(*k);
      ofMass.push_back(*m);
    }
    return true;
  }

  /// K and M at thin parameters.
  struct At {
    Symmetric stiffness, mass;
  };
  At at(const std::vector<double>& anchor) const {
    const Box own(anchor.begin(), anchor.end()), left = openAt(own);
    Box all = own;
    all.insert(all.end(), left.begin(), left.end());
    const Box v = evaluate<Interval>(root, {}, all, Interval(0.0)),
              entries = evaluate<Interval>(pencil, v, own, Interval(0.0));
    const auto first = entries.begin() + n, second = first + triangle;
    return {modal(Symmetric(f, {first, second})), modal(Symmetric(f, {second, entries.end()}))};
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

  bool isMassPositive() const {
    const Bound bound = boundOn(parameters, true, [&](int i) { return ofMass[i]; });
    Symmetric least = at(bound.corner).mass;
    least.add(Interval(1.0), bound.loss);
    return least.isKnown() && positives(least) == f;
  }

  static Vector eigenvaluesOf(const Matrix& k, const Matrix& m) {
    return Eigen::GeneralizedSelfAdjointEigenSolver<Matrix>(k, m, Eigen::EigenvaluesOnly).eigenvalues();
  }

  /// A number that λ is not below (or above) anywhere; nothing where none is proved. `atCorner`: at(), kept.
  template <class AtCorner>
  std::optional<double> end(int number, const Box& part, bool isLower, const AtCorner& atCorner) const {
    const At& centre = atCorner(middleOf(part));
    if (!centre.stiffness.isKnown() || !centre.mass.isKnown()) return {};
    double sigma = eigenvaluesOf(centre.stiffness.middle(), centre.mass.middle())[number], largest = 0;
    const auto boundAt = [&](double at) { return boundOn(part, isLower, [&](int i) { return slopeBounds(i, at); }); };
    constexpr int rounds = 4;
    for (int round = 0; round < rounds; ++round) {
      if (!(sigma > 0)) return isLower ? std::optional(0.0) : std::nullopt;
      const Bound bound = boundAt(sigma);
      const At& there = atCorner(bound.corner);
      if (!bound.loss.isKnown() || !there.stiffness.isKnown() || !there.mass.isKnown()) return {};
      const Vector all = eigenvaluesOf(there.stiffness.middle() + bound.loss.middle(), there.mass.middle());
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

EigenvalueBounds::EigenvalueBounds(const Program& pencil, const Program& root, const std::vector<double>& basis,
                                   const Box& parameters, const Box& open, const Open& openAt)
    : parts_(std::make_unique<const Parts>(pencil, root, basis, parameters, open, openAt)) {}

EigenvalueBounds::~EigenvalueBounds() = default;

std::vector<Interval> EigenvalueBounds::ranges(const std::vector<int>& numbers, const Box& part) const {
  std::map<std::vector<double>, Parts::At> corners;
  const auto atCorner = [&](const std::vector<double>& corner) -> const Parts::At& {
    const auto found = corners.find(corner);
    return found != corners.end() ? found->second : corners.emplace(corner, parts_->at(corner)).first->second;
  };
  std::vector<Interval> ranges(numbers.size(), Interval::entire());
  for (std::size_t k = 0; k < numbers.size() && parts_->isKnown; ++k) {
    const std::optional<double> lower = parts_->end(numbers[k], part, true, atCorner),
                                upper = parts_->end(numbers[k], part, false, atCorner);
    if (lower && upper) ranges[k] = Interval(*lower, *upper);
  }
  return ranges;
}

/// With S = [x, e_j for all others j], x_k = 1, the pencil at σ = c + δ is s = xᵀBx beside b_j = (Bx)_j and B_J, B
/// without row and column k. Where B_J is regular and has k negative eigenvalues for all p, λ_k < σ where s − bᵀB_J⁻¹b
/// < 0, and λ_k > σ where that is above 0 (E. V. Haynsworth). B_J = D^½ (±1 + F) D^½ with ‖F‖ ≤ q < 1 has the signs of
/// D, and |bᵀB_J⁻¹b| ≤ Σ b_j²/d_j/(1 − q).
std::vector<Interval> EigenvalueBounds::beside(const Program& near, const Program& shapes,
                                               const std::vector<int>& numbers,
                                               const std::vector<Interval>& ranges) const {
  const Parts& of = *parts_;
  const int f = of.f, perMode = 3 + 2 * f + of.triangle;
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> basis = of.basis;
  const Program residuals =
      record(0, of.root.parameters(), static_cast<int>(numbers.size()) * perMode,
             [&](auto, const auto&, const auto& p, auto& y) {
               const std::vector<Recorded> own(p.begin(), p.begin() + of.quantities),
                   all = evaluate<Recorded>(of.pencil, evaluate<Recorded>(of.root, {}, {p.begin(), p.end()}), own),
                   c = evaluate<Recorded>(near, {}, own), vectors = evaluate<Recorded>(shapes, {}, own);
               const std::span<const Recorded> entries = std::span<const Recorded>(all).subspan(of.n);
               const std::span<const double> phi(basis.data(), basis.size());
               const std::vector<Recorded> stiffness = congruent<Recorded>(entries.first(of.triangle), phi, f, f),
                                           mass = congruent<Recorded>(entries.last(of.triangle), phi, f, f);
               for (std::size_t w = 0; w < numbers.size(); ++w) {
                 const std::span<const Recorded> x = std::span<const Recorded>(vectors).subspan(w * f, f);
                 const std::vector<Recorded> held = times<Recorded>(stiffness, x), resisted = times<Recorded>(mass, x);
                 Recorded s(0.0), g(0.0);
                 for (int i = 0; i < f; ++i) {
                   const Recorded left = held[i] - c[w] * resisted[i];
                   s = s + x[i] * left;
                   g = g + x[i] * resisted[i];
                   y[w * perMode + 3 + i] = left;
                   y[w * perMode + 3 + f + i] = resisted[i];
                 }
                 for (int i = 0; i < of.triangle; ++i) y[w * perMode + 3 + 2 * f + i] = stiffness[i] - c[w] * mass[i];
                 y[w * perMode] = c[w];
                 y[w * perMode + 1] = s;
                 y[w * perMode + 2] = g;
               }
             });
  Box box = of.parameters;
  box.insert(box.end(), of.open.begin(), of.open.end());
  std::vector<int> narrow;
  for (std::size_t i = of.parameters.size(); i < box.size(); ++i) narrow.push_back(static_cast<int>(i));
  const Box found = encloseImage(residuals, 0.0, box, {}, degreeFor(of.parameters), nullptr, narrow)[0];

  const Parts::At middle = of.at(Parts::middleOf(of.parameters));
  std::vector<Interval> result;
  for (std::size_t w = 0; w < numbers.size(); ++w) {
    const Interval* own = &found[w * perMode];
    const int k = numbers[w];
    const Interval loose = ranges[w] - own[0];
    result.push_back(loose);
    if (!isBounded(own[0]) || !isBounded(own[1]) || !(own[2].lower() > 0) || !of.isKnown) continue;
    // What B_J leaves at the middle, and what the quantities add.
    const double c0 = midpoint(own[0]);
    Symmetric b0 = middle.stiffness, spread(f), massSpread(f);
    b0.add(Interval(-c0), middle.mass);
    for (int i = 0; i < of.quantities; ++i) {
      if (isThin(of.parameters[i])) continue;
      const LoewnerBounds bounds = of.slopeBounds(i, c0);
      const Interval radius(magnitude(of.parameters[i] - Interval(midpoint(of.parameters[i]))));
      spread.add(radius, bounds.below);
      spread.add(radius, bounds.above);
      massSpread.add(radius, of.ofMass[i].below);
      massSpread.add(radius, of.ofMass[i].above);
    }
    massSpread.add(Interval(1.0), middle.mass);
    double delta = magnitude(own[1]) / own[2].lower();
    constexpr int rounds = 6;
    for (int round = 0; round < rounds; ++round) {
      const double off = (Interval(magnitude(own[0] - Interval(c0))) + Interval(delta)).upper();
      Symmetric all = spread;
      all.add(Interval(off), massSpread);
      // Free of units, without row k.
      Matrix d = Matrix::Zero(f, f - 1);
      int negatives = 0;
      bool isApart = true;
      for (int j = 0, column = 0; j < f; ++j) {
        if (j == k) continue;
        const double at = midpoint(b0(j, j));
        isApart = isApart && at != 0;
        negatives += at < 0 ? 1 : 0;
        isApart = isApart && (at < 0) == (j < k);
        d(j, column++) = 1 / std::sqrt(std::abs(at));
      }
      if (!isApart || negatives != k) break;
      Symmetric rest = congruent(d, b0);
      double q = f > 1 ? largestOf(congruent(d, all)) : 0.0;
      for (int i = 0; i < f - 1; ++i) rest(i, i) -= Interval(midpoint(rest(i, i)) < 0 ? -1.0 : 1.0);
      q = (Interval(q) + Interval(normOf(rest))).upper();
      // Or by what polynomials know of the entries at c, which move with it.
      const Interval* first = own + 3 + 2 * f;
      if (const Symmetric atC(f, {first, first + of.triangle}); f > 1 && atC.isKnown()) {
        Symmetric entries = congruent(d, atC);
        for (int i = 0; i < f - 1; ++i) entries(i, i) -= Interval(i < k ? -1.0 : 1.0);
        q = std::min(
            q, (Interval(normOf(entries)) + Interval(delta) * Interval(largestOf(congruent(d, massSpread)))).upper());
      }
      if (!(q < 1)) break;
      Interval square(0.0);
      for (int j = 0, column = 0; j < f; ++j) {
        if (j == k) continue;
        square += sqr((Interval(magnitude(own[3 + j])) + Interval(delta) * Interval(magnitude(own[3 + f + j]))) *
                      Interval(d(j, column++)));
      }
      const double needed =
          ((Interval(magnitude(own[1])) + square / (Interval(1.0) - Interval(q))) / Interval(own[2].lower())).upper();
      if (needed < delta || (needed == 0 && delta == 0)) {
        result.back() = intersection(loose, Interval(-delta, delta));
        break;
      }
      delta = 1.01 * needed + 1e-300;
    }
  }
  return result;
}

}  // namespace gamut
