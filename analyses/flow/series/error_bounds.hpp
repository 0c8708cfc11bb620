// The constants of every a-priori error bound in round-to-nearest, each with its derivation. Internal to this room.
#pragma once

namespace gamut::bounds {

/// Unit roundoff: |fl(a ∘ b) - a ∘ b| ≤ u |fl(a ∘ b)|.
constexpr double unit = 0x1p-53;

/// A coefficient in double-double, a sum of N products and what follows it: N times this of Σ|products|
/// (fine_recursion.cpp).
constexpr double fine = 0x1p-96;

/// (1 + 2^-53)^(2^22) ≤ 1 + 2^-30: covers a formula of nonnegative numbers with fewer than four million roundings.
constexpr double up = 1 + 0x1p-30;

/// Values at or beyond this are refused.
constexpr double largest = 0x1p400;

/// Underflow: fewer than 2^30 operations, each off by at most 2^-1074, times factors below `largest`: 2^-644.
constexpr double tiny = 0x1p-600;

/// One rounding of a difference or a product in the direction that makes a lower bound lower.
constexpr double down = 1 - 0x1p-50;

}  // namespace gamut::bounds
