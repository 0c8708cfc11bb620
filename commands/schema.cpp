// gamut schema: what a study file may hold, as JSON Schema.
#include "studies/schema.hpp"

#include "commands/standard_streams.hpp"
#include "commands/table.hpp"

namespace gamut::commands {

Action schema(CLI::App& /*command*/) {
  return [] {
    sayOut(studySchema());
    return done;
  };
}

}  // namespace gamut::commands
