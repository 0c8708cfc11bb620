#include "analyses/roots/root_equations.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "scalars/program/differentiation.hpp"
#include "scalars/recorded.hpp"

namespace gamut {
namespace {

std::vector<int> numbersOf(const Box& parameters, bool thin) {
  std::vector<int> numbers;
  for (int i = 0; i < static_cast<int>(parameters.size()); ++i)
    if (isThin(parameters[i]) == thin) numbers.push_back(i);
  return numbers;
}

Box chosen(const Box& of, const std::vector<int>& numbers) {
  Box some;
  for (const int i : numbers) some.push_back(of[i]);
  return some;
}

/// f with the wide parameters as further states.
Program withStates(const Program& f, const Box& parameters) {
  const std::vector<int> wide = numbersOf(parameters, false), thin = numbersOf(parameters, true);
  const int n = f.states(), states = n + static_cast<int>(wide.size());
  return record(states, static_cast<int>(thin.size()), f.outputs(),
                [&](const auto& t, const auto& z, const auto& given, auto& y) {
                  std::vector<Recorded> p(parameters.size());
                  for (std::size_t l = 0; l < wide.size(); ++l) p[wide[l]] = z[n + l];
                  for (std::size_t l = 0; l < thin.size(); ++l) p[thin[l]] = given[l];
                  const std::vector<Recorded> values = written(f, {z.begin(), z.begin() + n}, p, t);
                  for (std::size_t i = 0; i < values.size(); ++i) y[i] = values[i];
                });
}

Box middlesOf(const Box& box) {
  Box middle;
  for (const Interval& each : box) middle.emplace_back(midpoint(each));
  return middle;
}

bool isKnown(const Interval& x) { return isBounded(x) && !isEmpty(x); }

/// The inverse by Gauss and Jordan, with pivots in units of rows and columns; false where one vanishes.
bool invert(std::vector<double>& a, int n) {
  std::vector<double> row(n, 0.0), column(n, 0.0);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) row[i] = std::max(row[i], std::abs(a[i * n + j]));
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      if (row[i] > 0) column[j] = std::max(column[j], std::abs(a[i * n + j]) / row[i]);
  for (int i = 0; i < n; ++i)
    if (!(row[i] > 0 && column[i] > 0 && std::isfinite(row[i]))) return false;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) a[i * n + j] /= row[i] * column[j];
  std::vector<int> swaps(n);
  for (int k = 0; k < n; ++k) {
    int pivot = k;
    for (int i = k + 1; i < n; ++i)
      if (std::abs(a[i * n + k]) > std::abs(a[pivot * n + k])) pivot = i;
    swaps[k] = pivot;
    for (int j = 0; j < n && pivot != k; ++j) std::swap(a[k * n + j], a[pivot * n + j]);
    const double inverse = 1 / a[k * n + k];
    if (!std::isfinite(inverse)) return false;
    a[k * n + k] = 1;
    for (int j = 0; j < n; ++j) a[k * n + j] *= inverse;
    for (int i = 0; i < n; ++i) {
      if (i == k) continue;
      const double factor = std::exchange(a[i * n + k], 0.0);
      for (int j = 0; j < n; ++j) a[i * n + j] -= factor * a[k * n + j];
    }
  }
  for (int k = n - 1; k >= 0; --k)
    for (int i = 0; i < n && swaps[k] != k; ++i) std::swap(a[i * n + k], a[i * n + swaps[k]]);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      if (!std::isfinite(a[i * n + j] /= column[i] * row[j])) return false;
  return true;
}

}  // namespace

struct RootEquations::Further {
  Further(const Program& also, const Box& parameters, const Box& thin, const Interval& time)
      : program(withStates(also, parameters)), consistency(program, thin, time) {}

  Program program;
  HullConsistency consistency;
};

