// Studies of where a mechanism rests and how it vibrates there: enclosures against closed forms and Sturm's counts in
// 128 bits, for any number of masses, and what is refused.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <complex>
#include <functional>
#include <string>
#include <vector>

#include "analyses/samples/arbiter.hpp"
#include "mechanics/rest_equations.hpp"
#include "mechanics/rest_stability.hpp"
#include "scalars/algebra/decompositions.hpp"
#include "scalars/evaluation/evaluate.hpp"
#include "studies/analyses/equilibria.hpp"
#include "studies/analyses/modes.hpp"
#include "studies/machine.hpp"
#include "studies/running/run.hpp"
#include "studies/study.hpp"
#include "tests/analyses/reference.hpp"
#include "tests/mechanics/four_bar.hpp"

namespace gamut::equilibria {
namespace {

using ::testing::HasSubstr;
using testing::Points;
using testing::Vector;

const Precise turn = 2 * acos(Precise(-1));

Machine machineOf(const std::string& text) { return Machine(readStudyText(text, "s.toml")); }

std::string studyOf(const std::string& mechanism, const std::string& outputs, const std::string& compare = "") {
  return "[study]\nanalysis = \"equilibria\"\n" + (compare.empty() ? "" : "compare = [" + compare + "]\n") +
         "[stochastic]\nsamples = 64\n[mechanism]\n" + mechanism + outputs;
}

std::string element(const std::string& type, const std::string& name, const std::string& keys) {
  return "[[mechanism.element]]\ntype = \"" + type + "\"\nname = \"" + name + "\"\n" + keys + "\n";
}

std::string hinge(const std::string& name, const std::string& from, const std::string& to,
                  const std::string& initial = "0") {
  return element("revolute", name,
                 "from = \"" + from + "\"\nto = \"" + to + "\"\naxis = \"z\"\ninitial = { angle = " + initial + " }");
}

std::string uncertain(const std::string& quantity, const std::string& interval) {
  return "[[uncertain]]\nquantity = \"" + quantity + "\"\ninterval = \"" + interval + "\"\n";
}

std::string output(const std::string& quantity) { return "[[output]]\nquantity = \"" + quantity + "\"\n"; }

std::string frequencies(int many) {
  std::string text;
  for (int mode = 1; mode <= many; ++mode) text += output("frequency." + std::to_string(mode));
  return text;
}

Interval found(const Results& results, std::size_t output) {
  return {results.interval.at.lower(0, output), results.interval.at.upper(0, output)};
}

/// Of free parameters, corners and points inside in turn.
Vector point(Points& points, const Machine& machine, int number) {
  const Box box(machine.box.begin() + static_cast<std::ptrdiff_t>(machine.states), machine.box.end());
  return number % 2 == 0 ? points.corner(box) : points.inside(box);
}

/// Masses in a row, of (10 + i)/10 kg, from the wall on at springs of k1, k2, … = 110, 120, … N/m.
std::string chain(int many, const std::string& tolerance, const std::string& outputs, const std::string& compare = "",
                  const std::string& ofMasses = "") {
  std::string parameters = "parameters = { ", elements, uncertainties, masses, before = "inertial";
  for (int i = 1; i <= many; ++i) {
    const std::string number = std::to_string(i), frame = "F" + number;
    parameters += (i > 1 ? ", k" : "k") + number + " = \"" + std::to_string(100 + 10 * i) + " N/m\", m" + number +
                  " = \"" + std::to_string(100 + 10 * i) + "/100 kg\"";
    elements += element("prismatic", "J" + number, "from = \"" + before + "\"\nto = \"" + frame + "\"\naxis = \"x\"") +
                element("mass", "M" + number, "at = \"" + frame + "\"\nmass = \"m" + number + "\"") +
                element("joint-spring", "S" + number, "joint = \"J" + number + "\"\nstiffness = \"k" + number + "\"");
    uncertainties += uncertain("k" + number, tolerance);
    if (!ofMasses.empty()) masses += uncertain("m" + number, ofMasses);
    before = frame;
  }
  return studyOf(parameters + " }\n" + elements + uncertainties + masses, outputs, compare);
}

/// Row by row.
using Dense = std::vector<Vector>;

/// Stiffness of a chain between its masses.
Dense stiffnessOf(const Vector& k) {
  const std::size_t many = k.size();
  Dense m(many, Vector(many, Precise(0)));
  for (std::size_t i = 0; i < many; ++i) {
    m[i][i] = k[i] + (i + 1 < many ? k[i + 1] : Precise(0));
    if (i > 0) m[i][i - 1] = m[i - 1][i] = -k[i];
  }
  return m;
}

Vector chainMasses(std::size_t many) {
  Vector masses;
  for (std::size_t i = 1; i <= many; ++i) masses.push_back(Precise(100 + 10 * i) / 100);
  return masses;
}

/// Where the kth of ω² lies, by how many pivots of K − ω² M are negative, M diagonal (J. W. Givens, 1954).
Precise squareOf(const Dense& stiffness, const Vector& masses, int k) {
  const std::size_t many = masses.size();
  const auto below = [&](const Precise& square) {
    Dense m = stiffness;
    int count = 0;
    for (std::size_t i = 0; i < many; ++i) m[i][i] -= square * masses[i];
    for (std::size_t i = 0; i < many; ++i) {
      count += m[i][i] < 0 ? 1 : 0;
      for (std::size_t j = i + 1; j < many; ++j) {
        if (m[j][i] == 0) continue;
        const Precise factor = m[j][i] / m[i][i];
        for (std::size_t l = j; l < many; ++l)
          if (m[l][i] != 0) m[l][j] -= factor * m[l][i];
      }
    }
    return count;
  };
  Precise low(0), high(1e6);
  for (int i = 0; i < 120; ++i) {
    const Precise middle = (low + high) / 2;
    (below(middle) >= k ? high : low) = middle;
  }
  return low;
}

Precise frequencyOf(const Dense& stiffness, const Vector& masses, int k) {
  return sqrt(squareOf(stiffness, masses, k)) / turn;
}

class Chains : public ::testing::TestWithParam<std::tuple<int, const char*>> {};

TEST_P(Chains, VibrateAsTheirPencilsSay) {
  const auto [many, tolerance] = GetParam();
  const Machine machine = machineOf(chain(many, tolerance, frequencies(many)));
  const Results results = run(machine, {});
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  Points points;
  const int tried = many > 10 ? 2 : 20;
  for (int number = 0; number < tried; ++number) {
    const Dense stiffness = stiffnessOf(point(points, machine, number));
    for (int k = 1; k <= many; ++k)
      EXPECT_THAT(found(results, k - 1), testing::Encloses(frequencyOf(stiffness, chainMasses(many), k)))
          << k << " of " << many;
  }
}

INSTANTIATE_TEST_SUITE_P(OfMasses, Chains,
                         ::testing::Combine(::testing::Values(1, 2, 3, 10),
                                            ::testing::Values("± 0.001 %", "± 5 %", "± 15 %")));

/// All springs soft and all masses great, or the other way round.
void expectAsTightAsCorners(const std::function<Interval(int)>& foundOf, int many, const Box& box) {
  Vector least, most, great = chainMasses(many), small = great;
  for (int i = 0; i < many; ++i) {
    least.emplace_back(box[i].lower());
    most.emplace_back(box[i].upper());
    if (box.size() == static_cast<std::size_t>(many)) continue;
    great[i] = Precise(box[many + i].upper());
    small[i] = Precise(box[many + i].lower());
  }
  for (int k = 1; k <= many; ++k) {
    const Precise low = frequencyOf(stiffnessOf(least), great, k), high = frequencyOf(stiffnessOf(most), small, k);
    const Interval own = foundOf(k - 1);
    EXPECT_THAT(own, testing::Encloses(low)) << k;
    EXPECT_THAT(own, testing::Encloses(high)) << k;
    EXPECT_LE(Precise(width(own)), high - low + Precise(1e-9) * high) << k;
  }
}

Box freeBox(const Machine& machine, const Box& box) {
  return {box.begin() + static_cast<std::ptrdiff_t>(machine.states), box.end()};
}

TEST(Equilibria, HaveFrequenciesAsTightAsCorners) {
  for (const auto& [many, tolerance, ofMasses] :
       {std::tuple{10, "± 5 %", ""}, {10, "± 15 %", ""}, {4, "± 60 %", "± 60 %"}, {7, "± 5 %", "± 10 %"}}) {
    const Machine machine = machineOf(chain(many, tolerance, frequencies(many), "\"interval\"", ofMasses));
    const Results results = run(machine, {});
    expectAsTightAsCorners([&](int k) { return found(results, k); }, many, freeBox(machine, machine.box));
  }
}

TEST(Equilibria, HaveAlphaCutsAsTightAsTheirCorners) {
  constexpr int many = 4;
  const Machine machine = machineOf(chain(many, "± 10 %", frequencies(many), "\"fuzzy\""));
  const Results results = run(machine, {});
  ASSERT_GT(machine.levels.size(), 2);
  for (std::size_t level = 0; level < machine.levels.size(); ++level) {
    const Envelope& cut = results.fuzzy.outer[level];
    expectAsTightAsCorners([&](int k) { return Interval(cut.lower(0, k), cut.upper(0, k)); }, many,
                           freeBox(machine, machine.levels[level]));
  }
}

const std::string pendulum = "gravity = [0, \"-9.81\", 0]\nparameters = { l = \"0.5 m\", c = \"0.2 N m s/rad\" }\n" +
                             hinge("A", "inertial", "K", "\"-80 deg\"") +
                             element("link", "rod", "from = \"K\"\nto = \"P\"\nvector = [\"l\", 0, 0]") +
                             element("mass", "bob", "at = \"P\"\nmass = 2") +
                             element("joint-spring", "resistance", "joint = \"A\"\ndamping = \"c\"");

/// ω₀² = g/l, ζ = c/(2 m l² ω₀)
TEST(Equilibria, OfAPendulumAreItsClosedForm) {
  const Machine machine = machineOf(studyOf(pendulum + uncertain("l", "± 5 %") + uncertain("c", "± 15 %"),
                                            output("A.angle") + output("frequency.1") + output("damping.1")));
  const Results results = run(machine, {});
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  EXPECT_LE(results.comparison.maximum, 1.02);
  Points points;
  for (int number = 0; number < 40; ++number) {
    const Vector p = point(points, machine, number);
    const Precise own = sqrt(Precise("9.81") / p[0]);
    EXPECT_THAT(found(results, 0), testing::Encloses(Precise(-turn / 4)));
    EXPECT_THAT(found(results, 1), testing::Encloses(Precise(own / turn)));
    EXPECT_THAT(found(results, 2), testing::Encloses(Precise(p[1] / (4 * p[0] * p[0] * own))));
  }
}

/// A motor whose moment falls with its own speed damps what it turns: by d n²/(2 √(k I)).
TEST(Equilibria, AreDampedByMotorsThatKnowTheirOwnSpeed) {
  const std::string mechanism =
      hinge("A", "inertial", "F") + element("mass", "disc", "at = \"F\"\nmass = 1\ninertia = [0.5, 0.5, 0.5]") +
      element("joint-spring", "spring", "joint = \"A\"\nstiffness = 8") +
      element("motor", "motor", "joint = \"A\"\nmoment = \"-0.0625 N m s/rad*motor.rate\"\nratio = 2");
  const Results results =
      run(readStudyText(studyOf(mechanism, uncertain("spring.stiffness", "± 2 %") + output("damping.1")), "s.toml"));
  EXPECT_EQ(results.stochastic.failures, 0);
  for (const double stiffness : {7.84, 8.0, 8.16}) {
    const Precise damping = Precise(0.25) / (2 * sqrt(Precise(stiffness) * Precise(0.5)));
    EXPECT_LE(Precise(found(results, 0).lower()), damping) << stiffness;
    EXPECT_GE(Precise(found(results, 0).upper()), damping) << stiffness;
  }
  EXPECT_LT(width(found(results, 0)), 0.0013);
}

TEST(Equilibria, OfThinNumbersAreKnownToTheRounding) {
  const Results results =
      run(machineOf(studyOf(pendulum, output("A.angle") + output("frequency.1") + output("damping.1"))), {});
  for (std::size_t j = 0; j < 3; ++j) EXPECT_LE(width(found(results, j)), 1e-14) << j;
}

/// Three that do not know of each other: the slowest is now this, now that.
TEST(Equilibria, KeepsApartWhatComesTogether) {
  std::string mechanism = "parameters = { kx = 100, ky = 100, kz = 102 }\n";
  for (const std::string axis : {"x", "y", "z"})
    mechanism +=
        element("prismatic", "J" + axis, "from = \"inertial\"\nto = \"F" + axis + "\"\naxis = \"" + axis + "\"") +
        element("mass", "m" + axis, "at = \"F" + axis + "\"\nmass = 1") +
        element("joint-spring", "S" + axis, "joint = \"J" + axis + "\"\nstiffness = \"k" + axis + "\"") +
        uncertain("k" + axis, axis == "x" ? "± 10 %" : "± 5 %");
  const Machine machine = machineOf(studyOf(mechanism, frequencies(3)));
  const Results results = run(machine, {});
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  Points points;
  for (int number = 0; number < 40; ++number) {
    Vector p = point(points, machine, number);
    std::ranges::sort(p);
    for (int k = 0; k < 3; ++k) EXPECT_THAT(found(results, k), testing::Encloses(Precise(sqrt(p[k]) / turn)));
  }
  EXPECT_LE(results.comparison.maximum, 1.0001);
}

/// Four masses at the corners of a square, each held by a spring and by its neighbours: λ, λ + 2c twice, λ + 4c.
TEST(Equilibria, OfASquareHaveTwoEqualFrequencies) {
  std::string parameters = "parameters = { ", elements, uncertainties;
  for (int i = 0; i < 4; ++i) {
    const std::string own = std::to_string(i), next = std::to_string((i + 1) % 4), last = std::to_string((i + 3) % 4);
    parameters += (i > 0 ? ", k" : "k") + own + " = 100, c" + own + " = 20";
    elements += element("prismatic", "Z" + own, "from = \"inertial\"\nto = \"P" + own + "\"\naxis = \"z\"") +
                element("mass", "m" + own, "at = \"P" + own + "\"\nmass = 1") +
                element("joint-force", "F" + own,
                        "joint = \"Z" + own + "\"\nforce = \"(-k" + own + "*Z" + own + ".displacement - c" + own +
                            "*(Z" + own + ".displacement - Z" + next + ".displacement) - c" + last + "*(Z" + own +
                            ".displacement - Z" + last + ".displacement))*(1 N/m)\"");
    uncertainties += uncertain("k" + own, "± 5 %") + uncertain("c" + own, "± 5 %");
  }
  const Machine machine = machineOf(studyOf(parameters + " }\n" + elements + uncertainties, frequencies(4)));
  const Results results = run(machine, {});
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  EXPECT_LE(results.comparison.maximum, 1.0001);
  Points points;
  for (int number = 0; number < 40; ++number) {
    const Vector p = point(points, machine, number);
    Dense stiffness(4, Vector(4, Precise(0)));
    for (int i = 0; i < 4; ++i) {
      const int next = (i + 1) % 4;
      const Precise &k = p[2 * i], &c = p[2 * i + 1];
      stiffness[i][i] += k + c;
      stiffness[next][next] += c;
      stiffness[i][next] -= c;
      stiffness[next][i] -= c;
    }
    for (int k = 1; k <= 4; ++k)
      EXPECT_THAT(found(results, k - 1), testing::Encloses(frequencyOf(stiffness, Vector(4, Precise(1)), k))) << k;
  }
}

/// The linkage of tests/mechanics/four_bar.hpp under its weight, two of its lengths uncertain.
std::string linkage() {
  const auto link = [](const std::string& name, const std::string& from, const std::string& to,
                       const std::string& length) {
    return element("link", name, "from = \"" + from + "\"\nto = \"" + to + "\"\nvector = [\"" + length + "\", 0, 0]");
  };
  return "gravity = [0, \"-9.81\", 0]\nparameters = { a = \"0.3 m\", b = \"0.8 m\", c = \"0.6 m\", d = \"0.9 m\" }\n" +
         hinge("A", "inertial", "K1", "4") +
         element("mass", "crank",
                 "at = \"K1\"\nmass = 1\ncentre = [\"0.15\", 0, 0]\ninertia = [\"0.0075\", \"0.0075\", \"0.0075\"]") +
         link("ab", "K1", "PB", "a") + hinge("B", "PB", "K2", "-2.8") +
         element("mass", "coupler",
                 "at = \"K2\"\nmass = 2\ncentre = [\"0.4\", \"0.1\", 0]\ninertia = [\"0.1\", \"0.1\", \"0.1\"]") +
         link("bc", "K2", "C1", "b") + link("ground", "inertial", "PD", "d") + hinge("D", "PD", "K3", "1.9") +
         element("mass", "rocker",
                 "at = \"K3\"\nmass = 1.5\ncentre = [\"0.3\", 0, 0]\ninertia = [\"0.05\", \"0.05\", \"0.05\"]") +
         link("dc", "K3", "C2", "c") + element("closure", "C", "as = \"pin\"\nfrom = \"C2\"\nto = \"C1\"") +
         uncertain("a", "± 1 %") + uncertain("d", "± 1 %");
}

/// Of the crank, at rest at this angle, with the closing point to the left.
Precise accelerationOf(const Precise& angle, const Vector& p) {
  return testing::fourBarByHand<Precise>(angle, Precise(0), {p[0], Precise("0.8"), Precise("0.6"), p[1]},
                                         [](const char* decimal) { return Precise(decimal); })
      .acceleration;
}

/// Where it is zero about an interval.
Precise restAbout(const Interval& angles, const Vector& p) {
  Precise low = Precise(angles.lower()) - Precise("0.01"), high = Precise(angles.upper()) + Precise("0.01");
  const bool falls = accelerationOf(low, p) > 0;
  EXPECT_EQ(accelerationOf(high, p) > 0, !falls);
  for (int i = 0; i < 110; ++i) {
    const Precise middle = (low + high) / 2;
    ((accelerationOf(middle, p) > 0) == falls ? low : high) = middle;
  }
  return low;
}

/// Of a linkage that hangs: ω² = −∂θ̈/∂θ.
TEST(Equilibria, OfALoopAreThoseOfItsMotion) {
  const Machine machine = machineOf(studyOf(linkage(), output("A.angle") + frequencies(1)));
  const Results results = run(machine, {});
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  Points points;
  for (int number = 0; number < 20; ++number) {
    const Vector p = point(points, machine, number);
    const Precise low = restAbout(found(results, 0), p);
    EXPECT_THAT(found(results, 0), testing::Encloses(low));
    const Precise step("1e-9");  // an error of step² and one of 1e-34/step
    const Precise square = (accelerationOf(low - step, p) - accelerationOf(low + step, p)) / (2 * step);
    EXPECT_THAT(found(results, 1), testing::Encloses(Precise(sqrt(square) / turn)));
  }
}

TEST(Equilibria, MeetRequirements) {
  const std::string text = studyOf(pendulum + uncertain("l", "± 5 %"), frequencies(1)) +
                           "[[requirement]]\nname = \"slow\"\nalways = \"frequency.1 < 0.75 Hz\"\n" +
                           "[[requirement]]\nname = \"fast\"\nalways = \"frequency.1 > 0.7 Hz\"\n";
  const Results results = run(machineOf(text), {});
  ASSERT_EQ(results.requirements.size(), 2);
}

/// A lever, of mass m at its end, and a spring from there to a pin, behind dead centre.
std::string toggle(const std::string& number) {
  return hinge("H" + number, "inertial", "L" + number, "0.5") +
         element("link", "arm" + number,
                 "from = \"L" + number + "\"\nto = \"E" + number + "\"\nvector = [\"a\", 0, 0]") +
         element("mass", "m" + number, "at = \"E" + number + "\"\nmass = \"50 g\"") +
         element("link", "post" + number, "from = \"inertial\"\nto = \"P" + number + "\"\nvector = [\"b\", 0, 0]") +
         element("spring-damper", "S" + number,
                 "from = \"P" + number + "\"\nto = \"E" + number + "\"\nstiffness = 2000\nrest_length = \"l\"");
}

std::string toggles(int many, const std::string& tolerance, const std::string& angles) {
  std::string mechanism = "parameters = { a = \"40 mm\", b = \"60 mm\", l = \"35 mm\" }\n";
  for (int i = 1; i <= many; ++i) mechanism += toggle(std::to_string(i));
  return studyOf(mechanism + uncertain("a", tolerance) + uncertain("b", tolerance) + uncertain("l", tolerance),
                 output("H1.angle")) +
         "[equilibria]\nangles = \"" + angles + "\"\n";
}

Interval positionOf(const EquilibriaResult& found, std::size_t number, std::size_t coordinate = 0) {
  return {found.lower(number, coordinate), found.upper(number, coordinate)};
}

/// Without weight: at dead centre, opposite, and where the spring has its length, cos θ = (a² + b² − l²)/(2 a b).
TEST(Equilibria, OfAToggleAreAllFound) {
  for (const char* tolerance : {"± 0.01 %", "± 2 %", "± 5 %"}) {
    const Machine machine = machineOf(toggles(1, tolerance, "179 deg"));
    const Results results = run(machine, {});
    const EquilibriaResult& found = results.of<EquilibriaResult>();
    ASSERT_TRUE(found.isComplete) << tolerance << found.why;
    ASSERT_EQ(found.number.size(), 4) << tolerance;
    EXPECT_EQ(found.stability, (std::vector<std::int64_t>{1, -1, 1, -1}));
    Points points;
    for (int number = 0; number < 40; ++number) {
      const Vector p = point(points, machine, number);
      const Precise angle = acos((p[0] * p[0] + p[1] * p[1] - p[2] * p[2]) / (2 * p[0] * p[1]));
      EXPECT_THAT(positionOf(found, 0), testing::Encloses(Precise(-angle)));
      EXPECT_THAT(positionOf(found, 1), testing::Encloses(Precise(0)));
      EXPECT_THAT(positionOf(found, 2), testing::Encloses(angle));
      EXPECT_THAT(positionOf(found, 3), testing::Encloses(Precise(turn / 2)));
    }
  }
}

TEST(Equilibria, OfTogglesAreAllCombinations) {
  for (const auto& [many, positions] : {std::pair{2, 9}, {3, 27}}) {
    const Results results = run(machineOf(toggles(many, "± 1 %", "80 deg")), {});
    const EquilibriaResult& found = results.of<EquilibriaResult>();
    EXPECT_TRUE(found.isComplete) << many << found.why;
    ASSERT_EQ(found.number.size(), positions);
    int stable = 0;
    for (std::size_t k = 0; k < found.number.size(); ++k) {
      bool isStable = true;
      for (std::size_t i = 0; i < found.coordinate.size(); ++i)
        isStable = isStable && !contains(positionOf(found, k, i), 0);
      EXPECT_EQ(found.stability[k], isStable ? 1 : -1);
      stable += isStable ? 1 : 0;
    }
    EXPECT_EQ(stable, 1 << many);
  }
}

/// Two of either way to assemble it, of which one hangs.
TEST(Equilibria, OfALoopAreFoundHoweverItIsAssembled) {
  const Machine machine = machineOf(studyOf(linkage(), output("A.angle")) + "[equilibria]\nangles = \"180 deg\"\n");
  const Results results = run(machine, {});
  const EquilibriaResult& all = results.of<EquilibriaResult>();
  ASSERT_TRUE(all.isComplete) << all.why;
  ASSERT_EQ(all.number.size(), 4);
  EXPECT_EQ(std::ranges::count(all.stability, 1), 2);
  EXPECT_EQ(std::ranges::count(all.stability, -1), 2);
  Points points;
  int left = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const Interval angles = positionOf(all, k);
    const Vector middle{Precise("0.3"), Precise("0.9")};
    const Precise below = accelerationOf(Precise(angles.lower()) - Precise("0.01"), middle),
                  above = accelerationOf(Precise(angles.upper()) + Precise("0.01"), middle);
    if (below * above > 0) continue;  // of the other way
    ++left;
    EXPECT_EQ(all.stability[k], below > 0 ? 1 : -1);
    for (int number = 0; number < 20; ++number)
      EXPECT_THAT(angles, testing::Encloses(restAbout(angles, point(points, machine, number))));
  }
  EXPECT_EQ(left, 2);
}

/// A pendulum that a force drives the way it turns.
TEST(Equilibria, AreUnstableWhereResistancesGiveEnergy) {
  const std::string bob = "gravity = [0, \"-9.81\", 0]\n" + hinge("A", "inertial", "K", "\"-80 deg\"") +
                          element("mass", "bob", "at = \"K\"\nmass = 1\ncentre = [\"0.3\", 0, 0]");
  const auto stabilityWith = [&](const std::string& elements, const std::string& uncertainties = "") {
    const Results results = run(
        machineOf(studyOf(bob + elements + uncertainties, output("A.angle")) + "[equilibria]\nangles = \"100 deg\"\n"),
        {});
    EXPECT_TRUE(results.of<EquilibriaResult>().isComplete);
    return results.of<EquilibriaResult>().stability;
  };
  const auto damper = [](const std::string& c) {
    return element("joint-spring", "d", "joint = \"A\"\nstiffness = 0\ndamping = \"" + c + "\"");
  };
  using Found = std::vector<std::int64_t>;
  EXPECT_EQ(stabilityWith(""), (Found{1}));
  EXPECT_EQ(stabilityWith(damper("0.1")), (Found{1}));
  EXPECT_EQ(stabilityWith(damper("-0.1")), (Found{-1}));
  EXPECT_EQ(stabilityWith(element("joint-force", "d", "joint = \"A\"\nforce = \"(0.1 N m s/rad)*A.rate\"")),
            (Found{-1}));
  EXPECT_EQ(stabilityWith(element("joint-force", "d", "joint = \"A\"\nforce = \"-(0.1 N m s/rad)*A.rate\"")),
            (Found{1}));
  EXPECT_EQ(stabilityWith(element("joint-force", "d",
                                  "joint = \"A\"\nforce = \"(0.3 N m s/rad)*abs(A.rate) - (0.1 N m s/rad)*A.rate\"")),
            (Found{0}));
  EXPECT_EQ(stabilityWith(damper("0.1"), uncertain("d.damping", "± 15 %")), (Found{1}));
  EXPECT_EQ(stabilityWith(damper("0.1"), "[[uncertain]]\nquantity = \"d.damping\"\ninterval = [\"-0.01\", \"0.2\"]\n"),
            (Found{0}));
}

std::string refusalOf(const std::string& text);

std::string damperBetween(const std::string& name, const std::string& from, const std::string& to,
                          const std::string& damping) {
  return element("spring-damper", name,
                 "from = \"" + from + "\"\nto = \"" + to + "\"\nto_point = [1, \"0.5\", 0]\nstiffness = 0\n" +
                     "rest_length = 0\ndamping = \"" + damping + "\"");
}

/// A chain with one damper or two, from mass to mass.
std::string dampedChain(int many, const std::string& tolerance, const std::string& damping) {
  const std::string last = "F" + std::to_string(many), middle = "F" + std::to_string((many + 1) / 2);
  return chain(many, tolerance,
               damperBetween("D", many > 1 ? middle : "inertial", last, "0.3") +
                   (many > 3 ? damperBetween("E", "F1", middle, "0.1") : "") +
                   "[[uncertain]]\nquantity = \"D.damping\"\ninterval = " + damping + "\n" + output("J1.displacement"),
               "\"interval\"", tolerance) +
         "[equilibria]\ndisplacements = \"1 mm\"\n";
}

/// What is damped is next to nothing of what moves.
TEST(Equilibria, OfMassesWithDampersBetweenThemAreStable) {
  for (const int many : {1, 2, 3, 10})
    for (const char* tolerance : {"± 1 %", "± 5 %", "± 15 %"})
      for (const char* damping : {"\"± 15 %\"", "[0, \"0.5\"]"}) {
        const Results results = run(machineOf(dampedChain(many, tolerance, damping)), {});
        const EquilibriaResult& all = results.of<EquilibriaResult>();
        EXPECT_TRUE(all.isComplete) << all.why;
        EXPECT_EQ(all.stability, (std::vector<std::int64_t>{1})) << many << tolerance << damping;
      }
  EXPECT_EQ(run(machineOf(dampedChain(3, "± 5 %", "[\"-0.01\", \"0.5\"]")), {}).of<EquilibriaResult>().stability,
            (std::vector<std::int64_t>{0}));
}

/// Two arms, and a damper from the base to the second: hanging, upright, and folded either way.
TEST(Equilibria, OfArmsWithADamperAreKnown) {
  const auto arm = [](const std::string& name, const std::string& from, const std::string& to, const char* at) {
    return hinge(name, from, to, at) +
           element("mass", "m" + name, "at = \"" + to + "\"\nmass = \"ma\"\ncentre = [\"0.3\", 0, 0]") +
           element("link", "l" + name, "from = \"" + to + "\"\nto = \"E" + to + "\"\nvector = [\"0.5\", 0, 0]");
  };
  const std::string arms = "gravity = [0, \"-9.81\", 0]\nparameters = { ma = \"2 kg\", cd = \"4 N s/m\" }\n" +
                           arm("A", "inertial", "K1", "\"-80 deg\"") + arm("B", "EK1", "K2", "\"10 deg\"") +
                           damperBetween("D", "inertial", "K2", "cd");
  for (const char* tolerance : {"± 1 %", "± 5 %", "± 15 %"}) {
    const Results results = run(machineOf(studyOf(arms + uncertain("ma", tolerance) + uncertain("cd", tolerance),
                                                  output("A.angle"), "\"interval\"") +
                                          "[equilibria]\nangles = \"175 deg\"\n"),
                                {});
    const EquilibriaResult& all = results.of<EquilibriaResult>();
    ASSERT_EQ(all.number.size(), 4) << all.why;
    for (std::size_t k = 0; k < 4; ++k) {
      const bool hangs = positionOf(all, k).upper() < 0 && magnitude(positionOf(all, k, 1)) < 1;
      EXPECT_EQ(all.stability[k], hangs ? 1 : -1) << tolerance << k;
    }
  }
}

/// Across a loop.
TEST(Equilibria, OfALoopWithADamperAcrossAreKnown) {
  for (const char* damping : {"± 15 %", "± 100 %"}) {
    const Results results =
        run(machineOf(studyOf(linkage() + damperBetween("d", "K1", "K3", "0.5") + uncertain("d.damping", damping),
                              output("A.angle"), "\"interval\"") +
                      "[equilibria]\nangles = \"180 deg\"\n"),
            {});
    const EquilibriaResult& all = results.of<EquilibriaResult>();
    ASSERT_EQ(all.number.size(), 4) << all.why;
    EXPECT_EQ(std::ranges::count(all.stability, 1), 2) << damping;
    EXPECT_EQ(std::ranges::count(all.stability, -1), 2) << damping;
  }
}

/// C less what others resist by is Σ c_k j_k j_kᵀ: symmetric, of the sign of all c_k, and of no higher rank than they
/// are many.
void expectResistancesOf(const std::string& text, int sign, const std::vector<double>& at) {
  const Study study = readStudyText(text, "s.toml");
  const RestEquations equations = restEquations(study.mechanism, {});
  const int n = equations.coordinates;
  Box x(at.begin(), at.end());
  if (equations.roots.states() > n) {
    x.resize(equations.roots.states(), Interval(0.0));
    x[n] = Interval(1.0);
  }
  x.resize(x.size() + n, Interval(0.0));
  const Resistances resistances = Resistances::of(n, equations.resistances, equations.masses,
                                                  evaluate<Interval>(equations.resisting, x, {}, Interval(0.0)));
  const NearRest near = NearRest::of(n, evaluate<Interval>(equations.nearRest, x, {}, Interval(0.0)));
  Eigen::MatrixXd c(n, n);
  for (int i = 0; i < n * n; ++i) c(i / n, i % n) = midpoint(near.damping[i]) - midpoint(resistances.others[i]);
  const double size = c.cwiseAbs().maxCoeff();
  EXPECT_GT(size, 1e-3);
  EXPECT_LE((c - c.transpose()).cwiseAbs().maxCoeff(), 1e-12 * size);
  const Eigen::VectorXd values = pencilValuesOf(sign * c, Eigen::MatrixXd::Identity(n, n));
  EXPECT_GE(values[0], -1e-12 * size);
  const auto nonzero =
      std::ranges::count_if(resistances.coefficients, [](const Interval& k) { return !contains(k, 0); });
  EXPECT_LE((values.array() > 1e-12 * size).count(), nonzero);
  EXPECT_GE(nonzero, 1);
  for (const Interval& each : resistances.coefficients) EXPECT_GE(sign * midpoint(each), 0);
  EXPECT_EQ(resistances.takesEnergy(), sign > 0);
  EXPECT_TRUE(resistances.isSymmetric());
}

TEST(Equilibria, KnowByWhatLoadsResist) {
  const std::string joints =
      hinge("A", "inertial", "K1") + element("revolute", "B", "from = \"K1\"\nto = \"K2\"\naxis = \"x\"") +
      element("link", "l", "from = \"K2\"\nto = \"E\"\nvector = [\"0.3\", \"0.2\", \"-0.4\"]") +
      element("prismatic", "P", "from = \"E\"\nto = \"K3\"\naxis = \"y\"") +
      element("revolute", "Q", "from = \"K3\"\nto = \"K4\"\naxis = \"z\"") +
      element("mass", "m", "at = \"K4\"\nmass = 1\ninertia = [1, 1, 1]\ncentre = [\"0.1\", 0, 0]");
  const std::vector<double> at{0.3, -0.4, 0.1, 0.7};
  const auto studyWith = [&](const std::string& mechanism) { return studyOf(mechanism, output("A.angle")); };
  const std::string ends = "from_point = [\"0.3\", \"-0.2\", \"0.7\"]\nto_point = [\"0.1\", \"0.4\", \"0.2\"]\n";
  for (const int sign : {1, -1}) {
    const auto signedNumber = [&](const std::string& text) {
      return "\"" + std::string(sign < 0 ? "-" : "") + text + "\"";
    };
    for (const std::string from : {"inertial", "K2"}) {
      const std::string both = "from = \"" + from + "\"\nto = \"K4\"\n" + ends;
      expectResistancesOf(
          studyWith(joints + element("spring-damper", "D", both + "stiffness = 3\ndamping = " + signedNumber("0.7"))),
          sign, at);
      const auto vector = [&](const char* x, const char* y, const char* z) {
        return "[" + signedNumber(x) + ", " + signedNumber(y) + ", " + signedNumber(z) + "]\n";
      };
      expectResistancesOf(studyWith(joints + element("bushing", "D",
                                                     both + "stiffness = [1, 2, 3]\nangular_stiffness = [3, 4, 5]\n" +
                                                         "damping = " + vector("0.3", "0.5", "0.1") +
                                                         "angular_damping = " + vector("0.2", "0.4", "0.6"))),
                          sign, at);
    }
    expectResistancesOf(studyWith(joints + element("joint-spring", "D",
                                                   "joint = \"P\"\nstiffness = 1\ndamping = " + signedNumber("2"))),
                        sign, at);
  }
  // Pressed into a plane, on which it would slip.
  expectResistancesOf(
      studyWith(joints + element("plane-contact", "D",
                                 "from = \"K1\"\nto = \"K4\"\nfrom_point = [0, 0, 1]\nnormal = [\"0.6\", 0, \"0.8\"]\n"
                                 "radius = \"0.3\"\nstiffness = 100\ndamping = \"0.1\"\nfriction = \"0.5\"\n"
                                 "slip_rate = \"0.2 m/s\"")),
      1, at);
}

/// With forces of a potential and none; what turns the motion aside.
TEST(Equilibria, AreNotSettledByDampersWhereForcesHaveNoPotential) {
  const auto stabilityWith = [](const std::string& k, const std::string& off, const std::string& aside,
                                const std::string& damping = "2") {
    const auto force = [&](const std::string& own, const std::string& other, const std::string& sign) {
      return element("joint-force", "F" + own,
                     "joint = \"" + own + "\"\nforce = \"(-(" + k + ")*" + own + ".displacement + " + sign + "(" + off +
                         ")*" + other + ".displacement)*(1 N/m) + " + sign + "(" + aside + ")*(1 N s/m)*" + other +
                         ".rate\"");
    };
    const Results results =
        run(machineOf(studyOf(element("prismatic", "X", "from = \"inertial\"\nto = \"A\"\naxis = \"x\"") +
                                  element("prismatic", "Y", "from = \"A\"\nto = \"B\"\naxis = \"y\"") +
                                  element("mass", "b", "at = \"B\"\nmass = 1") + force("X", "Y", "") +
                                  force("Y", "X", "-") + damperBetween("D", "inertial", "B", damping),
                              output("X.displacement"), "\"interval\"") +
                      "[equilibria]\ndisplacements = \"10 mm\"\n"),
            {});
    return results.of<EquilibriaResult>().stability;
  };
  using Found = std::vector<std::int64_t>;
  EXPECT_EQ(stabilityWith("100", "0", "0"), (Found{1}));
  EXPECT_EQ(stabilityWith("100", "30", "0"), (Found{0}));  // a follower force
  EXPECT_EQ(stabilityWith("100", "0", "3"), (Found{1}));
  EXPECT_EQ(stabilityWith("-100", "0", "0"), (Found{-1}));
  EXPECT_EQ(stabilityWith("-100", "0", "0", "-2"), (Found{-1}));
  EXPECT_NE(stabilityWith("-100", "0", "50", "0"), (Found{-1}));  // held by what turns it aside
}

TEST(Equilibria, NameOnlyQuantitiesThatRestFollowsFrom) {
  const std::string pushed = pendulum + element("joint-force", "push", "joint = \"A\"\nforce = \"9.5 N m\"") +
                             element("state", "z", "initial = 0\nrate = \"(A.angle/(1 rad) - z)/(1 s)\"") +
                             uncertain("c", "± 15 %");
  const std::string text = refusalOf(studyOf(pushed + uncertain("l", "± 5 %"), output("A.angle")));
  EXPECT_THAT(text, HasSubstr("a position of rest is not proved to exist for 'l' in ["));
  EXPECT_THAT(text, ::testing::Not(HasSubstr("'c'")));
}

/// On a coordinate that closes the loop.
TEST(Equilibria, OfALoopAreUnstableWhereAJointGivesEnergy) {
  for (const auto& [damping, sign] : {std::pair{"0.5", 1}, {"-0.5", -1}}) {
    const std::string damper =
        element("joint-spring", "d", std::string("joint = \"D\"\nstiffness = 0\ndamping = \"") + damping + "\"");
    const Results results =
        run(machineOf(studyOf(linkage() + damper, output("A.angle")) + "[equilibria]\nangles = \"180 deg\"\n"), {});
    const EquilibriaResult& all = results.of<EquilibriaResult>();
    ASSERT_EQ(all.number.size(), 4) << all.why;
    EXPECT_EQ(std::ranges::count(all.stability, 1), sign > 0 ? 2 : 0);
    EXPECT_EQ(std::ranges::count(all.stability, -1), sign > 0 ? 2 : 4);
  }
}

/// The region ends where the lever rests for some values.
TEST(Equilibria, AreNotToldAsAllWhereOneMayLeaveTheRegion) {
  const Results results = run(machineOf(toggles(1, "± 2 %", "0.1 rad")), {});
  const EquilibriaResult& found = results.of<EquilibriaResult>();
  EXPECT_FALSE(found.isComplete);
  EXPECT_GT(found.open, 0);
  EXPECT_THAT(found.told().front(), HasSubstr("others may be there"));
}

/// Two arms whose springs nearly balance their weight.
std::string lamp(const std::string& tolerance, const std::string& seconds) {
  const auto arm = [](const std::string& name, const std::string& at, const std::string& mass, const std::string& to) {
    return element("mass", name, "at = \"" + at + "\"\nmass = \"" + mass + "\"\ncentre = [\"" + to + "\", 0, 0]");
  };
  const auto spring = [](const std::string& name, const std::string& ends, const std::string& numbers) {
    return element("spring-damper", name, ends + "\n" + numbers);
  };
  return "[study]\nanalysis = \"equilibria\"\ncompare = [\"interval\"]\n[limits]\ntime = \"" + seconds +
         " s\"\n[equilibria]\nangles = \"90 deg\"\n[mechanism]\ngravity = [0, \"-9.81\", 0]\n"
         "parameters = { k1 = \"170 N/m\", k2 = \"302 N/m\", head = \"0.4 kg\" }\n" +
         hinge("A", "inertial", "K1", "\"60 deg\"") +
         element("link", "arm", "from = \"K1\"\nto = \"E1\"\nvector = [\"0.4\", 0, 0]") +
         arm("M1", "K1", "0.3", "0.2") + hinge("B", "E1", "K2", "\"-60 deg\"") + arm("M2", "K2", "0.25", "0.175") +
         arm("H", "K2", "head", "0.35") +
         spring("S1", "from = \"inertial\"\nto = \"K1\"\nfrom_point = [0, \"0.3\", 0]\nto_point = [\"0.12\", 0, 0]",
                "stiffness = \"k1\"\nrest_length = \"0.1\"") +
         spring("S2", "from = \"K1\"\nto = \"K2\"\nfrom_point = [\"0.522\", \"0.0445\", 0]\nto_point = [\"0.1\", 0, 0]",
                "stiffness = \"k2\"\nrest_length = \"0.08\"") +
         uncertain("k1", tolerance) + uncertain("k2", tolerance) + uncertain("head", tolerance) + output("A.angle") +
         output("B.angle");
}

/// The position that is proved for all values is one of those that are found, however little else is settled in time.
TEST(Equilibria, HoldTheOneThatIsProvedToBeThere) {
  const Results results = run(machineOf(lamp("± 5 %", "6")), {});
  const EquilibriaResult& found = results.of<EquilibriaResult>();
  ASSERT_GE(found.number.size(), 1U);
  EXPECT_EQ(found.units, "deg, deg");
  int proved = 0;
  for (std::size_t k = 0; k < found.number.size(); ++k) {
    if (found.lower(k, 0) > results.interval.at.upper(0, 0) || found.upper(k, 0) < results.interval.at.lower(0, 0))
      continue;
    ++proved;
    EXPECT_EQ(found.stability[k], 1);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_NEAR(found.lower(k, i), results.interval.at.lower(0, i), 1e-3);
      EXPECT_NEAR(found.upper(k, i), results.interval.at.upper(0, i), 1e-3);
    }
  }
  EXPECT_EQ(proved, 1);
  if (!found.isComplete) {
    EXPECT_THAT(found.why, HasSubstr("not settled: one that is proved for all values moves by 30.9 deg of A.angle"));
  }
}

