// CVODE behind a pointer, so that nobody else includes SUNDIALS.
#include "analyses/witness.hpp"

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

#include "scalars/evaluator.hpp"

namespace gamut {
namespace {

constexpr long maximumSteps = 2'000'000;  // between two output times: only a motion that goes nowhere needs more
constexpr double shortestStep = 1e-13;    // of the horizon: below, the motion runs into a singularity
constexpr double tightest = 1e-14;        // relative tolerance, some 50 roundings

template <class Handle>
Handle required(Handle handle, const char* what) {
  if (handle == nullptr) throw std::runtime_error(std::string("SUNDIALS could not make its ") + what);
  return handle;
}

bool allFinite(std::span<const double> values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

/// z = a x + b y. CVODE's prediction adds some eighty short vectors a step; without the library's dispatch on special
/// coefficients a double pendulum's motion costs 30 % less.
void addVectors(realtype a, N_Vector x, realtype b, N_Vector y, N_Vector z) {
  const sunindextype n = NV_LENGTH_S(x);
  const realtype* left = NV_DATA_S(x);
  const realtype* right = NV_DATA_S(y);
  realtype* sum = NV_DATA_S(z);
  if (a == 1 && b == 1)
    for (sunindextype i = 0; i < n; ++i) sum[i] = left[i] + right[i];
  else
    for (sunindextype i = 0; i < n; ++i) sum[i] = a * left[i] + b * right[i];
}

}  // namespace

void Motion::check() const {
  if (f.outputs() != f.states()) throw std::invalid_argument("a motion needs one derivative for each state");
  if (g.states() != f.states() || g.parameters() != f.parameters())
    throw std::invalid_argument("the outputs of a motion need the states and parameters of its derivatives");
  if (g.outputs() == 0) throw std::invalid_argument("a motion without outputs shows nothing");
  for (std::size_t i = 0; i < times.size(); ++i)
    if (!(times[i] >= 0) || !std::isfinite(times[i]) || (i > 0 && times[i] <= times[i - 1]))
      throw std::invalid_argument("output times must rise from 0 or later");
}

Tolerance Tolerance::tightened(double factor) const {
  return {std::max(relative / factor, std::min(relative, tightest)), absolute / factor};
}

/// CVODE's memory, in the order in which it is made (and unmade backwards).
struct Witness::Solver {
  Solver(const Motion& m, Method method, const std::atomic<bool>* stop)
      : motion(m), f(m.f), g(m.g), state(static_cast<std::size_t>(m.f.states())), cancelled(stop) {
    if (state.empty()) return;
    if (SUNContext_Create(nullptr, &context) != 0) throw std::runtime_error("SUNDIALS could not make its context");
    x = required(N_VMake_Serial(static_cast<sunindextype>(state.size()), state.data(), context), "state vector");
    x->ops->nvlinearsum = addVectors;  // clones, CVODE's work vectors, inherit it
    cvode = required(CVodeCreate(method == Method::adams ? CV_ADAMS : CV_BDF, context), "integrator");
    CVodeSetErrHandlerFn(cvode, &remember, this);
    bool good = CVodeInit(cvode, &derivative, 0, x) == CV_SUCCESS;
    good = good && CVodeSetUserData(cvode, this) == CV_SUCCESS && CVodeSStolerances(cvode, 1e-10, 1e-12) == CV_SUCCESS;
    good = good && CVodeSetMaxNumSteps(cvode, maximumSteps) == CV_SUCCESS;
    good = good && CVodeSetMaxHnilWarns(cvode, -1) == CV_SUCCESS;
    if (!m.times.empty()) good = good && CVodeSetMinStep(cvode, shortestStep * m.times.back()) == CV_SUCCESS;
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
  ~Solver() {
    if (cvode != nullptr) CVodeFree(&cvode);
    if (iteration != nullptr) SUNNonlinSolFree(iteration);
    if (linear != nullptr) SUNLinSolFree(linear);
    if (matrix != nullptr) SUNMatDestroy(matrix);
    if (x != nullptr) N_VDestroy(x);
    if (context != nullptr) SUNContext_Free(&context);
  }
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;

  static int derivative(realtype t, N_Vector x, N_Vector dx, void* self) {
    Solver& solver = *static_cast<Solver*>(self);
    if (solver.cancelled != nullptr && *solver.cancelled) return -1;
    const std::size_t n = solver.state.size();
    const std::span<double> rate(N_VGetArrayPointer(dx), n);
    solver.f(t, std::span<const double>(N_VGetArrayPointer(x), n), rate);
    // A rate that is no number makes CVODE try a shorter step.
    return allFinite(rate) ? 0 : 1;
  }

  static void remember(int, const char*, const char*, char* text, void* self) {
    static_cast<Solver*>(self)->message = text;
  }

  const Motion& motion;
  Evaluator<double> f, g;
  std::vector<double> state;
  const std::atomic<bool>* cancelled;
  std::string message;
  SUNContext context = nullptr;
  N_Vector x = nullptr;
  void* cvode = nullptr;
  SUNNonlinearSolver iteration = nullptr;
  SUNMatrix matrix = nullptr;
  SUNLinearSolver linear = nullptr;
};

Witness::Witness(const Motion& motion, Method method, const std::atomic<bool>* cancelled)
    : solver_(std::make_unique<Solver>(motion, method, cancelled)) {}
Witness::~Witness() = default;
Witness::Witness(Witness&&) noexcept = default;
Witness& Witness::operator=(Witness&&) noexcept = default;

Integration Witness::integrate(std::span<const double> start, const Tolerance& tolerance,
                               std::span<double> trajectory) {
  Solver& s = *solver_;
  const std::vector<double>& times = s.motion.times;
  const std::size_t n = s.state.size();
  const std::size_t m = s.motion.outputs();
  if (start.size() != s.motion.startValues() || trajectory.size() != times.size() * m)
    throw std::invalid_argument("start values or trajectory do not have the motion's size");
  std::fill(trajectory.begin(), trajectory.end(), std::numeric_limits<double>::quiet_NaN());
  s.f.setParameters(start.subspan(n));
  s.g.setParameters(start.subspan(n));
  std::copy_n(start.begin(), n, s.state.begin());
  s.message.clear();

  bool good = true;
  if (n > 0 && !times.empty() && times.back() > 0)
    good = CVodeReInit(s.cvode, 0, s.x) == CV_SUCCESS &&
           CVodeSStolerances(s.cvode, tolerance.relative, tolerance.absolute) == CV_SUCCESS &&
           CVodeSetStopTime(s.cvode, times.back()) == CV_SUCCESS;
  Integration result;
  for (std::size_t i = 0; i < times.size() && good; ++i) {
    realtype t = times[i];
    // Output between steps is CVODE's interpolant, of the order of the step itself.
    if (n > 0 && times[i] > 0) good = CVode(s.cvode, times[i], s.x, &t, CV_NORMAL) >= 0;
    result.reached = t;
    if (!good) break;
    const std::span<double> outputs = trajectory.subspan(i * m, m);
    s.g(t, s.state, outputs);
    if (!allFinite(outputs)) {
      std::ranges::fill(outputs, std::numeric_limits<double>::quiet_NaN());
      s.message = "an output is not finite";
      good = false;
      break;
    }
    result.times = i + 1;
  }
  if (!good) {
    if (s.cancelled != nullptr && *s.cancelled)
      result.why = "cancelled";
    else
      result.why = s.message.empty() ? "CVODE failed" : s.message;
  }
  return result;
}

}  // namespace gamut
