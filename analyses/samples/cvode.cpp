// CVODE's memory, and its vector operations for packs: row by row, with the greatest of the samples' norms.
#include "analyses/samples/cvode.hpp"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "analyses/samples/sides_of_motion.hpp"
#include "analyses/samples/sundials.hpp"
#include "analyses/workers.hpp"
#include "scalars/evaluation/sample_pack.hpp"

namespace gamut {
namespace {

using namespace detail;

constexpr double shortestStep = 1e-13;        // of the horizon: below, the motion runs into a singularity
constexpr long evaluationsBetweenLooks = 64;  // at the clock
constexpr double tightest = 1e-14;            // relative tolerance, some 50 roundings
constexpr double longestUnwatched = 0x1p-8;   // of the horizon: the longest step where equations turn
constexpr double nothingLeft = 1e-14;         // of the horizon, for which CVODE would not begin anew

using detail::load, detail::store;
GAMUT_INLINE void load(double& to, const double* from) { to = *from; }
GAMUT_INLINE void store(double* to, double from) { *to = from; }

// The vector operations that CVODE spends its time in: its prediction alone adds some eighty vectors a step. They give
// the bits of the library's own, whose dispatch on special coefficients costs short vectors more than the sums, and
// which a distribution may have compiled without optimising (Debian 12). V: as many values as a vector unit takes, or
// one.

/// z = a x + b y.
template <class V>
GAMUT_INLINE void addVectors(double a, N_Vector x, double b, N_Vector y, N_Vector z) {
  const sunindextype n = NV_LENGTH_S(x);
  const double* left = NV_DATA_S(x);
  const double* right = NV_DATA_S(y);
  double* sum = NV_DATA_S(z);
  V l, r;
  if (a == 1 && b == 1) {
    for (sunindextype i = 0; i < n; i += lanes<V>) {
      load(l, left + i);
      load(r, right + i);
      store(sum + i, l + r);
    }
  } else {
    for (sunindextype i = 0; i < n; i += lanes<V>) {
      load(l, left + i);
      load(r, right + i);
      store(sum + i, a * l + b * r);
    }
  }
}

/// z = a x.
template <class V>
GAMUT_INLINE void scaleVector(double a, N_Vector x, N_Vector z) {
  const sunindextype n = NV_LENGTH_S(x);
  const double* values = NV_DATA_S(x);
  double* result = NV_DATA_S(z);
  V value;
  for (sunindextype i = 0; i < n; i += lanes<V>) {
    load(value, values + i);
    store(result + i, a * value);
  }
}

/// z = a[0] x[0] + … , from the left.
template <class V>
GAMUT_INLINE void combineVectors(int count, const double* a, N_Vector* x, N_Vector z) {
  const sunindextype n = NV_LENGTH_S(z);
  double* result = NV_DATA_S(z);
  V sum, value;
  for (sunindextype i = 0; i < n; i += lanes<V>) {
    load(value, NV_DATA_S(x[0]) + i);
    sum = a[0] * value;
    for (int k = 1; k < count; ++k) {
      load(value, NV_DATA_S(x[k]) + i);
      sum = a[k] * value + sum;
    }
    store(result + i, sum);
  }
}

/// z[k] = a[k] x + y[k].
template <class V>
GAMUT_INLINE void addMultiples(int count, const double* a, N_Vector x, N_Vector* y, N_Vector* z) {
  for (int k = 0; k < count; ++k) addVectors<V>(a[k], x, 1, y[k], z[k]);
}

/// What differences in each state are multiplied by: 1 for one as great as the tolerance.
template <class V>
GAMUT_INLINE void weighStates(N_Vector x, N_Vector weights, const Tolerance& tolerance) {
  const sunindextype n = NV_LENGTH_S(x);
  const double* values = NV_DATA_S(x);
  double* weight = NV_DATA_S(weights);
  BitsOf<V> bits;
  V value;
  for (sunindextype i = 0; i < n; i += lanes<V>) {
    load(value, values + i);
    reinterpret(bits, value);
    bits &= ~(std::uint64_t{1} << 63);  // |value|
    reinterpret(value, bits);
    store(weight + i, 1.0 / (tolerance.relative * value + tolerance.absolute));
  }
}

/// The weighted root mean square of one sample.
double normOfOne(N_Vector x, N_Vector weights) {
  const sunindextype n = NV_LENGTH_S(x);
  double sum = 0;
  for (sunindextype i = 0; i < n; ++i) {
    const double product = NV_Ith_S(x, i) * NV_Ith_S(weights, i);
    sum += product * product;
  }
  return std::sqrt(sum / static_cast<double>(n));
}

/// The greatest of the samples' weighted root mean squares; infinite if one of them is no number, so that CVODE turns
/// to a shorter step.
template <class V>
GAMUT_INLINE double greatestNorm(N_Vector x, N_Vector weights) {
  const sunindextype n = NV_LENGTH_S(x);
  const double* values = NV_DATA_S(x);
  const double* weight = NV_DATA_S(weights);
  double sums[packWidth];
  for (int lane = 0; lane < packWidth; lane += lanes<V>) {
    V sum = V{}, value, by;
    for (sunindextype row = lane; row < n; row += packWidth) {
      load(value, values + row);
      load(by, weight + row);
      value = value * by;
      sum = sum + value * value;
    }
    store(sums + lane, sum);
  }
  double greatest = 0;
  for (const double sum : sums)
    if (!(sum <= greatest)) greatest = std::isnan(sum) ? std::numeric_limits<double>::infinity() : sum;
  const auto states = n / packWidth;
  return std::sqrt(greatest / static_cast<double>(states));
}

/// All of them, for one sample or for the packs of one vector unit.
struct Operations {
  void (*add)(double, N_Vector, double, N_Vector, N_Vector);
  void (*scale)(double, N_Vector, N_Vector);
  int (*combine)(int, double*, N_Vector*, N_Vector);
  int (*addMultiples)(int, double*, N_Vector, N_Vector*, N_Vector*);
  double (*norm)(N_Vector, N_Vector);
  void (*weigh)(N_Vector, N_Vector, const Tolerance&);

