// The natural cubic spline through a table, as a function of time with its two derivatives: a polynomial of degree 3
// from row to row, with a continuous second derivative that is 0 at both ends; before and behind the table it goes on
// along a straight line.
//
// With M_i the second derivative at row i, h_i = t_{i+1} − t_i, D_i = (M_{i+1} − M_i)/h_i and v_i the rate at row i:
//
//   c_i = max(0, t − t_i) − max(0, t − t_{i+1})                       how much of piece i has gone by
//   q̈ = Σ D_i c_i     q̇ = v_0 + Σ (M_i c_i + ½ D_i c_i²)
//   q = y_0 + v_0 min(0, t − t_0) + Σ (v_i c_i + ½ M_i c_i² + ⅙ D_i c_i³) + v_n max(0, t − t_n)
//
// The M_i are solved for in doubles and then taken as they are; v_i follow from them exactly. So derivatives are those
// of q without an error, and q passes through the table but for rounding. (C. de Boor, A Practical Guide to Splines,
// 1978, chapter IV.)
#pragma once

#include <array>
#include <vector>

#include "mechanics/description/time_table.hpp"
#include "scalars/interval.hpp"
#include "scalars/traits.hpp"

namespace gamut {

class CubicSpline {
 public:
  explicit CubicSpline(const TimeTable& table);

  /// q, q̇, q̈ at t [s].
  template <class S>
  std::array<S, 3> at(const S& t) const {
    using std::abs;
    const auto number = [](const Interval& value) { return constant<S>(value); };
    const auto since = [&](const Interval& time) {  // max(0, t − time)
      const S u = t - number(time);
      return S(S(0.5) * (u + abs(u)));
    };
    S begun = since(pieces_.front().start);
    const S early = t - number(pieces_.front().start) - begun;
    S q = number(first_) + number(pieces_.front().rate) * early, rate = number(pieces_.front().rate), second(0.0);
    for (const Piece& piece : pieces_) {
      const S ended = since(piece.end), c = begun - ended;
      const S m = number(piece.second), d = number(piece.third);
      q = q + c * (number(piece.rate) + c * (S(0.5) * m + c * (d * number(sixth()))));
      rate = rate + c * (m + c * (S(0.5) * d));
      second = second + c * d;
      begun = ended;
    }
    return {S(q + number(lastRate_) * begun), rate, second};
  }

 private:
  /// From one row to the next, with the derivatives at the first of them.
  struct Piece {
    Interval start, end, rate, second, third;
  };
  static Interval sixth() { return Interval(1.0) / Interval(6.0); }

  std::vector<Piece> pieces_;
  Interval first_, lastRate_;
};

}  // namespace gamut
