// A record: its head, its content in chunks, each behind its length, a length of zero, the digest of all that. The
// first record is the plan.
#include "studies/checkpoint_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <regex>
#include <system_error>
#include <utility>
#include <vector>

#include "scalars/archive.hpp"
#include "scalars/elementary/vector_unit.hpp"
#include "studies/version.hpp"
#include "studies/watch.hpp"

namespace gamut {
namespace {

constexpr std::string_view title = "Gamut checkpoint, format 1\n";
constexpr std::uint64_t planNumber = std::numeric_limits<std::uint64_t>::max(), magic = 0x7463655274756d61;
constexpr std::size_t chunkSize = std::size_t{1} << 20;

struct RecordHead {
  std::uint64_t begin, number, hasEnded, next, work;
  double cpu;
};

/// Eight bytes at a time, each mixed into all bits of what there was.
std::uint64_t digestOf(std::uint64_t digest, const char* bytes, std::size_t size) {
  const auto take = [&](std::uint64_t word) {
    digest = (digest ^ word) * 0x9e3779b97f4a7c15;
    digest ^= digest >> 32;
  };
  for (; size >= sizeof(std::uint64_t); bytes += sizeof(std::uint64_t), size -= sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes, sizeof word);
    take(word);
  }
  for (; size > 0; ++bytes, --size) take(static_cast<unsigned char>(*bytes));
  return digest;
}

[[noreturn]] void failNow() { throw std::system_error(errno, std::generic_category()); }

void writeAt(int file, std::uint64_t place, const void* bytes, std::size_t size) {
  const char* from = static_cast<const char*>(bytes);
  while (size > 0) {
    const ssize_t written = ::pwrite(file, from, size, static_cast<off_t>(place));
    if (written < 0 && errno != EINTR) failNow();
    if (written <= 0) continue;
    from += written, place += static_cast<std::uint64_t>(written), size -= static_cast<std::size_t>(written);
  }
}

/// False where there are not so many.
bool readAt(int file, std::uint64_t place, void* bytes, std::size_t size) {
  char* to = static_cast<char*>(bytes);
  while (size > 0) {
    const ssize_t read = ::pread(file, to, size, static_cast<off_t>(place));
    if (read < 0 && errno != EINTR) failNow();
    if (read == 0) return false;
    if (read < 0) continue;
    to += read, place += static_cast<std::uint64_t>(read), size -= static_cast<std::size_t>(read);
  }
  return true;
}

/// From a place on.
class RecordWriter {
 public:
  RecordWriter(int file, std::uint64_t place, const RecordHead& head) : file_(file), place_(place) {
    chunk_.reserve(chunkSize);
    put(&head, sizeof head);
  }

  void take(const void* bytes, std::size_t size) {
    const char* from = static_cast<const char*>(bytes);
    while (size > 0) {
      const std::size_t some = std::min(size, chunkSize - chunk_.size());
      chunk_.insert(chunk_.end(), from, from + some);
      from += some, size -= some;
      if (chunk_.size() == chunkSize) flush();
    }
  }

  /// Where the record ends.
  std::uint64_t end() {
    if (!chunk_.empty()) flush();
    const std::uint64_t none = 0;
    put(&none, sizeof none);
    const std::uint64_t digest = digest_;
    put(&digest, sizeof digest);
    return place_;
  }

 private:
  void put(const void* bytes, std::size_t size) {
    writeAt(file_, place_, bytes, size);
    digest_ = digestOf(digest_, static_cast<const char*>(bytes), size);
    place_ += size;
  }
  void flush() {
    const std::uint64_t size = chunk_.size();
    put(&size, sizeof size);
    put(chunk_.data(), chunk_.size());
    chunk_.clear();
  }

  int file_;
  std::uint64_t place_, digest_ = 0;
  std::vector<char> chunk_;
};

class RecordReader {
 public:
  RecordReader(int file, std::uint64_t place) : file_(file), place_(place) {}

  /// Each false where that is not there, or not as it was written.
  bool begin(RecordHead& head) { return get(&head, sizeof head) && head.begin == magic; }
  bool nextChunk() {
    std::uint64_t size = 0;
    at_ = 0;
    chunk_.clear();
    if (!get(&size, sizeof size) || size > chunkSize) return false;
    chunk_.resize(size);
    return size == 0 || get(chunk_.data(), size);
  }
  bool isOver() const { return chunk_.empty(); }
  bool end() {
    const std::uint64_t expected = digest_;
    std::uint64_t digest = 0;
    return get(&digest, sizeof digest) && digest == expected;
  }
  std::uint64_t place() const { return place_; }

