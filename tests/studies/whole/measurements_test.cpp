// Distributions from measurements and histograms: what is wrong with them is told of the line that is at fault.
#include <gmock/gmock.h>

#include <fstream>
#include <string>

#include "studies/study.hpp"
#include "tests/studies/sample_study.hpp"
#include "tests/studies/temporary_folder.hpp"

namespace gamut {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class Measurements : public ::testing::Test {
 protected:
  /// What is said of the start angle with this distribution and this table m.csv; empty if nothing.
  std::string messageOf(const std::string& distribution, const std::string& table = "") {
    std::ofstream(folder_.path("m.csv")) << table;
    const std::string path = folder_.path("s.toml");
    std::ofstream(path) << sampleStudyWith(
        "interval = \"± 1 %\"\ndistribution = { type = \"uniform\" }\nmembership = { type = \"triangular\" }\n",
        "[uncertain.distribution]\n" + distribution + "\n");
    try {
      readStudy(path);
    } catch (const StudyError& error) {
      return error.what();
    }
    return "";
  }

  std::string ofTable(const std::string& table, const std::string& column = "angle") {
    return messageOf("type = \"empirical\"\nfile = \"m.csv\"\ncolumn = \"" + column + "\"", table);
  }

  TemporaryFolder folder_;
};

TEST_F(Measurements, AreReadByTheNameOfTheirColumnWithOrWithoutItsUnit) {
  EXPECT_EQ(ofTable("angle [deg]\n29\n31\n30\n"), "");
  EXPECT_EQ(ofTable("angle [deg]\n29\n31\n30\n", "angle [deg]"), "");
}

TEST_F(Measurements, ThatMissTheNominalValueAreToldWhereTheyAreStated) {
  EXPECT_THAT(messageOf("type = \"empirical\"\nvalues = [\"31 deg\", \"32 deg\"]"),
              AllOf(HasSubstr("s.toml:33:"), HasSubstr("does not hold the nominal value")));
  EXPECT_THAT(ofTable("angle [deg]\n31\n32\n"),
              AllOf(HasSubstr("s.toml:33:"), HasSubstr("does not hold the nominal value")));
}

TEST_F(Measurements, AreNotEmpty) {
  EXPECT_THAT(messageOf("type = \"empirical\"\nvalues = []"), AllOf(HasSubstr("s.toml:33:"), HasSubstr("is empty")));
}

TEST_F(Measurements, OfTwoColumnsOfOneNameAreRefused) {
  EXPECT_THAT(ofTable("angle [deg],angle\n29,1\n31,1\n"), HasSubstr("m.csv:1:13: a second column is named 'angle'"));
}

TEST_F(Measurements, OfSpreadsheetsGetAHint) {
  EXPECT_THAT(ofTable("\"angle [deg]\",b\n29,1\n31,1\n"),
              HasSubstr("is in quotation marks; expected names without them"));
  EXPECT_THAT(ofTable("angle [deg];b\n29,5;1\n"), HasSubstr("m.csv:1:1: the cells are separated by semicolons"));
}

TEST_F(Measurements, WithDecimalCommasGetAHint) {
  const auto hint = HasSubstr("a decimal point, not a comma, in numbers");
  EXPECT_THAT(ofTable("angle [deg]\n29.5\n30,5\n"), AllOf(HasSubstr("m.csv:3:4: the row has 2 cells"), hint));
  EXPECT_THAT(ofTable("angle [deg],b\n\"29,5\",1\n"), AllOf(HasSubstr("m.csv:2:8: the row has 3 cells"), hint));
  EXPECT_THAT(ofTable("angle [deg];b\n29,5;1\n"), AllOf(HasSubstr("m.csv:1:1: "), hint));
  EXPECT_THAT(ofTable("angle [deg],b\n29;1,5\n"), AllOf(HasSubstr("m.csv:2:1: '29;1' is no number"), hint));
}

TEST_F(Measurements, MayNameTheirUnitInParentheses) {
  EXPECT_EQ(ofTable("no,angle (deg)\n1,29\n2,31\n"), "");
  EXPECT_EQ(ofTable("angle (deg)\n29\n31\n", "angle (deg)"), "");
  EXPECT_EQ(ofTable("angle (left)\n0.5\n0.6\n", "angle (left)"), "");
  EXPECT_THAT(ofTable("angle (kg)\n29\n31\n"), HasSubstr("m.csv:1:1: the column is in kg"));
  EXPECT_THAT(ofTable("angle (degrees)\n29\n31\n"),
              AllOf(HasSubstr("unknown column 'angle'; expected 'angle (degrees)'"),
                    HasSubstr("whose headings name units as in \"length [mm]\"")));
}

TEST_F(Measurements, InHistogramsAreToldByTheLineOfTheTable) {
  const auto said = [&](const std::string& rows) {
    return messageOf("type = \"histogram\"\nfile = \"m.csv\"", "lower [deg],upper [deg],weight\n" + rows);
  };
  EXPECT_EQ(said("29,30,1\n30,31,2\n"), "");
  EXPECT_THAT(said("29,30,1\n30,31,-2\n"), HasSubstr("m.csv:3:1: the weight is negative"));
  EXPECT_THAT(said("29,30,1\n\n31,30,2\n"), HasSubstr("m.csv:4:1: upper lies below lower"));
  EXPECT_THAT(said("29,30,1\n29.5,31,2\n"), HasSubstr("m.csv:3:1: lower lies below the upper"));
  EXPECT_THAT(said("29,30,0\n30,31,0\n"), HasSubstr("m.csv:2:1: no weight is above 0"));
}

}  // namespace
}  // namespace gamut
