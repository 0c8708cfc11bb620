// Reads a study file table by table. Everything is checked here but whether the mechanism's motion is determined, which
// its Machine finds (studies/machine.hpp).
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <map>
#include <optional>
#include <string_view>
#include <unordered_set>
#include <utility>

#include "mechanics/description/written_units.hpp"
#include "mechanics/elements/rigid_stop.hpp"
#include "studies/printable.hpp"
#include "studies/readable.hpp"
#include "studies/reading/dependence_reader.hpp"
#include "studies/reading/frequency_notes.hpp"
#include "studies/reading/mechanism_reader.hpp"
#include "studies/reading/requirement_reader.hpp"
#include "studies/reading/settings_reader.hpp"
#include "studies/reading/sweep_reader.hpp"
#include "studies/reading/toml_source.hpp"
#include "studies/reading/uncertain_reader.hpp"
#include "studies/results/results.hpp"
#include "studies/settings.hpp"
#include "studies/study.hpp"

namespace gamut {
namespace {

constexpr Dimension seconds{0, 0, 1, 0};

class StudyReader {
 public:
  StudyReader(const std::string& text, const std::string& name) : source_(text, name) {
    study_.text = text;
    study_.file = name;
  }

  Study read(const std::vector<Described>& types, const std::optional<FilesAtHand>& files, const ShapeTypes& shapes,
             const std::vector<AnalysisType>& analyses) {
    study_.analyses = made(analyses);
    const std::vector<StudySection> sections = studySections(study_);
    std::vector<std::string> names;
    for (const StudySection& section : sections) names.emplace_back(section.name);
    names.insert(names.begin() + 1, "mechanism");
    const TomlSection file(source_, source_.root(), "", std::move(names));
    readStudyTable(source_.asTable(file.require("study", "a table [study]"), "study"));
    source_.setNames(namesStatedIn(source_));
    ReadMechanism read = readMechanism(
        source_, source_.asTable(file.require("mechanism", "a table [mechanism]"), "mechanism"), types, files);
    study_.mechanism = std::move(read.mechanism);
    study_.robot = std::move(read.files.robot);
    study_.tables = std::move(read.files.tables);
    std::ranges::move(read.notes, std::back_inserter(study_.notes));
    std::ranges::move(notesOnFrequencies(source_, study_.mechanism), std::back_inserter(study_.notes));
    places_ = std::move(read.places);
    noteUnits();
    checkMotion(*file.find("mechanism"));
    if (study_.analysis == Study::Analysis::inverseDynamics) checkDrives(*file.find("mechanism"));
    if (study_.analysis == Study::Analysis::equilibria) study_.mechanism.measureModes();
    readUncertain(source_, tables("uncertain"), TableFiles(source_, study_.tables, files), places_, shapes, study_);
    readDependence(source_, tables("dependence"), study_);
    file.require("output", "a table [[output]] for each output that is wanted");
    for (const toml::table* table : tables("output")) readOutput(*table);
    readRequirements(source_, tables("requirement"), study_, outputNodes_);
    if (const toml::node* node = file.find("distribution")) readDistribution(source_.asTable(*node, "distribution"));
    checkInitialValues();
    checkEnds();
    checkSomethingMoves(*file.find("mechanism"));
    readSweep({source_, study_.mechanism, places_}, tables("sweep"));  // checked here, used by `gamut sweep`
    notePlaces(*file.find("mechanism"));
    study_.ensemble.transformation = Transformation::extended;
    for (const StudySection& each : sections)  // those that were read before say the same again
      if (const toml::node* node = file.find(each.name); node != nullptr && !each.isList)
        readSettings(source_, source_.asTable(*node, each.name), each.name, study_);
    checkPlan(file.find("stochastic"));
    checkAnalyses(file);
    checkGeneralMethod(file.find("fuzzy"));
    if (const toml::node* node = file.find("limits")) checkLimits(*node->as_table());
    return std::move(study_);
  }

 private:
  std::vector<const toml::table*> tables(std::string_view key) const { return tablesIn(source_, key); }

  // ---- [study] ------------------------------------------------------------------------------------------------------

