// The parts of the results describe themselves: every member, each once, and the guide shows what they say.
#include "studies/results/results.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>

#include "studies/results/results_file.hpp"
#include "tests/studies/sample_results.hpp"
#include "tests/studies/temporary_folder.hpp"

namespace gamut {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Sample results with a record in every list.
Results fullResults() {
  Results results = sampleResults();
  for (const Group& group : describe(results))
    if (group.size == 0) group.resize(1);
  return results;
}

/// Another number, not far from it where it is one.
double other(double x) { return x > 0 || x < 0 ? std::nextafter(x, 0.0) : 0.5; }

/// Gives the value of a field another content of a right shape.
void change(const FieldValue& value, const Results& results) {
  const Bounds bounds = sampleBounds(results.time.size(), results.outputs.size(), 77, 1);
  const std::size_t levels = results.fuzzy.alpha.size();
  std::visit(
      Visitor{[](double* x) { *x = other(*x); }, [](std::int64_t* x) { ++*x; }, [](std::uint64_t* x) { *x ^= 1; },
              [](bool* x) { *x = !*x; }, [](std::string* x) { *x += "?"; }, [](WholeText x) { *x.text += "?"; },
              [](Choice x) { *x.value = static_cast<unsigned char>((*x.value + 1) % x.all.size()); },
              [](std::vector<std::int64_t>* v) { ++v->back(); },
              [&](const Numbers& numbers) {
                std::visit(Visitor{[](std::vector<double>* v) { v->back() = other(v->back()); },
                                   [](Grid* g) { g->data.back() = other(g->data.back()); },
                                   [&](Table* t) { *t = bounds.lower; }, [&](Envelope* e) { *e = bounds; },
                                   [&](std::vector<Table>* v) { v->back() = bounds.lower; },
                                   [&](std::vector<Envelope>* v) { v->assign(levels, bounds); }},
                           numbers.holder());
              }},
      value);
}

TEST(Description, NamesEveryFieldOnce) {
  const Results results = fullResults();
  std::set<std::string> paths;
  for (const Group& group : describe(results))
    for (const Field& field : group.fields(0)) {
      EXPECT_TRUE(paths.insert(pathOf(group, field)).second) << pathOf(group, field);
      EXPECT_FALSE(field.meaning.empty()) << pathOf(group, field);
    }
}

TEST(Description, TellsAChangeOfEachField) {
  const Results before = fullResults();
  for (std::size_t g = 0; g < describe(before).size(); ++g)
    for (std::size_t f = 0; f < describe(before)[g].fields(0).size(); ++f) {
      Results after = before;
      const Group group = describe(after)[g];
      const Field field = group.fields(group.size - 1)[f];
      change(field.value, after);
      EXPECT_THAT(differences(before, after), ElementsAre(pathOf(group, field)));
    }
}

TEST(Description, IsWhatTheFileGivesBack) {
  const TemporaryFolder folder;
  const Results before = fullResults();
  Results after = before;
  std::size_t changed = 0;
  for (const Group& group : describe(after))
    for (const Field& field : group.fields(group.size - 1)) change(field.value, after), ++changed;
  EXPECT_EQ(differences(before, after).size(), changed);
  writeResults(after, folder.path("r.h5"));
  EXPECT_THAT(differences(readResults(folder.path("r.h5")), after), IsEmpty());
}

TEST(Description, GivesBackTheExtentsOfGridsWithoutNumbers) {
  const TemporaryFolder folder;
  Results before = sampleResults();
  DistributionResult& written = before.distribution;
  written.point.clear();
  written.value = written.lower = written.upper = Grid({1, 2, 0});
  written.sampled = written.excess = Grid();
  writeResults(before, folder.path("r.h5"));
  const DistributionResult read = readResults(folder.path("r.h5")).distribution;
  EXPECT_THAT(read.value.extents, ElementsAre(1, 2, 0));
  EXPECT_THAT(read.values(0, 1), IsEmpty());
  EXPECT_THAT(read.excess.extents, IsEmpty());  // nothing is there, though places for numbers are
}

TEST(Description, TellsWhichListsDiffer) {
  Results after = sampleResults();
  after.comparison.disputed.pop_back();
  after.fuzzy = {};
  EXPECT_THAT(differences(sampleResults(), after),
              ElementsAre("/fuzzy", "/fuzzy/transformation", "/fuzzy/influence", "/comparison/disputed"));
}

/// The longest run of bytes of an object that none of the fields holds, nor any of the members that are groups of their
/// own or say whether one is there.
template <class Object, class... Known>
std::size_t longestGap(const Object& object, const std::vector<Field>& fields, const Known&... known) {
  const auto* begin = reinterpret_cast<const char*>(&object);
  std::vector<char> isHeld(sizeof object, 0);
  if constexpr (std::is_polymorphic_v<Object>)
    std::fill_n(isHeld.begin(), sizeof(void*), char{1});  // its table of functions
  const auto hold = [&](const auto* value) {
    const auto* place = reinterpret_cast<const char*>(value);
    if (place >= begin && place < begin + sizeof object)
      std::fill_n(isHeld.begin() + (place - begin), sizeof *value, char{1});
  };
  (hold(&known), ...);
  for (const Field& field : fields)
    std::visit(Visitor{[&](WholeText x) { hold(x.text); }, [&](Choice x) { hold(x.value); },
                       [&](const Numbers& x) { std::visit(hold, x.holder()); }, [&](const auto* x) { hold(x); }},
               field.value);
  std::size_t longest = 0, run = 0;
  for (const char held : isHeld) longest = std::max(longest, run = held != 0 ? 0 : run + 1);
  return longest;
}

TEST(Description, LeavesOutNoMember) {
  constexpr std::size_t padding = sizeof(double) - 1;
  Results r = fullResults();
  std::map<std::string_view, std::vector<Field>> fields;
  for (const Group& group : describe(r)) fields[group.path] = group.fields(0);
  EXPECT_LE(longestGap(r.interval, fields["/interval"], r.interval.present), padding);
  EXPECT_LE(longestGap(r.stochastic, fields["/stochastic"], r.stochastic.present, r.stochastic.kept,
                       r.stochastic.failed, r.stochastic.convergence, r.stochastic.extremes, r.stochastic.switching),
            padding);
  EXPECT_LE(longestGap(r.stochastic.extremes, fields["/stochastic/extremes"], r.stochastic.extremes.present), padding);
  EXPECT_LE(longestGap(r.stochastic.switching, fields["/stochastic/switching"], r.stochastic.switching.present),
            padding);
  EXPECT_LE(longestGap(r.stochastic.failed[0], fields["/stochastic/failed"]), padding);
  EXPECT_LE(longestGap(r.stochastic.convergence, fields["/stochastic/convergence"], r.stochastic.convergence.present),
            padding);
  EXPECT_LE(longestGap(r.stochastic.kept, fields["/stochastic/kept"], r.stochastic.kept.present), padding);
  EXPECT_LE(longestGap(r.fuzzy, fields["/fuzzy"], r.fuzzy.present, r.fuzzy.influence, r.fuzzy.transformation), padding);
  EXPECT_LE(longestGap(r.fuzzy.transformation, fields["/fuzzy/transformation"], r.fuzzy.transformation.present),
            padding);
  EXPECT_LE(longestGap(r.fuzzy.influence, fields["/fuzzy/influence"], r.fuzzy.influence.present), padding);
  EXPECT_LE(longestGap(r.comparison, fields["/comparison"], r.comparison.present, r.comparison.disputed), padding);
  EXPECT_LE(longestGap(r.comparison.disputed[0], fields["/comparison/disputed"]), padding);
  const std::vector<RequirementResult>& requirements = r.requirements;
  EXPECT_LE(longestGap(r.requirements, fields["/requirements/proof"], r.requirements.present, requirements,
                       r.requirements.cells),
            padding);
  EXPECT_LE(longestGap(r.requirements.cells[0], fields["/requirements/cells"]), padding);
  EXPECT_LE(longestGap(requirements[0], fields["/requirements"]), padding);
  EXPECT_LE(longestGap(r.libraries[0], fields["/study/libraries"]), padding);
  EXPECT_LE(longestGap(r.costs[0], fields["/study/costs"]), padding);
  EXPECT_LE(longestGap(r.extensions[0], fields["/study/extensions"]), padding);
  EXPECT_LE(longestGap(r.outputs[0], fields["/study/outputs"]), padding);
  EXPECT_LE(longestGap(r.uncertain[0], fields["/study/uncertain"]), padding);
  EXPECT_LE(longestGap(r.shapes[0], fields["/study/shapes"]), padding);
  const PictureResult& m = r.picture;
  EXPECT_LE(longestGap(m, fields["/machine"], m.present, m.directions, m.points, m.parts, m.axes, m.profiles, m.places),
            padding);
  EXPECT_LE(longestGap(m.directions[0], fields["/machine/directions"]), padding);
  EXPECT_LE(longestGap(m.points[0], fields["/machine/points"]), padding);
  EXPECT_LE(longestGap(m.parts[0], fields["/machine/parts"]), padding);
  EXPECT_LE(longestGap(m.axes[0], fields["/machine/axes"]), padding);
  EXPECT_LE(longestGap(m.profiles[0], fields["/machine/profiles"]), padding);
  EXPECT_LE(longestGap(m.places, fields["/machine/places"], m.places.present), padding);
  std::vector<Field> origin = fields["/"];
  origin.insert(origin.end(), fields["/study"].begin(), fields["/study"].end());
  EXPECT_LE(longestGap<Origin>(r, origin, r.libraries, r.costs, r.extensions, r.outputs, r.uncertain, r.shapes),
            padding);
}

/// "time × output" for what lies at "/time" and "/output".
std::string shapeText(const Group& group, const Field& field) {
  std::string text;
  for (const std::string_view dimension : dimensionsOf(group, field))
    text += (text.empty() ? "" : " × ") + std::string(dimension.substr(dimension.rfind('/') + 1));
  if (!text.empty()) return text;
  return std::holds_alternative<WholeText>(field.value) ? "scalar" : "attribute";
}

/// The tables of the guide.
std::string layoutTables() {
  Results results = fullResults();
  std::string text;
  for (const Group& group : describe(results)) {
    text += "`" + std::string(group.path) + "`" + (group.meaning.empty() ? "" : ": " + std::string(group.meaning)) +
            "\n\n| name | shape | unit | holds |\n|---|---|---|---|\n";
    for (const Field& field : group.fields(0)) {
      const std::string name(field.name);
      const auto* numbers = std::get_if<Numbers>(&field.value);
      const bool isPair = numbers != nullptr && numbers->ends().size() == 2;
      text += "| `" + name + (isPair ? "_lower`, `" + name + "_upper" : "") + "` | " + shapeText(group, field) + " | " +
              std::string(field.unit) + " | " + std::string(field.meaning) + " |\n";
    }
    text += "\n";
  }
  return text;
}

TEST(Description, IsWhatTheGuideShows) {
  std::ifstream file(GAMUT_SOURCE_DIR "/docs/results-file.md");
  const std::string guide{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  EXPECT_NE(guide.find(layoutTables()), guide.npos) << "docs/results-file.md should hold:\n\n" << layoutTables();
}

}  // namespace
}  // namespace gamut