/// Opposite to where it begins, at either end of the turn.
TEST(Equilibria, AreNotLostWhereAWholeTurnEnds) {
  for (const char* initial : {"\"-90 deg\"", "\"270 deg\"", "\"-1/2 pi\""}) {
    const std::string bob =
        hinge("A", "inertial", "K", initial) + element("mass", "bob", "at = \"K\"\nmass = 2\ncentre = [1, 0, 0]");
    const Results results = run(machineOf(studyOf("gravity = [0, \"-9.81\", 0]\n" + bob, output("A.angle")) +
                                          "[equilibria]\nangles = \"180 deg\"\n"),
                                {});
    const EquilibriaResult& all = results.of<EquilibriaResult>();
    EXPECT_TRUE(all.isComplete) << initial << all.why;
    EXPECT_EQ(all.stability, (std::vector<std::int64_t>{-1, 1, -1})) << initial;
  }
}

/// K = [[100, f], [-f, 100]], f about zero: s² = −100 ± i f, so |s|² = √(10⁴ + f²), of either.
TEST(Equilibria, OfAFollowerForceThatIsZeroInTheMiddleAreNoPairOfAPotential) {
  const std::string text = studyOf(
      "parameters = { f = 0 }\n" + element("prismatic", "X", "from = \"inertial\"\nto = \"A\"\naxis = \"x\"") +
          element("prismatic", "Y", "from = \"A\"\nto = \"B\"\naxis = \"y\"") +
          element("mass", "b", "at = \"B\"\nmass = 1") +
          element("joint-force", "FX", "joint = \"X\"\nforce = \"(-100*X.displacement - f*Y.displacement)*(1 N/m)\"") +
          element("joint-force", "FY", "joint = \"Y\"\nforce = \"(-100*Y.displacement + f*X.displacement)*(1 N/m)\"") +
          "[[uncertain]]\nquantity = \"f\"\ninterval = [-5, 5]\n",
      frequencies(2));
  EXPECT_THAT(refusalOf(text), HasSubstr("are not told apart"));
}

