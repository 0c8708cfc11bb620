// Sections of a study file that describe themselves.
#pragma once

#include <functional>
#include <string_view>

#include "studies/reading/toml_source.hpp"

namespace gamut {

class Settings;

/// The table `name` of the file: fills in what needs no reader of its own. Throws StudyError, for keys that the section
/// has not and in kinematics for those of motion too.
TomlSection readSettings(const TomlSource& source, const toml::table& table, std::string_view name, Study& study);

/// Likewise what is described, of a section that has these keys.
void readSettings(const TomlSection& section, const std::function<void(Settings&)>& describe);

}  // namespace gamut
