// Random studies whose outputs are made of min, max, abs, clamps, signs and choices, run as a whole, with what makes
// bounds exact or next to it: values at ties, thin and wide tolerances, sizes from 1e-12 to 1e12, differences of large
// numbers, and of formulas that are equal. What outputs are is computed in rationals, from what the formulas mean:
// every such value lies in the enclosure and in the alpha-cuts, exactly, at output times and between, and meets what is
// told to be met; where a requirement is told to be violated, the values told violate it. And no sample may contradict
// an enclosure, or be left undecided.
// Usage:
//     extremes_campaign [studies = 3000] [first = 0]
// Prints what was judged; a study that fails is printed whole. The exit status is 1 if something does not hold.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "studies/running/run.hpp"
#include "studies/study.hpp"

namespace gamut::extremes_campaign {
namespace {

using Exact = boost::multiprecision::cpp_rational;

class Dice {
 public:
  explicit Dice(unsigned seed) : engine_(seed) {}
  /// Of 0 … count - 1.
  int roll(int count) { return static_cast<int>(engine_() % static_cast<unsigned>(count)); }
  bool happens(double share) { return roll(1000) < 1000 * share; }
  double between(double lower, double upper) {
    switch (roll(6)) {
      case 0:
        return lower;
      case 1:
        return upper;
      default:
        return std::clamp(lower + (upper - lower) * std::uniform_real_distribution<>()(engine_), lower, upper);
    }
  }

 private:
  std::mt19937 engine_;
};

/// A number as it is written in a study, and exactly.
struct Decimal {
  std::string text;
  Exact value;

  Decimal(int digits, int power) : text(fmt::format("{}e{}", digits, power)), value(digits) {
    for (int i = 0; i < std::abs(power); ++i) value = power > 0 ? Exact(value * 10) : Exact(value / 10);
  }
};

/// What formulas take: parameters, a state, and time in seconds; nothing where a choice is at its tie.
struct Point {
  std::vector<Exact> parameters;
  Exact state, time;
};
using Value = std::optional<Exact>;

struct Formula {
  std::string text;
  std::function<Value(const Point&)> of;
};

template <class Function>
Formula joined(std::string text, const Formula& a, const Formula& b, Function function) {
  return {std::move(text), [a, b, function](const Point& at) -> Value {
            const Value x = a.of(at), y = b.of(at);
            if (!x || !y) return std::nullopt;
            return function(*x, *y);
          }};
}
Formula sum(const Formula& a, const Formula& b) {
  return joined("(" + a.text + " + " + b.text + ")", a, b, [](const Exact& x, const Exact& y) { return Exact(x + y); });
}
Formula difference(const Formula& a, const Formula& b) {
  return joined("(" + a.text + " - " + b.text + ")", a, b, [](const Exact& x, const Exact& y) { return Exact(x - y); });
}
Formula product(const Formula& a, const Formula& b) {
  return joined(a.text + "*" + b.text, a, b, [](const Exact& x, const Exact& y) { return Exact(x * y); });
}
Formula least(const Formula& a, const Formula& b) {
  return joined("min(" + a.text + ", " + b.text + ")", a, b,
                [](const Exact& x, const Exact& y) { return x < y ? x : y; });
}
Formula greatest(const Formula& a, const Formula& b) {
  return joined("max(" + a.text + ", " + b.text + ")", a, b,
                [](const Exact& x, const Exact& y) { return x < y ? y : x; });
}
Formula size(const Formula& a) {
  return joined("abs(" + a.text + ")", a, a, [](const Exact& x, const Exact&) { return x < 0 ? Exact(-x) : x; });
}
Formula signum(const Formula& a) {
  return joined("sign(" + a.text + ")", a, a, [](const Exact& x, const Exact&) {
    return Exact(x < 0 ? -1 : x > 0 ? 1 : 0);
  });
}
Formula choice(const Formula& a, const Formula& b, const Formula& x, const Formula& y) {
  return {"where(" + a.text + " > " + b.text + ", " + x.text + ", " + y.text + ")", [=](const Point& at) -> Value {
            const Value left = a.of(at), right = b.of(at);
            if (!left || !right || *left == *right) return std::nullopt;
            return *left > *right ? x.of(at) : y.of(at);
          }};
}
Formula constant(const Decimal& decimal) {
  return {decimal.value < 0 ? "(" + decimal.text + ")" : decimal.text,
          [value = decimal.value](const Point&) -> Value { return value; }};
}

/// A study and what it means.
class RandomStudy {
 public:
  explicit RandomStudy(unsigned seed) : dice_(seed) {
    kind_ = dice_.roll(3);
    power_ = dice_.happens(0.5) ? 0 : 4 * dice_.roll(7) - 12;
    nominals_ = {number(1), number(1), number(2), number(1)};
    if (dice_.happens(0.3)) nominals_[1] = nominals_[0];  // a tie
    for (int i = 0; i < parameters; ++i) atoms_.push_back(parameter(i));
    if (kind_ != kinematics) atoms_.push_back({"(t/(1 s))", [](const Point& at) -> Value { return at.time; }});
    if (kind_ == dynamics) {
      rate_ = dice_.happens(0.3) ? constant(Decimal(0, 0)) : rateOfState();
      atoms_.push_back({"u", [rate = rate_](const Point& at) -> Value {
                          const Value by = rate.of(at);
                          if (!by) return std::nullopt;
                          return Exact(at.state + *by * at.time);
                        }});
    }
    for (int i = 0; i < 3; ++i) outputs_.push_back(output());
    write();
  }