std::string refusalOf(const std::string& text) {
  try {
    run(machineOf(text), {});
  } catch (const StudyError& error) {
    return error.what();
  }
  return "";
}

TEST(Equilibria, SayWhatHasNone) {
  const std::string bob = element("mass", "bob", "at = \"K\"\nmass = 2\ncentre = [1, 0, 0]"), asked = output("A.angle");
  EXPECT_THAT(refusalOf(studyOf(hinge("A", "inertial", "K") + bob, asked)),
              HasSubstr("nothing holds 'A.angle' where it rests"));
  EXPECT_THAT(refusalOf(studyOf("gravity = [0, \"-9.81\", 0]\n" + hinge("A", "inertial", "K") + bob +
                                    element("joint-force", "M", "joint = \"A\"\nforce = \"30 N m\""),
                                asked)),
              HasSubstr("no position of rest is found"));
  const std::string held =
      hinge("A", "inertial", "K") + bob + element("joint-spring", "S", "joint = \"A\"\nstiffness = 5");
  EXPECT_THAT(
      refusalOf(studyOf(held + element("joint-force", "M", "joint = \"A\"\nforce = \"3 N m * sin(t/(1 s))\""), asked)),
      HasSubstr("follow time"));
  EXPECT_THAT(refusalOf(studyOf(held + element("joint-friction", "R", "joint = \"A\"\ncoulomb = 1"), asked)),
              HasSubstr("jumps"));
  EXPECT_THAT(refusalOf(studyOf(held, asked + output("frequency.2"))), HasSubstr("frequency.2"));
  EXPECT_THAT(refusalOf(studyOf(held, asked) + "[equilibria]\ndisplacements = 1\n"),
              HasSubstr("how far 'A.angle' is looked at is not said"));
  EXPECT_THAT(refusalOf(studyOf(held, asked) + "[equilibria]\nangles = -1\n"), HasSubstr("is below 0"));
  EXPECT_THAT(refusalOf(studyOf(held + element("state", "z", "initial = 1\nrate = \"-z/(1 s)\""), asked) +
                        "[equilibria]\nangles = 1\n"),
              HasSubstr("looked for where no element has states"));
  EXPECT_THAT(refusalOf(studyOf(held + uncertain("A.angle", "± 0.1"), asked)),
              HasSubstr("'A.angle' is where rest is looked for first"));
  EXPECT_THAT(refusalOf(studyOf("gravity = [0, \"-9.81\", 0]\n" + hinge("A", "inertial", "K", "\"90 deg\"") + bob,
                                asked + output("frequency.1"))),
              HasSubstr("at rest 0 of 1 modes oscillate"));
}