  void setIn(_generic_N_Vector_Ops& vector) const {
    vector.nvlinearsum = add;
    vector.nvscale = scale;
    vector.nvconst = [](double value, N_Vector z) { std::fill_n(NV_DATA_S(z), NV_LENGTH_S(z), value); };
    vector.nvlinearcombination = combine;
    vector.nvscaleaddmulti = addMultiples;
    vector.nvwrmsnorm = norm;
  }
};

// What is inlined into a function may use the unit that the function names.
#define GAMUT_OPERATIONS(name, unit, V, normOf)                                                          \
  constexpr Operations name = {                                                                          \
      [](double a, N_Vector x, double b, N_Vector y, N_Vector z) unit { addVectors<V>(a, x, b, y, z); }, \
      [](double a, N_Vector x, N_Vector z) unit { scaleVector<V>(a, x, z); },                            \
      [](int count, double* a, N_Vector* x, N_Vector z) unit {                                           \
        combineVectors<V>(count, a, x, z);                                                               \
        return 0;                                                                                        \
      },                                                                                                 \
      [](int count, double* a, N_Vector x, N_Vector* y, N_Vector* z) unit {                              \
        addMultiples<V>(count, a, x, y, z);                                                              \
        return 0;                                                                                        \
      },                                                                                                 \
      [](N_Vector x, N_Vector weights) unit { return normOf(x, weights); },                              \
      [](N_Vector x, N_Vector weights, const Tolerance& t) unit { weighStates<V>(x, weights, t); }}
GAMUT_OPERATIONS(ofOne, , double, normOfOne);
GAMUT_OPERATIONS(ofPackOnBaseline, , Vector2, greatestNorm<Vector2>);
GAMUT_OPERATIONS(ofPackOnAvx2, GAMUT_AVX2, Vector4, greatestNorm<Vector4>);
GAMUT_OPERATIONS(ofPackOnAvx512, GAMUT_AVX512, Vector8, greatestNorm<Vector8>);

/// What CVODE's return means for a motion.
std::string meaningOf(int flag, const std::string& message) {
  switch (flag) {
    case CV_TOO_MUCH_WORK:
      return "it takes more than " + std::to_string(maximumSteps) + " steps between two output times";
    case CV_TOO_MUCH_ACC:
      return "its tolerance is finer than doubles can be";
    case CV_ERR_FAILURE:
    case CV_CONV_FAILURE:
      return std::string(Integration::stepsTooShort);
    case CV_RHSFUNC_FAIL:
    case CV_FIRST_RHSFUNC_ERR:
    case CV_REPTD_RHSFUNC_ERR:
    case CV_UNREC_RHSFUNC_ERR:
      return std::string(Integration::ratesNotFinite);
    default:
      return "the integrator gave up: " + message;
  }
}

}  // namespace

Tolerance Tolerance::tightened(double factor) const {
  return {std::max(relative / factor, std::min(relative, tightest)), absolute / factor};
}

/// In the order in which it is made (and unmade backwards).
struct Cvode::Memory {
  Memory(std::size_t size, const std::vector<double>& outputTimes, const std::atomic<bool>* stop,
         const Operations& vectorOperations)
      : times(outputTimes), cancelled(stop), operations(vectorOperations), state(size) {
    if (size == 0) return;
    if (SUNContext_Create(nullptr, &context) != 0) throw std::runtime_error("SUNDIALS could not make its context");
    x = required(N_VMake_Serial(static_cast<sunindextype>(size), state.data(), context), "state vector");
    operations.setIn(*x->ops);  // clones, CVODE's work vectors, inherit them
  }
  ~Memory() {
    if (cvode != nullptr) CVodeFree(&cvode);
    if (iteration != nullptr) SUNNonlinSolFree(iteration);
    if (linear != nullptr) SUNLinSolFree(linear);
    if (matrix != nullptr) SUNMatDestroy(matrix);
    if (x != nullptr) N_VDestroy(x);
    if (context != nullptr) SUNContext_Free(&context);
  }
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;

