// Results as a study of a swinging pendulum would give them, made from formulas: narrow bands around a large motion,
// widening with time. The tests break them one by one.
#pragma once

#include "studies/results/results.hpp"

namespace gamut::example {

/// `times` output times over 3 s, `outputs` outputs, every analysis present and in agreement.
Results pendulum(std::size_t times = 61, std::size_t outputs = 2, std::size_t levels = 11);

/// One position of a mechanism: time {0}, horizon 0, plain intervals beside the polynomial enclosure.
Results kinematics();

/// pendulum() with a machine to look at: two hinged rods with masses and a spring to the ground, that swing in the
/// plane of y and z, or, `isSpatial`, leave it; seen at so many times.
Results machine(bool isSpatial = false, std::size_t seen = 7);

/// pendulum() of two quantities, "first angle" and "<mass>", with all that is known of its statistics' confidence and
/// of whose doing its spread is: the first angle's at the start, the mass's from 1.5 s on.
Results sensitive();

}  // namespace gamut::example