const std::string shapes = "[modes]\nshapes = true\n";

/// x of (K − λ M) x = 0, M diagonal, by inverse iteration (H. Wielandt) with pivots.
Vector shapeOf(const Dense& stiffness, const Vector& masses, const Precise& square) {
  const std::size_t n = masses.size();
  Vector x(n);
  for (std::size_t i = 0; i < n; ++i) x[i] = Precise(1) / (i + 1);
  for (int round = 0; round < 3; ++round) {
    Dense m = stiffness;
    for (std::size_t i = 0; i < n; ++i) {
      m[i][i] -= (square + square * Precise("1e-27")) * masses[i];
      m[i].push_back(x[i]);
    }
    for (std::size_t i = 0; i < n; ++i) {
      const auto pivot = std::ranges::max_element(m.begin() + static_cast<std::ptrdiff_t>(i), m.end(), {},
                                                  [&](const Vector& row) { return Precise(abs(row[i])); });
      std::swap(m[i], *pivot);
      for (std::size_t j = i + 1; j < n; ++j) {
        const Precise factor = m[j][i] / m[i][i];
        for (std::size_t l = i; l <= n; ++l) m[j][l] -= factor * m[i][l];
      }
    }
    for (std::size_t i = n; i-- > 0;) {
      x[i] = m[i][n];
      for (std::size_t l = i + 1; l < n; ++l) x[i] -= m[i][l] * x[l];
      x[i] /= m[i][i];
    }
    Precise most(0);
    for (const Precise& each : x) most = std::max(most, Precise(abs(each)));
    for (Precise& each : x) each /= most;
  }
  return x;
}