  void readStudyTable(const toml::table& table) {
    study_.analysis = Study::Analysis::dynamics;  // until it is known, all keys have a meaning
    const TomlSection section = readSettings(source_, table, "study", study_);
    study_.title = section.text("title", printable(std::filesystem::path(study_.file).stem().string()));
    const toml::node& analysis =
        section.require("analysis", "\"dynamics\", \"inverse-dynamics\", \"kinematics\" or \"equilibria\"");
    const std::string word =
        source_.asChoice(analysis, "study.analysis", {"dynamics", "inverse-dynamics", "kinematics", "equilibria"});
    for (const auto each : {Study::Analysis::dynamics, Study::Analysis::inverseDynamics, Study::Analysis::kinematics,
                            Study::Analysis::equilibria}) {
      study_.analysis = each;
      if (study_.analysisName() == word) break;
    }
    readSettings(source_, table, "study", study_);
    if (!study_.moves())
      study_.times = {0.0};
    else
      readTimes(section);
    readCompare(section);
  }

  void readCompare(const TomlSection& section) {
    const toml::node* node = section.find("compare");
    if (node == nullptr) return;
    std::vector<std::string> words;
    const Results known;
    for (const Answer* answer : known.answers()) words.emplace_back(answer->word());
    study_.compare.clear();
    for (const toml::node& entry : source_.asArray(*node, "study.compare")) {
      const std::string word = source_.asChoice(entry, "study.compare", words);
      if (!study_.compare.insert(word).second)
        source_.fail(entry, fmt::format("study.compare names \"{}\" twice", word), "every analysis once");
    }
    if (study_.compare.empty())
      source_.fail(*node, "study.compare is empty", fmt::format("\"{}\" or some of them", fmt::join(words, "\", \"")));
  }

  void readTimes(const TomlSection& section) {
    const toml::node& end = section.require("horizon", "the time to be reached, in s");
    const Amount horizon = source_.asAmount(end, "study.horizon", seconds);
    if (horizon.value <= 0) source_.fail(end, "study.horizon is not positive", "a time above 0 s");
    study_.horizon = nearest(horizon);
    const toml::node* list = section.find("output_times");
    if (list == nullptr) return readStep(section, horizon);
    if (const toml::node* step = section.find("output_step"))
      source_.fail(*step, "study.output_step and study.output_times are both given", "one of them");
    readTimeList(*list, horizon);
  }

  /// 0, step, 2 step, …, horizon: each the double nearest to the decimal.
  void readStep(const TomlSection& section, const Amount& horizon) {
    const toml::node& node = section.require("output_step", "output_step in s, or a list output_times");
    const Amount step = source_.asAmount(node, "study.output_step", seconds);
    if (step.value <= 0) source_.fail(node, "study.output_step is not positive", "a time above 0 s");
    if (step.piPower != horizon.piPower)
      source_.fail(node, "study.output_step is a multiple of another power of pi than study.horizon",
                   "both without pi");
    const mpq_class count = horizon.value / step.value;
    if (count > static_cast<unsigned long>(maxOutputTimes) - 2)
      source_.fail(node, fmt::format("study.output_step gives more than {} output times", maxOutputTimes),
                   "a longer step or a shorter horizon");
    Amount time = step;
    for (unsigned long i = 0; i <= count; ++i) {
      time.value = step.value * i;
      study_.times.push_back(nearest(time));
    }
    if (study_.times.back() < study_.horizon) study_.times.push_back(study_.horizon);
    if (step.value > horizon.value)
      study_.notes.push_back(source_.note(
          node,
          fmt::format("study.output_step is longer than the horizon of {} s, so that outputs are those at its ends",
                      study_.horizon)));
    if (study_.times.size() > 1 && study_.times[1] == 0)
      source_.fail(node, "study.output_step is too small", "a longer step");
  }

