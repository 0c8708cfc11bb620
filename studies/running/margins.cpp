// A margin bounds an output where both are multiples of one formula plus a number, as their forms say.
#include "studies/running/margins.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

namespace gamut {
namespace {

/// Formulas in which numbers of the mechanism that are not uncertain stand with their values.
class WithConstants {
 public:
  explicit WithConstants(const Study& study) : study_(study) {}

  Expression of(const Expression& formula) {
    return formula.with([this](const std::string& name) { return valueOf(name); });
  }

 private:
  const Expression* valueOf(const std::string& name) {
    const Mechanism& mechanism = study_.mechanism;
    if (const auto known = values_.find(name); known != values_.end()) return &known->second;
    if (const Mechanism::Derived* derived = mechanism.derived().find(name))
      return &values_.emplace(name, of(derived->formula)).first->second;
    if (!mechanism.isParameter(name) ||
        std::ranges::find(study_.uncertain, name, &UncertainQuantity::quantity) != study_.uncertain.end())
      return nullptr;
    return &values_.emplace(name, Expression(mechanism.nominal(name))).first->second;
  }

  const Study& study_;
  std::map<std::string, Expression> values_;
};

class MarginFinder {
 public:
  explicit MarginFinder(const Study& study) : study_(study), constants_(study) {
    const std::size_t plain =
        study.requirements.empty() ? study.outputs.size() : study.requirements.front().firstMargin;
    for (std::size_t o = 0; o < plain; ++o) outputs_.push_back(constants_.of(study.outputs[o].expression));
  }

  MarginInfo find(const DemandTerm& term, std::size_t output) {
    MarginInfo margin{output,         term.what, term.side == DemandTerm::Side::above,
                      term.limitText, term.unit, term.isStrict,
                      output,         0,         term.limit.isConstant() && !term.expression.isConstant()};
    const Expression whole = constants_.of(term.margin());
    for (std::size_t o = 0; o < outputs_.size(); ++o)
      if (const std::optional<Interval> limit = limitOf(whole, o)) {
        margin.limited = o;
        margin.limit = midpoint(*limit / enclose(oneOfUnit(study_.outputs[o].unit)));
        if (whole.affineIn(outputs_[o])) break;  // it is what the study names
      }
    return margin;
  }

 private:
  /// What the output is where the margin is zero, in SI units: both are multiples of something plus a number.
  std::optional<Interval> limitOf(const Expression& margin, std::size_t output) const {
    for (const Expression& part : outputs_[output].parts())
      if (const auto ofMargin = margin.affineIn(part), ofOutput = outputs_[output].affineIn(part); ofMargin && ofOutput)
        return ofOutput->offset - ofOutput->factor * ofMargin->offset / ofMargin->factor;
    return std::nullopt;
  }

  const Study& study_;
  WithConstants constants_;
  std::vector<Expression> outputs_;  // without margins
};

}  // namespace

std::vector<MarginInfo> marginsOf(const Study& study) {
  MarginFinder finder(study);
  std::vector<MarginInfo> margins;
  for (const Requirement& requirement : study.requirements)
    for (const std::size_t output : requirement.marginOutputs())
      margins.push_back(finder.find(requirement.demand.terms[output - requirement.firstMargin], output));
  return margins;
}

}  // namespace gamut
