#include "studies/analysis.hpp"

#include "studies/results/results.hpp"

namespace gamut {

std::vector<Boxed<FurtherAnalysis>> made(const std::vector<AnalysisType>& types) {
  std::vector<Boxed<FurtherAnalysis>> analyses;
  for (const AnalysisType& make : types) analyses.emplace_back(make());
  return analyses;
}

std::vector<Boxed<FurtherPart>> furtherParts() {
  std::vector<Boxed<FurtherPart>> parts;
  for (const AnalysisType& make : analysisTypes()) parts.emplace_back(make()->part());
  return parts;
}

}  // namespace gamut
