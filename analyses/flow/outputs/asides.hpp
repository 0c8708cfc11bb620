// Values that are looked at besides the outputs, at some of the output times, such as the points of a picture. They are
// bounded by the polynomials of the states and what the errors of these can do, without derivatives: cheaply, and about
// as tightly as outputs wherever states are. A flow goes on as if they were not there.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <vector>

#include "analyses/flow/outputs/plain_outputs.hpp"
#include "analyses/flow/series/polynomial_range.hpp"
#include "analyses/flow/series/polynomial_series.hpp"
#include "analyses/flow/step/step.hpp"

namespace gamut {

/// Holds the workspace: one a thread.
class FlowAsides {
 public:
  /// `values`: its states and parameters are those of the flow. Monomials and inputs as for FlowOutputs.
  FlowAsides(const Program& values, std::shared_ptr<const Monomials> monomials,
             std::shared_ptr<const Monomials> ofStates, const std::vector<int>& varying,
             const std::atomic<bool>* cancelled = nullptr);

  /// An enclosure of every value for all ξ of the point, where the states are in these boxes.
  std::vector<Interval> enclose(double t, const FlowPoint& point, const std::vector<Interval>& states,
                                const std::vector<Embedded>& parameters);

 private:
  Program values_;
  std::shared_ptr<const Monomials> layout_;
  PolynomialSeries series_;
  PolynomialRange range_;
  std::optional<PlainOutputs> plain_;  // once needed
  std::vector<int> place_;             // of the states' monomials among the values'
};

}  // namespace gamut
