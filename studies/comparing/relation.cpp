// Studies that differ in a word are read again, and their motions are recorded anew, with all that is uncertain in
// either as free parameters: programs that are identical are the same motion, whatever the texts look like. Where they
// are not, they may still be the same; nothing is claimed then.
#include "studies/comparing/relation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "scalars/interval.hpp"
#include "studies/machine.hpp"
#include "studies/study.hpp"
#include "studies/words.hpp"

namespace gamut {
namespace {

/// Throws StudyError, or std::invalid_argument where it has not the outputs that the results have.
Study studyIn(const Results& results) {
  Study study = readStudyText(results.studyText, results.studyFile, elementTypes(),
                              FilesAtHand{results.robotText, namedTextsIn(results.tablesText)});
  if (!std::ranges::equal(study.outputs, results.outputs, {}, &OutputInfo::name, &OutputInfo::name))
    throw std::invalid_argument(results.studyFile + ": its outputs are not those of the results");
  return study;
}

const UncertainQuantity* uncertainIn(const Study& study, const std::string& quantity) {
  const auto found = std::ranges::find(study.uncertain, quantity, &UncertainQuantity::quantity);
  return found == study.uncertain.end() ? nullptr : &*found;
}

/// All that is uncertain in one of them at least.
std::vector<std::string> uncertainOf(const Study& first, const Study& second) {
  std::vector<std::string> names;
  for (const UncertainQuantity& of : first.uncertain) names.push_back(of.quantity);
  for (const UncertainQuantity& of : second.uncertain)
    if (uncertainIn(first, of.quantity) == nullptr) names.push_back(of.quantity);
  return names;
}

// ---- Motions --------------------------------------------------------------------------------------------------------

class Motions {
 public:
  Motions(const Study& first, const Study& second, const Shared& shared)
      : studies_{first, second}, all_(uncertainOf(first, second)) {
    const auto take = [&](Study& study) {
      study.uncertain.clear();
      for (const std::string& name : all_) study.uncertain.push_back({name, study.mechanism.unitOf(name), {}});
    };
    for (const auto& [one, other] : shared.outputs)
      outputs_.push_back({studies_.first.outputs[one], studies_.second.outputs[other]});
    for (const auto& quantity : all_)
      if (!isNumberOf(studies_.first, quantity) || !isNumberOf(studies_.second, quantity)) return;
    take(studies_.first);
    take(studies_.second);
    areOfOneKind_ = studies_.first.analysis == studies_.second.analysis &&
                    studies_.first.mechanism.stateNames() == studies_.second.mechanism.stateNames();
  }

  void compare(Relation& relation) {
    relation.isSameOutput.assign(outputs_.size(), 0);
    if (areOfOneKind_ && startAlike()) compareOutputs(0, outputs_.size(), relation);
    if (!relation.isSameMotion) relation.differences = differences();
  }

 private:
  static bool isNumberOf(const Study& study, const std::string& quantity) {
    const std::vector<std::string> known = study.mechanism.quantities();
    return std::ranges::find(known, quantity) != known.end();
  }

  bool isUncertain(const std::string& quantity) const { return std::ranges::find(all_, quantity) != all_.end(); }

  /// But for what is uncertain, and for initial values that follow from that: those are part of the program.
  bool startAlike() const {
    const Mechanism &one = studies_.first.mechanism, &other = studies_.second.mechanism;
    const std::vector<std::string> states = one.stateNames();
    const std::vector<Expression> starts = one.initialState(), otherStarts = other.initialState();
    std::vector<std::string> parameters;
    for (const std::string& name : all_)
      if (std::ranges::find(states, name) == states.end()) parameters.push_back(name);
    const std::vector<bool> follows = one.startsWith(parameters), otherFollows = other.startsWith(parameters);
    for (std::size_t i = 0; i < states.size(); ++i) {
      if (follows[i] != otherFollows[i]) return false;
      if (!follows[i] && !isUncertain(states[i]) && !isEqual(one.rangeOf(starts[i]), other.rangeOf(otherStarts[i])))
        return false;
    }
    return true;
  }

