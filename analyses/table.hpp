// Numbers of outputs over time, and pairs of them as bounds: what samples and enclosures are compared by.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace gamut {

/// One number for every output at every output time; NaN where there is none. Row by row one time.
struct Table {
  std::size_t times = 0;
  std::size_t outputs = 0;
  std::vector<double> data;

  Table() = default;
  Table(std::size_t timeCount, std::size_t outputCount)
      : times(timeCount),
        outputs(outputCount),
        data(timeCount * outputCount, std::numeric_limits<double>::quiet_NaN()) {}
  double& operator()(std::size_t time, std::size_t output) { return data[time * outputs + output]; }
  double operator()(std::size_t time, std::size_t output) const { return data[time * outputs + output]; }
  bool empty() const { return data.empty(); }
};

/// Least and greatest values; NaN where there are none.
struct Envelope {
  Table lower, upper;

  Envelope() = default;
  Envelope(std::size_t times, std::size_t outputs) : lower(times, outputs), upper(times, outputs) {}
  bool empty() const { return lower.empty(); }
  /// Widens the envelope by one value; ignores values that are not finite.
  void include(std::size_t time, std::size_t output, double value);
};

}  // namespace gamut
