// The adjoint goes back over a grid of times in steps of matrices: transitions of the linear motion between them, by a
// formula that damps what is stiff. A switch that is off by a small part of a turn costs the square of that.
#include "analyses/samples/worst_courses.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "analyses/work.hpp"
#include "analyses/workers.hpp"
#include "scalars/algebra/decompositions.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "scalars/index.hpp"
#include "scalars/program/sides.hpp"
#include "scalars/recorded.hpp"

namespace gamut {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

constexpr double stepsOfTurn = 8;  // of the grid, for each radian of twice the fastest turn
constexpr std::size_t leastSteps = 512, mostSteps = 8192, mostEntries = std::size_t{1} << 23;
constexpr Tolerance ofSweeps{1e-8, 1e-10};
constexpr int mostSweeps = 3;
constexpr double alike = 1e-7;       // of the horizon: courses that switch so near each other are one
constexpr double justBefore = 1e-9;  // of the horizon
constexpr double nothing = 1e-12;    // of the greatest that an adjoint is: it has no sign there

/// An output that is to be greatest (sign 1) or least (-1) at an output time.
struct Goal {
  std::size_t output, row;
  double sign;
};

/// Along one motion, at the times of the grid.
struct Linear {
  std::vector<Matrix> transition;  // of each step
  std::vector<Matrix> inputs;      // ∂f/∂p
};

struct Candidate {
  WorstCourse course;
  bool isAny = false;
};

std::vector<double> gridOf(const Motion& motion, std::size_t steps) {
  std::vector<double> times;
  for (std::size_t k = 0; k <= steps; ++k)
    times.push_back(motion.horizon() * static_cast<double>(k) / static_cast<double>(steps));
  times.back() = motion.horizon();
  times.insert(times.end(), motion.times.begin(), motion.times.end());
  std::ranges::sort(times);
  const auto repeated = std::ranges::unique(times);
  times.erase(repeated.begin(), repeated.end());
  return times;
}

Motion denseMotion(const Motion& motion, const std::vector<double>& grid) {
  Motion dense;
  dense.f = motion.f;
  dense.sampled = motion.sampled;
  dense.times = grid;
  const int n = motion.f.states();
  dense.g = record(n, motion.f.parameters(), n, [&](auto, const auto& x, const auto&, auto& y) {
    for (std::size_t i = 0; i < detail::at(n); ++i) y[i] = x[i];
  });
  return dense;
}

/// 0, 1/2, 1/4, 3/4, ... of all, so that the first of them are spread over all; each once.
std::vector<std::size_t> spreadOver(std::size_t count) {
  std::vector<std::size_t> result;
  std::vector<char> isTaken(count, 0);
  std::size_t all = 1;
  while (all < count) all *= 2;
  for (std::size_t i = 0; i < all; ++i) {
    std::size_t reversed = 0;
    for (std::size_t bit = 1, other = all / 2; bit < all; bit *= 2, other /= 2)
      if ((i & bit) != 0) reversed += other;
    const std::size_t place = reversed * count / all;
    if (place < count && isTaken[place]++ == 0) result.push_back(place);
  }
  for (std::size_t place = 0; place < count; ++place)
    if (isTaken[place] == 0) result.push_back(place);
  return result;
}

/// One motion after another, and what is worst about each. One a thread.
class Sweeper {
 public:
  Sweeper(const UncertainMotion& system, const WorstCourseOptions& options, const std::vector<double>& grid,
          const Motion& dense)
      : system_(system),
        motion_(system.switching.motion),
        grid_(grid),
        n_(detail::at(motion_.f.states())),
        k_(detail::at(motion_.f.parameters())),
        witness_(dense, options.method, options.cancelled),
        f_(motion_.forSamples().differentiated(true)),
        g_(motion_.g.differentiated(true)),
        trajectory_(grid.size() * n_) {}

  /// All at their nominal values.
  WorstCourse nominal() const {
    WorstCourse course;
    for (const Uncertain& q : system_.uncertain) course.values.push_back(q.nominal);
    for (const std::size_t q : system_.switching.quantities)
      course.courses.push_back({{0.0}, {system_.uncertain[q].nominal}});
    return course;
  }

  /// Follows it; false if that does not arrive.
  bool follow(const WorstCourse& course) {
    const Integration run =
        integrateAlong(witness_, system_, course.courses, system_.start(course.values), ofSweeps, trajectory_);
    return run.times == grid_.size();
  }

