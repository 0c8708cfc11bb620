// The files of which a report page is made (reports/page/ and the plotting library), carried inside the program so that
// it needs nothing beside it when it writes a page.
#pragma once

#include <string_view>

namespace gamut::page {

extern const std::string_view skeleton;   ///< page.html, with {{places}} to fill
extern const std::string_view style;      ///< page.css
extern const std::string_view domScript;  ///< dom.js, and so on: each follows those that it imports from
extern const std::string_view outputsScript;
extern const std::string_view keepScript;
extern const std::string_view momentsScript;
extern const std::string_view axesScript;
extern const std::string_view besideScript;
extern const std::string_view pageScript;
extern const std::string_view listScript;
extern const std::string_view sceneScript;
extern const std::string_view machineScript;
extern const std::string_view clockScript;
extern const std::string_view choiceScript;
extern const std::string_view exploreScript;
extern const std::string_view plottingStyle;    ///< uPlot's style sheet
extern const std::string_view plottingScript;   ///< uPlot, as one script that defines `uPlot`
extern const std::string_view plottingLicence;  ///< its licence, which has to travel with it

}  // namespace gamut::page
