// Ranges and words that a study file may use, as its guide (docs/study-file.md) explains them.
#include "studies/settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string_view>

namespace gamut {
namespace {

constexpr const char *text = R"({"type": "string"})", *number = R"({"type": ["number", "string"]})",
                     *aboveZero = R"({"type": ["number", "string"], "exclusiveMinimum": 0})",
                     *fromZero = R"({"type": ["number", "string"], "minimum": 0})";

void describeStudy(Settings& s, Study&) {
  s.own({"title", "text", "the file's name"}, text);
  s.own({"analysis",
         "`\"dynamics\"`; `\"inverse-dynamics\"` (below); `\"kinematics\"` (the outputs where the mechanism stands "
         "at first); or `\"equilibria\"` (where it rests, and how it vibrates there; below)",
         "required"},
        R"({"enum": ["dynamics", "inverse-dynamics", "kinematics", "equilibria"]})");
  s.own({"horizon", "end of the motion, s", "required where time passes", true}, aboveZero);
  s.own({"output_step", "outputs at 0, step, 2 step, … and at the horizon, s", "this or `output_times`", true},
        aboveZero);
  s.own({"output_times", "list of rising times, s; 0 and the horizon are added", "", true},
        R"({"type": "array", "items": {"type": ["number", "string"]}, "minItems": 1})");
  s.own(
      {"compare", "list of `\"interval\"` (guaranteed), `\"stochastic\"` (probable), `\"fuzzy\"` (possible)",
       "all three"},
      R"({"type": "array", "items": {"enum": ["interval", "stochastic", "fuzzy"]}, "minItems": 1, "uniqueItems": true})");
}

void describeUncertain(Settings& s, Study&) {
  s.own({"quantity",
         "a number of the mechanism: an initial value (`shoulder.angle`), a parameter (`upper.length`), or "
         "`ELEMENT.NUMBER` (`bob.mass`, `rod.vector.z`, `gravity.z`); or several, each uncertain by itself: a list of "
         "them, and `*` for any characters, `[\"rod*.length\", \"bob.mass\"]`",
         "required"},
        R"({"anyOf": [{"type": "string"}, {"type": "array", "items": {"type": "string"}, "minItems": 1}]})");
  s.own({"name", "text; not of several", "the quantity"}, text);
  s.own(
      {"interval",
       "`\"± 1 %\"` of the nominal value, `\"± 2 deg\"`, `\"+2 / -1 mm\"` (or in %, or each with its unit; one may be "
       "0), or `[lower, upper]`",
       "the least that holds the supports (points of a table) of distribution and membership, one of which is "
       "required then"},
      R"({"anyOf": [{"type": "string"}, {"type": "array", "items": {"type": ["number", "string"]}, "minItems": 2, "maxItems": 2}]})");
  s.own({"distribution",
         "`{ type = \"uniform\" }`, or another one [below](#distributions-and-memberships), with its keys", "uniform"},
        "distribution");
  s.own({"varies", "`\"freely\"`: it is no constant, but may take any course within the interval", "constant"},
        R"({"enum": ["freely"]})");
  s.own({"rate",
         "it may take any course within the interval that changes by no more than this in a second: `\"± 0.1 rad/s\"`",
         "constant"},
        number);
  s.own({"membership", "`{ type = \"triangular\" }`, or another one below", "triangular"}, "membership");
}

void describeDependence(Settings& s, Study&) {
  s.own({"quantities", "names of two or more uncertain quantities, constant in time", "required"},
        R"({"type": "array", "items": {"type": "string"}, "minItems": 2})");
  s.own({"rank_correlation",
         "of two a number, of more a matrix `[[1, 0.5, 0], [0.5, 1, 0.2], [0, 0.2, 1]]`: Spearman's; the quantities "
         "then have a Gaussian copula, and the matrix 2 sin(π ρ/6) of its normal numbers must be positive definite",
         "this or `unknown`"},
        R"({"anyOf": [{"type": ["number", "string"]}, {"type": "array", "items": {"type": "array"}}]})");
  s.own({"unknown", "`true`: nothing is known of how these depend on each other", "this or `rank_correlation`"},
        R"({"const": true})");
}

void describeOutput(Settings& s, Study&) {
  s.own({"quantity", "what is wanted: a quantity below, or an expression of them", "required"}, text);
  s.own({"name", "text", "the quantity"}, text);
  s.own({"unit", "in which it is told, everywhere; another one of its kind", "the SI unit"}, text);
  s.own({"resolution", "that differences up to this count for nothing: `\"0.01 mm\"`", "0"}, fromZero);
  s.own({"tightness", "the overestimation that is aimed at for it in place of `interval.tightness`, above 1",
         "`interval.tightness`", true},
        R"({"type": ["number", "string"], "exclusiveMinimum": 1})");
}

void describeRequirement(Settings& s, Study&) {
  s.own({"always",
         "a comparison with `<`, `<=`, `>` or `>=`, or two in one direction, of expressions as in an output, or of "
         "names of outputs (one that is called like another quantity, `t` or `pi` is refused); a number without a unit "
         "is in the SI unit of what it is compared with: met at all times of the window",
         "this or `eventually` is required"},
        text);
  s.own({"eventually", "the same, met at one time of the window at least", "this or `always` is required"}, text);
  s.own({"name", "text", "the comparison"}, text);
  s.own({"from", "begin of the window, s; it becomes an output time", "0 s", true}, fromZero);
  s.own({"until", "end of the window, likewise", "the horizon", true}, fromZero);
}

void describeSweep(Settings& s, Study&) {
  s.own(
      {"quantity",
       "what is varied: a number that the study states, of the mechanism or `SECTION.KEY`; its uncertainty goes along "
       "as it is stated",
       "required"},
      text);
  s.own({"values", "list of its values", "this, or the next three"},
        R"({"type": "array", "items": {"type": ["number", "string"]}, "minItems": 1})");
  s.own({"from", "the first of values that are spread evenly"}, number);
  s.own({"to", "the last of them"}, number);
  s.own({"count", "how many there are"}, R"({"type": "integer", "minimum": 1})");
}

void describeInterval(Settings& s, Study& study) {
  FlowOptions& flow = study.flow;
  s.number(
      {"tightness",
       "the overestimation aimed at: how many times wider than necessary an output's enclosure may be at the "
       "output times; above 1. Less costs more: degrees, bisection and repeated runs follow from it. Where a limit "
       "is met first, a note names it, the loosest output and the time",
       "1.02", true},
      {.least = 1,
       .isAbove = true,
       .fault = "is not above 1",
       .expected = "the overestimation that is aimed at, such as 1.02"},
      flow.tightness);
  s.number({"tolerance", "truncation error aimed at in a step, relative; above 0, at most 1",
            "chosen: by the tightness, the box and how many quantities are uncertain", true},
           {.least = 0,
            .most = 1,
            .isAbove = true,
            .fault = "is not above 0 and at most 1",
            .expected = "a small number above 0"},
           flow.tolerance);
  s.whole({"order", "of the series in time (4 to 30); `\"auto\"` or a number", "by the tolerance, 7 to 20", true}, 4,
          30, flow.order, true);
  s.whole({"degree", "of the polynomials in the uncertain quantities (1 to 30); `\"auto\"` or a number",
           "chosen on the way"},
          1, 30, flow.degree, true);
  s.flag({"split",
          "whether the box may be bisected (`\"auto\"`: true); of more than 8 quantities of like influence it is "
          "bisected only where a step fails otherwise, not for a tighter enclosure",
          "true", true},
         flow.split, true);
  s.whole({"max_pieces", "into how many pieces it may be bisected (1 to 1 000 000)", "2000", true}, 1, 1000000,
          flow.maxPieces);
}

/// What may be kept of something in the results, bytes.
NumberOf storageSize() {
  return {.unit = "GB",
          .least = 0,
          .most = gigabyte,
          .fault = "is not between 0 and 1 GB",
          .expected = "a size such as \"64 MB\"",
          .scale = gigabyte};
}

NumberOf positive() {
  return {.least = 0, .isAbove = true, .fault = "is not positive", .expected = "a number above 0"};
}

void describeStochastic(Settings& s, Study& study) {
  EnsembleOptions& ensemble = study.ensemble;
  s.whole(
      {"samples",
       "how many samples, up to 1 000 000 000; corners, centre, points inside the alpha-cuts and extremes are sampled "
       "besides, see below",
       "4096"},
      1, 1000000000, ensemble.samples);
  s.choice({"plan",
            "`\"sobol\"`, `\"random\"`, `\"latin-hypercube\"`, `\"halton\"` or `\"grid\"` (as many values of every "
            "quantity). All but the random one round the number of samples up: a grid to as many values of every "
            "quantity, the others from 32 samples on to a multiple of 16, see below. Of Sobol' at most 3667 uncertain "
            "quantities, of Halton 1229",
            "`\"sobol\"`"},
           {"sobol", "random", "latin-hypercube", "halton", "grid"},
           [&](const std::string& word) { ensemble.plan = planNamed(word); });
  s.whole({"seed", "a whole number", "1"}, 0, std::numeric_limits<std::int64_t>::max(), ensemble.seed);
  s.table({"tolerance", "`{ relative, absolute }`, of the integration of samples", "1e-10, 1e-12"}, [&](Settings& t) {
    t.number({"relative", "of each step, beside the state"}, positive(), ensemble.tolerance.relative);
    t.number({"absolute", "of each step"}, positive(), ensemble.tolerance.absolute);
  });
  s.choice({"method", "`\"adams\"`, or `\"bdf\"` for mechanisms with stiff springs", "`\"adams\"`"}, {"adams", "bdf"},
           [&](const std::string& word) { ensemble.method = word == "bdf" ? Method::bdf : Method::adams; });
  s.number({"storage",
            "what the samples' values and motions may take in the [results](results-file.md), in GB or as text "
            "(`\"64 MB\"`), up to 1 GB; 0 keeps none",
            "`\"4 MB\"`"},
           storageSize(), study.storage);
}

void describeDistribution(Settings& s, Study& study) {
  s.own({"times",
         "of which output times probabilities are bounded: how many, spread evenly (up to 1000; 0: none), or a list "
         "(`[\"1 s\", 2]`), which become output times",
         "10", true},
        R"({"anyOf": [{"type": "integer", "minimum": 0, "maximum": 1000},)"
        R"( {"type": "array", "items": {"type": ["number", "string"]}}]})");
  s.number({"gap", "how far apart the bounds of a probability may be, 0.001 to 1", "0.005"},
           {.least = 0.001,
            .most = 1,
            .fault = "is not between 0.001 and 1",
            .expected = "a difference of probabilities, such as 0.005"},
           study.distribution.gap);
  s.number(
      {"storage", "what the outputs' polynomials may take in the [results](results-file.md), as `stochastic.storage`",
       "`\"8 MB\"`"},
      storageSize(), study.distribution.storage);
}

void describeFuzzy(Settings& s, Study& study) {
  s.whole({"levels", "number of alpha-cuts from 0 to 1 (2 to 101)", "11"}, 2, 101, study.levels);
  s.choice({"method",
            "where samples are put inside the alpha-cuts, by the transformation method after Hanss: `\"reduced\"`, "
            "`\"general\"` or `\"extended\"`, see below",
            "`\"extended\"`"},
           {"reduced", "general", "extended"},
           [&](const std::string& word) { study.ensemble.transformation = transformationNamed(word); });
}

void describeLimits(Settings& s, Study& study) {
  const auto limit = [&](const char* key, const char* meaning, const char* otherwise, const char* unit,
                         std::optional<double>& value) {
    NumberOf of = positive();
    of.unit = unit;
    of.scale = of.unit == "GB" ? gigabyte : 1;
    s.optional({key, meaning, otherwise}, of, value);
  };
  limit("time", "of the whole run", "1800 s", "s", study.limits.time);
  limit("memory", "of the whole run", "three quarters of the machine's (or its control group's) memory", "GB",
        study.limits.memory);
  limit("enclosure_time", "of the guaranteed part, alpha-cuts included; not above `time`",
        "two thirds of the whole run's", "s", study.limits.enclosureTime);
  limit("enclosure_memory", "likewise; not above `memory`", "two thirds of the whole run's", "GB",
        study.limits.enclosureMemory);
  limit("sample_time", "of the integration of each sample, counted as below", "a hundredth of `time`", "s",
        study.limits.sampleTime);
  const auto share = [&](const char* key, const char* meaning, const char* otherwise, double& value) {
    s.number({key, meaning, otherwise},
             {.least = 0,
              .most = std::numeric_limits<double>::max(),
              .fault = "is negative, or no number",
              .expected = "how many times what enclosure and samples cost, such as 2"},
             value);
  };
  share("cuts",
        "what alpha-cuts' own flows may cost, in times what enclosure and samples cost, which count as 2.5 s at least "
        "(at rest: 1 s)",
        "0.5", study.shares.cuts);
  share("requirements", "the same of requirements", "0.8", study.shares.requirements);
  share(
      "probabilities",
      "the same of probabilities, with Sobol' indices and the polynomials of `gamut sample`; all three together twice, "
      "or 5 s",
      "0.7", study.shares.probabilities);
  share("advice",
        "what it may cost to try what lets an enclosure that ended early come to the horizon: as above, apart from the "
        "others; and half of what is left of `time` at most",
        "1", study.shares.advice);
  share("derivatives",
        "the same of `sensitivity.derivatives`, in times what the enclosure cost, which counts as 1 s at least", "20",
        study.shares.derivatives);
}

class KeyList final : public Settings {
 public:
  void any(const Key& key) override { keys.push_back(key); }

