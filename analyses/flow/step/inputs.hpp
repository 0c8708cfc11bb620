// Inputs: parameters that vary in time, in any measurable way within [centre - radius, centre + radius]. What they do
// in a step are generators of their own, one for each part of the step, and a rest that vanishes with the parts'
// length. docs/flow.md, section 6.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "analyses/flow/series/polynomial_series.hpp"
#include "analyses/flow/step/growth.hpp"

namespace gamut {

class FlowInputs {
 public:
  /// `parameters`: numbers of those that vary. `share`: of what they do in a step, that the rest may be.
  FlowInputs(int states, int order, std::vector<int> parameters, double share)
      : n_(states), order_(order), share_(share), parameters_(std::move(parameters)) {}

  bool empty() const { return parameters_.empty(); }
  double share() const { return share_; }
  int count() const { return static_cast<int>(parameters_.size()); }
  const std::vector<int>& parameters() const { return parameters_; }
  void load(const std::vector<Embedded>& parameters);

  /// Σ_k |∂f_i/∂w_k| radius_k on the set that was bounded last.
  double push(const PolynomialSeries& series, int i) const;

  /// The generators of a step of h seconds that was proved to lie in the set bounded last, in coordinates of the frame,
  /// and for each state what they leave over. Outputs n + n² + i·count() + k of the series are ∂f_i/∂w_k.
  void resolve(const PolynomialSeries& series, const FlowGrowth& growth, double theta, double h);
  /// How many times too long the step is for the share, with as many parts as there may be; at most 1: it is not.
  double haste() const { return haste_; }
  /// [part][input][row]; those of the first parts act first.
  const std::vector<double>& generators() const { return generators_; }
  /// How many of these numbers belong to parts that begin before `share` of the step has passed.
  std::size_t begunBefore(double share) const;
  double total(int j) const { return total_[j]; }  ///< Σ |generators|, rounded up
  double rest(int i) const { return rest_[i]; }

 private:
  int node(const PolynomialSeries& series, int i, int k) const {
    return series.outputNode(n_ + n_ * n_ + i * count() + k);
  }

  struct Course;
  Course courseOf(const PolynomialSeries& series, double theta) const;
  Eigen::MatrixXd solve(Course& course, double sigma) const;
  double speedOf(const Course& course, int i, int k, const Eigen::VectorXd& g) const;
  void choosePartsOf(Course& course, const FlowGrowth& growth, double h);
  void addPart(Course& course, double h, int part, std::vector<double>& turning, std::vector<double>& constant);

  int n_, order_;
  double share_, haste_ = 0;
  int parts_ = 1;
  std::vector<int> parameters_;
  std::vector<double> radius_, generators_, total_, rest_;
};

}  // namespace gamut
