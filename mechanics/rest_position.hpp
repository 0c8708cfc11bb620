// Where a mechanism rests: R(v, 0, 0) = 0, near where it stands at first.
#pragma once

#include <span>
#include <vector>

#include "mechanics/rest_rows.hpp"
#include "scalars/recorded.hpp"

namespace gamut {

/// From v on, against a resistance that is like the inertia and fades: down the potential, if there is one, so that
/// what is found is stable where that is near. Throws UnfitPart where there is none.
std::vector<double> settled(const RestRows& rows, std::vector<double> v, std::span<const double> parameters);

/// By Newton's steps from v on. Throws UnfitPart where they do not converge.
std::vector<double> rooted(const RestRows& rows, std::vector<double> v, std::span<const double> parameters);
/// By four of them, written down.
std::vector<Recorded> rooted(const RestRows& rows, std::vector<Recorded> v, std::span<const Recorded> parameters);

/// Throws UnfitPart where the position of rest is one of many.
void refuseLoose(const RestRows& rows, const LinearRows<double>& at);

}  // namespace gamut
