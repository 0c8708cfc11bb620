// A robot in words: for people who look at its file, and for those who begin a study of it.
#pragma once

#include <string>

#include "studies/robots/robot.hpp"

namespace gamut {

/// Its tree: links, joints with their kinds, axes and limits, masses; how many degrees of freedom it has.
std::string summaryOf(const Robot& robot);

/// A study of its motion in free fall, with a few masses uncertain. `path` is what the study calls the robot's file.
std::string studyOf(const Robot& robot, const std::string& path);

}  // namespace gamut
