// The [[uncertain]] part of a study file.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "studies/reading/table_reader.hpp"
#include "studies/reading/toml_source.hpp"

namespace gamut {

/// Reads uncertain quantities of the study's mechanism into the study, and notes what may be a mistake in them. The
/// mechanism's numbers stand at `places`; distributions and memberships are of `shapes`. Throws StudyError.
void readUncertain(const TomlSource& source, const std::vector<const toml::table*>& tables, const TableFiles& files,
                   const std::map<std::string, const toml::node*>& places, const ShapeTypes& shapes, Study& study);

/// What would do instead of a quantity that the mechanism does not have.
std::string quantityExpected(const std::string& word, const std::vector<std::string>& known);
/// What would do instead of an output that it does not have; of "spring.force" what the element named spring gives.
std::string outputExpected(const std::string& word, const std::vector<std::string>& known, const Mechanism& mechanism);

}  // namespace gamut