  const std::string& text() const { return text_; }
  const std::vector<Formula>& outputs() const { return outputs_; }
  bool hasTime() const { return kind_ != kinematics; }
  /// Of a requirement, "demand > limit".
  Formula margin() const { return difference(demand_, constant(limit_)); }

  Point pointOf(const std::vector<double>& uncertain, double time) const {
    Point at{{}, start_.value, Exact(time)};
    for (const Decimal& nominal : nominals_) at.parameters.push_back(nominal.value);
    for (std::size_t i = 0; i < uncertain.size(); ++i)
      (which_[i] < parameters ? at.parameters[static_cast<std::size_t>(which_[i])] : at.state) = Exact(uncertain[i]);
    return at;
  }

 private:
  enum { kinematics, inverse, dynamics };
  static constexpr int parameters = 4;

  /// Of few digits, so that ties come about.
  Decimal number(int size) {
    constexpr std::array few{1, 2, 3, 5, 25, 75, 95, 125};
    const int digits = few[static_cast<std::size_t>(dice_.roll(few.size()))] * (dice_.happens(0.2) ? -1 : 1);
    return {digits, power_ - (size == 1 ? 2 : 0) + (dice_.happens(0.1) ? 8 : 0)};
  }
  Formula parameter(int i) const {
    return {fmt::format("p{}", i),
            [i](const Point& at) -> Value { return at.parameters[static_cast<std::size_t>(i)]; }};
  }
  /// Of parameters alone, so that the state is linear in time.
  Formula rateOfState() {
    const Formula p = parameter(dice_.roll(parameters)), q = parameter(dice_.roll(parameters));
    return dice_.happens(0.5) ? greatest(difference(p, q), constant(Decimal(0, 0))) : difference(least(p, q), p);
  }

  Formula atom() {
    if (dice_.happens(0.3)) return constant(number(1));
    return atoms_[static_cast<std::size_t>(dice_.roll(static_cast<int>(atoms_.size())))];
  }

  Formula of(int depth) {
    if (depth == 0) return atom();
    const Formula a = of(depth - 1);
    switch (dice_.roll(8)) {
      case 0:
        return sum(a, of(depth - 1));
      case 1:
        return difference(a, of(depth - 1));
      case 2:
        return product(constant(Decimal(1 + dice_.roll(3), 0)), a);
      case 3:
        return least(a, of(depth - 1));
      case 4:
        return greatest(a, of(depth - 1));
      case 5:
        return size(a);
      case 6:
        return least(greatest(a, atom()), atom());
      default:
        return dice_.happens(0.5) ? product(signum(a), atom()) : choice(a, atom(), of(depth - 1), atom());
    }
  }

  /// Something that is nothing but for rounding, or next to it.
  Formula output() {
    const Formula a = of(dice_.roll(3)), b = of(dice_.roll(2));
    if (dice_.happens(0.2)) {  // where that is a double, bounds are exact
      const Formula limit = constant(Decimal(dice_.happens(0.5) ? 25 : 75, -2));
      return dice_.happens(0.5) ? difference(least(a, limit), limit) : difference(greatest(a, limit), limit);
    }
    const Formula zero = constant(Decimal(0, 0)), large = constant(Decimal(7, power_ + 9));
    switch (dice_.roll(9)) {
      case 0:
        return difference(least(a, b), b);
      case 1:
        return difference(greatest(a, b), sum(a, greatest(zero, difference(b, a))));
      case 2:
        return sum(least(a, b), greatest(difference(zero, a), difference(zero, b)));
      case 3:
        return difference(size(a), greatest(a, difference(zero, a)));
      case 4:
        return difference(sum(a, large), large);
      case 5:
        return difference(least(greatest(a, b), sum(b, large)), b);
      case 6:
        return difference(sum(least(a, b), greatest(a, b)), sum(a, b));
      case 7:
        return product(constant(Decimal(1, -power_)), difference(least(a, atom()), atom()));
      default:
        return of(2);
    }
  }

