// A sentence, what contradicts and what is worse, then a table of outputs and one of all else.
#include "reports/comparison_lines.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "reports/comparison_contradictions.hpp"
#include "reports/text_table.hpp"
#include "studies/words.hpp"

namespace gamut {
namespace {

using Rows = std::vector<std::vector<std::string>>;

/// "violated for some" for "partly".
std::string wordText(const std::string& word) { return word == "partly" ? "violated for some" : word; }

// ---- What was asked -------------------------------------------------------------------------------------------------

std::string valuesText(const Relation& r) {
  return r.isFirstInSecond && r.isSecondInFirst ? "the same intervals"
         : r.isFirstInSecond                    ? "wider intervals in B, which hold those of A"
         : r.isSecondInFirst                    ? "narrower intervals in B, which lie in those of A"
         : r.areShared                          ? "intervals that overlap"
                                                : "intervals that have no value in common";
}

std::string someOf(const std::vector<std::string>& names) {
  constexpr std::size_t most = 4;
  const std::size_t shown = names.size() > most ? most - 1 : names.size();
  std::string text =
      fmt::format("{}", fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(shown), ", "));
  return names.size() > shown ? fmt::format("{} and {} more", text, names.size() - shown) : text;
}

std::string questionText(const Relation& r) {
  if (r.isSameText) return "The same question: the studies are the same, word for word.";
  if (!r.why.empty())
    return fmt::format("Whether it is the same question cannot be told, and is not assumed: {}", r.why);
  if (r.isSameQuestion())
    return fmt::format("The same question: the same motion with the same intervals{}.",
                       r.hasSameDistributions && r.hasSameMemberships ? ""
                       : r.hasSameMemberships                         ? ", but other distributions or dependences"
                       : r.hasSameDistributions                       ? ", but other memberships"
                                                : ", but other distributions or dependences, and other memberships");
  if (r.isSameMotion) return fmt::format("Another question: the same motion, but {}.", valuesText(r));
  return fmt::format("Another question, of another motion: {}.", someOf(r.differences));
}

/// In what their samples were asked for differently; empty if in nothing.
std::string samplesText(const Results& first, const Results& second) {
  const StochasticResult &a = first.stochastic, &b = second.stochastic;
  if (!a.present || !b.present) return {};
  std::vector<std::string> parts;
  const auto add = [&](const char* what, const auto& one, const auto& other) {
    if (one != other) parts.push_back(fmt::format("{} {} in A, {} in B", what, one, other));
  };
  add("seed", first.seed, second.seed);
  add("plan", wordOf(a.plan), wordOf(b.plan));
  add("number", a.samples, b.samples);
  return parts.empty() ? "" : fmt::format("Other samples: {}.\n", fmt::join(parts, "; "));
}

std::string sentence(const Difference& d) {
  if (d.word == Difference::Word::error)
    return "One of both is wrong: what A proves contradicts what B proves of the same motion.";
  if (d.word == Difference::Word::incompatible)
    return "A and B are proved to differ: what is proved of one cannot hold of the other. Both may be right, since "
           "they "
           "are of different models or values.";
  if (d.word == Difference::Word::worse) return "Nothing contradicts, but B is worse than A by more than is tolerated.";
  return d.contradictions.compared == 0 ? "There is nothing that could contradict, and nothing is worse."
                                        : "Nothing contradicts, and nothing is worse than is tolerated.";
}

// ---- What is worse --------------------------------------------------------------------------------------------------

std::string excessText(const Excess& e, bool moves) {
  using Of = Excess::Of;
  const auto ofWidth = [&](const char* what) {
    return fmt::format("{} is {} times as wide{} ({} is tolerated)", what, atMostText(e.is, 5),
                       moves ? " at " + timeText(e.time, 10) : "", numberText(e.allowed, 6));
  };
  switch (e.of) {
    case Of::enclosure:
      return ofWidth("the enclosure");
    case Of::alphaCuts:
      return fmt::format("an alpha-cut is wider by {} of the widest{} ({} is tolerated)", atMostText(e.is - 1, 3),
                         moves ? " at " + timeText(e.time, 10) : "", numberText(e.allowed - 1, 6));
    case Of::overestimation:
      return fmt::format("the overestimation is {} times as great ({} is tolerated)", atMostText(e.is, 5),
                         numberText(e.allowed, 6));
    case Of::gap:
      return fmt::format("the bounds of probabilities lie {} farther apart ({} is tolerated)", atMostText(e.is, 3),
                         numberText(e.allowed, 6));
    case Of::reached:
      return moves ? fmt::format("ends at {}, {} % earlier ({} % is tolerated)", reachedText(e.time),
                                 atMostText(100 * e.is, 3), numberText(100 * e.allowed, 4))
                   : "ends before it has anything";
    case Of::requirement:
    case Of::verdict:
      return fmt::format("{} in A, {} in B", wordText(e.words.first),
                         e.words.second.empty() ? "none" : wordText(e.words.second));
    case Of::cpu:
      break;
  }
  return fmt::format("{} times as much ({} is tolerated)", atMostText(e.is, 4), numberText(e.allowed, 4));
}

/// A line for each output; of alpha-cuts only where the enclosure is not too wide already.
std::string excessesText(const std::vector<Excess>& excesses, bool moves) {
  using Of = Excess::Of;
  std::string text;
  const Excess* before = nullptr;
  for (const Excess& e : excesses) {
    const bool goesOn = before != nullptr && before->name == e.name && e.of <= Of::gap;
    if (e.of == Of::alphaCuts && goesOn) continue;
    if (goesOn) {
      text.back() = ',';
      text += " " + excessText(e, moves) + "\n";
    } else {
      const std::string name = e.of == Of::verdict ? "verdict" : e.of == Of::cpu ? "CPU time" : e.name;
      text += fmt::format("  worse: {}: {}\n", name, excessText(e, moves));
    }
    before = &e;
  }
  return text;
}

// ---- Tables ---------------------------------------------------------------------------------------------------------

std::string ratioText(double ratio, bool isGreatest) {
  if (std::isnan(ratio)) return "-";
  return isGreatest ? atMostText(ratio, 5) : numberText(ratio, 5);
}

std::string bothText(const Both<double>& both, std::string (*told)(double)) {
  const auto text = [&](double x) { return std::isnan(x) ? std::string("-") : told(x); };
  if (std::isnan(both.first) && std::isnan(both.second)) return "-";
  return fmt::format("{} / {}", text(both.first), text(both.second));
}

/// Without columns in which nothing is known.
Rows withoutEmptyColumns(const Rows& rows) {
  Rows kept(rows.size());
  for (std::size_t column = 0; column < rows.front().size(); ++column) {
    const bool isEmpty =
        std::ranges::all_of(rows.begin() + 1, rows.end(), [&](const auto& row) { return row[column] == "-"; });
    for (std::size_t i = 0; i < rows.size() && !isEmpty; ++i) kept[i].push_back(rows[i][column]);
  }
  return kept;
}

std::string outputsTable(const Changes& changes, bool moves) {
  Rows rows{{"widths, B over A", "least", "at", "greatest", "at", "alpha-cuts (greatest)", "overestimation A / B",
             "gap A / B"}};
  for (const OutputChange& output : changes.outputs) {
    if (output.isMargin) continue;
    const WidthRatio& ratio = output.enclosure;
    const std::string least = ratioText(ratio.least, false), greatest = ratioText(ratio.greatest, true);
    const auto at = [&](const std::string& found, double time) {
      return moves && found != "-" && found != "1" ? timeText(time, 10) : "-";
    };
    rows.push_back({headingOf(output.name, output.unit), least, at(least, ratio.leastTime), greatest,
                    at(greatest, ratio.greatestTime), ratioText(output.alphaCuts.greatest, true),
                    bothText(output.overestimation, timesText),
                    bothText(output.gap, [](double gap) { return atMostText(gap, 4); })});
  }
  if (rows.size() == 1) return "";
  const Rows kept = withoutEmptyColumns(rows);
  return kept.front().size() == 1 ? "" : textTable(kept);
}

std::string requirementText(const std::string& word, double factor) {
  return factor > 0 && factor < 1
             ? fmt::format("{}, factor {}", wordText(word), numberText(std::floor(1000 * factor) / 1000, 4))
             : wordText(word);
}

std::string restTable(const Changes& changes, const Results& first, const Results& second, bool moves) {
  Rows rows{{"", "A", "B"}};
  const auto add = [&](const std::string& what, const std::string& one, const std::string& other) {
    rows.push_back({what, one, other});
  };
  for (const AnswerChange& answer : changes.answers)
    if (moves) add(answer.name + " up to", reachedText(answer.reached.first), reachedText(answer.reached.second));
  for (const RequirementChange& r : changes.requirements)
    add("requirement " + r.name, requirementText(r.word.first, r.factor.first),
        requirementText(r.word.second, r.factor.second));
  const auto countOf = [](std::int64_t count) { return count > 0 ? fmt::format("{}", count) : std::string("-"); };
  const auto orNone = [](const std::string& word) { return word.empty() ? std::string("-") : word; };
  if (!changes.verdict.first.empty() || !changes.verdict.second.empty())
    add("verdict", orNone(changes.verdict.first), orNone(changes.verdict.second));
  if (changes.samples.first > 0 || changes.samples.second > 0)
    add("samples followed", countOf(changes.samples.first), countOf(changes.samples.second));
  add("CPU time", fmt::format("{:.2f} s", changes.cpu.first), fmt::format("{:.2f} s", changes.cpu.second));
  add("Gamut", first.version, second.version);
  return textTable(rows);
}

std::string onlyText(const std::string& in, const std::vector<std::string>& outputs, std::size_t times,
                     const std::vector<std::string>& answers, const std::vector<std::string>& requirements) {
  std::vector<std::string> parts;
  if (!outputs.empty())
    parts.push_back(fmt::format("{} {}", outputs.size() == 1 ? "output" : "outputs", someOf(outputs)));
  if (times > 0) parts.push_back(countText(static_cast<long long>(times), "output time"));
  if (!answers.empty()) parts.push_back(someOf(answers));
  if (!requirements.empty())
    parts.push_back(
        fmt::format("{} {}", requirements.size() == 1 ? "requirement" : "requirements", someOf(requirements)));
  return parts.empty() ? "" : fmt::format("  only in {}: {}\n", in, fmt::join(parts, "; "));
}

}  // namespace

