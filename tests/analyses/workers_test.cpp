// What threads count together is what one counts alone.
#include "analyses/workers.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace gamut {
namespace {

TEST(Workers, CountWhatIsDoneAndNotWhatTheyMakeForThemselves) {
  for (const int jobs : {1, 2, 5}) {
    const std::uint64_t began = Work::counted();
    forEachIndex(jobs, 20, nullptr, [] {
      Work::count(Work::cellTerm, 1e6);
      return [](std::size_t i) { Work::count(Work::bin, static_cast<double>(i)); };
    });
    EXPECT_EQ(Work::counted() - began, 10U * 190U) << jobs;
  }
}

TEST(Workers, ThrowTheFirstExceptionAgain) {
  const auto fails = [] {
    return [](std::size_t i) {
      if (i == 3) throw std::runtime_error("three");
    };
  };
  EXPECT_THROW(forEachIndex(2, 20, nullptr, fails), std::runtime_error);
}

}  // namespace
}  // namespace gamut