RootEquations::RootEquations(const Program& f, const Box& parameters, const Interval& time, std::vector<double> units,
                             const Program* also)
    : n_(f.states()),
      wide_(numbersOf(parameters, false)),
      thin_(chosen(parameters, numbersOf(parameters, true))),
      units_(std::move(units)),
      time_(time),
      f_(withStates(f, parameters)),
      derivative_(forwardDifferentiated(f_)),
      consistency_(f_, thin_, time),
      values_(f_),
      all_(derivative_),
      doubles_(derivative_),
      slopes_(derivative_.outputs()),
      value_(n_),
      spread_(n_) {
  size_ = f_.states();
  std::vector<double> numbers;
  for (const Interval& each : thin_) numbers.push_back(each.lower());
  values_.setParameters(thin_);
  all_.setParameters(thin_);
  doubles_.setParameters(numbers);
  if (also != nullptr) further_ = std::make_unique<Further>(*also, parameters, thin_, time);
}

RootEquations::~RootEquations() = default;

const Box& RootEquations::joint(const Box& x, const Box& q) {
  joint_.assign(x.begin(), x.end());
  joint_.insert(joint_.end(), q.begin(), q.end());
  return joint_;
}

bool RootEquations::contract(Box& x, const Box& q) {
  joint(x, q);
  if (!consistency_.contract(joint_)) return false;
  if (further_ && !further_->consistency.contract(joint_)) return false;
  std::copy_n(joint_.begin(), n_, x.begin());
  return true;
}

void RootEquations::evaluateSlopes(const Box& x, const Box& q) {
  ++evaluations_;
  all_(time_, std::span<const Interval>(joint(x, q)), std::span<Interval>(slopes_));
}

/// Y, of the last slopes.
std::optional<RootEquations::Matrix> RootEquations::inverseOfMiddle() const {
  Matrix y;
  for (int i = 0; i < n_; ++i)
    for (int j = 0; j < n_; ++j) {
      if (!isKnown(slope(i, j))) return {};
      y.push_back(midpoint(slope(i, j)));
    }
  if (!invert(y, n_)) return {};
  return y;
}

/// (Y [J K]) of row i and this column.
Interval RootEquations::preconditioned(const Matrix& y, int i, int variable) const {
  Interval sum(0.0);
  for (int k = 0; k < n_; ++k)
    if (const Interval& by = slope(k, variable); by.lower() != 0 || by.upper() != 0)
      sum += Interval(y[i * n_ + k]) * by;
  return sum;
}

/// Y F(m, q) for all q of the box, from F at its middle and the last slopes, which hold those at m; what q adds goes
/// into spread_.
Box RootEquations::moved(const Matrix& y, const Box& values, const Box& q) {
  Box b;
  for (int i = 0; i < n_; ++i) {
    Interval sum(0.0), byQ(0.0);
    for (int k = 0; k < n_; ++k) sum += Interval(y[i * n_ + k]) * values[k];
    for (int l = n_; l < size_; ++l) byQ += preconditioned(y, i, l) * (q[l - n_] - Interval(midpoint(q[l - n_])));
    spread_[i] = magnitude(byQ);
    b.push_back(sum + byQ);
  }
  return b;
}

bool RootEquations::step(Box& x, const Box& q) {
  evaluateSlopes(x, q);
  const Box m = middlesOf(x);
  values_(time_, std::span<const Interval>(joint(m, middlesOf(q))), std::span<Interval>(value_));
  std::ranges::fill(spread_, 0.0);
  isRounding_ = true;
  for (int i = 0; i < n_; ++i) {
    if (isEmpty(slopes_[i]) || isDisjoint(slopes_[i], Interval(0.0))) return false;
    Interval range = value_[i];
    bool isBounded = true;
    for (int j = 0; j < size_; ++j) {
      isBounded = isBounded && isKnown(slope(i, j));
      range += slope(i, j) * (j < n_ ? x[j] - m[j] : q[j - n_] - Interval(midpoint(q[j - n_])));
    }
    range = isBounded ? intersection(range, slopes_[i]) : slopes_[i];
    if (!contains(range, 0.0)) return false;
    isRounding_ = isRounding_ && 2 * width(value_[i]) >= width(range);
  }
  const std::optional<Matrix> y = inverseOfMiddle();
  if (!y) return true;
  const Box b = moved(*y, value_, q);
  Box offset;
  for (int j = 0; j < n_; ++j) offset.push_back(x[j] - m[j]);
  for (int i = 0; i < n_; ++i) {
    Interval rest = b[i], diagonal(0.0);
    for (int j = 0; j < n_; ++j) {
      const Interval a = preconditioned(*y, i, j);
      if (j == i)
        diagonal = a;
      else
        rest += a * offset[j];
    }
    if (!isKnown(rest) || !isKnown(diagonal)) continue;
    x[i] = intersection(x[i], m[i] + quotientWithin(-rest, diagonal, offset[i]));
    if (isEmpty(x[i])) return false;
    offset[i] = x[i] - m[i];
  }
  return true;
}

