// What commands say of results to people: lines and tables.
#pragma once

#include <string>

#include "studies/results/results.hpp"

namespace gamut {

/// A table of the outputs at the last time reached, and what it cost; several lines, the last one ended.
std::string textSummary(const Results& results);

/// Where results come from and what was found; several lines, the last one ended.
std::string infoText(const Results& results);

/// "normal (mean 0.8, deviation 0.01)", "triangular": the distribution or membership function of an uncertain quantity
/// and its numbers; the support only where it is not the interval, a table without its points.
std::string shapeText(const Results& results, const UncertainInfo& uncertain, ShapeKind shape);

/// Every field that a file of these results holds, as they describe it; several lines, the last one ended.
std::string contentText(const Results& results);

}  // namespace gamut