std::string comparisonQuestion(const Difference& difference) { return questionText(difference.relation); }

std::string comparisonSentence(const Difference& difference) { return sentence(difference); }

std::string comparisonNotes(const Difference& difference, const Results& first, const Results& second) {
  const auto& [shared, relation, contradictions, changes, excesses, word] = difference;
  const bool moves = first.horizon > 0 || second.horizon > 0;
  std::string text = contradictionsText(contradictions.found, moves) + excessesText(excesses, moves);
  double distance = 0;
  for (const Contradiction& c : contradictions.undecided) distance = std::max(distance, c.distance);
  if (distance > 0)
    text += fmt::format(
        "  not decided: samples lie outside the other's enclosure, by {} at most, which their errors may "
        "be the reason of\n",
        atMostText(distance, 2));
  text += onlyText("A", shared.otherOutputs.first, shared.otherTimes.first, shared.otherAnswers.first,
                   shared.otherRequirements.first);
  text += onlyText("B", shared.otherOutputs.second, shared.otherTimes.second, shared.otherAnswers.second,
                   shared.otherRequirements.second);
  for (const TwoUnits& output : shared.converted)
    text += fmt::format("  output {} is in {} in B; it is compared in {}\n", output.name, output.unit.second,
                        output.unit.first);
  for (const TwoUnits& output : shared.incomparable)
    text += fmt::format("  output {} is in {} in A and in {} in B, so not compared\n", output.name, output.unit.first,
                        output.unit.second);
  const auto isConverted = [&](const std::string& name) {
    return std::ranges::find(shared.converted, name, &TwoUnits::name) != shared.converted.end();
  };
  for (std::size_t k = 0; k < shared.outputs.size(); ++k)
    if (relation.isSameMotion && relation.isSameOutput[k] == 0 && !isConverted(changes.outputs[k].name))
      text += fmt::format("  output {} is another quantity: {} in A, {} in B\n", changes.outputs[k].name,
                          first.outputs[shared.outputs[k].first].quantity,
                          second.outputs[shared.outputs[k].second].quantity);
  std::vector<std::string> others;
  for (const RequirementChange& requirement : changes.requirements)
    if (!requirement.isSameDemand) others.push_back(requirement.name);
  if (!others.empty())
    text += fmt::format("  of another demand or window of time in B, so not compared: {}\n", someOf(others));
  return text;
}

std::string comparisonText(const Difference& difference, const Results& first, const Results& second,
                           const Both<std::string>& files) {
  const bool moves = first.horizon > 0 || second.horizon > 0;
  return fmt::format("A is {}, B is {}. {}\n{}{}\n", files.first, files.second, comparisonQuestion(difference),
                     samplesText(first, second), comparisonSentence(difference)) +
         comparisonNotes(difference, first, second) + outputsTable(difference.changes, moves) +
         restTable(difference.changes, first, second, moves);
}

}  // namespace gamut
