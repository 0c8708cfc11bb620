// Tests of pages in a browser: one for all tests of a suite, since to start it takes longer than what is asked of it.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <string>

#include "tests/reports/chromium.hpp"

namespace gamut {

class InChromium : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (Chromium::isInstalled()) chromium = std::make_unique<Chromium>();
  }
  static void TearDownTestSuite() { chromium.reset(); }

  void SetUp() override {
    if (chromium) return;
    const char* ci = std::getenv("CI");
    ASSERT_FALSE(ci != nullptr && std::string(ci) == "true") << "chromium is not installed";
    GTEST_SKIP() << "chromium is not installed";
  }

  static inline std::unique_ptr<Chromium> chromium;
};

}  // namespace gamut