/// Of a mode's true shape, φ = Σ φ_r (the shape that is 1 at r), over all modes that it is not told apart from: which
/// all are among those that were found.
void expectHeld(const ModesResult& found, int mode, const Vector& shape) {
  const auto own = std::ranges::find(found.mode, mode) - found.mode.begin();
  ASSERT_LT(own, std::ssize(found.mode)) << found.why;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    Precise lower(0), upper(0);
    for (std::size_t k = 0; k < found.number.size(); ++k) {
      if (found.mode[k] < found.first[own] || found.mode[k] > found.last[own]) continue;
      const Precise& share = shape[found.reference[k] - 1];
      const Precise one = share * found.lower(k, i), other = share * found.upper(k, i);
      lower += std::min(one, other);
      upper += std::max(one, other);
      EXPECT_EQ(found.imaginaryLower(k, i), 0);
      EXPECT_EQ(found.imaginaryUpper(k, i), 0);
    }
    const Precise rounding = abs(shape[i]) * Precise("1e-24");  // of the reference's iteration
    EXPECT_TRUE(lower - rounding <= shape[i] && shape[i] <= upper + rounding)
        << "mode " << mode << " coordinate " << i << ": " << shape[i].str(20) << " in " << lower.str(20) << ", "
        << upper.str(20);
  }
}

