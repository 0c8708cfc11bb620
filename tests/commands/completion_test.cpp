// What shells complete: asked of bash itself.
#include <gmock/gmock.h>

#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "commands/table.hpp"
#include "tests/commands/program.hpp"

namespace gamut {
namespace completion_test {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;

class Completion : public FromOutside {
 protected:
  void SetUp() override { folder_.write("gamut.bash", gamut("completion bash").out); }

  /// What bash offers for the last of these words, after "gamut".
  std::vector<std::string> offered(const std::string& words, int last) const {
    const std::string ask = "source gamut.bash; COMP_WORDS=(gamut " + words + "); COMP_CWORD=" + std::to_string(last) +
                            "; _gamut; printf \"%s\\n\" \"${COMPREPLY[@]}\"";
    EXPECT_EQ(std::system(("cd '" + folder_.path("") + "' && bash -c '" + ask + "' > .offered").c_str()), 0);
    std::istringstream lines(folder_.read(".offered"));
    std::vector<std::string> all;
    for (std::string line; std::getline(lines, line);) all.push_back(line);
    return all;
  }
};

TEST_F(Completion, OffersCommandsOptionsAndFiles) {
  std::vector<std::string> names;
  for (const Command& command : commands::table) names.emplace_back(command.name);
  EXPECT_THAT(offered("\"\"", 1), IsSupersetOf(names));
  EXPECT_THAT(offered("va", 1), ElementsAre("validate"));
  EXPECT_THAT(offered("run --ti", 2), ElementsAre("--time-limit"));
  EXPECT_THAT(offered("schema --ti", 2), ElementsAre(""));
  folder_.write("arm.toml", "");
  folder_.write("arm.h5", "");
  EXPECT_THAT(offered("run ar", 2), ElementsAre("arm.toml"));
  EXPECT_THAT(offered("check ar", 2), ElementsAre("arm.h5"));
  EXPECT_THAT(offered("run --json ar", 3), Contains("arm.toml"));
}

TEST_F(Completion, KnowsThreeShells) {
  for (const char* shell : {"zsh", "fish"}) {
    const Outcome said = gamut(std::string("completion ") + shell);
    EXPECT_EQ(said.exitCode, 0);
    for (const Command& command : commands::table) EXPECT_THAT(said.out, HasSubstr(command.name)) << shell;
    EXPECT_THAT(said.out, HasSubstr("memory-limit"));
  }
  const Outcome other = gamut("completion tcsh");
  EXPECT_EQ(other.exitCode, 2);
  EXPECT_THAT(other.error, HasSubstr("'tcsh'; expected bash, zsh or fish"));
}

}  // namespace completion_test
}  // namespace gamut