  /// The outputs then, and their derivatives by states and parameters, along the motion that was followed last.
  const std::vector<double>& outputsAt(std::size_t row, const WorstCourse& course) {
    std::vector<double> parameters = parametersOf(course);
    setCourses(course, motion_.times[row], parameters);
    g_.setParameters(parameters);
    outputs_.resize(motion_.outputs() * (1 + n_ + k_));
    g_(motion_.times[row], std::span<const double>(trajectory_).subspan(placeOf(row) * n_, n_), outputs_);
    Work::count(Work::aloneOperation, g_.tape().operations());
    return outputs_;
  }

  /// About the motion that was followed last. False if it has no finite derivatives.
  bool linearise(const WorstCourse& course, Linear& linear) {
    std::vector<double> parameters = parametersOf(course);
    std::vector<double> values(n_ * (1 + n_ + k_));
    const Matrix one = Matrix::Identity(rows(n_), rows(n_));
    linear.transition.clear();
    linear.inputs.clear();
    Matrix before, here;
    for (std::size_t i = 0; i < grid_.size(); ++i) {
      setCourses(course, grid_[i], parameters);
      f_.setParameters(parameters);
      f_(grid_[i], std::span<const double>(trajectory_).subspan(i * n_, n_), values);
      Work::count(Work::aloneOperation, f_.tape().operations());
      here = blockOf(values, n_, n_, n_);
      linear.inputs.push_back(blockOf(values, n_ + n_ * n_, n_, k_));
      if (!here.allFinite() || !linear.inputs.back().allFinite()) return false;
      if (i > 0) {  // of order three, and what is stiff comes to nothing
        const Matrix z = 0.5 * (grid_[i] - grid_[i - 1]) * (before + here);
        linear.transition.emplace_back(solved(one - 2.0 / 3 * z + 1.0 / 6 * z * z, one + 1.0 / 3 * z));
        Work::count(Work::matrixTerm, 3.0 * static_cast<double>(n_ * n_ * n_));
      }
      std::swap(before, here);
    }
    return true;
  }

  /// The worst course of the linear motion; none where that is not known.
  Candidate worst(const Linear& linear, const Goal& goal, const WorstCourse& along) {
    outputsAt(goal.row, along);
    const std::size_t m = motion_.outputs();
    Vector adjoint(rows(n_)), direct(rows(k_));
    for (std::size_t s = 0; s < n_; ++s) adjoint[rows(s)] = goal.sign * outputs_[m + goal.output * n_ + s];
    for (std::size_t p = 0; p < k_; ++p) direct[rows(p)] = goal.sign * outputs_[m + m * n_ + goal.output * k_ + p];
    if (!adjoint.allFinite() || !direct.allFinite()) return {};
    const std::size_t end = placeOf(goal.row);
    Matrix switching(rows(k_), rows(end + 1));  // of each parameter
    for (std::size_t i = end;; --i) {
      switching.col(rows(i)) = linear.inputs[i].transpose() * adjoint;
      if (i == 0) break;
      adjoint = linear.transition[i - 1].transpose() * adjoint;
    }
    Work::count(Work::matrixTerm, static_cast<double>(end * n_ * (n_ + k_)));
    if (!adjoint.allFinite() || !switching.allFinite()) return {};
    Candidate result{nominal(), true};
    const std::vector<std::size_t>& varying = system_.switching.quantities;
    for (std::size_t q = 0; q < system_.uncertain.size(); ++q) {
      const auto slot = static_cast<std::size_t>(system_.slot[q]);
      const auto isVarying = std::ranges::find(varying, q);
      const Uncertain& uncertain = system_.uncertain[q];
      if (slot < n_) {
        result.course.values[q] = endOf(uncertain, adjoint[rows(slot)]);
        continue;
      }
      const auto sigma = switching.row(rows(slot - n_));
      const double now = direct[rows(slot - n_)];
      const auto place = static_cast<std::size_t>(isVarying - varying.begin());
      if (isVarying != varying.end() && std::isinf(system_.switching.rates[place])) {
        result.course.courses[place] = courseOf(uncertain, sigma, now, end);
        continue;
      }
      double sum = now;
      for (std::size_t i = 0; i < end; ++i)
        sum += 0.5 * (grid_[i + 1] - grid_[i]) * (sigma[rows(i)] + sigma[rows(i + 1)]);
      const double value = endOf(uncertain, sum);
      if (isVarying != varying.end())
        result.course.courses[place].values[0] = value;
      else
        result.course.values[q] = value;
    }
    return result;
  }

 private:
  static Eigen::Index rows(std::size_t i) { return static_cast<Eigen::Index>(i); }
  static double endOf(const Uncertain& of, double derivative) {
    return derivative > 0 ? of.range.upper() : derivative < 0 ? of.range.lower() : of.nominal;
  }