/// Coordinates of the chain are its springs' extensions.
Vector extensionsOf(const Vector& places) {
  Vector all = places;
  for (std::size_t i = all.size(); i-- > 1;) all[i] -= all[i - 1];
  return all;
}

/// So many masses, of whose modes the slowest are alone, so many of them.
class ShapesOfChains : public ::testing::TestWithParam<std::tuple<int, const char*, int>> {};

TEST_P(ShapesOfChains, AreThoseOfTheirPencils) {
  const auto [many, tolerance, alone] = GetParam();
  const Machine machine = machineOf(chain(many, tolerance, frequencies(many) + shapes, "\"interval\""));
  const Results results = run(machine, {});
  const ModesResult& found = results.of<ModesResult>();
  ASSERT_GE(std::ssize(found.number), alone) << found.why;
  EXPECT_EQ(found.why.empty(), std::ssize(found.number) == many);
  for (std::size_t k = 0; k < found.number.size(); ++k) {
    if (static_cast<int>(k) < alone) {
      EXPECT_EQ(found.first[k], found.last[k]) << k + 1;
    }
    EXPECT_EQ(found.lower(k, found.reference[k] - 1), 1);
    EXPECT_EQ(found.upper(k, found.reference[k] - 1), 1);
  }
  Points points;
  for (int number = 0; number < 10; ++number) {
    const Dense stiffness = stiffnessOf(point(points, machine, number));
    for (std::size_t k = 0; k < found.number.size(); ++k) {
      const int mode = static_cast<int>(found.mode[k]);
      const Precise square = squareOf(stiffness, chainMasses(many), mode);
      expectHeld(found, mode, extensionsOf(shapeOf(stiffness, chainMasses(many), square)));
      EXPECT_TRUE(Precise(found.slowest[k]) <= sqrt(square) / turn + Precise("1e-20"));
      EXPECT_TRUE(Precise(found.fastest[k]) >= sqrt(square) / turn - Precise("1e-20"));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(OfMasses, ShapesOfChains,
                         ::testing::Values(std::tuple{1, "± 15 %", 1}, std::tuple{2, "± 1 %", 2},
                                           std::tuple{2, "± 15 %", 2}, std::tuple{3, "± 5 %", 3},
                                           std::tuple{3, "± 15 %", 2}, std::tuple{10, "± 1 %", 10},
                                           std::tuple{10, "± 5 %", 7}));

/// With masses that are uncertain too.
TEST(Equilibria, HaveShapesOfUncertainMasses) {
  constexpr int many = 3;
  const Machine machine = machineOf(chain(many, "± 5 %", frequencies(many) + shapes, "\"interval\"", "± 5 %"));
  const Results results = run(machine, {});
  Points points;
  for (int number = 0; number < 20; ++number) {
    const Vector p = point(points, machine, number), masses(p.begin() + many, p.end());
    const Dense stiffness = stiffnessOf({p.begin(), p.begin() + many});
    for (int k = 1; k <= many; ++k)
      expectHeld(results.of<ModesResult>(), k,
                 extensionsOf(shapeOf(stiffness, masses, squareOf(stiffness, masses, k))));
  }
}

/// As tight as first powers of the deviations: twice as wide for twice the tolerance, and not wider than corners by
/// much.
TEST(Equilibria, HaveShapesAboutAsTightAsCorners) {
  constexpr int many = 3;
  for (const char* tolerance : {"± 0.1 %", "± 1 %"}) {
    const Machine machine = machineOf(chain(many, tolerance, frequencies(many) + shapes, "\"interval\""));
    const Results results = run(machine, {});
    const ModesResult& found = results.of<ModesResult>();
    const Box box = freeBox(machine, machine.box);
    for (int k = 0; k < many; ++k)
      for (int i = 0; i < many; ++i) {
        Precise least(1e9), most(-1e9);
        for (int corner = 0; corner < 1 << many; ++corner) {
          Vector p;
          for (int j = 0; j < many; ++j) p.emplace_back((corner >> j) % 2 == 0 ? box[j].lower() : box[j].upper());
          const Dense stiffness = stiffnessOf(p);
          const Vector own =
              extensionsOf(shapeOf(stiffness, chainMasses(many), squareOf(stiffness, chainMasses(many), k + 1)));
          const Precise value = own[i] / own[found.reference[k] - 1];
          least = std::min(least, value);
          most = std::max(most, value);
        }
        EXPECT_LE(Precise(found.upper(k, i) - found.lower(k, i)), Precise(1.2) * (most - least) + Precise(1e-12))
            << tolerance << k << i;
      }
  }
}

TEST(Equilibria, OfASquareHaveTwoShapesThatAreNotToldApart) {
  std::string parameters = "parameters = { ", elements, uncertainties;
  for (int i = 0; i < 4; ++i) {
    const std::string own = std::to_string(i), next = std::to_string((i + 1) % 4), last = std::to_string((i + 3) % 4),
                      place = "*Z" + own + ".displacement";
    parameters += (i > 0 ? ", k" : "k") + own + " = 100";
    elements += element("prismatic", "Z" + own, "from = \"inertial\"\nto = \"P" + own + "\"\naxis = \"z\"") +
                element("mass", "m" + own, "at = \"P" + own + "\"\nmass = 1") +
                element("joint-force", "F" + own,
                        "joint = \"Z" + own + "\"\nforce = \"(-k" + own + place + " - 40" + place + " + 20*Z" + next +
                            ".displacement + 20*Z" + last + ".displacement)*(1 N/m)\"");
    uncertainties += uncertain("k" + own, "± 5 %");
  }
  const Machine machine =
      machineOf(studyOf(parameters + " }\n" + elements + uncertainties, frequencies(4) + shapes, "\"interval\""));
  const Results results = run(machine, {});
  const ModesResult& found = results.of<ModesResult>();
  ASSERT_EQ(found.number.size(), 4);
  EXPECT_EQ(found.first, (std::vector<std::int64_t>{1, 2, 2, 4}));
  EXPECT_EQ(found.last, (std::vector<std::int64_t>{1, 3, 3, 4}));
  EXPECT_THAT(found.told()[1], HasSubstr("mode 2 of 2 to 3, which are not told apart"));
  Points points;
  for (int number = 0; number < 20; ++number) {
    const Vector p = point(points, machine, number);
    Dense stiffness(4, Vector(4, Precise(0)));
    for (int i = 0; i < 4; ++i) {
      stiffness[i][i] += p[i] + 40;
      stiffness[i][(i + 1) % 4] -= 20;
      stiffness[(i + 1) % 4][i] -= 20;
    }
    for (int k = 1; k <= 4; ++k)
      expectHeld(found, k, shapeOf(stiffness, Vector(4, Precise(1)), squareOf(stiffness, Vector(4, Precise(1)), k)));
  }
}

/// Two masses with dampers that are not in proportion to springs: s of det(s² M + s C + K) = 0 by Newton's steps.
TEST(Equilibria, HaveComplexShapesWhereTheyAreDamped) {
  using Complex = std::complex<Precise>;
  const auto text = [](const std::string& tolerance) {
    return chain(2, tolerance,
                 element("joint-spring", "D1", "joint = \"J1\"\ndamping = \"c\"") + frequencies(2) + shapes,
                 "\"interval\"");
  };
  std::string study = text("± 2 %");
  study.replace(study.find("parameters = { "), 15, "parameters = { c = \"1 N s/m\", ");
  const Machine machine = machineOf(study + uncertain("c", "± 10 %"));
  const Results results = run(machine, {});
  const ModesResult& found = results.of<ModesResult>();
  ASSERT_EQ(found.number.size(), 2) << found.why;
  Points points;
  for (int number = 0; number < 20; ++number) {
    const Vector p = point(points, machine, number);
    const Precise &k1 = p[0], &k2 = p[1], &c = p[2], m1("1.1"), m2("1.2");
    for (int mode = 0; mode < 2; ++mode) {
      // (m1 s² + c s + k1 + k2) (m2 s² + k2) − k2²
      Complex s(Precise(0), Precise((found.slowest[mode] + found.fastest[mode]) / 2) * turn);
      for (int step = 0; step < 12; ++step) {
        const Complex first = m1 * s * s + c * s + (k1 + k2), second = m2 * s * s + k2;
        const Complex value = first * second - k2 * k2,
                      slope = (Precise(2) * m1 * s + c) * second + first * (Precise(2) * m2 * s);
        s -= value / slope;
      }
      // Row 2: −k2 x1 + (m2 s² + k2) x2 = 0, and extensions x1, x2 − x1.
      const Complex x2(1), x1 = (m2 * s * s + k2) / k2;
      const std::array<Complex, 2> extensions{x1, x2 - x1};
      const std::size_t reference = found.reference[mode] - 1;
      for (std::size_t i = 0; i < 2; ++i) {
        const Complex ratio = extensions[i] / extensions[reference];
        EXPECT_THAT(Interval(found.lower(mode, i), found.upper(mode, i)), testing::Encloses(Precise(ratio.real())));
        EXPECT_THAT(Interval(found.imaginaryLower(mode, i), found.imaginaryUpper(mode, i)),
                    testing::Encloses(Precise(ratio.imag())));
      }
      EXPECT_GT(found.imaginaryUpper(mode, 1 - reference) * found.imaginaryLower(mode, 1 - reference), 0);
    }
  }
}

TEST(Equilibria, SayWhereThereAreNoShapes) {
  EXPECT_THAT(refusalOf(studyOf(pendulum, output("A.angle")) + shapes), HasSubstr("no output is of a mode"));
}

}  // namespace
}  // namespace gamut::equilibria