  std::vector<Key> keys;
};

}  // namespace

void describeMechanism(Settings& s, bool hasRobot, RobotChoices& robot) {
  constexpr const char* vector = R"({"type": "array", "minItems": 3, "maxItems": 3})";
  s.own({"gravity", "[x, y, z], the acceleration of free fall, m/s^2", "none"}, vector);
  s.own({"base_acceleration",
         "[x, y, z], of the frame `inertial`, m/s^2: numbers, or expressions of time and parameters"},
        vector);
  s.own({"parameters", "numbers with names, which others may follow from"}, R"({"type": "object"})");
  s.own({"loops",
         "how loops are held in motion: `dependent`, by coordinates that follow from others; `multipliers`, by forces, "
         "so that dead points of these coordinates are passed",
         "dependent"},
        R"({"enum": ["dependent", "multipliers"]})");
  s.own({"element"}, "elements");
  s.own({"robot", "a robot's description (URDF, MJCF or SDFormat), from the study's folder"}, text);
  s.own({"urdf", "the same; the older word"}, text);
  if (!hasRobot) return;
  s.choice({"base", "of the robot: whether its root moves freely", "fixed"}, {"fixed", "free"},
           [&](const std::string& word) { robot.isFree = word == "free"; });
  s.flag({"damping", "of the robot: whether joints have their viscous damping", "true"}, robot.damping);
  s.flag({"friction", "of the robot: whether joints have their dry friction", "true"}, robot.friction);
  s.flag({"springs", "of the robot: whether joints have their springs", "true"}, robot.springs);
  s.flag({"mimic", "of the robot: whether joints follow others", "true"}, robot.mimic);
  s.flag({"collision", "of the robot: whether links carry the shapes by which they touch", "false"}, robot.collision);
  s.own({"initial", "of the robot: where its joints are at the start, and how fast", "0"}, R"({"type": "object"})");
}

std::vector<StudySection> studySections(const Study& study) {
  std::vector<StudySection> sections{
      {"study", false, true, "what is asked of the mechanism, and when", describeStudy},
      {"uncertain", true, false, "a number of the mechanism, or several, that is not known exactly", describeUncertain},
      {"dependence", true, false, "how some of the uncertain quantities depend on each other", describeDependence},
      {"output", true, true, "what is wanted of the motion", describeOutput},
      {"requirement", true, false, "what the motion is to keep", describeRequirement},
      {"sweep", true, false, "a number that `gamut sweep` varies; of several all combinations", describeSweep},
      {"interval", false, false, "what is guaranteed: how tight, and by what means", describeInterval},
      {"stochastic", false, false, "what is probable: the samples", describeStochastic},
      {"distribution", false, false, "bounds of the outputs' distribution functions", describeDistribution}};
  for (std::size_t i = 0; i < study.analyses.size(); ++i)
    sections.push_back({std::string(study.analyses[i]->section()), false, false,
                        std::string(study.analyses[i]->meaning()),
                        [i](Settings& s, Study& own) { own.analyses[i]->describe(s); }});
  sections.insert(sections.end(), {{"fuzzy", false, false, "what is possible: the alpha-cuts", describeFuzzy},
                                   {"limits", false, false, "what a run may spend", describeLimits}});
  return sections;
}

StudySection studySection(const Study& study, std::string_view name) {
  for (StudySection& section : studySections(study))
    if (section.name == name) return std::move(section);
  throw std::logic_error("study files have no such section: " + std::string(name));
}

std::vector<std::string> keysOf(const std::function<void(Settings&)>& describe) {
  KeyList list;
  describe(list);
  std::vector<std::string> names;
  for (const Key& key : list.keys) names.push_back(key.name);
  return names;
}

std::string guideTo(std::string_view section, const std::string& prefix) {
  KeyList list;
  Study study;
  studySection(study, section).describe(list, study);
  std::string rows;
  for (const Key& key : list.keys)
    rows += fmt::format("| `{}{}` | {} |{}|\n", prefix, key.name, key.meaning,
                        key.otherwise.empty() ? " " : " " + key.otherwise + " ");
  return rows;
}

}  // namespace gamut
