// What is read from an archive is what was written into it, bit for bit.
#include "scalars/archive.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

namespace gamut::archive_test {

class Even {
 public:
  explicit Even(int half) : half_(half) {}
  int value() const { return 2 * half_; }
  void archive(Archive& all) { all(half_); }

 private:
  int half_;
};

std::shared_ptr<Even> archived(Archive& all, const Even*) {
  int half = 0;
  all(half);
  return std::make_shared<Even>(half);
}

struct Node {
  std::string name;
  std::shared_ptr<const Node> next;
  std::shared_ptr<const Even> number;
  bool isLast = false;
};
void archive(Archive& all, Node& node) { all(node.name, node.next, node.number, node.isLast); }

template <class... T>
std::string written(T&... values) {
  std::string bytes;
  Archive all =
      Archive::writing([&](const void* from, std::size_t size) { bytes.append(static_cast<const char*>(from), size); });
  all(values...);
  return bytes;
}

template <class... T>
void read(const std::string& bytes, T&... values) {
  std::size_t at = 0;
  Archive all = Archive::reading([&](void* to, std::size_t size) {
    ASSERT_LE(at + size, bytes.size());
    std::memcpy(to, bytes.data() + at, size);
    at += size;
  });
  all(values...);
  EXPECT_EQ(at, bytes.size());
}

/// Reads a copy that holds something else before, and writes it: the bytes are the same.
template <class T>
T copyOf(T value, T before = T()) {
  const std::string bytes = written(value);
  read(bytes, before);
  EXPECT_EQ(written(before), bytes);
  return before;
}

TEST(Archive, KeepsEveryBitOfNumbers) {
  const double least = std::numeric_limits<double>::denorm_min(), none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(copyOf(least), least);
  EXPECT_TRUE(std::signbit(copyOf(-0.0, 1.0)));
  EXPECT_TRUE(std::isnan(copyOf(none)));
  EXPECT_EQ(copyOf(std::vector<double>{1.5, -least, 3e300}, {7.0}), (std::vector<double>{1.5, -least, 3e300}));
  EXPECT_EQ(copyOf(std::uint64_t{1} << 63), std::uint64_t{1} << 63);
  EXPECT_TRUE(copyOf(true));
}

TEST(Archive, KeepsIntervalsEmptyAndUnboundedOnesToo) {
  for (const Interval& x : {Interval(-0.0, 1), Interval::empty(), Interval::entire(), Interval(3)}) {
    EXPECT_TRUE(isEqual(copyOf(x, Interval(5)), x)) << x;
    const std::vector<Interval> copies = copyOf(std::vector<Interval>{x, Interval(1, 2)});
    ASSERT_EQ(copies.size(), 2U);
    EXPECT_TRUE(isEqual(copies[0], x));
    EXPECT_TRUE(isEqual(copies[1], Interval(1, 2)));
  }
}

TEST(Archive, KeepsContainersOfContainers) {
  using Lists = std::map<std::string, std::vector<std::optional<std::string>>>;
  const Lists lists{{"", {}}, {"two", {std::nullopt, std::string("a\0b", 3)}}};
  EXPECT_EQ(copyOf(lists, Lists{{"other", {"x"}}}), lists);
  const std::vector<std::pair<int, std::array<std::string, 2>>> pairs{{1, {"a", ""}}, {-2, {"", "b"}}};
  EXPECT_EQ(copyOf(pairs), pairs);
}

TEST(Archive, WhatIsSharedStaysSharedAndWhatIsNotDoesNot) {
  const auto even = std::make_shared<const Even>(21);
  const auto last = std::make_shared<const Node>(Node{"last", nullptr, even, true});
  const auto first = std::make_shared<const Node>(Node{"first", last, even});
  std::vector<std::shared_ptr<const Node>> all{first, last, nullptr, first};
  std::vector<std::shared_ptr<const Node>> copies(1, last);
  read(written(all), copies);
  ASSERT_EQ(copies.size(), 4U);
  EXPECT_EQ(copies[0], copies[3]);
  EXPECT_EQ(copies[0]->next, copies[1]);
  EXPECT_EQ(copies[2], nullptr);
  EXPECT_EQ(copies[0]->number, copies[1]->number);
  EXPECT_NE(copies[1], last);
  EXPECT_EQ(copies[1]->number->value(), 42);
  EXPECT_TRUE(copies[1]->isLast);
  EXPECT_EQ(copies[0]->name, "first");
}

TEST(Archive, WhatBothHaveAlreadyIsNotWritten) {
  const auto even = std::make_shared<const Even>(21), other = std::make_shared<const Even>(21);
  std::shared_ptr<const Even> one = even, two = other;
  std::string bytes;
  Archive writer =
      Archive::writing([&](const void* from, std::size_t size) { bytes.append(static_cast<const char*>(from), size); });
  for (int i = 0; i < 2; ++i) writer.share(even);
  writer(one, two);
  std::size_t at = 0;
  Archive reader = Archive::reading([&](void* to, std::size_t size) {
    std::memcpy(to, bytes.data() + at, size);
    at += size;
  });
  for (int i = 0; i < 2; ++i) reader.share(even);
  reader(one, two);
  EXPECT_EQ(one, even);
  EXPECT_NE(two, even);
  EXPECT_EQ(two->value(), 42);
}

TEST(Archive, RefusesASharedObjectThatNothingCameBefore) {
  std::uint64_t third = 3;
  std::shared_ptr<const Node> node;
  const std::string bytes = written(third);
  EXPECT_THROW(read(bytes, node), std::runtime_error);
}

}  // namespace gamut::archive_test
