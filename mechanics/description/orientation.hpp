// Orientations as users give them: axis and angle, roll, pitch and yaw, or a quaternion; as formulas of their numbers.
#pragma once

#include <string>
#include <vector>

#include "mechanics/description/fields.hpp"
#include "mechanics/quaternion.hpp"

namespace gamut {

/// How files say them.
inline const std::string orientationForms =
    "`[{ axis, angle }, …]` one after the other, one alone, `{ roll, pitch, yaw }` or `{ quaternion = [w, x, y, z] }`";

/// By yaw about z, then pitch about the new y, then roll about the new x [rad]: R = Rz(yaw) Ry(pitch) Rx(roll), as in
/// URDF. Their numbers are called so.
std::vector<FixedRotation> rollPitchYaw(const Expression& roll = 0.0, const Expression& pitch = 0.0,
                                        const Expression& yaw = 0.0);

/// That of a quaternion of any length.
FixedRotation byQuaternion(const Quaternion<Expression>& e);

/// e / |e|.
Quaternion<Expression> normalised(const Quaternion<Expression>& e);

/// The unit quaternion of fixed rotations, one after the other.
Quaternion<Expression> quaternionOf(const std::vector<FixedRotation>& rotations);

}  // namespace gamut