  void readTimeList(const toml::node& node, const Amount& horizon) {
    const toml::array& list = source_.asArray(node, "study.output_times");
    if (list.empty()) source_.fail(node, "study.output_times is empty", "at least one time");
    if (list.size() > maxOutputTimes - 2)
      source_.fail(node, fmt::format("study.output_times has more than {} times", maxOutputTimes - 2), "fewer times");
    study_.times.push_back(0.0);
    for (const toml::node& entry : list) {
      const double time = nearest(source_.asAmount(entry, "study.output_times", seconds));
      const bool isStart = time == 0 && &entry == list.get(0);
      if (!isStart && !(time > study_.times.back()))
        source_.fail(entry, fmt::format("the output time {} s does not follow {} s", time, study_.times.back()),
                     "times that rise from 0 s");
      if (time > nearest(horizon))
        source_.fail(entry, fmt::format("the output time {} s is beyond the horizon", time),
                     fmt::format("at most {} s", study_.horizon));
      if (!isStart) study_.times.push_back(time);
    }
    if (study_.times.back() < study_.horizon) study_.times.push_back(study_.horizon);
  }

  // ---- What the whole says ------------------------------------------------------------------------------------------

  /// Where it is given, or that of which it is.
  const toml::node& placeOf(std::string name) const {
    while (!places_.contains(name) && name.find('.') != std::string::npos) name.resize(name.rfind('.'));
    const auto found = places_.find(name);
    return found == places_.end() ? *places_.begin()->second : *found->second;
  }

  /// What varies in time has no one value that a motion could start with.
  void checkInitialValues() const {
    const std::vector<std::string> names = study_.mechanism.stateNames();
    const std::vector<Expression> initial = study_.mechanism.initialState();
    std::vector<UncertainQuantity> varying;
    std::ranges::copy_if(study_.uncertain, std::back_inserter(varying), &UncertainQuantity::varies);
    for (std::size_t i = 0; i < names.size(); ++i)
      for (const UncertainQuantity& uncertain : varying)
        if (study_.mechanism.dependsOn(initial[i], uncertain.quantity))
          source_.fail(placeOf(names[i]),
                       fmt::format("the initial value '{}' follows from '{}', which varies in time", names[i],
                                   uncertain.quantity),
                       "an initial value that follows from what does not");
  }

  /// What varies in time moves no rigid end, changes no restitution, and nothing that impulses are shared out by.
  void checkEnds() const {
    const Mechanism& m = study_.mechanism;
    for (const UncertainQuantity& uncertain : study_.uncertain)
      for (const Described& element : m.elements())
        if (const auto* stop = element.as<RigidStop>(); stop != nullptr && uncertain.varies)
          if (m.degreesOfFreedom() > 1 || m.dependsOn(stop->at, uncertain.quantity) ||
              m.dependsOn(stop->restitution, uncertain.quantity))
            source_.fail(placeOf(stop->name),
                         fmt::format("'{}' varies in time, in a machine with the rigid end '{}'", uncertain.quantity,
                                     stop->name),
                         m.degreesOfFreedom() > 1 ? "a quantity that does not, or an elastic end, `joint-stop`"
                                                  : "a quantity that does not");
  }

  /// That of the number, or of the parameter that stands for it.
  void noteUnits() {
    const auto textAt = [&](const std::string& name) -> std::string {
      const auto place = places_.find(name);
      return place != places_.end() && place->second->is_string() ? **place->second->as_string() : std::string();
    };
    for (const auto& [name, place] : places_) {
      const std::string number = textAt(name);
      std::string unit = unitBehindNumber(number);
      if (unit.empty()) unit = unitBehindNumber(textAt(number));
      if (!unit.empty()) study_.units[name] = unit;
    }
  }

  /// Throws if nothing can move where time passes.
  void checkMotion(const toml::node& mechanism) const {
    const Mechanism& m = study_.mechanism;
    const bool isAtRest = study_.analysis == Study::Analysis::equilibria;
    if (isAtRest && m.stateNames().empty())
      source_.fail(mechanism, "the mechanism has nothing that could come to rest",
                   "a joint without a drive, or a state, in [[mechanism.element]]");
    if (study_.moves() && m.stateNames().empty() && m.coordinates().empty())
      source_.fail(mechanism, "the mechanism has no joint and no state, so that nothing can move",
                   "a joint or a state in [[mechanism.element]], or analysis = \"kinematics\", which needs none");
    if (m.areLoopsHeld() && study_.analysis != Study::Analysis::dynamics)
      source_.fail(
          mechanism,
          fmt::format("mechanism.loops has no meaning in {}, where nothing moves by itself", study_.analysisName()),
          "no such key, or analysis = \"dynamics\"");
  }

