// F(x, q) = 0 and what one step of a search for its roots asks of it: q are the parameters that are not thin. The
// methods' derivations: all_roots.hpp.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "analyses/roots/hull_consistency.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "scalars/interval.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

class RootEquations {
 public:
  /// `units`: widths of what is looked at, one a state; `also`: what is zero at the roots that are meant, besides.
  RootEquations(const Program& f, const Box& parameters, const Interval& time, std::vector<double> units,
                const Program* also = nullptr);
  RootEquations(const RootEquations&) = delete;
  RootEquations& operator=(const RootEquations&) = delete;
  ~RootEquations();

  int states() const { return n_; }
  /// The numbers of the parameters that q holds.
  const std::vector<int>& wide() const { return wide_; }

  /// What hull consistency leaves of x, with what is zero besides; false where that is nothing. `isTame`: as of
  /// HullConsistency, of what x was.
  bool contract(Box& x, const Box& q);
  bool isTame() const { return consistency_.isTame(); }

  /// One step of Newton's method, where F is tame over x × q; false where no root is left.
  bool step(Box& x, const Box& q);
  // Of the last step, over all that x was:
  const Interval& range(int output) const { return slopes_[output]; }
  const Interval& slope(int output, int variable) const { return slopes_[n_ + output * size_ + variable]; }
  /// How far roots may move with q, in x_i.
  const std::vector<double>& spread() const { return spread_; }
  /// Whether F varies over the box by little more than its roundings in the middle.
  bool isRounding() const { return isRounding_; }

  /// An approximate root for the middle of q, by Newton's method in doubles from x; none where it does not converge to
  /// one within reach.
  std::optional<std::vector<double>> approximate(std::vector<double> x, const Box& q, const std::vector<double>& reach);

  struct Proof {
    Box root, alone;
    Box centre, middle, offset;  ///< for q it is in centre + S (q - middle) + offset,
    std::vector<double> s;       ///< row by row
    Box rootAt(const Box& q) const;
  };
  /// One root for each q, near c.
  std::optional<Proof> prove(const std::vector<double>& c, const Box& q);

  /// The same of a root that is known to be in a box for each q.
  std::optional<Proof> adopt(const Box& root, const Box& q);

  /// Evaluations of all derivatives so far.
  std::size_t evaluations() const { return evaluations_; }

 private:
  using Matrix = std::vector<double>;  // row by row

  void evaluateSlopes(const Box& x, const Box& q);
  std::optional<Matrix> inverseOfMiddle() const;
  Interval preconditioned(const Matrix& y, int i, int variable) const;
  Box moved(const Matrix& y, const Box& values, const Box& q);
  Box preconditioned(const Matrix& y) const;
  bool contracts(const Box& a, std::vector<double> r) const;
  struct Further;
  struct Course;
  struct Bent;
  bool canBend();
  bool evaluateBends(const Matrix& y, const Box& x, const Box& q);
  Interval bendAlong(const Course& course, int i, int a, int l) const;
  bool start(Course& course);
  bool slopesAlong(const Course& course, const Box& d, const std::vector<double>& r, Box& along, Box& anywhere);
  std::optional<Proof> prove(Course& course);
  std::optional<Proof> finished(Proof proof, const Matrix& y, const Box& path, std::vector<double> r, const Box& q);
  const Box& joint(const Box& x, const Box& q);

  int n_, size_;  // states, and these with q
  std::vector<int> wide_;
  Box thin_;  // the other parameters
  std::vector<double> units_;
  Interval time_;
  Program f_, derivative_;
  HullConsistency consistency_;
  std::unique_ptr<Further> further_;
  Evaluator<Interval> values_, all_;
  Evaluator<double> doubles_;
  Box joint_, slopes_, value_;  // slopes_: F, then the rows of its derivatives
  std::vector<double> spread_;
  std::unique_ptr<Bent> bent_;  // second derivatives, where they were asked for
  Box bends_;                   // Y times them: of output i, by variables a and b
  bool isRounding_ = false;
  std::size_t evaluations_ = 0;
};

}  // namespace gamut
