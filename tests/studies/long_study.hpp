// A study that takes a second or so, and what may differ between two runs of it.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "studies/results/results_file.hpp"
#include "tests/studies/sample_study.hpp"

namespace gamut {

/// Of some turns, samples in several blocks, corners and points of cuts, and a requirement that is left to cells.
/// `horizon`: s; `samples`: what is said of them besides their plan.
inline std::string longStudy(const std::string& horizon = "2.5", const std::string& samples = "samples = 4000") {
  std::string text =
      sampleStudyWith("horizon = 0.5\noutput_step = 0.1", "horizon = " + horizon + "\noutput_step = 0.02");
  const auto replace = [&](const std::string& old, const std::string& by) {
    text.replace(text.find(old), old.size(), by);
  };
  replace("± 1 %", "± 60 %");
  replace("samples = 16", samples + "\nstorage = \"0.1 MB\"");
  return text + R"([[requirement]]
name = "low enough"
always = "angle < 40 deg"
[fuzzy]
levels = 3
)";
}

/// Where two results differ, but for what a run costs, and when, where and from which file it was made.
inline std::vector<std::string> differencesButCosts(const Results& one, const Results& other) {
  std::vector<std::string> all = differences(one, other);
  std::erase_if(all, [](const std::string& path) {
    const std::string name = path.substr(path.rfind('/') + 1);
    return name == "cpu" || name == "cut_cpu" || name == "memory" || name == "date" || name == "host" ||
           path.starts_with("/study/cost");
  });
  return all;
}

}  // namespace gamut
