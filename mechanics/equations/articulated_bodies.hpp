// Accelerations of a tree of bodies by as many operations a joint, however many there are: articulated-body inertia
// (Featherstone, Rigid Body Dynamics Algorithms, 2008, chapter 7), as MOBILE's third level, the transmission of
// inertia.
//
// One motion with u̇ = 0 gives every force that remains, f. Inwards, each joint with motion s per unit u̇ and the inertia
// M behind it gives way: with U = M s and D = s·U, its u̇ = (Q + s·f − U·α)/D in terms of the acceleration α that it is
// carried with, so that in front of it M becomes M − U Uᵀ/D, and f becomes f − U (Q + s·f)/D. Outwards, α follows. Each
// pivot subtracts what joints further out take away, so that bounds grow with every joint: for samples, not for
// enclosures (sparse_equations.hpp).
#pragma once

#include <array>
#include <functional>
#include <stdexcept>
#include <unordered_map>
#include <vector>

#include "mechanics/element.hpp"

namespace gamut {

namespace detail {

template <class S>
using Spatial = std::array<Vector3<S>, 2>;  // angular, linear

template <class S>
S dot(const Spatial<S>& a, const Spatial<S>& b) {
  return a[0].dot(b[0]) + a[1].dot(b[1]);
}

/// M s.
template <class S>
Spatial<S> times(const SpatialInertia<S>& m, const Spatial<S>& s) {
  return {m.angular * s[0] + m.coupling * s[1], m.coupling.transpose() * s[0] + m.linear * s[1]};
}

/// The one component (0 … 5) in which s is known not to be zero, if the others are known zeros; -1 if there is none.
template <class S>
int onlyComponent(const Spatial<S>& s) {
  int only = -1;
  for (int i = 0; i < 6; ++i) {
    const S& component = s[i / 3][i % 3];
    if (isKnownZero(component)) continue;
    if (only >= 0 || !isKnownNonzero(component)) return -1;
    only = i;
  }
  return only;
}

/// M − U Uᵀ/D with G = U/D. Where the joint moves along one component, nothing of that component is left.
template <class S>
void giveWay(SpatialInertia<S>& m, const Spatial<S>& u, const Spatial<S>& g, int component) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const auto left = [&](const S& entry, int row, int column) {
        const bool isFreed = row == component || column == component;
        const auto at = [](const Spatial<S>& x, int k) { return x[k / 3][k % 3]; };
        return isFreed ? S(0.0) : S(entry - at(u, row) * at(g, column));
      };
      m.coupling(i, j) = left(m.coupling(i, j), i, 3 + j);
      if (j < i) continue;
      m.angular(j, i) = m.angular(i, j) = left(m.angular(i, j), i, j);
      m.linear(j, i) = m.linear(i, j) = left(m.linear(i, j), 3 + i, 3 + j);
    }
}

}  // namespace detail

/// u̇ of `speeds` at their present rates and positions; the chain has been moved with u̇ = 0. Changes accelerations and
/// forces of all frames. Throws std::domain_error, naming the speed, if one is known to move no inertia. Long, since
/// the three passes of the algorithm share what they find.
template <class S>
std::vector<S> articulatedAccelerations(const std::vector<std::reference_wrapper<Speed<S>>>& speeds, Chain<S>& chain,
                                        Frame<S>& base) {
  using detail::Spatial;
  struct Joint {
    Speed<S>* speed;
    Spatial<S> motion, g;
    S free;  // u̇ if the joint is not carried along
  };
  std::unordered_map<const Frame<S>*, SpatialInertia<S>> behind;
  std::unordered_map<const Element<S>*, std::vector<Joint>> joints;
  std::unordered_map<const Speed<S>*, std::size_t> number;
  for (std::size_t i = 0; i < speeds.size(); ++i) number[&speeds[i].get()] = i;

  base.clearForces();
  chain.clearForces();
  std::vector<Transmission<S>*> transmissions;
  for (auto element = chain.elements().rbegin(); element != chain.elements().rend(); ++element)
    if (auto* transmission = dynamic_cast<Transmission<S>*>(*element))
      transmissions.push_back(transmission);
    else
      (*element)->doForce();
  std::unordered_map<const Speed<S>*, S> reflected;
  for (const Inertia<S>* inertia : chain.inertias()) {
    behind[&inertia->frame()] += inertia->spatial();
    for (const auto& [speed, resistance] : inertia->reflected()) {
      const auto [at, isFirst] = reflected.emplace(speed, resistance);
      if (!isFirst) at->second = at->second + resistance;
    }
  }

  for (Transmission<S>* transmission : transmissions) {
    Frame<S>& to = transmission->to();
    SpatialInertia<S>& m = behind[&to];
    std::vector<Speed<S>*> own = transmission->speeds();
    std::erase_if(own, [&](const Speed<S>* speed) { return !number.contains(speed); });
    for (auto speed = own.rbegin(); speed != own.rend(); ++speed) {
      transmission->from().omegaDot = transmission->from().a = zeroVector<S>();
      for (Speed<S>* each : transmission->speeds()) each->acceleration = S(each == *speed ? 1.0 : 0.0);
      transmission->doMotion(MotionLevel::acceleration);
      const Spatial<S> motion = {to.omegaDot, to.a};
      const Spatial<S> u = detail::times(m, motion);
      const auto rotor = reflected.find(*speed);
      const S ofBodies = detail::dot(motion, u), d = rotor == reflected.end() ? ofBodies : S(ofBodies + rotor->second);
      if (isKnownZero(d)) throw std::domain_error("the variable " + (*speed)->name + " moves no mass");
      const S inverse = S(1.0) / d;
      const S free = ((*speed)->force + detail::dot(motion, {to.tau, to.f})) * inverse;
      const Spatial<S> g = {Vector3<S>(u[0] * inverse), Vector3<S>(u[1] * inverse)};
      joints[transmission].push_back({*speed, motion, g, free});
      const int component = rotor == reflected.end() ? detail::onlyComponent(motion) : -1;
      detail::giveWay(m, u, g, component);
      to.tau -= u[0] * free;
      to.f -= u[1] * free;
      if (component >= 0)  // s·f = −Q is what is left
        (component < 3 ? to.tau : to.f)[component % 3] = S(-((*speed)->force / motion[component / 3][component % 3]));
    }
    const bool isInmost = transmission->from().origin == nullptr;
    transmission->doForce();
    if (!isInmost) behind[&transmission->from()] += transmission->inFrom(m);
  }

  std::vector<S> result(speeds.size(), S(0.0));
  for (Speed<S>& speed : speeds) speed.acceleration = S(0.0);
  base.omegaDot = base.a = zeroVector<S>();
  for (Element<S>* element : chain.elements()) {
    element->doMotion(MotionLevel::acceleration);
    const auto found = joints.find(element);
    if (found == joints.end()) continue;
    Frame<S>& to = static_cast<Transmission<S>*>(element)->to();
    for (auto joint = found->second.rbegin(); joint != found->second.rend(); ++joint) {
      const S acceleration = joint->free - detail::dot(joint->g, {to.omegaDot, to.a});
      result[number.at(joint->speed)] = acceleration;
      to.omegaDot += joint->motion[0] * acceleration;
      to.a += joint->motion[1] * acceleration;
    }
  }
  return result;
}

}  // namespace gamut