std::optional<std::vector<double>> RootEquations::approximate(std::vector<double> x, const Box& q,
                                                              const std::vector<double>& reach) {
  constexpr int most = 20;
  constexpr double far = 16;
  const std::vector<double> start = x;
  constexpr double done = 0x1p-44, near = 0x1p-30;
  std::vector<double> z(size_), values(slopes_.size());
  for (int l = n_; l < size_; ++l) z[l] = midpoint(q[l - n_]);
  double last = HUGE_VAL;
  for (int k = 0; k < most; ++k) {
    std::ranges::copy(x, z.begin());
    doubles_(midpoint(time_), std::span<const double>(z), std::span<double>(values));
    Matrix jacobian;
    for (int i = 0; i < n_; ++i)
      for (int j = 0; j < n_; ++j) jacobian.push_back(values[n_ + i * size_ + j]);
    if (!invert(jacobian, n_)) return {};
    double largest = 0;
    for (int i = 0; i < n_; ++i) {
      double sum = 0;
      for (int j = 0; j < n_; ++j) sum += jacobian[i * n_ + j] * values[j];
      x[i] -= sum;
      largest = std::max(largest, std::abs(sum) / (units_[i] + std::abs(x[i])));
      if (!(std::abs(x[i] - start[i]) <= far * reach[i])) return {};
    }
    if (largest <= done || (last <= near && largest >= last)) {
      for (int i = 0; i < n_; ++i)
        if (!(std::abs(x[i] - start[i]) <= reach[i])) return {};
      return x;
    }
    last = largest;
  }
  return {};
}

/// Y J, row by row, of the last slopes.
Box RootEquations::preconditioned(const Matrix& y) const {
  Box a;
  for (int i = 0; i < n_; ++i)
    for (int j = 0; j < n_; ++j) a.push_back(preconditioned(y, i, j));
  return a;
}

/// Whether Σ_j |I - A|_ij r_j < r_i for some r > 0; from this r on, towards the matrix's own.
bool RootEquations::contracts(const Box& a, std::vector<double> r) const {
  Matrix size;
  for (int i = 0; i < n_; ++i)
    for (int j = 0; j < n_; ++j) {
      size.push_back(magnitude(Interval(i == j ? 1.0 : 0.0) - a[i * n_ + j]));
      if (!std::isfinite(size.back())) return false;
    }
  constexpr int tries = 4;
  for (int k = 0; k < tries; ++k) {
    std::vector<double> image;
    bool isLess = true;
    for (int i = 0; i < n_; ++i) {
      Interval sum(0.0);
      for (int j = 0; j < n_; ++j) sum += Interval(size[i * n_ + j]) * Interval(r[j]);
      image.push_back(sum.upper());
      isLess = isLess && image[i] < r[i];
    }
    if (isLess) return true;
    for (int i = 0; i < n_; ++i)
      if (!((r[i] = 0.5 * (r[i] + image[i])) > 0 && std::isfinite(r[i]))) return false;
  }
  return false;
}

/// What a proof is about: x = c + S (p - q) + δ, for all parameters p of a box with the middle q.
struct RootEquations::Course {
  const Box& parameters;
  Matrix y;
  Box centre, at;  // c; F and its derivatives at (c, q)
  Box shift;       // of p - q
  Matrix s;        // row by row
  bool isBent;     // whether second derivatives bound what varies along it
  Box path = {};   // of c + S (p - q)
  Box b = {};      // of Y F there
};

