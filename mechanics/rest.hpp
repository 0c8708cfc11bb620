// A mechanism at rest, and how it vibrates about there, as functions of its free parameters.
//
// With v = [q; z; λ], coordinates, own states and multipliers of loops, and the rows of motion R(v, v̇, v̈)
// (mechanics/rest_rows.hpp), rest is R(v, 0, 0) = 0. What is near to it moves as v + φ e^(st) with
//
//   (F_0 + s F_1 + s² F_2) φ = 0,   F_0 = ∂R/∂v, F_1 = ∂R/∂v̇, F_2 = ∂R/∂v̈ at rest
//
// (F. Tisseur & K. Meerbergen, The quadratic eigenvalue problem, SIAM Review 43, 2001). A pair s = −ζω ± iω√(1−ζ²) is a
// mode: frequency ω/2π, damping ratio ζ. Position and damped modes are roots of equations that hold the parameters:
// families (analyses/roots), each about a centre that Newton's steps from the nominal root write down. Where nothing
// damps, ω² are the eigenvalues of a symmetric pencil, and counted in their order (mechanics/rest_vibration.hpp).
#pragma once

#include <complex>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "mechanics/description/mechanism.hpp"
#include "mechanics/rest_damped_mode.hpp"
#include "mechanics/rest_rows.hpp"
#include "mechanics/rest_vibration.hpp"
#include "scalars/interval.hpp"
#include "scalars/program/program.hpp"
#include "scalars/recorded.hpp"
#include "scalars/samples.hpp"

namespace gamut {

class Rest {
 public:
  /// Of a program of parameters one that comes near to it over their box, and is simpler to bound; by so many terms,
  /// as a share of those that are well afforded.
  using Approximation = std::function<Program(const Program& steps, double share)>;

  /// The rest that the mechanism comes to from its initial position as if through honey; `parameters`: the box of the
  /// free ones, `modes`: those that are wanted, 1 the slowest. Throws UnfitPart where there is none, where it is not
  /// one position, and as RestRows does.
  Rest(const Mechanism& mechanism, const std::vector<std::string>& freeParameters, const Box& parameters,
       const std::set<int>& modes, const Approximation& approximated);

  /// Newton's maps of position and damped modes, of what each leaves open as states. Parameters: those of the
  /// mechanism; of modes what the position leaves open besides.
  const std::vector<Program>& families() const { return families_; }
  /// Of undamped modes; none where none is wanted, or something damps.
  const std::optional<RestVibration>& vibration() const { return vibration_; }
  const RestRows& rows() const { return rows_; }
  /// Of each coordinate, at the nominal values: by what its acceleration alone is resisted, kg m² or kg.
  std::vector<double> ownInertias() const;
  /// Of wanted modes, where something damps or forces have no potential.
  const std::vector<DampedMode>& damped() const { return damped_; }
  /// While recording: w of the kth of these, at these remainders (all there are) and parameters.
  std::vector<Recorded> dampedAt(std::size_t k, std::span<const Recorded> remainders,
                                 std::span<const Recorded> parameters) const;
  /// v of the parameters, then of what the position leaves open.
  const Program& position() const { return position_; }
  /// How many numbers all this leaves open: of the families, then of each undamped mode what is added to its ω²,
  /// rad²/s², and between which two numbers that lies.
  int remainders() const;

  struct Found {
    std::vector<Recorded> state;                 ///< x = [q; u; z], in the order of Mechanism::stateNames()
    std::map<std::string, Recorded> known;       ///< frequency.1 [Hz], damping.1 …, of wanted modes
    std::map<std::string, std::string> unknown;  ///< of those that have none: why
  };
  /// While recording: at these remainders and parameters. Undamped ω² as what is near to it and what is added to that,
  /// or besides, `withinEnds`, kept between their two numbers: intervals then know most, polynomials less.
  Found at(std::span<const Recorded> remainders, std::span<const Recorded> parameters, bool withinEnds = false) const;
  /// What samples leave open, to their rounding: by Newton's steps and eigenvalues of their own.
  std::vector<Samples> remaindersAt(const std::vector<Samples>& parameters) const;

 private:
  void takePosition(const Approximation& approximated);
  void takeDampedModes(const std::set<int>& modes, const Approximation& approximated);
  std::vector<Recorded> centreAt(std::size_t family, std::span<const Recorded> parameters) const;
  void recordSampled();

  RestRows rows_;
  std::vector<double> values_, nominal_, unit_;  // of parameters; of the last is what is left open of v
  std::vector<std::complex<double>> modes_;
  std::vector<DampedMode> damped_;
  std::optional<RestVibration> vibration_;
  std::vector<Program> centres_, families_;
  Program position_, sampled_;
};

}  // namespace gamut
