// Evaluates a Program with any scalar: doubles for samples, intervals for ranges, high precision for references.
// What depends on parameters alone is computed once, by setParameters.
#pragma once

#include <span>
#include <vector>

#include "scalars/index.hpp"
#include "scalars/program.hpp"
#include "scalars/traits.hpp"

namespace gamut {

/// Values of a Program's nodes for scalar S. One evaluator a thread; it must not outlive the program.
template <class S>
class Evaluator {
 public:
  explicit Evaluator(const Program& program) : program_(&program), value_(program.nodes().size(), S(0.0)) {
    for (std::size_t i = 0; i < value_.size(); ++i)
      if (!program.isInvariant(static_cast<int>(i))) varying_.push_back(static_cast<int>(i));
    if (program.parameters() == 0) setParameters({});
  }

  /// p: one value a parameter. Needed once before the first call if there are parameters.
  void setParameters(std::span<const S> p) {
    const auto& nodes = program_->nodes();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (!program_->isInvariant(static_cast<int>(i))) continue;
      const Node& n = nodes[i];
      if (n.op == Op::parameter)
        value_[i] = p[detail::at(n.a)];
      else if (n.op == Op::constant)
        value_[i] = constant<S>(program_->constants()[detail::at(n.a)]);
      else
        compute(static_cast<int>(i));
    }
  }

  /// y = f(t, x): x has one value a state, y one an output.
  void operator()(const S& t, std::span<const S> x, std::span<S> y) {
    const auto& nodes = program_->nodes();
    for (int i : varying_) {
      const Node& n = nodes[detail::at(i)];
      if (n.op == Op::state)
        value_[detail::at(i)] = x[detail::at(n.a)];
      else if (n.op == Op::time)
        value_[detail::at(i)] = t;
      else
        compute(i);
    }
    const auto& outputs = program_->outputNodes();
    for (std::size_t i = 0; i < outputs.size(); ++i) y[i] = value_[detail::at(outputs[i])];
  }

  /// The outputs as a vector.
  std::vector<S> operator()(const S& t, const std::vector<S>& x) {
    std::vector<S> y(detail::at(program_->outputs()), S(0.0));
    (*this)(t, std::span<const S>(x), std::span<S>(y));
    return y;
  }

 private:
  void compute(int i) {
    using std::atan, std::cos, std::exp, std::log, std::sin, std::sqrt;
    const Node& n = program_->nodes()[detail::at(i)];
    const S& a = value_[detail::at(n.a)];
    S& r = value_[detail::at(i)];
    switch (n.op) {
      case Op::add:
        r = a + value_[detail::at(n.b)];
        break;
      case Op::sub:
        r = a - value_[detail::at(n.b)];
        break;
      case Op::neg:
        r = -a;
        break;
      case Op::mul:
        r = a * value_[detail::at(n.b)];
        break;
      case Op::sqr:
        r = square(a);
        break;
      case Op::recip:
        r = S(1.0) / a;
        break;
      case Op::sqrt:
        r = sqrt(a);
        break;
      case Op::exp:
        r = exp(a);
        break;
      case Op::log:
        r = log(a);
        break;
      case Op::atan:
        r = atan(a);
        break;
      case Op::sin:
        r = sin(a);
        break;
      case Op::cos:
        r = cos(a);
        break;
      case Op::state:
      case Op::parameter:
      case Op::time:
      case Op::constant:
        break;
    }
  }

  const Program* program_;
  std::vector<S> value_;
  std::vector<int> varying_;
};

}  // namespace gamut
