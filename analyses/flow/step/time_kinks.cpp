// Forms of arguments from those of their operands, in intervals; zeros of others by bisection.
#include "analyses/flow/step/time_kinks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "analyses/flow/series/embedded.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "scalars/index.hpp"
#include "scalars/program/recorder.hpp"

namespace gamut {

using detail::at;

namespace {

/// [time, constant, parameters...]
using Form = std::vector<Interval>;

bool isConstant(const Form& form) {
  const auto isZero = [](const Interval& c) { return isEqual(c, Interval(0.0)); };
  return isZero(form[0]) && std::all_of(form.begin() + 2, form.end(), isZero);
}

Form scaled(Form form, const Interval& by) {
  for (Interval& c : form) c = c * by;
  return form;
}

/// Of every node; none where it is no such form.
std::vector<std::optional<Form>> formsOf(const Program& f) {
  std::vector<std::optional<Form>> forms;
  const Form zero(at(f.parameters()) + 2, Interval(0.0));
  for (const Node& node : f.nodes()) {
    const auto known = [&](int operand) { return forms[operand].has_value(); };
    std::optional<Form> form;
    const auto single = [&](std::size_t place, const Interval& value) {
      form = zero;
      (*form)[place] = value;
    };
    switch (node.op) {
      case Op::time:
        single(0, Interval(1.0));
        break;
      case Op::constant:
        single(1, f.constants()[node.a]);
        break;
      case Op::parameter:
        single(at(node.a) + 2, Interval(1.0));
        break;
      case Op::add:
      case Op::sub:
        if (!known(node.a) || !known(node.b)) break;
        form = *forms[node.a];
        for (std::size_t i = 0; i < form->size(); ++i)
          (*form)[i] = node.op == Op::add ? (*form)[i] + (*forms[node.b])[i] : (*form)[i] - (*forms[node.b])[i];
        break;
      case Op::neg:
        if (known(node.a)) form = scaled(*forms[node.a], Interval(-1.0));
        break;
      case Op::mul:
        if (!known(node.a) || !known(node.b)) break;
        if (isConstant(*forms[node.a]))
          form = scaled(*forms[node.b], (*forms[node.a])[1]);
        else if (isConstant(*forms[node.b]))
          form = scaled(*forms[node.a], (*forms[node.b])[1]);
        break;
      case Op::recip:
        if (known(node.a) && isConstant(*forms[node.a]) && !contains((*forms[node.a])[1], 0.0))
          single(1, Interval(1.0) / (*forms[node.a])[1]);
        break;
      default:
        break;
    }
    forms.push_back(std::move(form));
  }
  return forms;
}

/// u = a t + b with a ∈ time, b ∈ rest is zero at -b/a.
Interval momentOf(const Interval& time, Interval rest, const std::vector<Interval>& by,
                  const std::vector<Embedded>& parameters) {
  for (std::size_t k = 0; k < by.size(); ++k)
    if (!isEqual(by[k], Interval(0.0))) rest += by[k] * rangeOf(parameters[k]);
  return -rest / time;
}

/// A function of time alone.
class Course {
 public:
  explicit Course(const Program& u) : evaluate_(u), states_(at(u.states()), Interval(0.0)) {
    evaluate_.setParameters(Box(at(u.parameters()), Interval(0.0)));
  }
  Interval operator()(const Interval& time) {
    evaluate_(time, states_, value_);
    return isEmpty(value_[0]) ? Interval::entire() : value_[0];
  }

