// What a run is said to need is about what it takes, in a process of its own.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <string>
#include <utility>

#include "studies/running/run.hpp"
#include "studies/watch.hpp"
#include "tests/studies/sample_study.hpp"

namespace gamut {
namespace {

/// The pendulum with so many outputs at so many times.
Study wideStudy(int outputs, int times) {
  std::string text = sampleStudyWith("output_step = 0.1", "output_step = " + std::to_string(0.5 / (times - 1)));
  text.replace(text.find("samples = 16"), 12, "samples = 1024");
  for (int i = 2; i < outputs; ++i)
    text += "[[output]]\nname = \"o" + std::to_string(i) + "\"\nquantity = \"" + std::to_string(i) + "*hinge.angle\"\n";
  return readStudyText(text + "[distribution]\ntimes = 0\n", "s.toml");
}

/// Bytes that a run takes beyond what the process has already.
double bytesTaken(const Study& study) {
  int ends[2];
  if (::pipe(ends) != 0) return 0;
  const pid_t child = ::fork();
  if (child == 0) {
    double taken = -peakMemory();
    run(study);
    taken += peakMemory();
    ::_exit(::write(ends[1], &taken, sizeof taken) == sizeof taken ? 0 : 1);
  }
  double taken = 0;
  const bool isTold = ::read(ends[0], &taken, sizeof taken) == sizeof taken;
  int status = 0;
  ::waitpid(child, &status, 0);
  ::close(ends[0]);
  ::close(ends[1]);
  return isTold && status == 0 ? taken : 0;
}

TEST(Memory, IsToldBeforehandToAQuarter) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer takes memory of its own";
#endif
  for (const auto& [outputs, times] : {std::pair(16, 1001), {100, 401}}) {
    const Study study = wideStudy(outputs, times);
    constexpr double program = 6e7;  // whatever it does
    const double needed = memoryNeeded(study, {}), taken = program + bytesTaken(study);
    EXPECT_LT(needed, 1.25 * taken) << outputs << " x " << times;
    EXPECT_GT(needed, 0.75 * taken) << outputs << " x " << times;
  }
}

/// 310 outputs at 2001 times were told to need 10 GB, and took 5.7; they take 1.65 with results and page.
TEST(Memory, ManyOutputsAtManyTimesAreToldToNeedLessThanAGigabyteAndAHalf) {
  EXPECT_LT(memoryNeeded(wideStudy(310, 2001), {}), 1.5e9);
}

}  // namespace
}  // namespace gamut
