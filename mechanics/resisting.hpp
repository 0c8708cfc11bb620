// Loads that resist motion in proportion to it.
#pragma once

#include <vector>

namespace gamut {

/// A load that resists rates ṙ_k = j_kᵀ u, linear in the speeds u, each where it is measured: by Q = −Σ c_k j_k j_kᵀ u.
/// So what it resists by is symmetric, and takes the power Σ c_k ṙ_k².
template <class S>
class Resisting {
 public:
  Resisting() = default;
  Resisting(const Resisting&) = delete;
  Resisting& operator=(const Resisting&) = delete;
  virtual ~Resisting() = default;

  /// c_k at the present position, where nothing moves.
  virtual std::vector<S> resistances() const = 0;
  /// From now on all c_k are 0.
  virtual void release() = 0;
};

}  // namespace gamut
