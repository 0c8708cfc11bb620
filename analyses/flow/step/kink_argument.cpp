#include "analyses/flow/step/kink_argument.hpp"

#include <utility>

#include "scalars/program/expression.hpp"
#include "scalars/program/recorder.hpp"

namespace gamut {

KinkArgument kinkArgumentOf(const Program& f, int node) {
  std::optional<LinearForm> form = linearFormOf(f, node);
  if (form) return {std::move(form), std::nullopt};
  return {std::nullopt, Recorder(f).finish({node})};
}

bool isArgument(const KinkArgument& u, const Program& f, int node) {
  if (u.function) return isSameExpression(*u.function, u.function->outputNodes()[0], f, node);
  const std::optional<LinearForm> form = linearFormOf(f, node);
  return form && isSameForm(*u.form, *form);
}

bool isSameSurface(const KinkArgument& u, const Program& f, int node) {
  if (u.function) return isArgument(u, f, node);
  const std::optional<LinearForm> form = linearFormOf(f, node);
  return form && signOfRatio(*u.form, *form) != 0;
}

}  // namespace gamut
