// Studies of machines that anyone may write, run to the end: the samples arrive and lie inside a tight guarantee.
#include <gmock/gmock.h>

#include <array>

#include "studies/running/run.hpp"
#include "studies/study.hpp"

namespace gamut {
namespace {

struct StudiedMachine {
  std::string name;
  std::string text;
  double overestimation;
};

std::string hinge(const std::string& name, const std::string& from, const std::string& to, const std::string& axis,
                  const std::string& initial) {
  return "[[mechanism.element]]\ntype = \"revolute\"\nname = \"" + name + "\"\nfrom = \"" + from + "\"\nto = \"" + to +
         "\"\naxis = \"" + axis + "\"\ninitial = { " + initial + " }\n";
}

std::string link(const std::string& name, const std::string& from, const std::string& to, const std::string& vector) {
  return "[[mechanism.element]]\ntype = \"link\"\nname = \"" + name + "\"\nfrom = \"" + from + "\"\nto = \"" + to +
         "\"\nvector = " + vector + "\n";
}

std::string mass(const std::string& name, const std::string& at, const std::string& rest) {
  return "[[mechanism.element]]\ntype = \"mass\"\nname = \"" + name + "\"\nat = \"" + at + "\"\n" + rest + "\n";
}

std::string head(double horizon) {
  return "[study]\nanalysis = \"dynamics\"\nhorizon = " + std::to_string(horizon) +
         "\noutput_step = " + std::to_string(horizon / 10) +
         "\ncompare = [\"interval\", \"stochastic\"]\n[interval]\ntightness = 1.005\n[stochastic]\nplan = "
         "\"grid\"\nsamples = "
         "65\n[mechanism]\ngravity "
         "= [0, 0, -9.81]\n";
}

std::string uncertain(const std::string& quantity) {
  return "[[uncertain]]\nquantity = \"" + quantity + "\"\ninterval = \"± 1 %\"\n";
}

std::string output(const std::string& quantity) {
  return "[[output]]\nname = \"" + quantity + "\"\nquantity = \"" + quantity + "\"\n";
}

/// Links of 0.1 m and bodies of 1 kg, all angles 0.1 rad.
std::string planarChain(int links, double horizon) {
  std::string text = head(horizon), from = "inertial", outputs;
  for (int i = 0; i < links; ++i) {
    const std::string n = std::to_string(i);
    text += hinge("joint" + n, from, "K" + n, "x", "angle = 0.1, rate = 0") +
            link("link" + n, "K" + n, "E" + n, "[0, 0, -0.1]") + mass("body" + n, "E" + n, "mass = 1");
    outputs += output("joint" + n + ".rate");
    from = "E" + n;
  }
  return text + uncertain("joint0.angle") + outputs;
}

/// Hinge z, hinge y from -10° through 0, a body with inertia; and so on with x.
std::string perpendicular(int axes) {
  std::string text = head(2), from = "inertial";
  for (int i = 0; i < axes; ++i) {
    const std::string n = std::to_string(i);
    text += hinge("joint" + n, from, "K" + n,
                  i % 3 == 0   ? "z"
                  : i % 3 == 1 ? "y"
                               : "x",
                  i == 0 ? "angle = 0, rate = 0.5" : "angle = \"-10 deg\", rate = 1") +
            link("link" + n, "K" + n, "E" + n, "[0.3, 0, 0]");
    if (i > 0) text += mass("body" + n, "E" + n, "mass = 1\ninertia = [0.1, 0.2, 0.3]");
    from = "E" + n;
  }
  return text + uncertain("joint1.angle") + output("joint0.angle") + output("joint1.angle") + output("joint1.rate");
}

/// A body without a joint, or on a ball, turned by an uncertain roll about an uncertain start.
std::string tumbling(const std::string& type, double horizon) {
  return head(horizon) + "[[mechanism.element]]\ntype = \"" + type +
         "\"\nname = \"joint\"\nfrom = \"inertial\"\nto = \"B\"\ninitial = { orientation = { roll = \"30 deg\", yaw = "
         "1 }, "
         "rate = [0.1, 3, 0.1] }\n" +
         mass("body", "B", "mass = 1\ncentre = [0, 0, 0.3]\ninertia = [1, 2, 2.5]") +
         uncertain("joint.orientation.roll") + uncertain("body.inertia.yy") + output("joint.quaternion.w") +
         output("joint.rate.x") + output("body.position.z");
}

/// Its length is also what the slider starts with.
std::string startsAtALength() {
  return head(2) +
         "[[mechanism.element]]\ntype = \"prismatic\"\nname = \"slide\"\nfrom = \"inertial\"\nto = \"S\"\naxis = "
         "\"x\"\nparameters = { length = \"1 m\" }\ninitial = { displacement = \"sqrt(slide.length * 1 m) + "
         "slide.length^2 / (2 m)\" }\n" +
         mass("body", "S", "mass = 1") +
         "[[mechanism.element]]\ntype = \"joint-spring\"\nname = \"spring\"\njoint = \"slide\"\nstiffness = 10\nrest = "
         "\"slide.length\"\n" +
         uncertain("slide.length") + output("slide.displacement") + output("slide.rate");
}

std::string coupling(const std::string& joint, const std::string& to, const std::string& ratio) {
  return "[[mechanism.element]]\ntype = \"coupling\"\nname = \"" + joint + "Gear\"\njoint = \"" + joint +
         "\"\nto = \"" + to + "\"\nratio = " + ratio + "\n";
}

std::string headWithCorners(const std::string& horizon, const std::string& step) {
  return "[study]\nanalysis = \"dynamics\"\nhorizon = " + horizon + "\noutput_step = " + step +
         "\ncompare = [\"interval\", \"stochastic\"]\n[stochastic]\nsamples = 256\n[distribution]\ntimes = 0\n";
}

/// Five masses, of which three go round as planets: the inertia is constant.
std::string planetaryGear() {
  const std::string ball = "inertia = [0.0002, 0.0002, 0.0002]";
  std::string text = headWithCorners("2", "0.5") + "[mechanism]\ngravity = [0, 0, -9.81]\n" +
                     hinge("carrier", "inertial", "C", "z", "rate = 0") + mass("plate", "C", "mass = 1\n" + ball) +
                     hinge("sun", "inertial", "S", "z", "rate = 0") + mass("centre", "S", "mass = 0.2\n" + ball) +
                     coupling("sun", "carrier", "4");
  const std::array<const char*, 3> arms = {"[0.08, 0, 0]", "[-0.04, 0.0693, 0]", "[-0.04, -0.0693, 0]"};
  for (std::size_t i = 0; i < arms.size(); ++i) {
    const std::string n = std::to_string(i);
    text += link("arm" + n, "C", "A" + n, arms[i]) + hinge("planet" + n, "A" + n, "P" + n, "z", "rate = 0") +
            mass("disc" + n, "P" + n, "mass = 0.3\n" + ball) + coupling("planet" + n, "carrier", "-3");
  }
  return text +
         "[[mechanism.element]]\ntype = \"joint-force\"\nname = \"drive\"\njoint = \"sun\"\nforce = \"0.05 N m\"\n" +
         "[[uncertain]]\nquantity = \"*.mass\"\ninterval = \"± 2 %\"\n" + output("carrier.angle") +
         output("carrier.acceleration") + output("energy.kinetic");
}

/// A body turned by three wheels that spin at 200 rad/s.
std::string reactionWheels() {
  std::string text = headWithCorners("60", "10") +
                     "[mechanism]\n[mechanism.parameters]\nkd = \"0.45 N m s\"\nspin = \"5e-4 kg m^2\"\n"
                     "[[mechanism.element]]\ntype = \"spherical\"\nname = \"orbit\"\nfrom = \"inertial\"\nto = \"B\"\n"
                     "initial = { orientation = { roll = \"8 deg\", yaw = \"10 deg\" }, rate = [0.02, 0.01, 0.01] }\n" +
                     mass("bus", "B", "mass = 25\ninertia = [1.2, 1.4, 0.9]");
  const std::array<std::string, 3> axes = {"x", "y", "z"};
  for (std::size_t i = 0; i < axes.size(); ++i) {
    std::array<std::string, 3> inertia;
    inertia.fill("\"0.55*spin\"");
    inertia[i] = "\"spin\"";
    text += hinge("wheel" + axes[i], "B", "W" + axes[i], axes[i], "rate = 200") +
            mass("rotor" + axes[i], "W" + axes[i],
                 "mass = 0.5\ninertia = [" + inertia[0] + ", " + inertia[1] + ", " + inertia[2] + "]") +
            "[[mechanism.element]]\ntype = \"motor\"\nname = \"motor" + axes[i] + "\"\njoint = \"wheel" + axes[i] +
            "\"\nmoment = \"0.16 N m * orbit.quaternion." + axes[i] + " + kd*orbit.rate." + axes[i] + "\"\n";
  }
  return text + "[[uncertain]]\nquantity = \"spin\"\ninterval = \"± 5 %\"\n" +
         "[[uncertain]]\nquantity = \"kd\"\ninterval = \"± 5 %\"\n" + output("wheelx.rate") + output("wheely.rate") +
         output("wheelz.rate");
}

class Machines : public ::testing::TestWithParam<StudiedMachine> {};

TEST_P(Machines, ArriveInsideATightGuarantee) {
  const Results results = run(readStudyText(GetParam().text, "machine.toml"), {});
  EXPECT_EQ(results.interval.reached, results.horizon) << results.interval.why;
  EXPECT_EQ(results.stochastic.reached, results.horizon) << results.stochastic.why;
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  EXPECT_LE(results.comparison.maximum, GetParam().overestimation);
}

INSTANTIATE_TEST_SUITE_P(Study, Machines,
                         ::testing::Values(StudiedMachine{"perpendicularHinges", perpendicular(2), 1.01},
                                           StudiedMachine{"threePerpendicularHinges", perpendicular(3), 1.01},
                                           StudiedMachine{"sixPerpendicularHinges", perpendicular(6), 1.01},
                                           StudiedMachine{"freeBody", tumbling("free", 5), 1.01},
                                           StudiedMachine{"top", tumbling("spherical", 3), 1.01},
                                           StudiedMachine{"planetaryGear", planetaryGear(), 1.02},
                                           StudiedMachine{"reactionWheels", reactionWheels(), 1.02},
                                           StudiedMachine{"startsAtALength", startsAtALength(), 1.01},
                                           StudiedMachine{"chainOfThree", planarChain(3, 2), 1.01},
                                           StudiedMachine{"chainOfFive", planarChain(5, 2), 1.01},
                                           StudiedMachine{"chainOfEight", planarChain(8, 2), 1.01},
                                           StudiedMachine{"chainOfTen", planarChain(10, 0.5), 1.01}),
                         [](const auto& machine) { return machine.param.name; });

}  // namespace
}  // namespace gamut
