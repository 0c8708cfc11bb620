// IDA's memory, and one motion after another in it.
#include "analyses/samples/implicit_witness.hpp"

#include <ida/ida.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "analyses/samples/sundials.hpp"
#include "analyses/work.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "scalars/index.hpp"

namespace gamut {
namespace {

using namespace detail;

/// What IDA's return means for a motion.
std::string meaningOfIda(int flag, const std::string& message) {
  switch (flag) {
    case IDA_TOO_MUCH_WORK:
      return "it takes more than " + std::to_string(maximumSteps) + " steps between two output times";
    case IDA_TOO_MUCH_ACC:
      return "its tolerance is finer than doubles can be";
    case IDA_ERR_FAIL:
    case IDA_CONV_FAIL:
    case IDA_LSETUP_FAIL:
    case IDA_LSOLVE_FAIL:
      return "its steps became too short, as where the motion runs into a singularity";
    default:
      return "the integrator gave up: " + message;
  }
}

}  // namespace

/// In the order in which it is made (and unmade backwards).
struct ImplicitWitness::Solver {
  Solver(const ImplicitMotion& m, const std::atomic<bool>* stop)
      : motion(m),
        cancelled(stop),
        r(m.r),
        g(m.g),
        n(m.isAlgebraic.size()),
        y(n),
        dy(n),
        kind(n),
        absolute(n),
        both(2 * n) {
    if (at(m.r.states()) != 2 * n || at(m.r.outputs()) != n || at(m.g.states()) != n ||
        m.g.parameters() != m.r.parameters() || n == 0)
      throw std::invalid_argument("an implicit motion needs an equation for each of its unknowns");
    std::ranges::transform(m.isAlgebraic, kind.begin(), [](bool is) { return is ? 0.0 : 1.0; });
    if (SUNContext_Create(nullptr, &context) != 0) throw std::runtime_error("SUNDIALS could not make its context");
    const auto size = static_cast<sunindextype>(n);
    unknowns = required(N_VMake_Serial(size, y.data(), context), "state vector");
    rates = required(N_VMake_Serial(size, dy.data(), context), "vector of rates");
    kinds = required(N_VMake_Serial(size, kind.data(), context), "vector of kinds");
    tolerances = required(N_VMake_Serial(size, absolute.data(), context), "vector of tolerances");
    ida = required(IDACreate(context), "integrator");
    IDASetErrHandlerFn(ida, &remember, this);
    matrix = required(SUNDenseMatrix(size, size, context), "matrix");
    linear = required(SUNLinSol_Dense(unknowns, matrix, context), "linear solver");
    const bool good = IDAInit(ida, &residual, 0, unknowns, rates) == IDA_SUCCESS &&
                      IDASetUserData(ida, this) == IDA_SUCCESS && IDASStolerances(ida, 1e-6, 1e-6) == IDA_SUCCESS &&
                      IDASetId(ida, kinds) == IDA_SUCCESS && IDASetSuppressAlg(ida, SUNTRUE) == IDA_SUCCESS &&
                      IDASetMaxNumSteps(ida, maximumSteps) == IDA_SUCCESS &&
                      IDASetLinearSolver(ida, linear, matrix) == IDA_SUCCESS;
    if (!good) throw std::runtime_error("SUNDIALS refused its settings: " + message);
  }
  ~Solver() {
    if (linear != nullptr) SUNLinSolFree(linear);
    if (matrix != nullptr) SUNMatDestroy(matrix);
    if (ida != nullptr) IDAFree(&ida);
    for (N_Vector vector : {tolerances, kinds, rates, unknowns})
      if (vector != nullptr) N_VDestroy(vector);
    if (context != nullptr) SUNContext_Free(&context);
  }
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;

  bool isCancelled() const { return cancelled != nullptr && *cancelled; }

