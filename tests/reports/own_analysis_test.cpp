// An analysis of one's own: all that there is of it stands here, and nothing else of Gamut knows of it.
#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "reports/json.hpp"
#include "reports/report.hpp"
#include "reports/summary.hpp"
#include "reports/verdict.hpp"
#include "studies/results/results_file.hpp"
#include "studies/running/context.hpp"
#include "studies/running/run.hpp"
#include "studies/settings.hpp"
#include "tests/studies/sample_study.hpp"

namespace gamut {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// The middle part of every enclosure, and when it is so many times as wide as at first.
struct CoreResult final : FurtherPart {
  double share = 0;
  Envelope core;
  std::vector<double> widened;       ///< s, one an output
  std::vector<double> lower, upper;  ///< likewise, any bounds

  std::string_view key() const override { return "core"; }
  std::string title() const override { return "cores"; }
  std::string_view verb() const override { return "found"; }
  std::unique_ptr<FurtherPart> copy() const override { return std::make_unique<CoreResult>(*this); }
  void describe(std::vector<Group>& groups) override {
    groups.push_back(groupOf<CoreResult>("/core", "the middle of enclosures", *this, [](CoreResult& c) {
      using namespace dimension;
      return c.fieldsAnd({{"share", &c.share, unit::one, "of the width", allowed::share},
                          {"core", &c.core, unit::ofOutput, "middle of the enclosure", {time, output}},
                          {"lower", &c.lower, unit::ofOutput, "any bounds", {output}},
                          {"upper", &c.upper, unit::ofOutput, "upper bound", {output}},
                          {"widened", &c.widened, unit::second, "when it is wider than at first", {output}}});
    }));
  }
};

class CoreAnalysis final : public AnalysisOf<CoreAnalysis, CoreResult> {
 public:
  std::string_view section() const override { return "core"; }
  std::string_view meaning() const override { return "the middle of enclosures"; }
  void describe(Settings& s) override {
    s.number({"share", "part of the width"}, {.least = 0, .most = 1, .fault = "is no share", .expected = "0 to 1"},
             share_);
    s.number({"times", "how much wider"}, {.least = 0, .fault = "is negative", .expected = "0 or more"}, times_);
  }
  bool isAsked() const override { return share_ > 0; }
  std::optional<Refusal> refusal(const Study& study) const override {
    if (!isAsked() || study.asksFor<IntervalResult>()) return {};
    return Refusal{"share", "there is no enclosure", "\"interval\" in study.compare"};
  }

  void find(Run& run, const Results& before, CoreResult& result) const {
    if (times_ == 99) throw std::bad_alloc();
    const Bounds& at = before.interval.at;
    result.share = share_;
    result.reached = before.interval.reached;
    result.core = run.emptyBounds();
    result.widened.assign(run.study.outputs.size(), std::numeric_limits<double>::quiet_NaN());
    for (std::size_t k = 0; k < run.study.outputs.size(); ++k) {
      result.lower.push_back(static_cast<double>(k));
      result.upper.push_back(static_cast<double>(k + 1));
    }
    const auto width = [&](std::size_t i, std::size_t k) { return at.upper(i, k) - at.lower(i, k); };
    for (std::size_t k = 0; k < run.study.outputs.size(); ++k)
      for (std::size_t i = 0; i < run.study.times.size(); ++i) {
        result.core.lower(i, k) = at.lower(i, k) + 0.5 * (1 - share_) * width(i, k);
        result.core.upper(i, k) = at.upper(i, k) - 0.5 * (1 - share_) * width(i, k);
        if (std::isnan(result.widened[k]) && width(i, k) > times_ * width(0, k)) result.widened[k] = run.study.times[i];
      }
  }

