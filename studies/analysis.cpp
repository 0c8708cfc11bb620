#include "studies/analysis.hpp"

#include <set>
#include <stdexcept>

#include "studies/results/results.hpp"

namespace gamut {

std::vector<Boxed<FurtherAnalysis>> made(const std::vector<AnalysisType>& types) {
  std::vector<Boxed<FurtherAnalysis>> analyses;
  std::set<std::string_view> sections;
  for (const AnalysisType& make : types)
    if (!sections.insert(analyses.emplace_back(make())->section()).second)
      throw std::invalid_argument("two analyses are asked for by [" + std::string(analyses.back()->section()) +
                                  "]; expected a section of its own for each");
  return analyses;
}

std::vector<Boxed<FurtherPart>> furtherParts() {
  std::vector<Boxed<FurtherPart>> parts;
  for (const AnalysisType& make : analysisTypes()) parts.emplace_back(make()->part());
  return parts;
}

}  // namespace gamut