  /// Finds what is consistent at the start: coarsely first, for how large algebraic unknowns are is not known before.
  /// These are then told to a part of the greatest.
  int begin(const Tolerance& tolerance) {
    constexpr double coarse = 1e-6;
    const double first = motion.times.front() > 0 ? motion.times.front() : motion.times.at(1);
    std::ranges::fill(absolute, coarse);
    for (const double relative : {coarse, tolerance.relative}) {
      if (IDAReInit(ida, 0, unknowns, rates) != IDA_SUCCESS ||
          IDASVtolerances(ida, relative, tolerances) != IDA_SUCCESS ||
          IDASetStopTime(ida, motion.times.back()) != IDA_SUCCESS)
        return IDA_ILL_INPUT;
      if (const int flag = IDACalcIC(ida, IDA_YA_YDP_INIT, first); flag != IDA_SUCCESS) return flag;
      if (const int flag = IDAGetConsistentIC(ida, unknowns, rates); flag != IDA_SUCCESS) return flag;
      double greatest = 0;
      for (std::size_t i = 0; i < n; ++i)
        if (kind[i] == 0) greatest = std::max(greatest, std::abs(y[i]));
      for (std::size_t i = 0; i < n; ++i)
        absolute[i] = std::max(tolerance.absolute, kind[i] == 0 ? tolerance.relative * greatest : 0);
    }
    return IDA_SUCCESS;
  }

  static int residual(realtype t, N_Vector at, N_Vector ratesAt, N_Vector out, void* self) {
    Solver& s = *static_cast<Solver*>(self);
    if (s.isCancelled()) return -1;
    std::copy_n(NV_DATA_S(at), s.n, s.both.begin());
    std::copy_n(NV_DATA_S(ratesAt), s.n, s.both.begin() + static_cast<std::ptrdiff_t>(s.n));
    const std::span<double> rows(NV_DATA_S(out), s.n);
    s.r(t, s.both, rows);
    Work::count(Work::aloneOperation, s.ofRows);
    return allFinite(rows) ? 0 : 1;
  }

  static void remember(int, const char*, const char*, char* text, void* self) {
    static_cast<Solver*>(self)->message = text;
  }

  const ImplicitMotion& motion;
  const std::atomic<bool>* cancelled;
  Evaluator<double> r, g;
  const double ofRows = motion.r.operations();
  std::size_t n;
  std::vector<double> y, dy, kind, absolute, both;
  std::string message;
  SUNContext context = nullptr;
  N_Vector unknowns = nullptr, rates = nullptr, kinds = nullptr, tolerances = nullptr;
  void* ida = nullptr;
  SUNMatrix matrix = nullptr;
  SUNLinearSolver linear = nullptr;
};

ImplicitWitness::ImplicitWitness(const ImplicitMotion& motion, const std::atomic<bool>* cancelled)
    : solver_(std::make_unique<Solver>(motion, cancelled)) {}
ImplicitWitness::~ImplicitWitness() = default;
ImplicitWitness::ImplicitWitness(ImplicitWitness&&) noexcept = default;
ImplicitWitness& ImplicitWitness::operator=(ImplicitWitness&&) noexcept = default;

Integration ImplicitWitness::integrate(std::span<const double> start, std::span<const double> parameters,
                                       const Tolerance& tolerance, std::span<double> values) {
  Solver& s = *solver_;
  const std::vector<double>& times = s.motion.times;
  const std::size_t outputs = at(s.motion.g.outputs());
  if (start.size() != s.n || values.size() != times.size() * outputs)
    throw std::invalid_argument("start or values do not have the motion's size");
  std::ranges::fill(values, std::numeric_limits<double>::quiet_NaN());
  std::ranges::copy(start, s.y.begin());
  std::ranges::fill(s.dy, 0.0);
  s.r.setParameters(parameters);
  s.g.setParameters(parameters);
  s.message.clear();
  Integration result;
  const bool moves = !times.empty() && times.back() > 0;
  int flag = moves ? s.begin(tolerance) : IDA_SUCCESS;
  bool isFinite = true;
  for (std::size_t i = 0; i < times.size() && flag >= 0 && isFinite; ++i) {
    realtype t = times[i];
    if (t > 0) flag = IDASolve(s.ida, times[i], &t, s.unknowns, s.rates, IDA_NORMAL);
    result.reached = t;
    if (flag < 0) break;
    const std::span<double> row = values.subspan(i * outputs, outputs);
    s.g(t, s.y, row);
    isFinite = allFinite(row);
    if (isFinite)
      result.times = i + 1;
    else
      std::ranges::fill(row, std::numeric_limits<double>::quiet_NaN());
  }
  if (flag < 0 || !isFinite)
    result.why = s.isCancelled() ? "cancelled" : flag < 0 ? meaningOfIda(flag, s.message) : "an output is not finite";
  return result;
}

}  // namespace gamut
