// An arm of six turning joints like a PUMA, and all its postures in closed form.
#pragma once

#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace gamut::testing {

template <class S>
struct Turn {
  S w, x, y, z;
  friend Turn operator*(const Turn& a, const Turn& b) {
    return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
            a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
  }
};

/// Place of the wrist and turn of the hand of an arm like a PUMA: shoulder about z, upper arm and forearm about y,
/// three axes z, y, z that meet in the wrist. Lengths p0 … p3 in m.
template <class S>
std::pair<std::array<S, 3>, Turn<S>> hand(const std::vector<S>& q, const std::vector<S>& p) {
  using std::cos, std::sin;
  const S both = q[1] + q[2];
  const S reach = p[0] * cos(q[1]) + p[1] * cos(both) + p[2] * sin(both);
  const S height = p[2] * cos(both) - p[0] * sin(q[1]) - p[1] * sin(both);
  const auto aboutZ = [](const S& a) { return Turn<S>{cos(S(0.5) * a), S(0.0), S(0.0), sin(S(0.5) * a)}; };
  const auto aboutY = [](const S& a) { return Turn<S>{cos(S(0.5) * a), S(0.0), sin(S(0.5) * a), S(0.0)}; };
  return {{cos(q[0]) * reach - sin(q[0]) * p[3], sin(q[0]) * reach + cos(q[0]) * p[3], height},
          aboutZ(q[0]) * aboutY(both) * aboutZ(q[3]) * aboutY(q[4]) * aboutZ(q[5])};
}

/// All 8, of numbers of many digits: the shoulder on either side, both elbows, the wrist turned over.
template <class N>
std::vector<std::vector<N>> posturesOf(const std::vector<N>& p) {
  const N turn = 8 * atan(N(1));
  const auto wrapped = [&](const N& angle) { return N(angle - turn * round(angle / turn)); };
  const N px = p[4], py = p[5], pz = p[6];
  const Turn<N> goal{p[7], p[8], p[9], p[10]};
  std::vector<std::vector<N>> postures;
  for (const int shoulder : {1, -1}) {
    const N reach = shoulder * sqrt(px * px + py * py - p[3] * p[3]);
    const N q0 = atan2(py, px) - atan2(p[3], reach);
    // reach = a cos q1 + l cos(q1 + q2 - β), -height = a sin q1 + l sin(q1 + q2 - β), l² = p1² + p2², tan β = p2 / p1
    const N l = sqrt(p[1] * p[1] + p[2] * p[2]), beta = atan2(p[2], p[1]);
    const N c = (reach * reach + pz * pz - p[0] * p[0] - l * l) / (2 * p[0] * l);
    for (const int elbow : {1, -1}) {
      const N bend = elbow * acos(c);
      const N q1 = atan2(-pz, reach) - atan2(l * sin(bend), p[0] + l * cos(bend)), q2 = bend + beta;
      const auto half = [](const N& a) { return std::pair{cos(a / 2), sin(a / 2)}; };
      const auto [cy, sy] = half(-(q1 + q2));
      const auto [cz, sz] = half(-q0);
      const Turn<N> rest = Turn<N>{cy, 0, sy, 0} * Turn<N>{cz, 0, 0, sz} * goal;
      // aboutZ(a) aboutY(b) aboutZ(c) = (cos b/2 cos (a+c)/2, -sin b/2 sin (a-c)/2, sin b/2 cos (a-c)/2, cos b/2 sin
      // ...)
      const N b = 2 * atan2(sqrt(rest.x * rest.x + rest.y * rest.y), sqrt(rest.w * rest.w + rest.z * rest.z));
      const N sum = atan2(rest.z, rest.w), difference = atan2(-rest.x, rest.y);
      for (const int over : {1, -1}) {
        const N flip = over == 1 ? N(0) : N(turn / 2);
        postures.push_back({wrapped(q0), wrapped(q1), wrapped(q2), wrapped(sum + difference + flip), over * b,
                            wrapped(sum - difference + flip)});
      }
    }
  }
  return postures;
}

}  // namespace gamut::testing
