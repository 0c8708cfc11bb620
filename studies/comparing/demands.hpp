// Guaranteed answers of a requirement that cannot both be true.
#pragma once

#include <string>

#include "studies/comparing/relation.hpp"
#include "studies/results/results.hpp"

namespace gamut {

/// The same demand in the same window of time, as far as words say so.
bool isSameDemand(const Results& first, const RequirementResult& one, const Results& second,
                  const RequirementResult& other);

/// How two answers to the same demand contradict each other, in words of the first, "A", and of the second, "B"; empty
/// if they do not. `isSame`: of the same motion.
std::string oppositionOf(const RequirementResult& one, const RequirementResult& other, const Relation& relation,
                         bool isSame, bool haveCuts);

}  // namespace gamut
