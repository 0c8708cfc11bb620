// Requirements and outputs that hold the sign of a surface on which some motions rest already.
#include <gmock/gmock.h>

#include "studies/results/results_file.hpp"
#include "studies/running/run.hpp"
#include "tests/studies/sample_study.hpp"

namespace gamut {
namespace {

/// x falls by 9/8 a second and rests from 0.444 … 0.889 s on, where its sign is -1/8.
Study comingToRest(const std::string& besides, const std::string& times = "[0.25]") {
  return readStudyText(R"([study]
title = "Comes to rest"
analysis = "dynamics"
horizon = 0.5
output_times = )" + times +
                           R"toml(
[mechanism]
[[mechanism.element]]
type = "state"
name = "x"
initial = 0.75
rate = "-1/8 - sign(x)"
[[uncertain]]
name = "x0"
quantity = "x"
interval = [0.5, 1.0]
[stochastic]
samples = 512
[[output]]
quantity = "x"
)toml" + besides,
                       "s.toml");
}

/// Met where x0 >= 0.52875: those that rest before 0.47 s violate it, with a probability of 0.0575.
TEST(HeldSigns, AreNotMetWhereThatWasProvedBetweenOutputTimes) {
  const std::string requirement = R"(
[[requirement]]
name = "R"
always = "(-1/8 - sign(x) + 0.1)*20*(1/2 - t/(1 s)) < LIMIT"
from = 0.25
)";
  const auto withLimit = [&](const std::string& limit) {
    std::string text = requirement;
    return text.replace(text.find("LIMIT"), 5, limit);
  };
  for (const char* times : {"[0.25]", "[0.25, 0.45]"}) {
    const RequirementResult result = run(comingToRest(withLimit("0.06"), times)).requirements.at(0);
    EXPECT_NE(result.word, Decision::met) << times;
    EXPECT_LE(result.probabilityLower, 0.9425) << times;
    EXPECT_GE(result.probabilityUpper, 0.9425) << times;
  }
  EXPECT_EQ(run(comingToRest(withLimit("0.12"))).requirements.at(0).word, Decision::met);  // least 0.1111 away
}

TEST(HeldSigns, AsOutputsHoldAllSamples) {
  for (const char* quantity : {"sign(x)", "sign(2*x)", "sign(-x)", "where(x > 0, 1, 2)", "sign(x^3)", "abs(sign(x))"}) {
    const Results results = run(comingToRest("[[output]]\nname = \"s\"\nquantity = \"" + std::string(quantity) + "\""));
    EXPECT_EQ(results.comparison.verdict, Agreement::inside) << quantity;
  }
}

}  // namespace
}  // namespace gamut
