// What the guide says of distributions and memberships is what they say of themselves.
#include <gmock/gmock.h>

#include <fstream>
#include <iterator>
#include <string>

#include "studies/reading/shape_reader.hpp"

namespace gamut {
namespace {

TEST(ShapesGuide, HasTheTablesOfAllShapes) {
  std::ifstream file(GAMUT_SOURCE_DIR "/docs/study-file.md");
  const std::string guide{std::istreambuf_iterator<char>(file), {}};
  EXPECT_THAT(guide, ::testing::HasSubstr(shapesGuide({})));
}

}  // namespace
}  // namespace gamut
