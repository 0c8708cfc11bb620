// Outputs and uncertain quantities are dimensions of what follows: their names are scales at the root of the file.
#include "studies/results/origin.hpp"

#include <algorithm>

namespace gamut {
namespace {

std::vector<Field> fieldsOfRoot(Origin& o) {
  return {{"title", &o.title, unit::none, "of the study"},
          {"time", &o.time, unit::second, "output times", {dimension::time}, allowed::finite}};
}

std::vector<Field> fieldsOfStudy(Origin& o) {
  return {{"text", WholeText{&o.studyText}, unit::none, "the study file, word for word"},
          {"urdf", WholeText{&o.robotText}, unit::none,
           "the robot's file that it names, word for word (of one that includes others a JSON object, texts by name); "
           "else empty"},
          {"tables", WholeText{&o.tablesText}, unit::none,
           "the tables (CSV) that it names, word for word: a JSON object, texts by name; else empty"},
          {"file", &o.studyFile, unit::none, "name of the study file"},
          {"analysis", &o.analysis, unit::none, "\"dynamics\", \"inverse-dynamics\", \"kinematics\" or \"equilibria\""},
          {"dependence", &o.dependence, unit::none,
           "how uncertain quantities depend on each other, in words, and whether several distributions are possible; "
           "empty where they are independent"},
          {"assumptions", &o.assumptions, unit::none,
           "on which all answers rest, but which cannot be proved; empty where there are none"},
          fresh({"assembly", &o.assembly, unit::none,
                 "where loops close at the nominal start, of the ways in which they may: the coordinates that follow "
                 "from others; empty where there are none"}),
          {"seed", &o.seed, unit::none, "of the samples"},
          {"horizon", &o.horizon, unit::second, "time asked for; 0 where none passes", allowed::finite},
          {"version", &o.version, unit::none, "of Gamut"},
          {"host", &o.host, unit::none, "machine on which it ran"},
          {"date", &o.date, unit::none, "when it began, UTC"},
          {"cpu", &o.cpu, unit::second, "CPU time of all analyses"},
          {"memory", &o.memory, unit::byte, "the most that the run had at a time"},
          {"stopped", &o.stopped, unit::none,
           "what kept the run from doing all that it could: an interrupt, the first limit of time or memory that it "
           "reached, or an internal failure; empty if nothing did"},
          {"time_limit", &o.limits.time, unit::second, "CPU time that the run was allowed"},
          {"memory_limit", &o.limits.memory, unit::byte, "memory that the run was allowed"},
          {"enclosure_time_limit", &o.limits.enclosureTime, unit::second, "of it to the enclosure"},
          {"enclosure_memory_limit", &o.limits.enclosureMemory, unit::byte, "of it to the enclosure"},
          {"sample_time_limit", &o.limits.sampleTime, unit::second, "of it to each sample"}};
}

std::vector<Field> fieldsOfCost(CostInfo& c) {
  return {{"what", &c.what, unit::none, "\"equations\" (their recording), \"advice\"; in older files \"requirements\""},
          {"cpu", &c.cpu, unit::second, "CPU time", allowed::finite}};
}

std::vector<Field> fieldsOfLibrary(LibraryInfo& l) {
  return {{"name", &l.name, unit::none, "name of the library"}, {"version", &l.version, unit::none, "its version"}};
}

std::vector<Field> fieldsOfExtension(ExtensionInfo& e) {
  return {{"before", &e.before, unit::none, "samples of the plan that there had been", allowed::count},
          {"version", &e.version, unit::none, "of Gamut"},
          {"host", &e.host, unit::none, "machine on which all samples were taken anew"},
          {"date", &e.date, unit::none, "when that began, UTC"},
          {"cpu", &e.cpu, unit::second, "CPU time"},
          {"time_limit", &e.timeLimit, unit::second, "CPU time that was allowed"},
          {"memory_limit", &e.memoryLimit, unit::byte, "memory that was allowed"}};
}

std::vector<Field> fieldsOfOutput(OutputInfo& o) {
  return {{dimension::output, &o.name, unit::none, "name of the output"},
          {"quantity", &o.quantity, unit::none, "quantity of the mechanism"},
          {"unit", &o.unit, unit::none, "its unit: SI, unless the study states another"},
          {"resolution",
           &o.resolution,
           unit::none,
           "in its unit: differences up to this count for nothing; 0: none was stated",
           {0, allowed::finite.greatest}},
          {"tightness", &o.tightness, unit::none, "asked for of it alone; NaN: as of all others"}};
}

std::vector<Field> fieldsOfUncertain(UncertainInfo& u) {
  return {{dimension::quantity, &u.name, unit::none, "name of the uncertain quantity"},
          {"quantity", &u.quantity, unit::none, "quantity of the mechanism"},
          {"unit", &u.unit, unit::none, "its SI unit"},
          {"lower", &u.lower, unit::ofQuantity, "lower bound of the interval", allowed::finite},
          {"nominal", &u.nominal, unit::ofQuantity, "nominal value", allowed::finite},
          {"upper", &u.upper, unit::ofQuantity, "upper bound of the interval", allowed::finite},
          {"distribution", &u.distribution, unit::none, "name of the distribution"},
          {"membership", &u.membership, unit::none, "name of the membership function"},
          {"inconsistency", &u.inconsistency, unit::one,
           "by how much the probability of an event exceeds its possibility at most; 1/256 or less: probability and "
           "possibility agree as far as was looked",
           allowed::share},
          fresh({"told", &u.told, unit::none,
                 "unit in which summary and page tell it, as the study states it; empty: its SI unit"}),
          fresh({"stated", &u.stated, unit::none,
                 "the interval as the study states it, such as \"± 2 %\"; empty where it follows from distribution and "
                 "membership"})};
}

std::vector<Field> fieldsOfShape(ShapeInfo& s) {
  return {{"of", &s.quantity, unit::none, "name of the uncertain quantity"},
          {"shape", Choice::of(s.shape), unit::none, "\"distribution\" or \"membership\""},
          {"name", &s.name, unit::none, "of the number, such as \"lower\" and \"upper\" (of the support), \"mode\""},
          {"value", &s.value, unit::none, "in the unit beside it"},
          {"unit", &s.unit, unit::none, "its SI unit"}};
}

}  // namespace

void addCost(Origin& origin, std::string_view what, double cpu) {
  const auto known = std::ranges::find(origin.costs, what, &CostInfo::what);
  (known == origin.costs.end() ? origin.costs.emplace_back(CostInfo{std::string(what)}) : *known).cpu += cpu;
}

std::string takerOfSamples(const Origin& o) {
  return o.extensions.empty() ? "Gamut " + o.version + " on " + o.host
                              : "Gamut " + o.extensions.back().version + " on " + o.extensions.back().host;
}

void describe(Origin& o, std::vector<Group>& groups) {
  groups.push_back(groupOf("/", "", o, fieldsOfRoot));
  groups.push_back(groupOf("/study", "what was asked, and where the numbers come from", o, fieldsOfStudy));
  groups.push_back(
      listOf("/study/libraries", "with what it was computed", "/study/libraries/name", o.libraries, fieldsOfLibrary));
  groups.push_back(listOf("/study/costs", "what was spent beside what the answers took", "/study/costs/what", o.costs,
                          fieldsOfCost));
  groups.push_back(listOf("/study/extensions", "samples that `gamut extend` added", "/study/extensions/before",
                          o.extensions, fieldsOfExtension));
  groups.push_back(listOf("/study/outputs", "what was to be looked at", dimension::output, o.outputs, fieldsOfOutput));
  groups.push_back(
      listOf("/study/uncertain", "what is uncertain", dimension::quantity, o.uncertain, fieldsOfUncertain));
  groups.back().makesSense = [&o](std::size_t i) { return o.uncertain[i].lower <= o.uncertain[i].upper; };
  groups.push_back(listOf("/study/shapes", "the numbers that distributions and membership functions are made of",
                          "/study/shapes/of", o.shapes, fieldsOfShape));
}

}  // namespace gamut
