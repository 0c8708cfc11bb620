// A force on a joint's coordinate that follows from its position and rate, and what is measured of it.
#pragma once

#include <string>
#include <utility>

#include "mechanics/assembler.hpp"

namespace gamut {

template <class S, class Law>
class CoordinateLoad final : public Load<S> {
 public:
  CoordinateLoad(Variable<S>& variable, Law law) : variable_(variable), law_(std::move(law)) {}

  S force() const { return law_(variable_); }
  S power() const { return force() * variable_.rate; }

 private:
  void applyForce() override { variable_.force += force(); }

  Variable<S>& variable_;
  Law law_;
};

inline void describeCoordinateLoad(Fields& f, Coordinate kind) {
  f.measure({"force", forceUnitOf(kind), "in the direction in which the coordinate grows"});
  f.measure({"power", "W", "that it brings in"});
}

/// law(variable) is the force on the coordinate.
template <class S, class Law>
void addCoordinateLoad(Assembler<S>& a, const std::string& joint, Law law) {
  const auto& load = a.template add<CoordinateLoad<S, Law>>(a.coordinate(joint), std::move(law));
  a.measure("force", [&load] { return load.force(); });
  a.measure("power", [&load] { return load.power(); });
}

}  // namespace gamut