std::optional<RootEquations::Proof> RootEquations::prove(const std::vector<double>& c, const Box& q) {
  const Box centre(c.begin(), c.end());
  const Box middle = middlesOf(q);
  if (!consistency_.isTameOn(joint(centre, middle))) return {};
  evaluateSlopes(centre, middle);
  const std::optional<Matrix> y = inverseOfMiddle();
  if (!y) return {};
  Course course{q, *y, centre, slopes_, {}, Matrix(n_ * (size_ - n_), 0.0), false};
  Matrix along;
  for (int i = 0; i < n_; ++i)
    for (int l = n_; l < size_; ++l) {
      const Interval moves = preconditioned(*y, i, l);
      if (!isKnown(moves)) return {};
      along.push_back(-midpoint(moves));
    }
  for (const Interval& each : q) course.shift.push_back(each - Interval(midpoint(each)));
  std::optional<Proof> proof = prove(course);
  if (proof || q.empty()) return proof;
  course.s = std::move(along);
  course.isBent = canBend();
  return prove(course);
}

/// Whether second derivatives are few enough to be worth their while.
bool RootEquations::canBend() {
  constexpr int most = 30000;
  if ((n_ + n_ * size_) * size_ > most) return false;
  if (!bent_) bent_ = std::make_unique<Bent>(derivative_, *this);
  return true;
}

struct RootEquations::Bent {
  Bent(const Program& derivative, const RootEquations& of)
      : program(forwardDifferentiated(derivative)),
        consistency(derivative, of.thin_, of.time_),
        evaluator(program),
        values(program.outputs()) {
    evaluator.setParameters(of.thin_);
  }

  Program program;
  HullConsistency consistency;
  Evaluator<Interval> evaluator;
  Box values;  // F, its derivatives row by row, then those of all of them
};

/// F and its derivatives over x × q into slopes_, Y times the second derivatives into bends_; false where they are not
/// known.
bool RootEquations::evaluateBends(const Matrix& y, const Box& x, const Box& q) {
  ++evaluations_;
  if (!bent_->consistency.isTameOn(joint(x, q))) return false;
  Box& values = bent_->values;
  bent_->evaluator(time_, std::span<const Interval>(joint_), std::span<Interval>(values));
  std::copy_n(values.begin(), slopes_.size(), slopes_.begin());
  bends_.assign(n_ * size_ * size_, Interval(0.0));
  for (int i = 0; i < n_; ++i)
    for (int k = 0; k < n_; ++k)
      for (int ab = 0; ab < size_ * size_; ++ab)
        if (const Interval& by = values[slopes_.size() + n_ * size_ + k * size_ * size_ + ab];
            by.lower() != 0 || by.upper() != 0)
          bends_[i * size_ * size_ + ab] += Interval(y[i * n_ + k]) * by;
  return std::ranges::all_of(bends_, isKnown);
}

/// Along the course, of row i and column a of bends_: what parameter l adds.
Interval RootEquations::bendAlong(const Course& course, int i, int a, int l) const {
  const Interval* row = &bends_[(i * size_ + a) * size_];
  Interval sum = row[n_ + l];
  for (int k = 0; k < n_; ++k) sum += row[k] * Interval(course.s[k * (size_ - n_) + l]);
  return sum;
}

