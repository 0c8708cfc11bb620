// The four-bar linkage of tests/mechanics/four_bar.hpp as a study, and its crank's motion by hand.
#pragma once

#include <string>
#include <vector>

#include "scalars/program/program.hpp"
#include "scalars/recorded.hpp"
#include "tests/mechanics/four_bar.hpp"

namespace gamut::testing {

/// The lengths of tests/mechanics/four_bar.hpp, the horizon in s.
inline std::string fourBarText(const std::string& horizon, const std::string& uncertain, const std::string& pin = "",
                               const std::string& coupler = "angle = -0.5") {
  const auto hinge = [](const std::string& name, const std::string& from, const std::string& to,
                        const std::string& initial) {
    return "[[mechanism.element]]\ntype = \"revolute\"\nname = \"" + name + "\"\nfrom = \"" + from + "\"\nto = \"" +
           to + "\"\naxis = \"z\"\ninitial = { " + initial + " }\n";
  };
  const auto link = [](const std::string& name, const std::string& from, const std::string& to,
                       const std::string& length) {
    return "[[mechanism.element]]\ntype = \"link\"\nname = \"" + name + "\"\nfrom = \"" + from + "\"\nto = \"" + to +
           "\"\nvector = [\"" + length + "\", 0, 0]\n";
  };
  const auto mass = [](const std::string& name, const std::string& at, const std::string& numbers) {
    return "[[mechanism.element]]\ntype = \"mass\"\nname = \"" + name + "\"\nat = \"" + at + "\"\n" + numbers + "\n";
  };
  return "[study]\nanalysis = \"dynamics\"\nhorizon = " + horizon + "\noutput_step = " + horizon +
         "\ncompare = [\"interval\", \"stochastic\"]\n[stochastic]\nsamples = 64\n"
         "[mechanism]\ngravity = [0, \"-9.81\", 0]\n"
         "parameters = { a = \"0.3 m\", b = \"0.8 m\", c = \"0.6 m\", d = \"0.9 m\" }\n" +
         hinge("A", "inertial", "K1", "angle = 1, rate = 4") +
         mass("crank", "K1", "mass = 1\ncentre = [\"0.15\", 0, 0]\ninertia = [\"0.0075\", \"0.0075\", \"0.0075\"]") +
         link("ab", "K1", "PB", "a") + hinge("B", "PB", "K2", coupler) +
         mass("coupler", "K2", "mass = 2\ncentre = [\"0.4\", \"0.1\", 0]\ninertia = [\"0.1\", \"0.1\", \"0.1\"]") +
         link("bc", "K2", "C1", "b") + link("ground", "inertial", "PD", "d") + hinge("D", "PD", "K3", "angle = 1.6") +
         mass("rocker", "K3", "mass = 1.5\ncentre = [\"0.3\", 0, 0]\ninertia = [\"0.05\", \"0.05\", \"0.05\"]") +
         link("dc", "K3", "C2", "c") +
         "[[mechanism.element]]\ntype = \"closure\"\nname = \"C\"\nas = \"pin\"\nfrom = \"C2\"\nto = \"C1\"\n" + pin +
         "\n" + uncertain + "[[output]]\nquantity = \"A.angle\"\n[[output]]\nquantity = \"A.rate\"\n" +
         "[[output]]\nquantity = \"C1.position.x\"\n[[output]]\nquantity = \"C2.position.y\"\n";
}

inline std::string uncertain(const std::vector<std::string>& quantities, const std::string& interval) {
  std::string text;
  for (const std::string& quantity : quantities)
    text += "[[uncertain]]\nquantity = \"" + quantity + "\"\ninterval = \"" + interval + "\"\n";
  return text;
}

inline Recorded decimal(const char* number) { return constant<Recorded>(Interval(number)); }

/// θ, θ̇ by lengths.
inline Program byHand() {
  return record(2, 4, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = fourBarByHand<Recorded>(x[0], x[1], {p[0], p[1], p[2], p[3]}, decimal).acceleration;
  });
}

}  // namespace gamut::testing
