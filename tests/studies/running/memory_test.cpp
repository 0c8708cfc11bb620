// What a run is said to need is about what it takes, in a process of its own.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <string>
#include <utility>

#include "studies/machine.hpp"
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

/// Likewise, of two quantities, with all answers: distributions and sensitivities come from models of all outputs.
Study wideStudyOfTwo(int outputs, int times) {
  std::string text = sampleStudyWith("output_step = 0.1", "output_step = " + std::to_string(0.5 / (times - 1)));
  text.replace(text.find("samples = 16"), 12, "samples = 1024");
  text.insert(text.find("[[output]]"),
              "[[uncertain]]\nname = \"length\"\nquantity = \"rod.length\"\ninterval = \"± 1 %\"\n");
  for (int i = 2; i < outputs; ++i)
    text += "[[output]]\nname = \"o" + std::to_string(i) + "\"\nquantity = \"" + std::to_string(i) + "*hinge.angle\"\n";
  return readStudyText(text, "s.toml");
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

/// Samples of sensitivities alone took 0.6 GB of these when outputs of all of them were there at once.
TEST(Memory, IsToldOfStudiesWithSensitivities) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer takes memory of its own";
#endif
  const Study study = wideStudyOfTwo(40, 301);
  constexpr double program = 6e7;  // whatever it does
  const double needed = memoryNeeded(study, {}), taken = program + bytesTaken(study);
  EXPECT_LT(needed, 1.25 * taken);
  EXPECT_GT(needed, 0.75 * taken);
}

/// One joint behind the other.
std::string studyOfChain(int joints) {
  std::string chain;
  for (int i = 0; i < joints; ++i) {
    const std::string number = std::to_string(i), from = i == 0 ? "tip" : "E" + std::to_string(i - 1);
    chain += "[[mechanism.element]]\ntype = \"revolute\"\nname = \"h" + number + "\"\nfrom = \"" + from +
             "\"\nto = \"F" + number + "\"\naxis = \"x\"\n[[mechanism.element]]\ntype = \"link\"\nname = \"l" + number +
             "\"\nfrom = \"F" + number + "\"\nto = \"E" + number +
             "\"\nvector = [0, 0, -0.1]\n[[mechanism.element]]\ntype = \"mass\"\nname = \"m" + number + "\"\nat = \"E" +
             number + "\"\nmass = 1\n";
  }
  return sampleStudyWith("[[uncertain]]", chain + "[[uncertain]]");
}

/// It may be read for other purposes, as comparisons do, by a program that holds more than its runs may.
TEST(Memory, ThatAStudyStatesIsOfItsRunsAlone) {
  Study study = readStudyText(studyOfChain(100), "s.toml");
  const std::size_t nodes = recordedMotion(study).f.nodes().size();
  study.limits.memory = 1e6;
  EXPECT_EQ(recordedMotion(study).f.nodes().size(), nodes);
}

/// In a chain every joint moves all masses behind it.
TEST(Memory, IsToldToBeTooLittleForEquationsOfManyJoints) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer takes memory of its own";
#endif
  const std::string text = studyOfChain(400);  // some 170 MB
  const pid_t child = ::fork();                // what is freed here does not count there
  if (child == 0) {
    double pages[6] = {};  // the last: data
    std::ifstream file("/proc/self/statm");
    for (double& number : pages) file >> number;
    rlimit data{};
    ::getrlimit(RLIMIT_DATA, &data);
    data.rlim_cur = static_cast<rlim_t>(pages[5] * static_cast<double>(::sysconf(_SC_PAGESIZE)) + 8e7);
    ::setrlimit(RLIMIT_DATA, &data);
    const double before = peakMemory();
    const std::string message = messageOf(text);
    const bool isEarly = peakMemory() - before < 4e7;  // and not when all that there is has been taken
    const bool isTold = isEarly && message.find("s.toml:7:1: the equations of 802 states do not fit into the") == 0;
    rlimit after{};
    ::getrlimit(RLIMIT_DATA, &after);
    ::_exit(isTold && after.rlim_cur == data.rlim_cur ? 0 : 1);
  }
  int status = 1;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
}

/// 310 outputs at 2001 times were told to need 10 GB, and took 5.7; a chain of ten bodies with
/// two uncertain quantities takes 1.38 of 512 samples, with results and page, where it took more than 8.
TEST(Memory, ManyOutputsAtManyTimesAreToldToNeedLessThanAGigabyteAndAHalf) {
  EXPECT_LT(memoryNeeded(wideStudy(310, 2001), {}), 1.5e9);
  EXPECT_LT(memoryNeeded(wideStudyOfTwo(310, 2001), {}), 1.5e9);
}

}  // namespace
}  // namespace gamut
