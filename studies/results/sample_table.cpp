// The whole file in memory, as all files of Gamut.
#include "studies/results/sample_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>

#include "studies/results/detail/hdf5.hpp"
#include "studies/words.hpp"

namespace gamut {

std::string hdf5Of(const SampleTable& table) {
  constexpr hsize_t nothingInFront = 512;
  return hdf5InMemory(nothingInFront, [&](hid_t file) {
    Hdf5Writer out(file);
    out.attribute("long_name", "samples of outputs, from polynomials with proved errors");
    out.attribute("results", table.results);
    out.attribute("plan", table.plan);
    out.attribute("seed", table.seed);
    std::vector<std::string> outputs, quantities, outputUnits, quantityUnits;
    for (const OutputInfo& output : table.outputs) outputs.push_back(output.name), outputUnits.push_back(output.unit);
    for (const UncertainInfo& quantity : table.quantities)
      quantities.push_back(quantity.name), quantityUnits.push_back(quantity.unit);
    const hsize_t samples = table.samples(), times = table.times.size(), count = outputs.size();
    out.numbers("time", table.times.data(), {times}, "output times", "s");
    out.makeScale("time", "time");
    out.texts("output", outputs, "names of the outputs");
    out.makeScale("output", "output");
    out.texts("output_unit", outputUnits, "their units");
    if (!quantities.empty()) {
      out.texts("quantity", quantities, "names of the uncertain quantities");
      out.makeScale("quantity", "quantity");
      out.texts("quantity_unit", quantityUnits, "their units");
      out.numbers("values", table.values.data(), {samples, quantities.size()},
                  "values of the quantities, a row a sample", "", true);
    }
    out.numbers("outputs", table.numbers.data(), {samples, times, count}, "outputs by sample and time", "", true);
    out.numbers("errors", table.errors.data(), {samples, times, count},
                "the output is not farther from the number than this, proved; infinite where nothing is known", "");
  });
}

std::string csvOf(const SampleTable& table) {
  fmt::memory_buffer text;
  const auto end = std::back_inserter(text);
  std::vector<std::string> heads{"sample"};
  for (const UncertainInfo& quantity : table.quantities)
    heads.push_back(csvHeading("uncertain " + quantity.name, quantity.unit));
  heads.push_back(csvHeading("time", "s"));
  for (const OutputInfo& output : table.outputs) heads.push_back(csvHeading(output.name, output.unit));
  for (const OutputInfo& output : table.outputs) heads.push_back(csvHeading("error of " + output.name, output.unit));
  fmt::format_to(end, "{}\n", fmt::join(heads, ","));
  const std::size_t quantities = table.quantities.size(), outputs = table.outputs.size();
  for (std::size_t i = 0; i < table.samples(); ++i)
    for (std::size_t t = 0; t < table.times.size(); ++t) {
      fmt::format_to(end, "{}", i);
      for (std::size_t q = 0; q < quantities; ++q) fmt::format_to(end, ",{}", table.values[i * quantities + q]);
      fmt::format_to(end, ",{}", table.times[t]);
      const std::size_t at = (i * table.times.size() + t) * outputs;
      for (const std::vector<double>* numbers : {&table.numbers, &table.errors})
        for (std::size_t k = 0; k < outputs; ++k) fmt::format_to(end, ",{}", (*numbers)[at + k]);
      fmt::format_to(end, "\n");
    }
  return fmt::to_string(text);
}

}  // namespace gamut
