// Loops that close as triangles do, in closed form. Two joints of a loop in a plane, or one and a rod, leave three
// points at known distances, two of which are where the rest of the machine puts them. In complex numbers of the plane,
// with z, z' the directions of what hinges turn, s the path of a slide along the direction d, l the length of a rod:
//
//   two hinges            z a + z' b = e
//   a hinge and a rod     |z a − e| = l
//   a hinge and a slide   z a = c + d s
//   a slide on a hinge    z (c + d s) = e
//   a slide and a rod     |c + d s| = l
//
// Of r = z a with |e − r| = l (that is |b| of two hinges), and of |c + d s| = l (|a| and |e|) with |d| = 1:
//
//   r = (m + i n) e    m = (1 + (|a|² − l²)/|e|²)/2    n² = |a|²/|e|² − m²
//   s = n − c·d        n² = l² − (c × d)²
//
// The sign of n tells both ways of assembly apart; where n is 0 the machine is at a dead point.
// Source: A. Kecskeméthy, T. Krupp, M. Hiller, Multibody System Dynamics 1 (1997), 23 (pairs of joints).
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "mechanics/element.hpp"

namespace gamut {

/// A hinge as a triangle has put it.
template <class S>
struct PlacedHinge {
  Variable<S>* angle;
  S cosine, sine;
};

/// Of double, to learn how a machine is assembled, and of Recorded.
template <class S>
class Triangle {
 public:
  virtual ~Triangle() = default;

  /// Of a loop that `closing` closes by these coordinates, the joints of which are in `chain`; null where it is none by
  /// its structure.
  static std::unique_ptr<Triangle> of(const Constraint<S>& closing, std::span<Variable<S>* const> by,
                                      const Chain<S>& chain);

  /// What the closed form is made of, as the last motion left it: dependent coordinates must have no part in it. Empty
  /// where the loop is not known to be in a plane.
  virtual std::vector<S> given() = 0;
  /// After given(): n, by the joints' positions, in parts of the side |a| or of l.
  virtual S side() const = 0;
  /// After given(): l² and what sides leave of the sum of both others, or l of the slide's distance |c × d|: above
  /// zero, all of them, just where this is a triangle, of which no side is zero and n is not.
  virtual std::vector<S> margins() const = 0;
  /// After given(): puts the joints to where the loop is closed, with n of this sign.
  virtual void place(double side) = 0;
  /// Its hinges as they were put last.
  virtual const std::vector<PlacedHinge<S>>& placed() const = 0;
  /// The joints stand by their coordinates again.
  virtual void release() = 0;
};

extern template class Triangle<double>;
extern template class Triangle<Recorded>;

}  // namespace gamut
