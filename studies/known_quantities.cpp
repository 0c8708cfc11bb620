#include "studies/known_quantities.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <limits>
#include <stdexcept>

#include "mechanics/assembly.hpp"

namespace gamut {
namespace {

/// The decimal of 15 digits, where it is one of the nominal values: 0.02 in [0.01999…97, 0.02].
double readable(const Interval& nominal) {
  const double middle = midpoint(nominal), decimal = std::strtod(fmt::format("{:.15g}", middle).c_str(), nullptr);
  return contains(nominal, decimal) ? decimal : middle;
}

double valueOf(const Assembly<double>& assembly, const std::string& name) {
  try {
    return assembly.output(name) + 0.0;  // no -0
  } catch (const std::domain_error&) {
    return std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace

std::vector<KnownQuantity> numbersOf(const Mechanism& mechanism) {
  std::vector<KnownQuantity> numbers;
  for (const std::string& name : mechanism.quantities())
    numbers.push_back({name, mechanism.unitOf(name), readable(mechanism.nominal(name))});
  return numbers;
}

std::vector<KnownQuantity> measurableOf(const Mechanism& mechanism) {
  const Assembly<double> assembly(mechanism);
  std::vector<KnownQuantity> outputs;
  for (const std::string& name : mechanism.outputQuantities())
    outputs.push_back({name, mechanism.unitOf(name), valueOf(assembly, name)});
  return outputs;
}

}  // namespace gamut
