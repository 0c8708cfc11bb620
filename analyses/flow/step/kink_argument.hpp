// u of |u|, wherever that stands.
#pragma once

#include <optional>

#include "scalars/program/linear_form.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

struct KinkArgument {
  std::optional<LinearForm> form;   ///< if it is one
  std::optional<Program> function;  ///< else: u, its only output
};

KinkArgument kinkArgumentOf(const Program& f, int node);

/// Whether a node is u: the same linear form, or the same operations.
bool isArgument(const KinkArgument& u, const Program& f, int node);

/// Whether it is zero where u is, as far as formulas tell.
bool isSameSurface(const KinkArgument& u, const Program& f, int node);

}  // namespace gamut