 private:
  double share_ = 0, times_ = 1;
};

std::vector<AnalysisType> withOwnAnalysis() {
  std::vector<AnalysisType> types = analysisTypes();
  types.push_back([]() -> std::unique_ptr<FurtherAnalysis> { return std::make_unique<CoreAnalysis>(); });
  return types;
}

Study studyOf(const std::string& section, const std::string& old = "", const std::string& instead = "") {
  return readStudyText(sampleStudyWith(old, instead) + section, "s.toml", elementTypes(), {}, {}, withOwnAnalysis());
}

std::string refusalOf(const std::string& section, const std::string& old = "", const std::string& instead = "") {
  try {
    studyOf(section, old, instead);
  } catch (const StudyError& error) {
    return error.what();
  }
  return "it was read";
}

TEST(OwnAnalysis, HasASectionOfItsOwn) {
  std::vector<AnalysisType> twice = withOwnAnalysis();
  twice.push_back(twice.back());
  EXPECT_THROW(made(twice), std::invalid_argument);
}

TEST(OwnAnalysis, IsFoundOnlyWhereItIsAskedFor) {
  const Results without = run(studyOf(""));
  EXPECT_FALSE(without.of<CoreResult>().present);
  EXPECT_EQ(nlohmann::json::parse(jsonSummary(without, findVerdict(without)))["core"], nullptr);
  EXPECT_EQ(without.comparison.verdict, Agreement::inside);
}

TEST(OwnAnalysis, IsFoundKeptAndTold) {
  const Results found = run(studyOf("[core]\nshare = 0.5\ntimes = 0.5\n"));
  const CoreResult& core = found.of<CoreResult>();
  ASSERT_TRUE(core.present);
  EXPECT_EQ(core.why, "");
  EXPECT_EQ(found.comparison.verdict, Agreement::inside);
  EXPECT_GT(core.cpu, 0);
  const double lower = core.core.lower(5, 0), upper = core.core.upper(5, 0);
  EXPECT_LT(found.interval.at.lower(5, 0), lower);
  EXPECT_LT(lower, upper);
  EXPECT_LT(upper, found.interval.at.upper(5, 0));

  const std::string path = std::filesystem::temp_directory_path() / ("core" + std::to_string(getpid()) + ".h5");
  writeResults(found, path);
  std::vector<Boxed<FurtherPart>> parts;
  for (const auto& analysis : made(withOwnAnalysis())) parts.emplace_back(analysis->part());
  const Results read = readResults(path, parts);
  EXPECT_THAT(differences(found, read), ::testing::IsEmpty());
  EXPECT_FALSE(readResults(path).of<CoreResult>().present);  // who does not know it, reads the rest
  std::filesystem::remove(path);

  const nlohmann::json json = nlohmann::json::parse(jsonSummary(read, findVerdict(read)))["core"];
  EXPECT_EQ(json["share"], 0.5);
  EXPECT_EQ(json["reached"], 0.5);
  EXPECT_EQ(json["why"], nullptr);
  EXPECT_EQ(json["outputs"]["angle"]["bounds"], (nlohmann::json{0, 1}));  // others with names stand beside them
  EXPECT_EQ(json["outputs"]["angle"]["core"], (nlohmann::json{lower, upper}));
  EXPECT_EQ(json["outputs"]["angle"]["widened"], 0);  // at once, of half the width
  EXPECT_THAT(textSummary(read), HasSubstr("cores: found up to 0.5 s\n"));
  EXPECT_THAT(contentText(read), HasSubstr("/core: the middle of enclosures"));
  const std::string page = renderReport(read);
  EXPECT_THAT(page, HasSubstr("middle of the enclosure"));
  EXPECT_THAT(page, HasSubstr(".drawing .corecore{fill:"));
  EXPECT_THAT(renderReport(run(studyOf(""))), Not(HasSubstr("middle of the enclosure")));
}

TEST(OwnAnalysis, CostsNothingThatWasProvedWhereMemoryEnds) {
  const Results found = run(studyOf("[core]\nshare = 0.5\ntimes = 99\n"));
  EXPECT_THAT(found.of<CoreResult>().why, HasSubstr("memory"));
  EXPECT_EQ(found.interval.reached, 0.5);
}

TEST(OwnAnalysis, SaysWhereItWasStopped) {
  Results results = run(studyOf("[core]\nshare = 0.5\n"));
  results.of<CoreResult>().stopped = "the run was interrupted";
  const Verdict verdict = judge(results);
  EXPECT_EQ(verdict.word, Agreement::incomplete);
  EXPECT_THAT(verdict.sentence, HasSubstr("Their cores were not found to the end."));
  EXPECT_THAT(verdict.notes, ::testing::Contains("Cores were not found to the end: the run was interrupted."));
}

TEST(OwnAnalysis, RefusesLikeOthers) {
  EXPECT_THAT(refusalOf("[core]\nshare = 2\n"), HasSubstr("core.share is no share; expected 0 to 1"));
  EXPECT_THAT(refusalOf("[core]\nshaer = 1\n"), HasSubstr("unknown key 'shaer' in [core]; expected 'share'?"));
  EXPECT_THAT(refusalOf("[coer]\nshare = 1\n"), HasSubstr("expected 'core'?"));
  EXPECT_THAT(refusalOf("[core]\nshare = 1\n", "compare = [\"interval\", \"stochastic\", \"fuzzy\"]",
                        "compare = [\"stochastic\"]"),
              HasSubstr("there is no enclosure; expected \"interval\" in study.compare"));
}

}  // namespace
}  // namespace gamut