  /// Of these outputs all at once; where they are not the same, of each half, until those are found that differ.
  void compareOutputs(std::size_t begin, std::size_t end, Relation& relation) {
    Study& one = studies_.first;
    Study& other = studies_.second;
    one.outputs.clear(), other.outputs.clear();
    for (std::size_t i = begin; i < end; ++i) {
      one.outputs.push_back(outputs_[i].first);
      other.outputs.push_back(outputs_[i].second);
    }
    const Motion motion = recordedMotion(one), otherMotion = recordedMotion(other);
    relation.isSameMotion = isIdentical(motion.f, otherMotion.f);
    if (!relation.isSameMotion) return;
    if (isIdentical(motion.g, otherMotion.g)) {
      std::fill(relation.isSameOutput.begin() + static_cast<std::ptrdiff_t>(begin),
                relation.isSameOutput.begin() + static_cast<std::ptrdiff_t>(end), 1);
    } else if (end - begin > 1) {
      const std::size_t middle = begin + (end - begin) / 2;
      compareOutputs(begin, middle, relation);
      compareOutputs(middle, end, relation);
    }
  }

  /// Numbers first, since they are what mostly differs.
  std::vector<std::string> differences() const {
    const Study &one = studies_.first, &other = studies_.second;
    if (one.analysis != other.analysis)
      return {fmt::format("{} in A, {} in B", one.analysisName(), other.analysisName())};
    std::vector<std::string> found;
    for (const std::string& name : one.mechanism.quantities()) {
      if (!isNumberOf(other, name)) {
        found.push_back(fmt::format("'{}' is no number of B", name));
      } else if (const Interval value = one.mechanism.nominal(name), otherValue = other.mechanism.nominal(name);
                 !isUncertain(name) && !isEqual(value, otherValue)) {
        const std::string unit = one.mechanism.unitOf(name);
        found.push_back(fmt::format("{} is {} in A, {} in B", name, inUnit(numberText(midpoint(value), 12), unit),
                                    inUnit(numberText(midpoint(otherValue), 12), unit)));
      }
    }
    for (const std::string& name : other.mechanism.quantities())
      if (!isNumberOf(one, name)) found.push_back(fmt::format("'{}' is no number of A", name));
    if (found.empty()) found.emplace_back("their elements or formulas differ");
    return found;
  }

