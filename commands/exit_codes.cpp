// A sample that could not be decided is as bad as one outside: the guarantee is in doubt.
#include "commands/exit_codes.hpp"

namespace gamut {

ExitCode exitCode(const Verdict& verdict) {
  switch (verdict.word) {
    case Agreement::inside:
      return done;
    case Agreement::outside:
    case Agreement::unresolved:
      return refuted;
    case Agreement::incomplete:
      break;
  }
  return endedEarly;
}

}  // namespace gamut
