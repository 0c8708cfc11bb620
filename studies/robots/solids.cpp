// With d from the common centre to that of a part, Steiner:  I = Σ (Iᵢ + mᵢ (|d|² 1 − d dᵀ)).
#include "studies/robots/solids.hpp"

#include <algorithm>

#include "mechanics/rotation.hpp"

namespace gamut {
namespace {

using Matrix = Matrix3<Interval>;
using Vector = Vector3<Interval>;

bool isZero(const Interval& x) { return isEqual(x, Interval(0.0)); }

Rotation<Interval> rotationOf(const Robot::Place& place) {
  std::vector<Robot::Turn> turns = {{axisZ, 0, place.rpy[2]}, {axisY, 0, place.rpy[1]}, {axisX, 0, place.rpy[0]}};
  if (place.turns) turns = *place.turns;
  Rotation<Interval> rotation;
  for (const Robot::Turn& turn : turns) {
    if (turn.quaternion) {
      const auto& e = *turn.quaternion;
      const Interval length = sqrt(sqr(e[0]) + sqr(e[1]) + sqr(e[2]) + sqr(e[3]));
      rotation = rotation.then(
          Rotation<Interval>(Quaternion<Interval>{e[0] / length, e[1] / length, e[2] / length, e[3] / length}));
    } else if (turn.quarterTurns % 4 != 0 || !isZero(turn.angle)) {
      rotation = rotation.then(Rotation<Interval>(turn.axis, turn.angle, turn.quarterTurns));
    }
  }
  return rotation;
}

Matrix matrixOf(const std::array<Interval, 6>& entries) {
  const auto& [xx, yy, zz, xy, yz, zx] = entries;
  Matrix matrix;
  matrix << xx, xy, zx, xy, yy, yz, zx, yz, zz;
  return matrix;
}

std::array<Interval, 6> entriesOf(const Matrix& m) { return {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(1, 2), m(2, 0)}; }

/// |d|² 1 − d dᵀ
std::array<Interval, 6> steiner(const std::array<Interval, 3>& d) {
  const Interval xx = sqr(d[0]), yy = sqr(d[1]), zz = sqr(d[2]);
  return {yy + zz, zz + xx, xx + yy, -(d[0] * d[1]), -(d[1] * d[2]), -(d[2] * d[0])};
}

}  // namespace

Interval volumeOf(const Solid& solid) {
  const auto& [a, b, c] = solid.size;
  const Interval ball = Interval(4.0) * pi() / Interval(3.0);
  switch (solid.form) {
    case Solid::Form::sphere:
      return ball * pow(a, 3);
    case Solid::Form::capsule:
      return Interval(2.0) * pi() * sqr(a) * b + ball * pow(a, 3);
    case Solid::Form::cylinder:
      return Interval(2.0) * pi() * sqr(a) * b;
    case Solid::Form::ellipsoid:
      return ball * a * b * c;
    case Solid::Form::box:
      break;
  }
  return Interval(8.0) * a * b * c;
}

std::array<Interval, 3> momentsOf(const Solid& solid) {
  const auto& [a, b, c] = solid.size;
  switch (solid.form) {
    case Solid::Form::sphere: {
      const Interval moment = Interval(2.0) * sqr(a) / Interval(5.0);
      return {moment, moment, moment};
    }
    case Solid::Form::capsule: {
      // Of 1 kg the ends have 4r / (4r + 6h), the middle 6h / (4r + 6h). Half a ball has its centre 3r/8 from its
      // plane, and two of them, h apart from the middle, have 2r²/5 + h² + 3hr/4 about an axis across.
      const Interval whole = Interval(4.0) * a + Interval(6.0) * b;
      const Interval ends = Interval(4.0) * a / whole, middle = Interval(6.0) * b / whole;
      const Interval ball = Interval(2.0) * sqr(a) / Interval(5.0);
      const Interval across = middle * (Interval(3.0) * sqr(a) + Interval(4.0) * sqr(b)) / Interval(12.0) +
                              ends * (ball + sqr(b) + Interval(3.0) * a * b / Interval(4.0));
      return {across, across, middle * sqr(a) / Interval(2.0) + ends * ball};
    }
    case Solid::Form::cylinder: {
      const Interval across = (Interval(3.0) * sqr(a) + Interval(4.0) * sqr(b)) / Interval(12.0);
      return {across, across, sqr(a) / Interval(2.0)};
    }
    case Solid::Form::ellipsoid:
      return {(sqr(b) + sqr(c)) / Interval(5.0), (sqr(c) + sqr(a)) / Interval(5.0), (sqr(a) + sqr(b)) / Interval(5.0)};
    case Solid::Form::box:
      break;
  }
  return {(sqr(b) + sqr(c)) / Interval(3.0), (sqr(c) + sqr(a)) / Interval(3.0), (sqr(a) + sqr(b)) / Interval(3.0)};
}

void Composed::add(const Interval& mass, const Solid& solid, const std::vector<Robot::Place>& places) {
  const std::array<Interval, 3> moments = momentsOf(solid);
  add(mass, {0.0, 0.0, 0.0}, {mass * moments[0], mass * moments[1], mass * moments[2], 0.0, 0.0, 0.0}, places);
}

void Composed::add(const Interval& mass, const Solid& solid, const std::array<Interval, 3>& centre,
                   const std::array<Interval, 3>& along, const std::vector<Robot::Place>& places) {
  // I = Iₓ 1 + (I_z − Iₓ) u uᵀ of the unit vector u along it.
  const std::array<Interval, 3> moments = momentsOf(solid);
  const Interval across = mass * moments[0], more = mass * (moments[2] - moments[0]);
  const Interval square = sqr(along[0]) + sqr(along[1]) + sqr(along[2]);
  const auto part = [&](std::size_t i, std::size_t j) {
    return more * (i == j ? sqr(along[i]) : along[i] * along[j]) / square;
  };
  add(mass, centre, {across + part(0, 0), across + part(1, 1), across + part(2, 2), part(0, 1), part(1, 2), part(2, 0)},
      places);
}

void Composed::add(const Interval& mass, std::array<Interval, 3> centre, std::array<Interval, 6> inertia,
                   const std::vector<Robot::Place>& places) {
  for (auto place = places.rbegin(); place != places.rend(); ++place) {
    const Rotation<Interval> rotation = rotationOf(*place);
    Vector at = rotation.toParent(Vector(centre[0], centre[1], centre[2]));
    for (int i = 0; i < 3; ++i) centre[static_cast<std::size_t>(i)] = place->xyz[static_cast<std::size_t>(i)] + at[i];
    if (!rotation.isNone()) inertia = entriesOf(rotation.symmetricToParent(matrixOf(inertia)));
  }
  parts_.push_back({mass, centre, inertia});
}

std::optional<Robot::Inertial> Composed::inertial() const {
  Robot::Inertial whole;
  std::array<Interval, 3> moment = {0.0, 0.0, 0.0};
  std::size_t heavy = 0;
  for (const Part& part : parts_) {
    if (isZero(part.mass)) continue;
    ++heavy;
    whole.mass += part.mass;
    for (std::size_t i = 0; i < 3; ++i) moment[i] += part.mass * part.centre[i];
  }
  if (heavy == 0) return {};
  for (const Part& part : parts_) {
    if (isZero(part.mass)) continue;
    if (heavy == 1) {
      whole.place.xyz = part.centre;
      whole.inertia = part.inertia;
    }
  }
  if (heavy == 1) return whole;
  for (std::size_t i = 0; i < 3; ++i) whole.place.xyz[i] = moment[i] / whole.mass;
  for (const Part& part : parts_) {
    if (isZero(part.mass)) continue;
    std::array<Interval, 3> apart;
    for (std::size_t i = 0; i < 3; ++i) apart[i] = part.centre[i] - whole.place.xyz[i];
    const std::array<Interval, 6> shifted = steiner(apart);
    for (std::size_t i = 0; i < 6; ++i) whole.inertia[i] += part.inertia[i] + part.mass * shifted[i];
  }
  return whole;
}

}  // namespace gamut
