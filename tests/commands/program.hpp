// The program run from outside, in a folder of its own.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <filesystem>
#include <string>

#include "tests/studies/temporary_folder.hpp"

namespace gamut {

struct Outcome {
  int exitCode = -1;
  std::string out, error;
};

class FromOutside : public ::testing::Test {
 protected:
  /// Runs the program in the temporary folder, after `before` in the same shell.
  Outcome gamut(const std::string& arguments, const std::string& before = "") const {
    const std::string command =
        "cd '" + folder_.path("") + "' && " + before + "'" GAMUT_PROGRAM "' " + arguments + " > .out 2> .error";
    const int status = std::system(command.c_str());
    const Outcome run{WIFEXITED(status) ? WEXITSTATUS(status) : -1, folder_.read(".out"), folder_.read(".error")};
    std::filesystem::remove(folder_.path(".out"));
    std::filesystem::remove(folder_.path(".error"));
    return run;
  }

  TemporaryFolder folder_;
};

}  // namespace gamut
