// The file in which a run remembers what it has done: whatever happens to its end, what came before holds.
#include "studies/checkpoint_file.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>

#include "scalars/archive.hpp"
#include "tests/studies/temporary_folder.hpp"

namespace gamut::checkpoint_file_test {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

CheckpointPlan plan() {
  CheckpointPlan plan;
  plan.studyText = "a study";
  plan.seed = 7;
  plan.samples = 16;
  plan.timeLimit = 0.125;
  plan.report = "/page.html";
  return plan;
}

class CheckpointFileTest : public ::testing::Test {
 protected:
  std::unique_ptr<CheckpointFile> begun() {
    return std::make_unique<CheckpointFile>(path(), plan(),
                                            [this](const std::string& line) { notes_.push_back(line); });
  }
  std::unique_ptr<CheckpointFile> opened() {
    return CheckpointFile::open(path(), [this](const std::string& line) { notes_.push_back(line); });
  }
  std::string path() const { return folder_.path("s.h5.checkpoint"); }

  /// Records numbers in a task of its own.
  static void record(CheckpointFile& file, std::vector<int> numbers) {
    CheckpointedTask task(&file);
    task.record([&](Archive& all) { all(numbers); });
  }
  /// What the next task had recorded; empty if nothing.
  static std::vector<int> recalled(CheckpointFile& file) {
    std::vector<int> numbers;
    CheckpointedTask(&file).recall({}, [&](Archive& all) { all(numbers); });
    return numbers;
  }

