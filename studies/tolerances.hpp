// How much worse results may be than others of the same outputs before a comparison of both fails: what a team agrees
// on and keeps in a TOML file (docs/results-file.md).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace gamut {

/// Of one output. What is not stated is free.
struct OutputTolerances {
  double wider = 0.01;                   ///< enclosures and alpha-cuts may be so much wider: 0.01 is one per cent
  double gap = 0.01;                     ///< bounds of probabilities may lie so much farther apart
  std::optional<double> overestimation;  ///< may be so much greater, as a part of what it was
};

struct Tolerances : OutputTolerances {
  double shorter = 0;         ///< an analysis may end so much earlier, as a part of the time that it reached
  std::optional<double> cpu;  ///< CPU time may be so many times what it was
  std::map<std::string, OutputTolerances, std::less<>> of;  ///< by name of the output

  const OutputTolerances& ofOutput(const std::string& name) const {
    const auto found = of.find(name);
    return found == of.end() ? *this : found->second;
  }
};

/// Reads a file of tolerances for results with these outputs; what it does not state is as above, of an output as the
/// file states it for all. Throws StudyError, one line "file:line:column: what is wrong; what was expected".
Tolerances readTolerances(const std::string& path, const std::vector<std::string>& outputs);

/// The same for text at hand; `name` is what messages call the file.
Tolerances readTolerancesText(const std::string& text, const std::string& name,
                              const std::vector<std::string>& outputs);

}  // namespace gamut