  void start(Method method) {
    if (state.empty()) return;
    cvode = required(CVodeCreate(method == Method::adams ? CV_ADAMS : CV_BDF, context), "integrator");
    CVodeSetErrHandlerFn(cvode, &remember, this);
    bool good = CVodeInit(cvode, &derivative, 0, x) == CV_SUCCESS;
    good = good && CVodeSetUserData(cvode, this) == CV_SUCCESS && CVodeWFtolerances(cvode, &weights) == CV_SUCCESS;
    good = good && CVodeSetMaxNumSteps(cvode, maximumSteps) == CV_SUCCESS;
    good = good && CVodeSetMaxHnilWarns(cvode, -1) == CV_SUCCESS;
    if (!times.empty()) good = good && CVodeSetMinStep(cvode, shortestStep * times.back()) == CV_SUCCESS;
    if (method == Method::adams) {
      iteration = required(SUNNonlinSol_FixedPoint(x, 0, context), "functional iteration");
      good = good && CVodeSetNonlinearSolver(cvode, iteration) == CV_SUCCESS;
    } else {
      const auto n = static_cast<sunindextype>(state.size());
      matrix = required(SUNDenseMatrix(n, n, context), "matrix");
      linear = required(SUNLinSol_Dense(x, matrix, context), "linear solver");
      good = good && CVodeSetLinearSolver(cvode, linear, matrix) == CV_SUCCESS;
    }
    if (!good) throw std::runtime_error("SUNDIALS refused its settings: " + message);
  }

  bool restart(const Tolerance& wanted) {
    tolerance = wanted;
    return tolerance.relative >= 0 && tolerance.absolute > 0 && CVodeReInit(cvode, 0, x) == CV_SUCCESS &&
           CVodeSetStopTime(cvode, times.back()) == CV_SUCCESS;
  }

  /// To time t, in steps of which none passes over a whole cell: it ends no later than the cell after the one in which
  /// it begins.
  int advance(double t, std::span<const double> cells) {
    for (long steps = 0; reached < t; ++steps) {
      while (cell + 1 < cells.size() && cells[cell] <= reached) ++cell;
      if (steps == maximumSteps) return CV_TOO_MUCH_WORK;
      if (CVodeSetStopTime(cvode, cells[std::min(cell + 1, cells.size() - 1)]) != CV_SUCCESS) return CV_ILL_INPUT;
      if (const int flag = CVode(cvode, t, x, &reached, CV_ONE_STEP); flag < 0) return flag;
    }
    return CVodeGetDky(cvode, t, 0, x);  // as CVode itself does between steps
  }