  void write() {
    constexpr std::array analyses{"kinematics", "inverse-dynamics", "dynamics"};
    text_ = fmt::format("[study]\nanalysis = \"{}\"\ncompare = [\"interval\", \"stochastic\", \"fuzzy\"]\n",
                        analyses[static_cast<std::size_t>(kind_)]);
    if (hasTime()) text_ += "horizon = 1\noutput_step = 0.25\n[distribution]\ntimes = 0\n";
    text_ += "[stochastic]\nsamples = 24\n[fuzzy]\nlevels = 3\n[mechanism.parameters]\n";
    for (int i = 0; i < parameters; ++i)
      text_ += fmt::format("p{} = \"{}\"\n", i, nominals_[static_cast<std::size_t>(i)].text);
    text_ += "[[mechanism.element]]\n";
    start_ = number(1);
    if (kind_ == dynamics)
      text_ += fmt::format("type = \"state\"\nname = \"u\"\ninitial = \"{}\"\nrate = \"{}/(1 s)\"\n", start_.text,
                           rate_.text);
    else if (kind_ == inverse)
      text_ +=
          "type = \"prismatic\"\nname = \"slide\"\nfrom = \"inertial\"\nto = \"slider\"\naxis = \"x\"\n"
          "[[mechanism.element]]\ntype = \"drive\"\nname = \"motor\"\njoint = \"slide\"\nposition = \"t*(1 m/s)\"\n";
    else
      text_ += "type = \"link\"\nname = \"arm\"\nfrom = \"inertial\"\nto = \"tip\"\nvector = [\"1 m\", 0, 0]\n";
    const int count = 1 + dice_.roll(kind_ == dynamics ? 5 : 4);
    for (int i = 0; i < count; ++i) {
      which_.push_back(i);
      constexpr std::array tolerances{"1e-13", "1e-9", "1e-4", "0.5", "5", "15", "100"};
      text_ += fmt::format("[[uncertain]]\nquantity = \"{}\"\ninterval = \"± {} %\"\n",
                           i < parameters ? fmt::format("p{}", i) : "u",
                           tolerances[static_cast<std::size_t>(dice_.roll(tolerances.size()))]);
    }
    for (const Formula& formula : outputs_) text_ += fmt::format("[[output]]\nquantity = \"{}\"\n", formula.text);
    demand_ = dice_.happens(0.5) ? least(of(1), atom()) : output();
    limit_ = number(1);
    if (dice_.happens(0.3)) limit_ = nominals_[static_cast<std::size_t>(dice_.roll(parameters))];
    text_ += fmt::format("[[requirement]]\nname = \"demanded\"\nalways = \"{} >= {}\"\n", demand_.text, limit_.text);
  }

  Dice dice_;
  int kind_ = 0, power_ = 0;
  std::vector<Decimal> nominals_;
  Decimal start_{0, 0}, limit_{0, 0};
  Formula rate_, demand_;
  std::vector<Formula> atoms_, outputs_;
  std::vector<int> which_;
  std::string text_;
};

struct Counts {
  std::size_t studies = 0, refused = 0, values = 0, exact = 0, disputes = 0, ended = 0, met = 0, violated = 0,
              failures = 0;
};

class Trial {
 public:
  Trial(unsigned seed, Counts& counts) : seed_(seed), dice_(seed + 1'000'000), study_(seed), counts_(counts) {}

  void run() {
    ++counts_.studies;
    std::optional<Study> study;
    try {
      study = readStudyText(study_.text(), "s");
      machine_.emplace(*study);
    } catch (const StudyError& error) {
      ++counts_.refused;
      if (std::getenv("EXTREMES_REFUSED") != nullptr) fmt::print("{}: {}\n", seed_, error.what());
      return;
    }
    results_ = gamut::run(*machine_);
    counts_.disputes += results_.comparison.disputed.size();
    const Agreement verdict = results_.comparison.verdict;
    counts_.ended += verdict == Agreement::incomplete ? 1 : 0;
    if (verdict == Agreement::outside) fail("a sample contradicts an enclosure");
    if (verdict == Agreement::unresolved) fail("a sample is left undecided");
    judgeValues();
    judgeRequirement();
    if (hasFailed_) fmt::print("{}\n", study_.text());
  }

 private:
  void fail(const std::string& what) {
    ++counts_.failures;
    hasFailed_ = true;
    fmt::print("study {}: {}\n", seed_, what);
  }

  std::vector<double> anywhere(double share) {
    std::vector<double> values;
    for (const Uncertain& u : machine_->motion.uncertain) {
      const auto within = [&](double end) { return u.nominal + share * (end - u.nominal); };
      const double lower = std::max(within(u.range.lower()), u.range.lower());
      values.push_back(dice_.between(lower, std::min(within(u.range.upper()), u.range.upper())));
    }
    return values;
  }

