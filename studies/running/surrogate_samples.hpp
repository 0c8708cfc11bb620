// As many samples as somebody wants, from the polynomials that results keep of every output: nothing is integrated.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "studies/results/results.hpp"
#include "studies/results/sample_table.hpp"
#include "studies/study.hpp"

namespace gamut {

struct SurrogateRequest {
  std::string plan = "random";
  std::uint64_t samples = 0, seed = 1;
  std::vector<double> times;         ///< s; all of which there are polynomials, if none is named
  std::vector<std::string> outputs;  ///< likewise, by name
  int jobs = 1;
};

/// `study` is that of the results. Throws std::invalid_argument, saying what is there instead, for results without
/// polynomials, a time or an output of which there are none, and for more numbers than 2e8.
SampleTable sampleSurrogate(const Results& results, const Study& study, const SurrogateRequest& request);

}  // namespace gamut