  /// Throws if some joint moves by itself; what closes a loop moves as the others do.
  void checkDrives(const toml::node& mechanism) const {
    const Mechanism& m = study_.mechanism;
    const std::vector<std::string> states = m.stateNames();
    const std::span moved = std::span(states).first(m.positions() + static_cast<std::size_t>(m.degreesOfFreedom()));
    const auto free = std::ranges::find_if(moved, [&](const std::string& state) {
      return std::ranges::find(m.dependents(), state) == m.dependents().end();
    });
    if (free == moved.end()) return;
    const auto joint = std::ranges::find_if(
        m.elements(), [&](const Described& element) { return free->starts_with(element.name() + "."); });
    source_.fail(joint == m.elements().end() ? mechanism : *places_.at(joint->name()),
                 fmt::format("nothing drives '{}'", *free),
                 m.isClosed() ? "a drive for every coordinate but those that close loops, or analysis = \"dynamics\""
                              : "a drive for every coordinate, or analysis = \"dynamics\", which tells what drives "
                                "need as well");
  }

  void checkSomethingMoves(const toml::node& mechanism) const {
    if (study_.analysis == Study::Analysis::dynamics && study_.mechanism.stateNames().empty())
      source_.fail(mechanism, "every joint is driven, so that nothing is left to move by itself",
                   "a joint without a drive, or analysis = \"inverse-dynamics\" or \"kinematics\"");
  }

  void notePlaces(const toml::node& mechanism) {
    StudyPlaces& places = study_.places;
    places.mechanism = source_.placeOf(mechanism);
    for (const toml::node* node : outputNodes_) places.outputs.push_back(source_.placeOf(*node));
    std::vector<std::pair<const toml::node*, std::string>> formulas;
    for (const auto& [name, node] : places_) {
      places.named[name] = source_.placeOf(*node);
      if (node->is_string()) formulas.emplace_back(node, name);
    }
    std::ranges::sort(formulas, {}, [](const auto& formula) {
      const toml::source_position at = formula.first->source().begin;
      return std::pair(at.line, at.column);
    });
    for (const auto& [node, name] : formulas)
      places.formulas.push_back({name, source_.placeOf(*node), source_.asExpression(*node, name, true)});
  }

  // ---- [[output]] ---------------------------------------------------------------------------------------------------

  /// A quantity, or an expression of quantities.
  Expression outputExpression(const toml::node& node, const std::string& quantity) const {
    const Mechanism& mechanism = study_.mechanism;
    const auto refuse = [&](const std::string& name) {
      source_.fail(node, fmt::format("unknown quantity '{}'", name),
                   outputExpected(name, mechanism.namesInFormulas(), mechanism));
    };
    if (mechanism.isOutputQuantity(quantity)) return Expression::named(quantity);
    const bool isNumber = quantity == "t" || mechanism.knows(quantity);
    if (!isNumber && quantity.find_first_of(" +-*/^()'") == std::string::npos) refuse(quantity);
    Expression expression = source_.asExpression(node, "output.quantity", true);
    for (const std::string& name : expression.names())
      if (name != "t" && !mechanism.knows(name) && !mechanism.isOutputQuantity(name)) refuse(name);
    return expression;
  }

  std::string unitOfOutput(const toml::node& node, const Expression& expression) const {
    try {
      return unitOf(study_.mechanism.dimensionOf(expression));
    } catch (const UnitError& error) {
      source_.fail(node, error.problem(), error.expected());
    }
  }

  /// The unit in which it is wanted, if that is stated.
  std::string statedUnit(const TomlSection& section, const std::string& own) const {
    const toml::node* node = section.find("unit");
    if (node == nullptr) return own;
    const std::string unit = source_.asText(*node, "output.unit");
    try {
      if (const std::string name = source_.nameIn("1 " + unit); !name.empty())
        source_.fail(*node,
                     fmt::format("output.unit is {}, and the study has a number of its own named '{}'", unit, name),
                     "another unit of that kind, or another name for that number");
      if (dimensionOf(unit) == dimensionOf(own)) return unit == "1" || unit.empty() ? own : unit;
      if (isAlikeButForRadians(dimensionOf(unit), dimensionOf(own))) return unit;
    } catch (const UnitError& error) {
      source_.fail(*node, error.problem(), error.expected());
    }
    source_.fail(
        *node, fmt::format("output.unit is {}, which does not measure what is wanted", unit),
        fmt::format("{}, or another unit of that kind{}", own, perRadian(dimensionOf(own), dimensionOf(unit))));
  }