  void expectHeld(const Envelope& bounds, std::size_t row, std::size_t output, const Exact& value, const char* by) {
    const double lower = bounds.lower(row, output), upper = bounds.upper(row, output);
    if (std::isnan(lower)) return;
    ++counts_.values;
    counts_.exact += lower == upper ? 1 : 0;
    const bool isAbove = std::isinf(lower) || Exact(lower) <= value,
               isBelow = std::isinf(upper) || value <= Exact(upper);
    if (!isAbove || !isBelow)
      fail(fmt::format("{} of output {} at row {}: {} is not in [{}, {}]", by, output, row, value.convert_to<double>(),
                       lower, upper));
  }

  void judgeValues() {
    const std::size_t rows = results_.time.size();
    for (int i = 0; i < 30; ++i) {
      const std::vector<double> values = anywhere(1);
      for (std::size_t row = 0; row < rows; ++row) {
        const double end = results_.time[row], begin = row == 0 ? 0 : results_.time[row - 1];
        for (std::size_t output = 0; output < study_.outputs().size(); ++output) {
          const Formula& formula = study_.outputs()[output];
          if (const Value at = formula.of(study_.pointOf(values, end))) {
            expectHeld(results_.interval.at, row, output, *at, "the enclosure");
            if (!results_.interval.direct.empty())
              expectHeld(results_.interval.direct, row, output, *at, "what is direct");
          }
          if (!study_.hasTime()) continue;
          if (const Value between = formula.of(study_.pointOf(values, dice_.between(begin, end))))
            expectHeld(results_.interval.over, row, output, *between, "the enclosure between");
        }
      }
      judgeCuts();
    }
  }

  void judgeCuts() {
    for (std::size_t level = 0; level < results_.fuzzy.outer.size(); ++level) {
      std::vector<double> values;
      const Box& box = machine_->levels[level];
      for (const int slot : machine_->motion.slot) {
        const Interval& cut = box[static_cast<std::size_t>(slot)];
        values.push_back(dice_.between(cut.lower(), cut.upper()));
      }
      for (std::size_t row = 0; row < results_.time.size(); ++row)
        for (std::size_t output = 0; output < study_.outputs().size(); ++output)
          if (const Value at = study_.outputs()[output].of(study_.pointOf(values, results_.time[row])))
            expectHeld(results_.fuzzy.outer[level], row, output, *at, "an alpha-cut");
    }
  }

  void judgeRequirement() {
    const RequirementResult& told = results_.requirements.at(0);
    const Formula margin = study_.margin();
    if (told.word == Decision::met) {
      ++counts_.met;
      for (int i = 0; i < 100; ++i)
        if (const Value at = margin.of(study_.pointOf(anywhere(1), dice_.between(0, study_.hasTime() ? 1 : 0))))
          if (*at < 0) fail("what is told to be met is not");
    }
    const bool isViolated = told.word == Decision::violated || told.word == Decision::partly;
    counts_.violated += isViolated ? 1 : 0;
    if (!isViolated || told.violation.empty()) return;
    std::vector<double> values = told.violation;
    for (std::size_t i = 0; i < values.size(); ++i)
      if (std::isnan(values[i])) values[i] = machine_->motion.uncertain[i].nominal;
    if (std::isnan(told.violationTime)) return;
    const Value at = margin.of(study_.pointOf(values, told.violationTime));
    if (at && !(*at < 0)) fail("what is told to violate does not");
  }

  unsigned seed_;
  Dice dice_;
  RandomStudy study_;
  Counts& counts_;
  std::optional<Machine> machine_;
  Results results_;
  bool hasFailed_ = false;
};

int run(int argc, char** argv) {
  const auto argument = [&](int i, int otherwise) { return argc > i ? std::atoi(argv[i]) : otherwise; };
  const int count = argument(1, 3000), first = argument(2, 0);
  Counts counts;
  for (int i = first; i < first + count; ++i) Trial(static_cast<unsigned>(i), counts).run();
  fmt::print(
      "{} studies, {} of them refused: {} values held, {} of them by exact bounds; {} samples were disputed, {} "
      "studies ended early, {} "
      "requirements met, {} violated; {} failures\n",
      counts.studies, counts.refused, counts.values, counts.exact, counts.disputes, counts.ended, counts.met,
      counts.violated, counts.failures);
  return counts.failures > 0 || counts.refused == counts.studies ? 1 : 0;
}

}  // namespace
}  // namespace gamut::extremes_campaign

int main(int argc, char** argv) { return gamut::extremes_campaign::run(argc, argv); }