  void give(void* bytes, std::size_t size) {
    char* to = static_cast<char*>(bytes);
    while (size > 0) {
      if (at_ == chunk_.size() && (!nextChunk() || isOver()))
        throw std::runtime_error("a checkpoint's record is short");
      const std::size_t some = std::min(size, chunk_.size() - at_);
      std::memcpy(to, chunk_.data() + at_, some);
      at_ += some, to += some, size -= some;
    }
  }

 private:
  bool get(void* bytes, std::size_t size) {
    if (!readAt(file_, place_, bytes, size)) return false;
    digest_ = digestOf(digest_, static_cast<const char*>(bytes), size);
    place_ += size;
    return true;
  }

  int file_;
  std::uint64_t place_, digest_ = 0;
  std::vector<char> chunk_;
  std::size_t at_ = 0;
};

std::filesystem::path placeOf(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  return folder.empty() ? "." : folder;
}

/// In the folder of `path`; -1 where there are none such.
int fileWithoutName(const std::string& path) {
  return ::open(placeOf(path).c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0666);
}

/// Beside `path`, until it is renamed: called as what other writers leave and clear up.
std::string partOf(const std::string& path) {
  return (placeOf(path) / ("." + std::filesystem::path(path).filename().string() + ".gamut-part")).string();
}

/// Of the program that runs: other instructions may round otherwise.
std::string digestOfProgram() {
  std::ifstream program("/proc/self/exe", std::ios::binary);
  std::vector<char> bytes(chunkSize);
  std::uint64_t digest = 0;
  while (program.read(bytes.data(), static_cast<std::streamsize>(bytes.size())) || program.gcount() > 0)
    digest = digestOf(digest, bytes.data(), static_cast<std::size_t>(program.gcount()));
  return fmt::format("{:016x}", digest);
}

/// Whether lines are such as some build on some processor writes.
bool areSound(const std::string& build, const std::string& where) {
  static const std::regex ofBuilds("gamut [0-9]+[.][0-9]+[.][0-9]+, build [0-9a-f]{16}");
  static const std::regex ofProcessors("(baseline|AVX2|AVX-512)( with fused products)?");
  return std::regex_match(build, ofBuilds) && std::regex_match(where, ofProcessors);
}

std::string heading() { return fmt::format("{}{}\n{}\n", title, builtBy(), processor()); }

void checkHeading(const std::string& path, int file) {
  constexpr std::size_t most = 512;
  std::string begin(most, '\0');
  const ssize_t size = ::pread(file, begin.data(), begin.size(), 0);
  begin.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  if (!begin.starts_with(title.substr(0, title.find(',')))) {
    const bool isEmpty = begin.empty();
    throw CheckpointError(fmt::format("{}: {}; expected what gamut run --checkpoint leaves when it is killed", path,
                                      isEmpty ? "is empty" : "is no checkpoint"));
  }
  const auto line = [&](std::size_t number) {
    std::size_t from = 0;
    for (; number > 0 && from != begin.npos; --number) from = begin.find('\n', from) + 1;
    return begin.substr(from, begin.find('\n', from) - from);
  };
  if (begin.starts_with(title) && !areSound(line(1), line(2)))
    throw CheckpointError(
        fmt::format("{}: damaged; expected the file as gamut run wrote it, or run the study again", path));
  if (!begin.starts_with(title))
    throw CheckpointError(
        fmt::format("{}: is of another format; expected {}", path, title.substr(0, title.size() - 1)));
  if (line(1) != builtBy())
    throw CheckpointError(
        fmt::format("{}: was written by {}, and this is {}: numbers might differ in their last "
                    "digits; expected the same program, or run the study again",
                    path, line(1), builtBy()));
  if (line(2) != processor())
    throw CheckpointError(
        fmt::format("{}: was written on a processor with {}, and this one has {}: numbers might "
                    "differ in their last digits; expected such a processor, or run the study again",
                    path, line(2), processor()));
}

}  // namespace