  void readOutput(const toml::table& table) {
    const TomlSection section = readSettings(source_, table, "output", study_);
    const toml::node& node = section.require("quantity", "what is wanted, such as \"tip.position.z\" or \"energy\"");
    const std::string quantity = source_.asText(node, "output.quantity");
    const Expression expression = outputExpression(node, quantity);
    const std::string own = study_.mechanism.isOutputQuantity(quantity) ? study_.mechanism.unitOf(quantity)
                                                                        : unitOfOutput(node, expression),
                      unit = statedUnit(section, own);
    const std::string name = section.text("name", quantity);
    if (!outputNames_.insert(name).second) {
      const toml::node* at = section.find("name");
      source_.fail(at == nullptr ? node : *at, fmt::format("two outputs are named '{}'", name), "different names");
    }
    WantedOutput output{{name, quantity, unit}, expression};
    if (const toml::node* stated = section.find("resolution")) output.resolution = resolutionOf(*stated, unit);
    if (const toml::node* stated = section.find("tightness")) {
      output.tightness = nearest(source_.asAmount(*stated, "output.tightness", {}));
      if (!(output.tightness > 1 && std::isfinite(output.tightness)))
        source_.fail(*stated, fmt::format("output.tightness is {}", output.tightness),
                     "a number above 1: how many times wider than necessary its enclosure may be");
    }
    study_.outputs.push_back(std::move(output));
    outputNodes_.push_back(&node);
  }

  /// In the output's unit; as there, a number without unit is in the SI unit.
  double resolutionOf(const toml::node& node, const std::string& unit) const {
    const Amount one = oneOfUnit(unit);
    const double resolution = nearest(source_.asAmount(node, "output.resolution", one.dimension)) / nearest(one);
    if (!(resolution >= 0 && std::isfinite(resolution)))
      source_.fail(node, fmt::format("output.resolution is {}", resolution),
                   "a number that is not negative: differences up to it count for nothing");
    return resolution;
  }

  // ---- What other sections say together ---------------------------------------------------------------------------

  /// Not every plan serves every number of quantities.
  void checkPlan(const toml::node* stochastic) const {
    if (!study_.asksFor<StochasticResult>()) return;
    try {
      Sampling(study_.ensemble.plan, study_.uncertain.size(), 1, study_.ensemble.seed);
    } catch (const std::invalid_argument& error) {
      source_.failWith(stochastic == nullptr ? source_.root() : *stochastic, error.what(),
                       "plan = \"random\" or \"latin-hypercube\" in [stochastic], of any number of quantities");
    }
  }

  void checkAnalyses(const TomlSection& file) const {
    for (const Boxed<FurtherAnalysis>& analysis : study_.analyses)
      if (const auto refusal = analysis->refusal(study_)) {
        const toml::node* section = file.find(analysis->section());
        const toml::node* key = section == nullptr ? nullptr : section->as_table()->get(refusal->key);
        source_.fail(key == nullptr ? source_.root() : *key, refusal->problem, refusal->expected);
      }
  }

  void readDistribution(const toml::table& table) {
    const TomlSection section = readSettings(source_, table, "distribution", study_);
    DistributionPlan& plan = study_.distribution;
    const toml::node* times = section.find("times");
    if (times == nullptr) return;
    if (!times->is_array()) {
      plan.count = static_cast<std::size_t>(section.integer("times", 0, 0, 1000));
      return;
    }
    for (const toml::node& entry : *times->as_array()) {
      const double time = nearest(source_.asAmount(entry, "distribution.times", seconds));
      if (!(time >= 0 && time <= study_.horizon))
        source_.fail(entry, fmt::format("distribution.times has {} s, outside the study's time", time),
                     fmt::format("times from 0 s to {} s", study_.horizon));
      for (std::vector<double>* all : {&study_.times, &plan.times}) {
        const auto place = std::ranges::lower_bound(*all, time);
        if (place == all->end() || *place != time) all->insert(place, time);
      }
    }
    plan.count = plan.times.size();
  }