  static Matrix blockOf(const std::vector<double>& values, std::size_t from, std::size_t height, std::size_t width) {
    return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
        values.data() + from, rows(height), rows(width));
  }

  /// Of an output time, on the grid.
  std::size_t placeOf(std::size_t row) const {
    return static_cast<std::size_t>(std::ranges::lower_bound(grid_, motion_.times[row]) - grid_.begin());
  }

  std::vector<double> parametersOf(const WorstCourse& course) const {
    const std::vector<double> start = system_.start(course.values);
    return {start.begin() + static_cast<std::ptrdiff_t>(n_), start.end()};
  }

  void setCourses(const WorstCourse& course, double t, std::vector<double>& parameters) const {
    for (std::size_t i = 0; i < course.courses.size(); ++i)
      parameters[static_cast<std::size_t>(system_.slot[system_.switching.quantities[i]]) - n_] =
          course.courses[i].at(t);
  }

  template <class Sigma>
  SwitchingCourse courseOf(const Uncertain& of, const Sigma& sigma, double now, std::size_t end) const {
    const double greatest = sigma.cwiseAbs().maxCoeff();
    SwitchingCourse course;
    double last = 0;  // the last that has a sign, and its place
    std::size_t place = 0;
    for (std::size_t i = 0; i <= end; ++i) {
      const double here = sigma[rows(i)];
      if (!(std::fabs(here) > nothing * greatest)) continue;
      if (last == 0) {
        course = {{0.0}, {endOf(of, here)}};
      } else if ((last > 0) != (here > 0)) {
        course.from.push_back(grid_[place] + (grid_[i] - grid_[place]) * (last / (last - here)));
        course.values.push_back(endOf(of, here));
      }
      last = here;
      place = i;
    }
    if (course.from.empty()) course = {{0.0}, {now != 0 ? endOf(of, now) : of.nominal}};
    const double before = grid_[end] - justBefore * grid_.back();
    if (now != 0 && course.values.back() != endOf(of, now) && before > course.from.back()) {
      course.from.push_back(before);
      course.values.push_back(endOf(of, now));
    }
    return course;
  }

  const UncertainMotion& system_;
  const Motion& motion_;
  const std::vector<double>& grid_;
  std::size_t n_, k_;
  Witness witness_;
  Evaluator<double> f_, g_;
  std::vector<double> trajectory_, outputs_;
};

bool areAlike(const WorstCourse& a, const WorstCourse& b, double horizon) {
  if (a.values != b.values) return false;
  for (std::size_t q = 0; q < a.courses.size(); ++q) {
    if (a.courses[q].values != b.courses[q].values) return false;
    for (std::size_t i = 0; i < a.courses[q].from.size(); ++i)
      if (std::fabs(a.courses[q].from[i] - b.courses[q].from[i]) > alike * horizon) return false;
  }
  return true;
}

bool stands(const WorstCourse& course) {
  return std::ranges::all_of(course.courses, [](const SwitchingCourse& of) { return of.from.size() == 1; });
}

constexpr double roundings = 1e-9;

/// Whether two motions have the same derivatives but for roundings.
bool areSame(const Linear& a, const Linear& b) {
  const auto areNear = [&](const std::vector<Matrix>& one, const std::vector<Matrix>& other) {
    for (std::size_t i = 0; i < one.size(); ++i)
      if (!((one[i] - other[i]).cwiseAbs().maxCoeff() <= roundings * one[i].cwiseAbs().maxCoeff())) return false;
    return true;
  };
  return areNear(a.transition, b.transition) && areNear(a.inputs, b.inputs);
}

/// Whether outputs, and their derivatives behind the first `m`, are the same but for roundings.
bool areSame(const std::vector<double>& a, const std::vector<double>& b, std::size_t m) {
  for (std::size_t i = m; i < a.size(); ++i)
    if (!(std::fabs(a[i] - b[i]) <= roundings * std::fabs(a[i]))) return false;
  return true;
}

/// Whether some quantity may switch at any time.
bool mayAnySwitch(const UncertainMotion& system) {
  for (std::size_t i = 0; i < system.switching.quantities.size(); ++i)
    if (std::isinf(system.switching.rates[i]) && canSwitch(system.uncertain[system.switching.quantities[i]].range))
      return true;
  return false;
}

