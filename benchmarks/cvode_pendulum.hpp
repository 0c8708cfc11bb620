// The double pendulum as one CVODE problem a sample, as somebody would write it who has this one machine: equations by
// hand, in doubles; one memory, begun anew for every sample; Adams's method with functional iteration. For the same
// accuracy dense Newton iteration takes as long or up to a tenth longer, Anderson's a tenth longer, BDF twice as
// long.
#pragma once

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <stdexcept>
#include <vector>

#include "analyses/samples/cvode.hpp"
#include "benchmarks/double_pendulum.hpp"

namespace gamut::benchmarks {

/// Who adds and scales the states: SUNDIALS' serial vectors, which a distribution may have compiled without optimising
/// (Debian 12), or loops over just four states, compiled as the rest of this program.
enum class Vectors { ofLibrary, ofFour };

/// Integrates one sample after another. One a thread.
class CvodePendulum {
 public:
  CvodePendulum(const Tolerance& tolerance, Vectors vectors) : tolerance_(tolerance) {
    if (SUNContext_Create(nullptr, &context_) != 0) throw std::runtime_error("SUNDIALS could not make its context");
    x_ = N_VMake_Serial(4, state_.data(), context_);
    if (vectors == Vectors::ofFour) useFour(*x_->ops);
    if (vectors == Vectors::ofLibrary) N_VEnableFusedOps_Serial(x_, SUNTRUE);
    cvode_ = CVodeCreate(CV_ADAMS, context_);
    iteration_ = SUNNonlinSol_FixedPoint(x_, 0, context_);
    const bool good = CVodeInit(cvode_, &rates, 0, x_) == CV_SUCCESS && CVodeSetUserData(cvode_, this) == CV_SUCCESS &&
                      (vectors == Vectors::ofFour
                           ? CVodeWFtolerances(cvode_, &weights)
                           : CVodeSStolerances(cvode_, tolerance.relative, tolerance.absolute)) == CV_SUCCESS &&
                      CVodeSetMaxNumSteps(cvode_, 100'000) == CV_SUCCESS &&
                      CVodeSetNonlinearSolver(cvode_, iteration_) == CV_SUCCESS;
    if (!good) throw std::runtime_error("SUNDIALS refused its settings");
  }
  ~CvodePendulum() {
    CVodeFree(&cvode_);
    SUNNonlinSolFree(iteration_);
    N_VDestroy(x_);
    SUNContext_Free(&context_);
  }
  CvodePendulum(const CvodePendulum&) = delete;
  CvodePendulum& operator=(const CvodePendulum&) = delete;

  /// trajectory: the four states at the first output time, then at the next.
  void integrate(std::span<const double> start, const std::vector<double>& times, std::span<double> trajectory) {
    std::ranges::copy(start, state_.begin());
    bool good = CVodeReInit(cvode_, 0, x_) == CV_SUCCESS && CVodeSetStopTime(cvode_, times.back()) == CV_SUCCESS;
    for (std::size_t i = 0; i < times.size() && good; ++i) {
      realtype t = 0;
      good = CVode(cvode_, times[i], x_, &t, CV_NORMAL) >= 0;
      std::ranges::copy(state_, trajectory.begin() + static_cast<std::ptrdiff_t>(4 * i));
    }
    if (!good) throw std::runtime_error("CVODE gave up");
  }

 private:
  struct Rates {
    double* rate;
    double& operator[](std::size_t i) const { return rate[i]; }
  };

  static int rates(realtype, N_Vector x, N_Vector dx, void*) {
    Rates result{NV_DATA_S(dx)};
    doublePendulum(9.81, NV_DATA_S(x), result);
    return 0;
  }

  static int weights(N_Vector x, N_Vector w, void* self) {
    const auto [relative, absolute] = static_cast<CvodePendulum*>(self)->tolerance_;
    for (int i = 0; i < 4; ++i) NV_Ith_S(w, i) = 1 / (relative * std::abs(NV_Ith_S(x, i)) + absolute);
    return 0;
  }

  /// The operations that this method spends its time in.
  static void useFour(_generic_N_Vector_Ops& operations) {
    operations.nvlinearsum = [](realtype a, N_Vector x, realtype b, N_Vector y, N_Vector z) {
      for (int i = 0; i < 4; ++i) NV_Ith_S(z, i) = a * NV_Ith_S(x, i) + b * NV_Ith_S(y, i);
    };
    operations.nvscale = [](realtype a, N_Vector x, N_Vector z) {
      for (int i = 0; i < 4; ++i) NV_Ith_S(z, i) = a * NV_Ith_S(x, i);
    };
    operations.nvconst = [](realtype a, N_Vector z) { std::fill_n(NV_DATA_S(z), 4, a); };
    operations.nvwrmsnorm = [](N_Vector x, N_Vector w) {
      double sum = 0;
      for (int i = 0; i < 4; ++i) sum += NV_Ith_S(x, i) * NV_Ith_S(w, i) * (NV_Ith_S(x, i) * NV_Ith_S(w, i));
      return std::sqrt(sum / 4);
    };
    operations.nvlinearcombination = [](int count, realtype* a, N_Vector* x, N_Vector z) {
      std::array<double, 4> sum{};
      for (int k = 0; k < count; ++k)
        for (std::size_t i = 0; i < 4; ++i) sum[i] += a[k] * NV_DATA_S(x[k])[i];
      std::ranges::copy(sum, NV_DATA_S(z));
      return 0;
    };
    operations.nvscaleaddmulti = [](int count, realtype* a, N_Vector x, N_Vector* y, N_Vector* z) {
      for (int k = 0; k < count; ++k)
        for (int i = 0; i < 4; ++i) NV_Ith_S(z[k], i) = a[k] * NV_Ith_S(x, i) + NV_Ith_S(y[k], i);
      return 0;
    };
  }

  Tolerance tolerance_;
  std::array<double, 4> state_{};
  SUNContext context_ = nullptr;
  N_Vector x_ = nullptr;
  void* cvode_ = nullptr;
  SUNNonlinearSolver iteration_ = nullptr;
};

}  // namespace gamut::benchmarks