/// course.path and course.b; false where they are not known.
bool RootEquations::start(Course& course) {
  const Box& q = course.parameters;
  const Matrix &y = course.y, &s = course.s;
  const int parameters = size_ - n_;
  course.path = course.centre;
  course.b.clear();
  for (int i = 0; i < n_; ++i) {
    for (int l = 0; l < parameters; ++l) course.path[i] += Interval(s[i * parameters + l]) * course.shift[l];
    if (!(width(course.path[i]) <= 4 * units_[i])) return false;
  }
  if (course.isBent) {  // slopes_ at the middle, for Y (K + J S) there
    if (!evaluateBends(y, course.path, q)) return false;
  } else {
    if (!consistency_.isTameOn(joint(course.path, q))) return false;
    evaluateSlopes(course.path, q);
  }
  const Box range(slopes_.begin(), slopes_.begin() + n_);
  if (course.isBent) slopes_ = course.at;
  for (int i = 0; i < n_; ++i) {
    Interval sum(0.0), whole(0.0);
    for (int k = 0; k < n_; ++k) {
      sum += Interval(y[i * n_ + k]) * course.at[k];
      whole += Interval(y[i * n_ + k]) * range[k];
    }
    for (int l = 0; l < parameters; ++l) {
      Interval slope = preconditioned(y, i, n_ + l);
      for (int j = 0; j < n_; ++j)
        if (const double moves = s[j * parameters + l]; moves != 0) slope += preconditioned(y, i, j) * Interval(moves);
      sum += slope * course.shift[l];
    }
    if (course.isBent)
      for (int l = 0; l < parameters; ++l)
        for (int m = 0; m < parameters; ++m) {
          Interval bend = bendAlong(course, i, n_ + l, m);
          for (int k = 0; k < n_; ++k) bend += Interval(s[k * parameters + l]) * bendAlong(course, i, k, m);
          sum += 0.5 * bend * (l == m ? sqr(course.shift[l]) : course.shift[l] * course.shift[m]);
        }
    course.b.push_back(intersection(sum, whole));
    if (!isKnown(course.b[i])) return false;
  }
  return true;
}

/// Y J for x in `d` and all parameters, once along the course, where δ is in [-r, r], and once anywhere; false where
/// they are not known.
bool RootEquations::slopesAlong(const Course& course, const Box& d, const std::vector<double>& r, Box& along,
                                Box& anywhere) {
  if (course.isBent ? !evaluateBends(course.y, d, course.parameters)
                    : !consistency_.isTameOn(joint(d, course.parameters)))
    return false;
  if (!course.isBent) evaluateSlopes(d, course.parameters);
  along = anywhere = preconditioned(course.y);
  if (!course.isBent) return true;
  slopes_ = course.at;
  const Box middle = preconditioned(course.y);
  for (int i = 0; i < n_; ++i)
    for (int j = 0; j < n_; ++j) {
      const Interval* row = &bends_[(i * size_ + j) * size_];
      Interval there = middle[i * n_ + j], here = there;
      for (int l = 0; l < size_ - n_; ++l) {
        here += bendAlong(course, i, j, l) * course.shift[l];
        there += row[n_ + l] * course.shift[l];
      }
      for (int k = 0; k < n_; ++k) {
        here += row[k] * Interval(-r[k], r[k]);
        there += row[k] * (d[k] - course.centre[k]);
      }
      along[i * n_ + j] = intersection(along[i * n_ + j], here);
      anywhere[i * n_ + j] = intersection(anywhere[i * n_ + j], there);
    }
  return true;
}

std::optional<RootEquations::Proof> RootEquations::prove(Course& course) {
  if (!start(course)) return {};
  const Box &path = course.path, &b = course.b;
  std::vector<double> r;
  for (const Interval& each : b) r.push_back(1.25 * magnitude(each));
  constexpr int tries = 10;
  for (int k = 0; k < tries; ++k) {
    double largest = 0;  // what is exact gets room to map into too
    for (int i = 0; i < n_; ++i) largest = std::max(largest, r[i] / units_[i]);
    Box d, along, anywhere;
    for (int i = 0; i < n_; ++i) {
      if (!(r[i] <= 4 * units_[i])) return {};
      r[i] = std::max({r[i], 0x1p-24 * largest * units_[i], 0x1p-50 * magnitude(path[i]), 0x1p-60 * units_[i]});
      d.push_back(path[i] + Interval(-r[i], r[i]));
    }
    if (!slopesAlong(course, d, r, along, anywhere)) return {};
    bool isInside = true;
    Box root, offset;
    std::vector<double> next = r;
    for (int i = 0; i < n_; ++i) {
      Interval image = -b[i];
      for (int j = 0; j < n_; ++j) image += (Interval(i == j ? 1.0 : 0.0) - along[i * n_ + j]) * Interval(-r[j], r[j]);
      if (!isKnown(image)) return {};
      root.push_back(path[i] + image);
      offset.push_back(image);
      isInside = isInside && magnitude(image) < r[i] && isInterior(root[i], d[i]);
      next[i] = std::max(r[i], 1.25 * magnitude(image));
    }
    if (isInside) {
      std::vector<double> halves;
      for (const Interval& each : d) halves.push_back(radius(each));
      if (contracts(anywhere, halves))
        return finished({std::move(root), d, course.centre, middlesOf(course.parameters), std::move(offset), course.s},
                        course.y, path, r, course.parameters);
      if (course.isBent) return {};  // larger boxes would only be worse
    }
    r = next;
  }
  return {};
}

