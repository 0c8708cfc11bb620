// Figures at some times, of which one is shown: a slider for all of a section chooses it.
#pragma once

#include <string>
#include <vector>

namespace gamut {

/// Where the script puts the slider of all figures of this kind; nothing where there is one time.
std::string momentsControl(const std::string& kind, const std::string& label, const std::vector<double>& times);

/// One figure a time, all but the last hidden, until somebody moves the slider.
std::string momentFigures(const std::string& kind, const std::vector<std::string>& drawings,
                          const std::vector<std::string>& captions, const std::vector<std::string>& numbers);

}  // namespace gamut