  /// Its points are all combinations of values.
  void checkGeneralMethod(const toml::node* fuzzy) const {
    if (study_.ensemble.transformation != Transformation::general || !study_.asksFor<FuzzyResult>() ||
        !study_.asksFor<StochasticResult>())
      return;
    const auto countOf = [&](int levels) {
      std::vector<Box> cuts;
      for (int level = 0; level < levels; ++level) {
        cuts.emplace_back();
        for (const UncertainQuantity& q : study_.uncertain)
          cuts.back().push_back(q.uncertain.membership.cut(levelOf(level, levels)));
      }
      return generalCount(cuts);
    };
    constexpr auto most = static_cast<double>(mostGeneralPoints);
    const double points = countOf(study_.levels);
    if (points <= most) return;
    int levels = study_.levels - 1;
    while (levels >= 3 && countOf(levels) > most) --levels;  // of two levels there is nothing inside
    source_.fail(
        *fuzzy->as_table()->get("method"),
        fmt::format("fuzzy.method \"general\" takes {:.6g} points of {} quantities at {} levels, and {} are the most",
                    points, study_.uncertain.size(), study_.levels, mostGeneralPoints),
        levels >= 3 ? fmt::format("\"extended\", \"reduced\", or fuzzy.levels of {} at most", levels)
                    : "\"extended\" or \"reduced\"");
  }

  void checkLimits(const toml::table& table) const {
    const StatedLimits& limits = study_.limits;
    if (limits.enclosureTime.value_or(0) > limits.resolved().time)
      refusePart(table, "enclosure_time", "time", fmt::format("{:.12g} s", *limits.enclosureTime),
                 fmt::format("{:.12g} s", limits.resolved().time));
    if (limits.memory && limits.enclosureMemory.value_or(0) > *limits.memory)
      refusePart(table, "enclosure_memory", "memory", fmt::format("{:.12g} GB", *limits.enclosureMemory / gigabyte),
                 fmt::format("{:.12g} GB", *limits.memory / gigabyte));
  }

  /// The enclosure cannot have more than the whole run.
  [[noreturn]] void refusePart(const toml::table& table, std::string_view part, std::string_view whole,
                               const std::string& ofPart, const std::string& ofWhole) const {
    source_.fail(*table.get(part),
                 fmt::format("limits.{} is {}, more than limits.{}, which is {}{}", part, ofPart, whole, ofWhole,
                             table.get(whole) == nullptr ? " unless given" : ""),
                 fmt::format("at most {}, or a greater limits.{}", ofWhole, whole));
  }

  TomlSource source_;
  Study study_;
  std::vector<const toml::node*> outputNodes_;
  std::unordered_set<std::string> outputNames_;
  std::map<std::string, const toml::node*> places_;  // of the mechanism's numbers and elements
};

}  // namespace

Study readStudyText(const std::string& text, const std::string& name, const std::vector<Described>& types,
                    const std::optional<FilesAtHand>& files, const ShapeTypes& shapes,
                    const std::vector<AnalysisType>& analyses) {
  return StudyReader(text, name).read(types, files, shapes, analyses);
}

Mechanism readMechanismText(const std::string& text, const std::string& name, const std::vector<Described>& types) {
  TomlSource source(text, name);
  source.setNames(namesStatedIn(source));
  const toml::node* mechanism = source.root().get("mechanism");
  if (mechanism == nullptr) source.fail(source.root(), "'mechanism' is missing", "a table [mechanism]");
  return readMechanism(source, source.asTable(*mechanism, "mechanism"), types).mechanism;
}

std::string textOfStudy(const std::string& path) {
  if (const std::string fault = whyUnreadable(path); !fault.empty())
    throw StudyError(path, fault, "a study file (TOML)");
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

Study readStudy(const std::string& path, const std::vector<Described>& types) {
  return readStudyText(textOfStudy(path), path, types);
}

}  // namespace gamut
