// A memory that ends the run which it belongs to after so many records, and goes on in the next one.
#pragma once

#include <algorithm>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "analyses/checkpoints.hpp"
#include "scalars/archive.hpp"

namespace gamut::testing {

/// Thrown out of the run that is killed.
struct Killed {};

/// The bytes that an archive gets from `content`.
inline std::string bytesOf(const Checkpoints::Content& content) {
  std::string bytes;
  Archive all =
      Archive::writing([&](const void* from, std::size_t size) { bytes.append(static_cast<const char*>(from), size); });
  content(all);
  return bytes;
}

/// Throws std::runtime_error unless it reads all of them.
inline void readBytes(const std::string& bytes, const Checkpoints::Content& content) {
  std::size_t at = 0;
  Archive all = Archive::reading([&](void* to, std::size_t size) {
    if (size > bytes.size() - at) throw std::runtime_error("more is read than was written");
    std::memcpy(to, bytes.data() + at, size);
    at += size;
  });
  content(all);
  if (at != bytes.size()) throw std::runtime_error("less is read than was written");
}

class Memory final : public Checkpoints {
 public:
  using Records = std::map<std::uint64_t, std::pair<Note, std::string>>;

  /// What is due is so always.
  explicit Memory(Records before = {}, int recordsUntilKilled = -1)
      : Checkpoints(0), records(std::move(before)), left_(recordsUntilKilled) {}

  Records records;
  int count = 0;            // of records since it was made
  double addedSeconds = 0;  // of CPU

 protected:
  std::optional<Note> find(std::uint64_t number) const override {
    const auto found = records.find(number);
    return found == records.end() ? std::nullopt : std::optional(found->second.first);
  }
  void read(std::uint64_t number, const Content& content) override { readBytes(records.at(number).second, content); }
  void write(std::uint64_t number, const Note& note, const Content& content) override {
    std::string bytes = bytesOf(content);
    records.erase(records.lower_bound(number), records.lower_bound(std::max(note.next, number + 1)));
    records[number] = {note, std::move(bytes)};
    ++count;
    if (left_ > 0 && --left_ == 0) throw Killed();
  }
  double cpuSeconds() const override { return addedSeconds; }
  void addCpuSeconds(double seconds) override { addedSeconds += seconds; }

 private:
  int left_;
};

}  // namespace gamut::testing
