// How a box is written in symbols ξ ∈ [-1,1]^k: which components get one, and which part of [-1,1] a sub-box covers.
#pragma once

#include <string>
#include <vector>

#include "analyses/flow/flow.hpp"
#include "analyses/flow/series/embedded.hpp"
#include "analyses/flow/series/monomials.hpp"
#include "analyses/flow/series/polynomial_range.hpp"
#include "analyses/flow/step/set.hpp"
#include "scalars/interval.hpp"

namespace gamut {

/// Which box components get a symbol, and how a component is written in it.
struct Embedding {
  std::vector<Embedded> components;  ///< one a box component
  int symbols = 0;
  double widest = 0;  ///< greatest half-width relative to its centre, at most 1

  /// `inputs` vary in time and have no symbol: parameters, behind `states` initial values.
  /// The last `dependent` initial values follow from the others, `remainders` are what such functions leave open: they
  /// have none either.
  /// `weights`: of Emphasis, for all wide components in order; the width of one of weight 0 is carried as rounding is.
  /// Without weights every one gets a symbol.
  Embedding(const Box& box, int states, const std::vector<VaryingParameter>& inputs,
            const std::vector<int>& weights = {}, int dependent = 0, const std::vector<int>& remainders = {});
  explicit Embedding(const Box& box) : Embedding(box, 0, {}) {}

  /// Of a thin box: its components as they are known.
  void takeDigitsOf(const std::vector<PreciseValue>& values);
};

/// The part of [-1,1] of each symbol that a sub-box covers on a piece ξ_study = centre + half·ξ; false if none.
bool restrictTo(const Box& level, const Embedding& embedding, const std::vector<double>& centre,
                const std::vector<double>& half, Box& xi);

/// Where the polynomial whose range was found last, on such a piece, is extreme.
OutputExtremes extremesOf(const PolynomialRange& range, const Box& box, const Embedding& embedding,
                          const std::vector<double>& centre, const std::vector<double>& half);

/// A symbol of this weight is kept to its first power, without products.
inline constexpr int mostWeight = 16;

/// How much of a polynomial's variation is in terms that hold a symbol, of the polynomial where that is most.
struct Influence {
  double any = 0, nonlinear = 0;  ///< in all such terms; in those of more than the first order
};

/// Raises `influence`, one for each of the first symbols, to what they have in this polynomial.
void measureInfluence(const double* polynomial, const Monomials& m, std::vector<Influence>& influence);

/// How symbols are to be treated.
struct Emphasis {
  std::vector<int> weights;  ///< one a symbol (Monomials), 1 for those that matter most; 0: no symbol
  double effective = 0;      ///< so many symbols of equal influence would count as much

  bool isUniform() const;
};

/// A symbol whose nonlinear terms have less than
/// `negligible` of what the greatest have is kept to fewer powers; those that together have less than five times
/// `negligible` of the `share` that a remainder may have get weight 0.
Emphasis emphasisOf(const std::vector<Influence>& influence, double negligible, double share);

/// The degrees that a flow may use for symbols of these weights: higher ones only as needed, and no more monomials than
/// pay; of pieces that are not bisected on the way up to `fixedDegree`, if that is not 0.
std::vector<int> degreeLadder(const std::vector<int>& weights, int fixedDegree = 0);
/// How many monomials there are in symbols of these weights, up to that degree.
double countOfMonomials(const std::vector<int>& weights, int degree);
/// Of the frame of such a piece: what it cuts off is what errors grow by.
int frameDegreeOfFixed(const std::vector<int>& weights, int degree);
/// Of the frame, for so many symbols of weight 1.
int automaticFrameDegree(int symbols, int degree);

/// The set of n states at the start, without second doubles.
FlowSet startOf(const Embedding& embedding, int n, const Monomials& monomials, int frameDegree);

/// Throws std::invalid_argument unless the condition holds.
void requireThat(bool condition, const std::string& what);
/// Throws std::invalid_argument unless the box is bounded and every level lies in the one before, the first in the box.
void requireNested(const Box& box, const std::vector<Box>& levels);
/// Throws std::runtime_error unless this thread rounds to nearest and keeps subnormal numbers, as the flow's bounds
/// ask.
void requireNearest();

}  // namespace gamut