/// F(·, p) is one-to-one where Y J is near to 1 (all_roots.hpp): what holds the known root, and where that is so, holds
/// no other.
std::optional<RootEquations::Proof> RootEquations::adopt(const Box& root, const Box& q) {
  const Box centre = middlesOf(root), middle = middlesOf(q);
  if (!consistency_.isTameOn(joint(centre, middle))) return {};
  evaluateSlopes(centre, middle);
  const std::optional<Matrix> y = inverseOfMiddle();
  if (!y || !consistency_.isTameOn(joint(root, q))) return {};
  evaluateSlopes(root, q);
  Box offset;
  std::vector<double> r;
  for (int i = 0; i < n_; ++i) {
    offset.push_back(root[i] - centre[i]);
    r.push_back(std::max({magnitude(offset[i]), 0x1p-50 * magnitude(root[i]), 0x1p-60 * units_[i]}));
  }
  if (!contracts(preconditioned(*y), r)) return {};
  return finished({root, root, centre, middle, std::move(offset), Matrix(n_ * (size_ - n_), 0.0)}, *y, centre, r, q);
}

Box RootEquations::Proof::rootAt(const Box& q) const {
  Box at;
  for (std::size_t i = 0; i < root.size(); ++i) {
    at.push_back(centre[i] + offset[i]);
    for (std::size_t l = 0; l < q.size(); ++l) at[i] += Interval(s[i * q.size() + l]) * (q[l] - middle[l]);
    at[i] = intersection(at[i], root[i]);
  }
  return at;
}

/// With the largest box in which it is alone: all its sides doubled, then each by itself; and as narrow a root box as
/// Newton's steps make it.
std::optional<RootEquations::Proof> RootEquations::finished(Proof proof, const Matrix& y, const Box& path,
                                                            std::vector<double> r, const Box& q) {
  const auto larger = [&](const std::vector<double>& radii) {
    Box box;
    std::vector<double> halves;
    for (int i = 0; i < n_; ++i) {
      if (!(radii[i] <= 2 * units_[i])) return false;
      box.push_back(path[i] + Interval(-radii[i], radii[i]));
      halves.push_back(radius(box[i]));
    }
    if (!consistency_.isTameOn(joint(box, q))) return false;
    evaluateSlopes(box, q);
    if (!contracts(preconditioned(y), halves)) return false;
    proof.alone = box;
    r = radii;
    return true;
  };
  std::vector<double> wider = r;
  for (const double factor : {16.0, 2.0, 1.4}) do {
      for (int i = 0; i < n_; ++i) wider[i] = factor * r[i];
    } while (larger(wider));
  for (int i = 0; i < n_ && n_ > 1; ++i) do {
      wider = r;
      wider[i] *= 2;
    } while (larger(wider));
  constexpr int most = 4;
  for (int k = 0; k < most; ++k) {
    const Box before = proof.root;
    if (!consistency_.isTameOn(joint(proof.root, q)) || !step(proof.root, q)) return {};
    bool isGained = false;
    for (int i = 0; i < n_; ++i) isGained = isGained || width(proof.root[i]) < 0.9 * width(before[i]);
    if (!isGained) break;
  }
  return proof;
}

}  // namespace gamut
