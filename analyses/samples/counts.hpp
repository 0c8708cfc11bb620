// Many small counts, in two bytes each where none can become more than that holds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace gamut {

class Archive;

class Counts {
 public:
  Counts() = default;
  /// So many, all zero, of which none becomes more than `most`.
  Counts(std::size_t size, std::size_t most) { areFew(most) ? few_.resize(size) : many_.resize(size); }

  void increment(std::size_t i) { few_.empty() ? static_cast<void>(++many_[i]) : static_cast<void>(++few_[i]); }
  std::uint32_t operator[](std::size_t i) const { return few_.empty() ? many_[i] : few_[i]; }
  /// Puts `count` of another's, from `first` on, behind its own; both are of one `most`.
  void append(const Counts& other, std::size_t first, std::size_t count) {
    const auto take = [&](const auto& from, auto& to) {
      if (from.empty()) return;
      const auto begin = from.begin() + static_cast<std::ptrdiff_t>(first);
      to.insert(to.end(), begin, begin + static_cast<std::ptrdiff_t>(count));
    };
    take(other.few_, few_);
    take(other.many_, many_);
  }

  void archive(Archive& all);
  /// So many of them, from `first` on.
  void archive(Archive& all, std::size_t first, std::size_t count);

  /// Bytes that each takes.
  static std::size_t bytesOf(std::size_t most) { return areFew(most) ? sizeof(std::uint16_t) : sizeof(std::uint32_t); }

 private:
  static bool areFew(std::size_t most) { return most <= std::numeric_limits<std::uint16_t>::max(); }

  std::vector<std::uint16_t> few_;
  std::vector<std::uint32_t> many_;  // one of the two is empty
};

}  // namespace gamut