  Both<Study> studies_;
  std::vector<std::string> all_;
  std::vector<Both<WantedOutput>> outputs_;
  bool areOfOneKind_ = false;
};

// ---- Values that uncertain quantities may have ----------------------------------------------------------------------

/// The courses that a quantity may take in one study; a number that is not uncertain takes one, its value, which is
/// known by an interval if it is no double.
struct Courses {
  Interval range;
  bool isWhole = true;  ///< every number of the range is meant
  bool varies = false;
  double rate = 0;
};

std::optional<Courses> coursesIn(const Study& study, const std::string& quantity) {
  if (const UncertainQuantity* of = uncertainIn(study, quantity))
    return Courses{of->uncertain.range, true, of->varies, of->varies ? of->rate : 0};
  const std::vector<std::string> known = study.mechanism.quantities();
  if (std::ranges::find(known, quantity) == known.end()) return std::nullopt;
  const Interval nominal = study.mechanism.nominal(quantity);
  return Courses{nominal, isThin(nominal)};
}

/// Whether all courses of one are courses of the other; what is constant is a course too.
bool areAmong(const Courses& one, const Courses& other) {
  return other.isWhole && isSubset(one.range, other.range) && (!one.varies || other.varies) && one.rate <= other.rate;
}

void compareValues(const Study& first, const Study& second, Relation& relation) {
  bool isFirstInSecond = true, isSecondInFirst = true, areShared = true;
  for (const std::string& quantity : uncertainOf(first, second)) {
    const std::optional<Courses> one = coursesIn(first, quantity), other = coursesIn(second, quantity);
    if (!one || !other) return;
    const bool areIn = areAmong(*one, *other), areOthersIn = areAmong(*other, *one);
    isFirstInSecond = isFirstInSecond && areIn;
    isSecondInFirst = isSecondInFirst && areOthersIn;
    areShared = areShared &&
                (areIn || areOthersIn || (one->isWhole && other->isWhole && !isDisjoint(one->range, other->range)));
  }
  relation.isFirstInSecond = isFirstInSecond;
  relation.isSecondInFirst = isSecondInFirst;
  relation.areShared = areShared;
}

/// Whether the same quantities are uncertain in the same way.
bool haveSameShapes(const Results& first, const Results& second, ShapeKind shape) {
  const auto numbersOf = [&](const Results& results, const UncertainInfo& of) {
    std::vector<std::pair<std::string, double>> numbers;
    for (const ShapeInfo& number : results.shapes)
      if (number.quantity == of.name && number.shape == shape) numbers.emplace_back(number.name, number.value);
    return numbers;
  };
  if (first.uncertain.size() != second.uncertain.size()) return false;
  return std::ranges::all_of(first.uncertain, [&](const UncertainInfo& of) {
    const auto other = std::ranges::find(second.uncertain, of.quantity, &UncertainInfo::quantity);
    return other != second.uncertain.end() && of.shape(shape) == other->shape(shape) &&
           numbersOf(first, of) == numbersOf(second, *other);
  });
}

/// Whether quantities depend on each other in the same way, in whatever order that is said.
bool haveSameDependence(const Study& first, const Study& second) {
  const auto of = [](const Study& study) {
    std::map<std::pair<std::string, std::string>, std::pair<double, double>> rank;
    std::set<std::set<std::string>> unknown;
    const auto name = [&](std::size_t q) { return study.uncertain[q].quantity; };
    for (const GaussianCopula& copula : study.dependence.copulas)
      for (std::size_t i = 0; i < copula.rank().size(); ++i)
        for (std::size_t j = 0; j < copula.rank().size(); ++j)
          rank[{name(copula.quantities()[i]), name(copula.quantities()[j])}] = {copula.rank()[i][j].lower(),
                                                                                copula.rank()[i][j].upper()};
    for (const std::vector<std::size_t>& group : study.dependence.unknown) {
      std::set<std::string> names;
      for (const std::size_t q : group) names.insert(name(q));
      unknown.insert(std::move(names));
    }
    return std::pair(rank, unknown);
  };
  return of(first) == of(second);
}

}  // namespace

Relation relationOf(const Results& first, const Results& second, const Shared& shared) {
  Relation relation;
  if (first.studyText == second.studyText && first.robotText == second.robotText &&
      first.tablesText == second.tablesText) {
    relation.isSameText = relation.isSameMotion = relation.isFirstInSecond = relation.isSecondInFirst =
        relation.areShared = relation.hasSameDistributions = relation.hasSameMemberships = true;
    relation.isSameOutput.assign(shared.outputs.size(), 1);
    return relation;
  }
  relation.isSameOutput.assign(shared.outputs.size(), 0);
  bool dependAlike = false;
  try {
    const Study one = studyIn(first), other = studyIn(second);
    Motions(one, other, shared).compare(relation);
    compareValues(one, other, relation);
    dependAlike = haveSameDependence(one, other);
  } catch (const std::exception& error) {
    relation = {};
    relation.isSameOutput.assign(shared.outputs.size(), 0);
    relation.why = error.what();
    return relation;
  }
  const bool haveSameValues = relation.isFirstInSecond && relation.isSecondInFirst;
  relation.hasSameDistributions =
      haveSameValues && dependAlike && haveSameShapes(first, second, ShapeKind::distribution);
  relation.hasSameMemberships = haveSameValues && haveSameShapes(first, second, ShapeKind::membership);
  return relation;
}

}  // namespace gamut