  TemporaryFolder folder_;
  std::vector<std::string> notes_;
};

using Numbers = std::vector<int>;

TEST_F(CheckpointFileTest, IsThereOnceThereIsARecordAndHoldsThePlan) {
  {
    const auto file = begun();
    EXPECT_FALSE(std::filesystem::exists(path()));
    record(*file, {1, 2, 3});
    record(*file, {4});
  }
  const auto file = opened();
  EXPECT_EQ(file->plan().studyText, "a study");
  EXPECT_EQ(file->plan().seed, 7U);
  EXPECT_EQ(file->plan().samples, 16U);
  EXPECT_EQ(file->plan().timeLimit, 0.125);
  EXPECT_EQ(file->plan().report, "/page.html");
  EXPECT_EQ(recalled(*file), (Numbers{1, 2, 3}));
  EXPECT_EQ(recalled(*file), Numbers{4});
  EXPECT_EQ(recalled(*file), Numbers());
  file->remove();
  EXPECT_EQ(folder_.count(), 0U);
}

TEST_F(CheckpointFileTest, ANewerRecordTakesThePlaceOfItsOwnAndOfWhatItHolds) {
  {
    const auto file = begun();
    CheckpointedTask whole(file.get());
    record(*file, {1});
    Numbers state{5};
    whole.record([&](Archive& all) { all(state); });
    record(*file, {2});
  }
  const auto file = opened();
  Numbers state;
  CheckpointedTask whole(file.get());
  EXPECT_EQ(whole.recall({}, [&](Archive& all) { all(state); }), CheckpointedTask::Recalled::state);
  EXPECT_EQ(state, Numbers{5});
  EXPECT_EQ(recalled(*file), Numbers{2});
}

TEST_F(CheckpointFileTest, HoldsWhatCameBeforeWhateverItsEndIs) {
  std::vector<std::size_t> sizes;
  {
    const auto file = begun();
    for (int i = 0; i < 3; ++i) {
      record(*file, Numbers(400000, i));
      sizes.push_back(std::filesystem::file_size(path()));
    }
  }
  const std::string whole = folder_.read("s.h5.checkpoint");
  ASSERT_EQ(whole.size(), sizes.back());
  const auto firstNumber = [](const Numbers& numbers) { return numbers.empty() ? -1 : numbers.front(); };
  for (const std::size_t size : {sizes[1], sizes[1] + 1, sizes[1] + 60, sizes[1] + 1600000, sizes[2] - 1}) {
    for (const bool isFilled : {false, true}) {
      SCOPED_TRACE(std::to_string(size) + (isFilled ? ", filled up" : ""));
      std::string part = whole.substr(0, size);
      if (isFilled) part.resize(whole.size(), 'x');
      folder_.write("s.h5.checkpoint", part);
      const auto file = opened();
      EXPECT_EQ(firstNumber(recalled(*file)), 0);
      EXPECT_EQ(firstNumber(recalled(*file)), 1);
      EXPECT_EQ(firstNumber(recalled(*file)), -1);
      record(*file, {7});
    }
  }
  std::string damaged = whole;
  damaged[sizes[0] + 1000] ^= 1;
  folder_.write("s.h5.checkpoint", damaged);
  EXPECT_EQ(firstNumber(recalled(*opened())), 0);
  const auto file = opened();
  recalled(*file);
  EXPECT_EQ(firstNumber(recalled(*file)), -1);
}

TEST_F(CheckpointFileTest, GoesOnBehindWhatIsWhole) {
  {
    const auto file = begun();
    record(*file, {1});
  }
  folder_.write("s.h5.checkpoint", folder_.read("s.h5.checkpoint") + "half a record");
  {
    const auto file = opened();
    EXPECT_EQ(recalled(*file), Numbers{1});
    record(*file, {2});
  }
  const auto file = opened();
  EXPECT_EQ(recalled(*file), Numbers{1});
  EXPECT_EQ(recalled(*file), Numbers{2});
}

TEST_F(CheckpointFileTest, DoesNotGrowWithTheNumberOfRecords) {
  Numbers numbers(1000000);
  {
    const auto file = begun();
    CheckpointedTask first(file.get());
    Numbers kept{17};
    first.record([&](Archive& all) { all(kept); });
    CheckpointedTask task(file.get());
    for (int i = 0; i < 40; ++i) {
      numbers.front() = i;
      task.record([&](Archive& all) { all(numbers); });
      EXPECT_LE(std::filesystem::file_size(path()), 33000000U);
    }
  }
  EXPECT_EQ(folder_.count(), 1U);
  const auto file = opened();
  EXPECT_EQ(recalled(*file), Numbers{17});
  EXPECT_EQ(recalled(*file).front(), 39);
}

TEST_F(CheckpointFileTest, ADiskThatIsFullCostsARecordAndIsToldOnce) {
  const auto file = begun();
  record(*file, {1});
  const auto failing = [](Archive&) { throw std::runtime_error("No space left on device"); };
  CheckpointedTask second(file.get());
  second.record(failing);
  second.record(failing);
  ASSERT_EQ(notes_.size(), 1U);
  EXPECT_THAT(notes_.front(),
              HasSubstr("s.h5.checkpoint cannot be written (No space left on device); the run goes on"));
  EXPECT_EQ(recalled(*opened()), Numbers{1});
  Numbers numbers{2};
  second.record([&](Archive& all) { all(numbers); });
  second.record(failing);
  EXPECT_EQ(notes_.size(), 2U);
  const auto again = opened();
  EXPECT_EQ(recalled(*again), Numbers{1});
  EXPECT_EQ(recalled(*again), Numbers{2});
}

TEST_F(CheckpointFileTest, SaysWhatItCannotGoOnWith) {
  const auto refuses = [&](const std::string& what) {
    EXPECT_THAT([&] { opened(); }, ThrowsMessage<CheckpointError>(HasSubstr(what)));
  };
  refuses("s.h5.checkpoint: cannot be read (No such file or directory)");
  folder_.write("s.h5.checkpoint", "");
  refuses("is empty");
  folder_.write("s.h5.checkpoint", "something else");
  refuses("is no checkpoint; expected what gamut run --checkpoint leaves");
  record(*begun(), {1});
  const std::string whole = folder_.read("s.h5.checkpoint");
  const auto with = [&](const std::string& old, const std::string& replacement) {
    std::string text = whole;
    text.replace(text.find(old), old.size(), replacement);
    folder_.write("s.h5.checkpoint", text);
  };
  const std::size_t build = whole.find("build ") + 6, digits = 16, processor = build + digits + 1,
                    end = whole.find('\n', processor);
  with(whole.substr(build, digits), std::string(digits, '0'));
  refuses("numbers might differ in their last digits; expected the same program, or run the study again");
  with("format 1", "format 2");
  refuses("is of another format; expected Gamut checkpoint, format 1");
  const std::string other = whole.substr(processor, end - processor) == "AVX2" ? "baseline" : "AVX2";
  folder_.write("s.h5.checkpoint", whole.substr(0, processor) + other + whole.substr(end));
  refuses("was written on a processor with " + other + ", and this one has ");
  folder_.write("s.h5.checkpoint", whole.substr(0, end + 20));
  refuses("holds nothing that is whole");
}

/// Wherever its heading or its plan is cut off or changed, by one readable line.
TEST_F(CheckpointFileTest, IsRefusedWhereItsBeginningIsDamaged) {
  record(*begun(), {1});
  const std::string whole = folder_.read("s.h5.checkpoint");
  const auto complaint = [&](const std::string& bytes) -> std::string {
    folder_.write("s.h5.checkpoint", bytes);
    try {
      opened();
    } catch (const CheckpointError& error) {
      return error.what();
    }
    return "";
  };
  std::size_t end = 0;  // of heading and plan
  for (std::string said; end < whole.size() && !(said = complaint(whole.substr(0, end))).empty(); ++end) {
    EXPECT_THAT(said, HasSubstr("s.h5.checkpoint: ")) << end;
    std::string bytes = whole;
    bytes[end] = static_cast<char>(bytes[end] ^ "\x01\x20\x80"[end % 3]);
    said = complaint(bytes);
    EXPECT_THAT(said, HasSubstr("s.h5.checkpoint: ")) << end;
    EXPECT_TRUE(std::ranges::all_of(said, [](unsigned char c) { return c >= ' ' && c < 0x7f; })) << end;
  }
  EXPECT_GT(end, 150);
  EXPECT_LT(end, whole.size());
  folder_.write("s.h5.checkpoint", whole);
  EXPECT_EQ(recalled(*opened()), Numbers{1});
}

}  // namespace
}  // namespace gamut::checkpoint_file_test
