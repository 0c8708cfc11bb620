// [[requirement]]: what the motion is to keep. Its margins become outputs of the study, behind all others.
#pragma once

#include <string>
#include <vector>

#include "studies/reading/toml_source.hpp"
#include "studies/study.hpp"

namespace gamut {

/// Whether they are of one kind where radians are taken for numbers, as in m r ω², which is a force; of masses and
/// lengths alone, since rad/s is not Hz, and not of what is by the radian: a stiffness is no moment.
bool isAlikeButForRadians(const Dimension& a, const Dimension& b);

/// What to do where the quantity is what is wanted by the radian, as power by rate is a moment by the radian: in
/// parentheses, behind a blank; empty elsewhere.
std::string perRadian(const Dimension& quantity, const Dimension& wanted);

/// Adds requirements, their margins and the ends of their windows to a study whose mechanism, outputs and times are
/// known. `nodes`: where each output stands, added to. Throws StudyError.
void readRequirements(const TomlSource& source, const std::vector<const toml::table*>& tables, Study& study,
                      std::vector<const toml::node*>& nodes);

}  // namespace gamut
