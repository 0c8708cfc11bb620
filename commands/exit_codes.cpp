// A sample that could not be decided is as bad as one outside: the guarantee is in doubt.
#include "commands/exit_codes.hpp"

#include <stdexcept>

namespace gamut {

ExitCode exitCode(const Verdict& verdict) {
  if (verdict.word == "inside") return done;
  if (verdict.word == "outside" || verdict.word == "unresolved") return refuted;
  if (verdict.word == "incomplete") return endedEarly;
  throw std::invalid_argument("no verdict: '" + verdict.word + "'");
}

}  // namespace gamut
