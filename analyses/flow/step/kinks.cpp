// Arguments, rates and pushes by intervals.
#include "analyses/flow/step/kinks.hpp"

#include "analyses/flow/series/embedded.hpp"
#include "scalars/index.hpp"
#include "scalars/program/recorder.hpp"

namespace gamut {

using detail::at;

namespace {

/// The nodes |u| that f needs, of linear u without inputs.
std::vector<int> linearKinks(const Program& differentiated, const std::vector<int>& varying,
                             std::vector<LinearForm>& forms) {
  std::vector<char> isNeeded(differentiated.nodes().size(), 0);
  for (int i = 0; i < differentiated.states(); ++i) isNeeded[differentiated.outputNodes()[i]] = 1;
  for (std::size_t i = isNeeded.size(); i-- > 0;)
    if (isNeeded[i] != 0)
      detail::forEachOperand(differentiated.table(), static_cast<int>(i), [&](int operand) { isNeeded[operand] = 1; });
  std::vector<int> nodes;
  for (std::size_t i = 0; i < isNeeded.size(); ++i) {
    const Node& node = differentiated.nodes()[i];
    if (isNeeded[i] == 0 || node.op != Op::abs) continue;
    const auto form = linearFormOf(differentiated, node.a);
    bool isKnown = form.has_value();
    for (const int input : varying) isKnown = isKnown && form->parameters[input] == 0;
    if (!isKnown) continue;
    nodes.push_back(static_cast<int>(i));
    forms.push_back(*form);
  }
  return nodes;
}

Program withKinksGiven(const Program& differentiated, const std::vector<int>& nodes) {
  const int n = differentiated.states(), k = differentiated.parameters();
  Recorder recorder(n, k + static_cast<int>(nodes.size()));
  std::vector<int> instead(differentiated.nodes().size(), -1), outputs;
  for (std::size_t j = 0; j < nodes.size(); ++j) instead[nodes[j]] = recorder.parameter(k + static_cast<int>(j));
  const std::vector<int> here = recorder.append(differentiated, {}, instead);
  for (int i = 0; i < n; ++i) outputs.push_back(here[differentiated.outputNodes()[i]]);
  return recorder.finish(outputs);
}

Program byKinks(const Program& given, std::size_t count) {
  if (count == 0) return given;
  const Program all = given.differentiated(true);
  const std::size_t n = at(given.states()), k = at(given.parameters());
  std::vector<int> columns;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = k - count; j < k; ++j) columns.push_back(all.outputNodes()[n + n * n + i * k + j]);
  return Recorder(all).finish(columns);
}

}  // namespace

FlowKinks::FlowKinks(const Program& differentiated, const std::vector<int>& varying)
    : nodes_(linearKinks(differentiated, varying, forms_)),
      motion_(withKinksGiven(differentiated, {})),
      given_(withKinksGiven(differentiated, nodes_)),
      pushes_(byKinks(given_, nodes_.size())),
      f_(given_),
      columns_(pushes_) {}

void FlowKinks::bound(const Interval& time, const Box& box, const std::vector<Embedded>& parameters,
                      std::vector<Interval>& u, std::vector<Interval>& rates) {
  time_ = time;
  box_ = box;
  all_ = rangesOf(parameters);
  u.clear();
  for (const LinearForm& form : forms_) u.push_back(rangeOf(form, box, all_));
  for (const Interval& argument : u) all_.push_back(abs(argument));
  f_.setParameters(all_);
  std::vector<Interval> f(box.size());
  f_(time, box, f);
  rates.clear();
  for (const LinearForm& form : forms_) {
    Interval rate(0.0);
    for (std::size_t i = 0; i < box.size(); ++i)
      if (form.states[i] != 0) rate += Interval(form.states[i]) * f[i];
    rates.push_back(rate);
  }
  for (std::size_t k = 0; k < u.size(); ++k) {
    const double most = magnitude(u[k]);
    all_[parameters.size() + k] = Interval(-most, most);
  }
}

std::vector<Interval> FlowKinks::pushOf(std::size_t kink) {
  std::vector<Interval> columns(box_.size() * count()), result;
  columns_.setParameters(all_);
  columns_(time_, box_, columns);
  for (std::size_t i = 0; i < box_.size(); ++i) result.push_back(columns[i * count() + kink]);
  return result;
}

}  // namespace gamut
