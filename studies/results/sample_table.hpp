// Samples of outputs with their proved errors, as HDF5 or CSV: what `gamut sample` writes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "studies/results/origin.hpp"

namespace gamut {

struct SampleTable {
  std::string results;  ///< file that the polynomials come from
  std::string plan;
  std::uint64_t seed = 0;
  std::vector<UncertainInfo> quantities;
  std::vector<OutputInfo> outputs;
  std::vector<double> times;            ///< s
  std::vector<double> values;           ///< [sample][quantity]
  std::vector<double> numbers, errors;  ///< [sample][time][output]: the output is not farther from it than the error

  std::size_t samples() const { return quantities.empty() ? 1 : values.size() / quantities.size(); }
};

/// The bytes of a file with the data sets /time, /output, /quantity, /values, /outputs and /errors.
std::string hdf5Of(const SampleTable& table);
/// A row a sample and time, decimals that give the same doubles back.
std::string csvOf(const SampleTable& table);

}  // namespace gamut
