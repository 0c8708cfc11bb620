// About an axis u by the angle φ: e = (cos φ/2, u sin φ/2).
#include "mechanics/description/orientation.hpp"

#include "scalars/interval.hpp"

namespace gamut {

std::vector<FixedRotation> rollPitchYaw(const Expression& roll, const Expression& pitch, const Expression& yaw) {
  return {{axisZ, 0, yaw, "yaw"}, {axisY, 0, pitch, "pitch"}, {axisX, 0, roll, "roll"}};
}

FixedRotation byQuaternion(const Quaternion<Expression>& e) {
  FixedRotation rotation;
  rotation.quaternion = e;
  return rotation;
}

Quaternion<Expression> normalised(const Quaternion<Expression>& e) {
  const Expression length = sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2] + e[3] * e[3]);
  return {e[0] / length, e[1] / length, e[2] / length, e[3] / length};
}

Quaternion<Expression> quaternionOf(const std::vector<FixedRotation>& rotations) {
  Quaternion<Expression> whole = {1.0, 0.0, 0.0, 0.0};
  for (const FixedRotation& rotation : rotations) {
    if (rotation.quaternion) {
      whole = product(whole, normalised(*rotation.quaternion));
      continue;
    }
    const Expression half = Expression(0.5) * rotation.angle + Interval(rotation.quarterTurns) * pi() / Interval(4.0);
    const std::array<Interval, 3> u = rotation.axis.enclosure();
    whole = product(whole, {cos(half), u[0] * sin(half), u[1] * sin(half), u[2] * sin(half)});
  }
  return whole;
}

}  // namespace gamut