  /// Before the first step of a motion whose equations turn. CVODE finds where a function falls from above zero; below
  /// zero it may be by what rounding left of it at the last turn.
  bool startWatching() {
    const std::size_t count = problem->watched();
    last = {state, std::vector<double>(count)};
    problem->watch(0, last.x, last.values);
    values.assign(count, 0);
    fallen.assign(count, 0);
    hasToTurn = false;
    events = shortEvents = 0;
    lastEvent = -times.back();
    halted.clear();
    if (found.size() == count) return true;
    found.assign(count, -1);
    return CVodeRootInit(cvode, static_cast<int>(count), &watchedFunctions) == CV_SUCCESS &&
           CVodeSetRootDirection(cvode, found.data()) == CV_SUCCESS &&
           CVodeSetNoInactiveRootWarn(cvode) == CV_SUCCESS &&
           CVodeSetMaxStep(cvode, longestUnwatched * times.back()) == CV_SUCCESS;
  }

  /// As `advance`, where equations turn. A turn waits for the output times before it, which lie within CVODE's step.
  int follow(double t, std::span<const double> cells) {
    for (long steps = 0; reached < t; ++steps) {
      if (steps == maximumSteps) return CV_TOO_MUCH_WORK;
      if (hasToTurn && !turn(reached, last.x)) return CV_SUCCESS;
      if (times.back() - reached <= nothingLeft * times.back()) {
        state = last.x;
        return CV_SUCCESS;
      }
      while (cell + 1 < cells.size() && cells[cell] <= reached) ++cell;
      const double stop = cells.empty() ? times.back() : cells[std::min(cell + 1, cells.size() - 1)];
      if (CVodeSetStopTime(cvode, stop) != CV_SUCCESS) return CV_ILL_INPUT;
      realtype now = reached;
      const int flag = CVode(cvode, times.back(), x, &now, CV_ONE_STEP);
      if (flag < 0) return flag;
      if (!endStep(now, flag == CV_ROOT_RETURN)) return CV_SUCCESS;
    }
    return CVodeGetDky(cvode, t, 0, x);
  }

  /// A function that was not above zero before the step, and fell, turned where the step began. False if the motion
  /// ends.
  bool endStep(double now, bool hasRoot) {
    problem->watch(now, state, values);
    bool fellAtOnce = false;
    for (std::size_t k = 0; k < values.size(); ++k) {
      fallen[k] = static_cast<char>(values[k] < 0 && last.values[k] <= 0 && values[k] < last.values[k]);
      fellAtOnce = fellAtOnce || fallen[k] != 0;
    }
    if (fellAtOnce) return turn(now, state);
    if (hasRoot) {
      CVodeGetRootInfo(cvode, found.data());
      std::ranges::transform(found, fallen.begin(), [](int root) { return static_cast<char>(root != 0); });
      hasToTurn = true;
    }
    last = {state, values};
    reached = now;
    return true;
  }

  bool turn(double later, std::span<const double> xLater) {
    hasToTurn = false;
    shortEvents = reached - lastEvent <= shortestPhase * times.back() ? shortEvents + 1 : 0;
    lastEvent = reached;
    if (++events > mostEvents || shortEvents > mostShortEvents)
      halted = jumpsWithoutEnd;
    else
      halted = problem->turn(reached, last.x, later, xLater, fallen);
    if (!halted.empty()) return false;
    state = last.x;
    problem->watch(reached, last.x, last.values);
    if (CVodeReInit(cvode, reached, x) == CV_SUCCESS) return true;
    halted = "the integrator gave up: " + message;
    return false;
  }

  bool isCancelled() const { return cancelled != nullptr && *cancelled; }

  bool tookTooLong() {
    if (++evaluations % evaluationsBetweenLooks == 0) isLate = static_cast<double>(Work::counted() - began) >= allowed;
    return isLate;
  }

  static int derivative(realtype t, N_Vector x, N_Vector dx, void* self) {
    Memory& memory = *static_cast<Memory*>(self);
    if (memory.isCancelled() || memory.tookTooLong()) return -1;
    const std::size_t n = memory.state.size();
    const std::span<double> rates(NV_DATA_S(dx), n);
    memory.problem->differentiate(t, std::span<const double>(NV_DATA_S(x), n), rates);
    return allFinite(rates) ? 0 : 1;
  }

  static int weights(N_Vector x, N_Vector w, void* self) {
    const Memory& memory = *static_cast<Memory*>(self);
    memory.operations.weigh(x, w, memory.tolerance);
    return 0;
  }

  static int watchedFunctions(realtype t, N_Vector x, realtype* values, void* self) {
    Memory& memory = *static_cast<Memory*>(self);
    memory.problem->watch(t, std::span<const double>(NV_DATA_S(x), memory.state.size()),
                          std::span<double>(values, memory.found.size()));
    return 0;
  }