std::string builtBy() { return fmt::format("gamut {}, build {}", version(), digestOfProgram()); }

std::string processor() {
  std::string name = nameOf(usableUnits().back());
#if defined(__x86_64__)
  if (__builtin_cpu_supports("fma")) name += " with fused products";
#endif
  return name;
}

void CheckpointPlan::archive(Archive& all) {
  all(studyText, robotText, tablesText, studyFile, seed, samples, timeLimit, memoryLimit, report, isReplaced,
      isPageReplaced, interval, extended, extendedDigest);
}

std::string checkpointOf(const std::string& results) { return results + ".checkpoint"; }

CheckpointFile::CheckpointFile(std::string path, CheckpointPlan plan, std::function<void(const std::string&)> tell)
    : Checkpoints(plan.interval), path_(std::move(path)), plan_(std::move(plan)), tell_(std::move(tell)) {}

CheckpointFile::~CheckpointFile() {
  if (file_ >= 0) ::close(file_);
}

std::unique_ptr<CheckpointFile> CheckpointFile::open(const std::string& path,
                                                     std::function<void(const std::string&)> tell) {
  const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0)
    throw CheckpointError(
        fmt::format("{}: cannot be read ({}); expected what gamut run --checkpoint leaves when it is "
                    "killed",
                    path, std::strerror(errno)));
  CheckpointPlan plan;
  try {
    checkHeading(path, file);
    RecordReader reader(file, heading().size());
    RecordHead head{};
    bool isWhole = reader.begin(head) && head.number == planNumber;
    while (isWhole && (isWhole = reader.nextChunk()) && !reader.isOver()) {
    }
    if (!isWhole || !reader.end())
      throw CheckpointError(
          fmt::format("{}: holds nothing that is whole: the run was killed at once, or the file is damaged; expected "
                      "the file as gamut run wrote it, or run the study again",
                      path));
    RecordReader again(file, heading().size());
    again.begin(head);
    Archive all = Archive::reading([&](void* bytes, std::size_t size) { again.give(bytes, size); });
    all(plan);
  } catch (...) {
    ::close(file);
    throw;
  }
  auto found = std::make_unique<CheckpointFile>(path, std::move(plan), std::move(tell));
  found->file_ = file;
  found->isNamed_ = true;
  found->scan();
  return found;
}

/// All records that are whole; a newer one is in place of older ones, as it was when it was written.
void CheckpointFile::scan() {
  end_ = heading().size();
  for (;;) {
    RecordReader reader(file_, end_);
    RecordHead head{};
    bool isWhole = reader.begin(head);
    while (isWhole && (isWhole = reader.nextChunk()) && !reader.isOver()) {
    }
    if (!isWhole || !reader.end()) return;
    const Place place{end_, reader.place(), {head.hasEnded != 0, head.next, head.work, head.cpu}};
    end_ = place.end;
    if (head.number != planNumber) put(head.number, place);
  }
}

/// The record counts from now on, and those that it holds do no longer.
void CheckpointFile::put(std::uint64_t number, const Place& place) {
  places_.erase(places_.lower_bound(number), places_.lower_bound(std::max(place.note.next, number + 1)));
  places_[number] = place;
}

/// Where the file system knows no files without names, it has one at once.
void CheckpointFile::create() {
  file_ = fileWithoutName(path_);
  isNamed_ = file_ < 0;
  if (isNamed_) file_ = ::open(path_.c_str(), O_CREAT | O_TRUNC | O_RDWR | O_CLOEXEC, 0666);
  if (file_ < 0) failNow();
  try {
    begin();
  } catch (...) {
    ::close(std::exchange(file_, -1));
    throw;
  }
}

/// Heading and plan of a new file.
void CheckpointFile::begin() {
  const std::string text = heading();
  writeAt(file_, 0, text.data(), text.size());
  end_ = text.size();
  end_ = append(planNumber, {}, [this](Archive& all) { all(plan_); }).end;
}

void CheckpointFile::giveName() {
  const std::chrono::duration<double> age = std::chrono::steady_clock::now() - made_;
  if (isNamed_ || age.count() < interval()) return;
  ::unlink(path_.c_str());  // of a run that is to be forgotten
  const std::string open = fmt::format("/proc/self/fd/{}", file_);
  if (::linkat(AT_FDCWD, open.c_str(), AT_FDCWD, path_.c_str(), AT_SYMLINK_FOLLOW) != 0) failNow();
  isNamed_ = true;
}

