// The [mechanism] part of a study file.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mechanics/description/mechanism.hpp"
#include "studies/reading/toml_source.hpp"

namespace gamut {

/// A mechanism, and where its numbers, parameters and elements stand, by their names.
struct ReadMechanism {
  Mechanism mechanism;
  std::map<std::string, const toml::node*> places;
  FilesAtHand files;               ///< those that it names
  std::vector<std::string> notes;  ///< what of it is left out, or may be meant otherwise
};

/// What parameters and states of the mechanism are named in the file, whatever else is wrong with them.
TomlSource::Names namesStatedIn(const TomlSource& source);

/// Reads gravity, parameters, a robot and elements of these types, in the order of the file. Throws StudyError.
ReadMechanism readMechanism(const TomlSource& source, const toml::table& table, const std::vector<Described>& types,
                            const std::optional<FilesAtHand>& files = {});

}  // namespace gamut