  static void remember(int, const char*, const char*, char* text, void* self) {
    static_cast<Memory*>(self)->message = text;
  }

  const std::vector<double> times;
  const std::atomic<bool>* cancelled;
  const Operations& operations;
  Tolerance tolerance;
  std::vector<double> state;
  CvodeProblem* problem = nullptr;  // while it is integrated
  std::string message;
  std::uint64_t began = 0;  // by the clock of work
  double allowed = 0;
  long evaluations = 0;
  realtype reached = 0;  // by steps; the first cell that does not end before it
  std::size_t cell = 0;
  bool isLate = false;
  struct {
    std::vector<double> x, values;
  } last;                      // at the end of the last step, or at the last turn
  std::vector<double> values;  // of the watched functions
  std::vector<char> fallen;
  std::vector<int> found;
  bool hasToTurn = false;  // at the end of the last step
  int events = 0, shortEvents = 0;
  double lastEvent = 0;
  std::string halted;  // why the equations do not turn
  SUNContext context = nullptr;
  N_Vector x = nullptr;
  void* cvode = nullptr;
  SUNNonlinearSolver iteration = nullptr;
  SUNMatrix matrix = nullptr;
  SUNLinearSolver linear = nullptr;
};

Cvode::Cvode(std::size_t states, const std::vector<double>& times, Method method, const std::atomic<bool>* cancelled)
    : memory_(std::make_unique<Memory>(states, times, cancelled, ofOne)) {
  memory_->start(method);
}

Cvode::Cvode(std::size_t states, const std::vector<double>& times, VectorUnit unit, const std::atomic<bool>* cancelled)
    : memory_(std::make_unique<Memory>(states * packWidth, times, cancelled,
                                       unit == VectorUnit::avx512 ? ofPackOnAvx512
                                       : unit == VectorUnit::avx2 ? ofPackOnAvx2
                                                                  : ofPackOnBaseline)) {
  memory_->start(Method::adams);
}

Cvode::~Cvode() = default;
Cvode::Cvode(Cvode&&) noexcept = default;
Cvode& Cvode::operator=(Cvode&&) noexcept = default;

Integration Cvode::integrate(CvodeProblem& problem, std::span<const double> x, const Tolerance& tolerance,
                             std::span<const double> cells, double seconds) {
  Memory& m = *memory_;
  const std::vector<double>& times = m.times;
  if (x.size() != m.state.size()) throw std::invalid_argument("the initial values do not have the problem's size");
  std::ranges::copy(x, m.state.begin());
  m.message.clear();
  m.problem = &problem;
  m.began = Work::counted();
  m.allowed = seconds * Work::perSecond;
  m.evaluations = 0;
  m.isLate = false;
  m.reached = 0;
  m.cell = 0;
  const bool moves = !x.empty();
  int flag = !moves || times.empty() || times.back() == 0 || m.restart(tolerance) ? CV_SUCCESS : CV_ILL_INPUT;
  const bool turns = moves && !times.empty() && times.back() > 0 && problem.watched() > 0;
  if (turns && flag >= 0 && !m.startWatching()) flag = CV_ILL_INPUT;
  bool isFinite = true;
  Integration result;
  for (std::size_t i = 0; i < times.size() && flag >= 0 && isFinite; ++i) {
    realtype t = times[i];
    // Output between steps is CVODE's interpolant, of the order of the step itself.
    if (moves && times[i] > 0)
      flag = turns           ? m.follow(times[i], cells)
             : cells.empty() ? CVode(m.cvode, times[i], m.x, &t, CV_NORMAL)
                             : m.advance(times[i], cells);
    const bool isHalted = turns && !m.halted.empty();
    result.reached = isHalted || (flag < 0 && (turns || !cells.empty())) ? m.reached : t;
    if (isHalted) result.why = m.halted;
    if (flag < 0 || isHalted) break;
    isFinite = problem.observe(i, t, m.state);
    if (isFinite) result.times = i + 1;
  }
  if (flag < 0 || !isFinite)
    result.why = m.isCancelled() ? "cancelled"
                 : m.isLate      ? "the time limit of " + toString(seconds) + " s CPU for a sample was reached"
                 : flag < 0      ? meaningOf(flag, m.message)
                                 : problem.whatIsNotFinite();
  return result;
}

}  // namespace gamut