/// Behind all others, as if it were not there yet.
CheckpointFile::Place CheckpointFile::append(std::uint64_t number, const Note& note, const Content& content) {
  RecordWriter writer(file_, end_, {magic, number, note.hasEnded ? 1U : 0U, note.next, note.work, note.cpu});
  Archive all = Archive::writing([&](const void* bytes, std::size_t size) { writer.take(bytes, size); });
  content(all);
  return {end_, writer.end(), note};
}

void CheckpointFile::write(std::uint64_t number, const Note& note, const Content& content) {
  try {
    if (file_ < 0) create();
    const Place place = append(number, note, content);
    if (::fdatasync(file_) != 0 && errno != EINVAL) failNow();
    end_ = place.end;
    put(number, place);
    giveName();
    tidy();
    hasTold_ = false;
  } catch (const std::exception& error) {
    if (file_ >= 0 && ::ftruncate(file_, static_cast<off_t>(end_)) != 0) {
    }  // what is behind the last record is none, and is written over
    if (!std::exchange(hasTold_, true) && tell_)
      tell_(fmt::format("{} cannot be written ({}); the run goes on, and would begin again {} if it were killed", path_,
                        error.what(), places_.empty() ? "at its beginning" : "where it was written last"));
  }
}

/// Once most of the file is records that do not count any more.
void CheckpointFile::tidy() {
  constexpr std::uint64_t little = std::uint64_t{1} << 24;
  std::uint64_t live = 0;
  for (const auto& [number, place] : places_) live += place.end - place.begin;
  if (end_ <= 2 * live + little) return;
  const std::string part = isNamed_ ? partOf(path_) : "";
  const int fresh = isNamed_ ? ::open(part.c_str(), O_CREAT | O_TRUNC | O_RDWR | O_NOFOLLOW | O_CLOEXEC, 0666)
                             : fileWithoutName(path_);
  if (fresh < 0) return;              // it may be possible later
  ::flock(fresh, LOCK_EX | LOCK_NB);  // whoever clears up here sees that it has a writer
  const int before = std::exchange(file_, fresh);
  const std::uint64_t endBefore = end_;
  std::map<std::uint64_t, Place> places = places_;
  try {
    begin();
    std::vector<char> bytes(chunkSize);
    for (auto& [number, place] : places) {
      const std::uint64_t begin = end_;
      for (std::uint64_t at = place.begin; at < place.end;) {
        const std::size_t some = std::min<std::uint64_t>(bytes.size(), place.end - at);
        if (!readAt(before, at, bytes.data(), some)) throw std::runtime_error("it became shorter");
        writeAt(file_, end_, bytes.data(), some);
        at += some, end_ += some;
      }
      place.begin = begin, place.end = end_;
    }
    if (::fdatasync(file_) != 0 && errno != EINVAL) failNow();
    if (isNamed_ && ::rename(part.c_str(), path_.c_str()) != 0) failNow();
  } catch (const std::exception&) {
    if (isNamed_) ::unlink(part.c_str());
    ::close(std::exchange(file_, before));
    end_ = endBefore;
    return;
  }
  ::close(before);
  places_ = std::move(places);
}

void CheckpointFile::remove() {
  if (file_ >= 0) ::close(std::exchange(file_, -1));
  places_.clear();
  if (isNamed_ || plan_.isReplaced) ::unlink(path_.c_str());
}

std::optional<Checkpoints::Note> CheckpointFile::find(std::uint64_t number) const {
  const auto found = places_.find(number);
  if (found == places_.end()) return std::nullopt;
  return found->second.note;
}

void CheckpointFile::read(std::uint64_t number, const Content& content) {
  RecordReader reader(file_, places_.at(number).begin);
  RecordHead head{};
  if (!reader.begin(head)) throw std::runtime_error("a checkpoint's record is gone");
  Archive all = Archive::reading([&](void* bytes, std::size_t size) { reader.give(bytes, size); });
  content(all);
}

double CheckpointFile::cpuSeconds() const { return processCpuSeconds(); }
void CheckpointFile::addCpuSeconds(double seconds) { gamut::addCpuSeconds(seconds); }

}  // namespace gamut