 private:
  Evaluator<Interval> evaluate_;
  Box states_, value_{Interval(0.0)};
};

/// The zeros of u(t), in cells that are no longer than `resolution` or touch; none where these are too many.
std::optional<std::vector<Interval>> zerosOf(Course& u, double horizon, double resolution) {
  constexpr int mostLooks = 200000;  // some 60 a zero
  std::vector<Interval> found, open{Interval(0.0, horizon)};
  for (int looks = 0; !open.empty(); ++looks) {
    if (looks == mostLooks) return std::nullopt;
    const Interval cell = open.back();
    open.pop_back();
    if (!contains(u(cell), 0.0)) continue;
    const double middle = std::floor(midpoint(cell) / resolution) * resolution;
    if (middle > cell.lower() && middle < cell.upper()) {
      open.emplace_back(middle, cell.upper());
      open.emplace_back(cell.lower(), middle);
    } else if (!found.empty() && found.back().upper() == cell.lower()) {
      found.back() = hull(found.back(), cell);
    } else {
      found.push_back(cell);
    }
  }
  return found;
}

/// Of each node: whether it depends on time, and whether on nothing else but constants.
std::vector<char> functionsOfTime(const Program& f) {
  std::vector<char> isAlone, depends;
  for (std::size_t i = 0; i < f.nodes().size(); ++i) {
    const Op op = f.nodes()[i].op;
    bool alone = op != Op::state && op != Op::parameter, does = op == Op::time;
    detail::forEachOperand(f.table(), static_cast<int>(i), [&](int operand) {
      alone = alone && isAlone[operand] != 0;
      does = does || depends[operand] != 0;
    });
    isAlone.push_back(static_cast<char>(alone));
    depends.push_back(static_cast<char>(does));
  }
  for (std::size_t i = 0; i < isAlone.size(); ++i) isAlone[i] = static_cast<char>(isAlone[i] != 0 && depends[i] != 0);
  return isAlone;
}

}  // namespace

TimeKinks::TimeKinks(const Program& f, double horizon, double resolution) {
  const auto isKink = [](const Node& node) { return !isSmooth(node.op); };
  if (std::ranges::none_of(f.nodes(), isKink)) return;
  const std::vector<std::optional<Form>> forms = formsOf(f);
  const std::vector<char> isOfTime = functionsOfTime(f);
  std::map<int, Switching> known;  // |u| and sign u have one u
  for (std::size_t i = 0; i < f.nodes().size(); ++i) {
    const Node& node = f.nodes()[i];
    if (!isKink(node)) continue;
    if (forms[node.a] && !contains((*forms[node.a])[0], 0.0)) {
      const Form& form = *forms[node.a];
      linear_.push_back({static_cast<int>(i), form[0], form[1], {form.begin() + 2, form.end()}});
    } else if (isOfTime[node.a] != 0) {
      const auto [place, isNew] = known.try_emplace(node.a);
      if (isNew) place->second = switchingOf(Recorder(f).finish({node.a}), horizon, resolution);
      if (place->second.sides.empty()) continue;
      switching_.push_back(place->second);
      switching_.back().node = static_cast<int>(i);
    }
  }
}

/// Without sides where its zeros are too many.
TimeKinks::Switching TimeKinks::switchingOf(const Program& u, double horizon, double resolution) {
  Switching result{-1, {}, {}};
  Course course(u);
  const auto zeros = zerosOf(course, horizon, resolution);
  if (!zeros) return result;
  result.zeros = *zeros;
  double from = 0;
  for (std::size_t i = 0; i <= zeros->size(); ++i) {
    const double to = i < zeros->size() ? (*zeros)[i].lower() : horizon;
    const Interval between = course(Interval(midpoint(Interval(from, std::max(from, to)))));
    result.sides.push_back(between.lower() > 0 ? 1 : between.upper() < 0 ? -1 : 0);
    if (i < zeros->size()) from = (*zeros)[i].upper();
  }
  return result;
}

std::vector<Interval> TimeKinks::moments(const std::vector<Embedded>& parameters) const {
  std::vector<Interval> result;
  for (const Linear& kink : linear_) result.push_back(momentOf(kink.time, kink.constant, kink.parameters, parameters));
  for (const Switching& kink : switching_) result.insert(result.end(), kink.zeros.begin(), kink.zeros.end());
  return result;
}

double TimeKinks::nextLinear(const std::vector<Embedded>& parameters, double from) const {
  double next = std::numeric_limits<double>::infinity();
  for (const Linear& kink : linear_)
    if (const Interval moment = momentOf(kink.time, kink.constant, kink.parameters, parameters); moment.lower() >= from)
      next = std::min(next, moment.lower());
  return next;
}

void TimeKinks::giveSides(const std::vector<Embedded>& parameters, double from, double to,
                          PolynomialSeries& series) const {
  for (const Linear& kink : linear_) {
    const Interval moment = momentOf(kink.time, kink.constant, kink.parameters, parameters);
    const double after = kink.time.lower() > 0 ? 1 : -1;
    if (from >= moment.upper()) series.kinks().giveSide(kink.node, after);
    if (to <= moment.lower()) series.kinks().giveSide(kink.node, -after);
  }
  for (const Switching& kink : switching_) {
    const auto next = std::ranges::upper_bound(kink.zeros, from, {}, [](const Interval& zero) { return zero.upper(); });
    const double side = kink.sides[next - kink.zeros.begin()];
    if (side != 0 && (next == kink.zeros.end() || to <= next->lower())) series.kinks().giveSide(kink.node, side);
  }
}

}  // namespace gamut
