// What ever more samples say: a number a count of samples, of every output a line.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "reports/drawing/layer.hpp"

namespace gamut {

/// Counts rise, each twice the one before or so: equal factors lie equally far apart. The line `main` is drawn in
/// front. Empty where no line has two numbers.
std::string drawConvergence(const std::vector<double>& counts, const std::vector<Line>& lines, std::size_t main,
                            const std::string& axisName, const std::string& label);

}  // namespace gamut
