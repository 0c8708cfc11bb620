// Work: what is computed, counted. What decides how much of something is computed is counted so, not timed: two runs
// then do the same on any machine, with any number of threads, however busy it is.
#pragma once

#include <cstddef>
#include <cstdint>

namespace gamut {

/// A clock of the calling thread that goes on by what it computes. Whoever gives work to other threads adds what they
/// counted once they have ended (forEachIndex does), so that differences of the clock are the work of all.
class Work {
 public:
  /// What is counted; work.cpp has the units of each. A unit is about a nanosecond of the machine on which they were
  /// measured: on another one the same work takes another time.
  enum Kind : std::uint32_t {
    convolvedRow,      ///< of a product of two series: a pair of monomials, eight orders with eight
    seriesProduct,     ///< of a product of two series: a pair of monomials, eight orders with eight, all at once
    multipliedPair,    ///< of a product of polynomials: a pair of monomials
    coefficient,       ///< of series: a coefficient that is computed, stored or bounded
    boundedNode,       ///< of a certificate: a node
    matrixTerm,        ///< of matrices and linear systems: a multiplication
    columnTerm,        ///< of matrices with many columns: a multiplication
    rangeTerm,         ///< of a polynomial's range: a coefficient and symbol, on each part
    cellTerm,          ///< of cells of the box: a coefficient of a polynomial there
    transformed,       ///< of distributions: a number in each level of a transform
    bin,               ///< of distributions: a bin of a quantity, or ten steps of the output
    focalElement,      ///< of distributions that are not known exactly: an element, or a box of a copula
    quickEdge,         ///< of a distribution whose function is a short formula: that at an edge of a bin
    preciseEdge,       ///< of any other one, or of the first kind where it is not known exactly
    vagueEdge,         ///< of any other one that is not known exactly
    momentTerm,        ///< of Sobol' indices: a pair of terms and a symbol
    evaluatedTerm,     ///< of a surrogate: a term at a sample
    sampledOperation,  ///< of samples: an operation of the equations or outputs, of a pack
    sampledState,      ///< of samples: a state that the integrator steps, of a pack
    aloneOperation,    ///< the same of a sample by itself
    aloneState,
    kinds
  };
  /// What a second is worth on that machine.
  static constexpr double perSecond = 1e9;

  static std::uint64_t counted() { return clock_; }
  static void count(Kind kind, double number) {
    clock_ += static_cast<std::uint64_t>(unitsOf[kind] * number);
#ifdef GAMUT_WORK_PROFILE
    numbers[kind] += number;
#endif
  }
  /// What so much will be.
  static double of(Kind kind, double number) { return unitsOf[kind] * number; }
  /// What other threads counted.
  static void add(std::uint64_t units) { clock_ += units; }
  /// While one lives nothing is counted: what a thread makes for itself, of which there is more with more threads.
  class Aside {
   public:
    Aside() = default;
    ~Aside() { clock_ = before_; }
    Aside(const Aside&) = delete;
    Aside& operator=(const Aside&) = delete;

   private:
    const std::uint64_t before_ = clock_;
  };
#ifdef GAMUT_WORK_PROFILE
  static inline double numbers[kinds] = {};
#endif

 private:
  static const double unitsOf[kinds];
  static inline constinit thread_local std::uint64_t clock_ = 0;
};

}  // namespace gamut
