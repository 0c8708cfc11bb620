#include "mechanics/elements/motor.hpp"

#include "mechanics/elements/coordinate_load.hpp"
#include "mechanics/rotors.hpp"

namespace gamut {

void Motor::describe(Fields& f) {
  const Coordinate kind = f.coordinateOf({"joint", "", "the joint, or one of its coordinates"}, joint);
  f.signal({"moment", "N m", "on the rotor; an expression of time and of the motion"}, moment);
  f.number(
      {"ratio", kind == Coordinate::angle ? "1" : "rad/m", "turns of the rotor by those of the joint; 1 unless given"},
      ratio);
  f.number({"inertia", "kg m^2", "of the rotor about its axis, gear included"}, inertia);
  f.number({"friction", "N m s/rad", "viscous, on the rotor"}, friction);
  describeCoordinateLoad(f, kind);
  f.drawsMotor(joint);
  f.measureMotion({"rate", "rad/s", "of the rotor; `moment` may depend on it"});
}

template <class S>
void Motor::assemble(Assembler<S>& a) const {
  const S n = a.number(ratio), d = a.number(friction);
  const Variable<S>& turned = a.coordinate(joint);
  addCoordinateLoad(
      a, joint, [n, d, given = a.signal(moment)](const Variable<S>& q) { return S(n * (given() - d * (n * q.rate))); });
  a.measure("rate", [&turned, n] { return S(n * turned.rate); });
  a.template add<ReflectedInertia<S>>(a.coordinate(joint), S(a.number(inertia) * square(n)));
}

std::vector<Fault> Motor::faults(const RangeOf& rangeOf) const {
  if (rangeOf(inertia).upper() >= 0) return {};
  return {{"inertia", "the rotor of '" + name + "' has a negative inertia", "an inertia of at least 0 kg m^2"}};
}

GAMUT_ASSEMBLE(Motor)

}  // namespace gamut
