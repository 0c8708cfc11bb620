// Interrupts over whole files: `run --force`, `extend` and `sample` are interrupted at random moments, as often as the
// first argument says (each, 100 unless it is there); the old results, pages and tables must stay whole and complete,
// to the last byte, and nothing half may be left. A study so long that it never ends in time is run beside one that
// does: then whole new files may take the place of the old ones. Says how many were interrupted, and what was wrong.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "reports/verdict.hpp"
#include "studies/results/results_file.hpp"
#include "tests/commands/started_program.hpp"
#include "tests/studies/sample_study.hpp"
#include "tests/studies/temporary_folder.hpp"

namespace gamut {
namespace {

using Words = std::vector<std::string>;

class Campaign {
 public:
  explicit Campaign(int count) : count_(count) {
    folder_.write("s.toml", sampleStudy);
    restore();
  }

  int failures() const { return failures_; }

  /// `mayFinish`: whole new files in the place of the old ones are as good.
  void interrupt(const char* title, const Words& words, bool mayFinish) {
    int interrupted = 0;
    for (int i = 0; i < count_; ++i) {
      StartedProgram program(folder_, words);
      program.awaitBegin();
      program.signalAfter(moment(), kinds[random_() % 3]);
      if (random_() % 4 == 0) program.signalAfter(moment() / 4, SIGINT);
      const int code = program.wait();
      interrupted += code == 3;
      const std::string what = fmt::format("{}, number {}", title, i);
      if (code != 3 && !(mayFinish && code == 0)) fail(what, fmt::format("ended with {}", code));
      expectWhole(what, code == 0 || mayFinish);
    }
    fmt::print("{}: {} of {} interrupted\n", title, interrupted, count_);
  }

 private:
  static constexpr int kinds[] = {SIGINT, SIGTERM, SIGHUP};

  void restore() {
    if (StartedProgram(folder_, {"run", "s.toml", "--quiet", "--force"}).wait() != 0 ||
        StartedProgram(folder_, {"sample", "s.h5", "--samples", "1000", "-o", "t.csv", "--force"}).wait() != 0)
      fail("the whole run", "did not come to its end");
    for (std::size_t i = 0; i < std::size(names); ++i) old_[i] = folder_.read(names[i]);
  }

  /// From 10 µs to 1 s, all orders of magnitude alike.
  double moment() { return std::pow(10.0, std::uniform_real_distribution(-5.0, 0.0)(random_)); }

  void expectWhole(const std::string& what, bool isNew) {
    for (std::size_t i = 0; i < std::size(names); ++i)
      if (!isNew && folder_.read(names[i]) != old_[i]) fail(what, std::string(names[i]) + " has changed");
    try {
      if (const Agreement word = judge(readResults(folder_.path("s.h5"))).word; word != Agreement::inside)
        fail(what, "the verdict became " + std::string(wordOf(word)));
    } catch (const ResultsFileError& error) {
      fail(what, error.what());
    }
    if (!folder_.read("s.html").ends_with("</html>\n")) fail(what, "half a page");
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path(""))) {
      const std::string name = entry.path().filename().string();
      if (name.ends_with(".gamut-part")) fail(what, "left " + name);
      if (name.find(".partial") != std::string::npos && name.ends_with(".h5")) expectPart(what, entry.path().string());
    }
    for (std::size_t i = 0; i < std::size(names); ++i) old_[i] = folder_.read(names[i]);
  }

  void expectPart(const std::string& what, const std::string& path) {
    try {
      const Results results = readResults(path);
      if (results.stopped.empty() || judge(results).word != Agreement::incomplete) fail(what, path + " is no part");
    } catch (const ResultsFileError& error) {
      fail(what, error.what());
    }
  }

  void fail(const std::string& what, const std::string& why) {
    fmt::print("FAILED: {}: {}\n", what, why);
    ++failures_;
  }

  static constexpr const char* names[] = {"s.h5", "s.html", "t.csv"};

  const int count_;
  TemporaryFolder folder_;
  std::string old_[std::size(names)];
  std::mt19937_64 random_{1};
  int failures_ = 0;
};

int runCampaign(int count) {
  Campaign campaign(count);
  const std::string many = "10000000";
  campaign.interrupt("run --force", {"run", "s.toml", "--samples", many, "--force", "--quiet"}, false);
  campaign.interrupt("run --force that may finish", {"run", "s.toml", "--force", "--quiet"}, true);
  campaign.interrupt("extend", {"extend", "s.h5", "--samples", many, "--quiet"}, false);
  campaign.interrupt("sample", {"sample", "s.h5", "--samples", "6000000", "-o", "t.csv", "--force"}, false);
  fmt::print("{} failures\n", campaign.failures());
  return campaign.failures() == 0 ? 0 : 1;
}

}  // namespace
}  // namespace gamut

int main(int argc, char** argv) { return gamut::runCampaign(argc > 1 ? std::atoi(argv[1]) : 100); }