std::vector<Goal> goalsOf(const Motion& motion, const std::vector<std::size_t>& outputs) {
  std::vector<Goal> goals;
  const std::size_t last = motion.times.size() - 1;
  const std::size_t first = motion.times.front() > 0 ? 0 : 1, count = motion.times.size() - first;
  for (const std::size_t place : spreadOver(count))
    for (const std::size_t output : outputs)
      for (const double sign : {1.0, -1.0}) goals.push_back({output, last - place, sign});
  return goals;
}

/// The best of courses that follow from each other, each the worst of the motion linear along the one before.
Candidate improved(Sweeper& sweeper, Linear& linear, const Goal& goal, Candidate candidate, double horizon) {
  Candidate best;
  double greatest = -std::numeric_limits<double>::infinity();
  for (int sweep = 0; sweep <= mostSweeps && candidate.isAny && sweeper.follow(candidate.course); ++sweep) {
    const double value = goal.sign * sweeper.outputsAt(goal.row, candidate.course)[goal.output];
    if (!(value > greatest)) break;
    greatest = value;
    best = candidate;
    if (sweep == mostSweeps || !sweeper.linearise(candidate.course, linear)) break;
    Candidate better = sweeper.worst(linear, goal, candidate.course);
    if (better.isAny && areAlike(better.course, candidate.course, horizon)) break;
    candidate = std::move(better);
  }
  return best;
}

}  // namespace

std::vector<WorstCourse> worstCourses(const UncertainMotion& system, const WorstCourseOptions& options) {
  const Motion& motion = system.switching.motion;
  const auto n = static_cast<std::size_t>(motion.f.states()), k = static_cast<std::size_t>(motion.f.parameters());
  if (!mayAnySwitch(system) || !(motion.horizon() > 0) || !jumpsOf(motion.forSamples()).empty()) return {};
  const std::size_t mostHere = mostEntries / (n * (n + k));
  const auto wanted =
      static_cast<std::size_t>(std::clamp(stepsOfTurn * options.fastest * motion.horizon(),
                                          static_cast<double>(leastSteps), static_cast<double>(mostSteps)));
  if (mostHere < leastSteps) return {};
  const std::vector<double> grid = gridOf(motion, std::min(wanted, mostHere));
  const Motion dense = denseMotion(motion, grid);
  const std::uint64_t began = Work::counted();
  Sweeper base(system, options, grid, dense);
  const WorstCourse nominal = base.nominal();
  Linear atNominal;
  if (!base.follow(nominal)) return {};
  if (!base.linearise(nominal, atNominal)) return {};

  const std::vector<Goal> goals = goalsOf(motion, options.outputs);
  const std::size_t last = motion.times.size() - 1;
  const auto isCancelled = [&] { return options.cancelled != nullptr && *options.cancelled; };
  std::vector<WorstCourse> found;
  std::optional<bool> isAffine;
  double ofOne = 0;  // work
  constexpr std::size_t together = 32;
  for (std::size_t next = 0; next < goals.size() && found.size() < options.most && !isCancelled(); next += together) {
    std::vector<Candidate> candidates(std::min(together, goals.size() - next));
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      candidates[i] = base.worst(atNominal, goals[next + i], nominal);
      if (isAffine || !candidates[i].isAny) continue;
      Linear other;
      Sweeper probe(system, options, grid, dense);
      const std::uint64_t before = Work::counted();
      const bool arrives = probe.follow(candidates[i].course);
      ofOne = static_cast<double>(Work::counted() - before);
      isAffine = arrives && probe.linearise(candidates[i].course, other) && areSame(atNominal, other) &&
                 areSame(base.outputsAt(last, nominal), probe.outputsAt(last, candidates[i].course), motion.outputs());
    }
    if (isAffine && !*isAffine) {
      forEachIndex(options.jobs, candidates.size(), options.cancelled, [&] {
        return [&, sweeper = Sweeper(system, options, grid, dense), linear = Linear()](std::size_t i) mutable {
          candidates[i] = improved(sweeper, linear, goals[next + i], std::move(candidates[i]), motion.horizon());
        };
      });
      if (isCancelled()) break;
    }
    for (Candidate& candidate : candidates) {
      if (!candidate.isAny || found.size() == options.most || stands(candidate.course)) continue;
      const double spent = static_cast<double>(Work::counted() - began) + ofOne * static_cast<double>(found.size() + 1);
      if (spent > options.budget * ofOne) return found;
      if (std::ranges::none_of(
              found, [&](const WorstCourse& other) { return areAlike(candidate.course, other, motion.horizon()); }))
        found.push_back(std::move(candidate.course));
    }
  }
  return isCancelled() ? std::vector<WorstCourse>() : found;
}

}  // namespace gamut
