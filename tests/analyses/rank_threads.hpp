// Ranks that are threads of one process.
#pragma once

#include <barrier>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "analyses/communicator.hpp"

namespace gamut::testing {

/// Where they meet.
struct MeetingPoint {
  explicit MeetingPoint(int ranks) : said(ranks), saidToEach(ranks), barrier(ranks) {}
  std::vector<std::string> said;
  std::vector<std::vector<std::string>> saidToEach;
  std::barrier<> barrier;
};

class RankThread final : public Communicator {
 public:
  RankThread(int rank, MeetingPoint& point) : Communicator(rank, static_cast<int>(point.said.size())), point_(point) {}

  std::size_t bytes = 0;  // that it has told

 protected:
  std::vector<std::string_view> gather(std::string& own) override {
    bytes += own.size();
    point_.said[rank()] = own;
    point_.barrier.arrive_and_wait();
    heard_ = point_.said;
    point_.barrier.arrive_and_wait();
    return {heard_.begin(), heard_.end()};
  }

  std::vector<std::string_view> scatter(std::vector<std::string>& own) override {
    for (const std::string& part : own) bytes += part.size();
    point_.saidToEach[rank()] = own;
    point_.barrier.arrive_and_wait();
    heard_.clear();
    for (const std::vector<std::string>& said : point_.saidToEach) heard_.push_back(said[rank()]);
    point_.barrier.arrive_and_wait();
    return {heard_.begin(), heard_.end()};
  }

 private:
  MeetingPoint& point_;
  std::vector<std::string> heard_;
};

/// Does the same on so many ranks at once: `task(communicator)`. One that parts waits until all have ended.
template <class Task>
void onRanks(int ranks, const Task& task) {
  MeetingPoint point(ranks);
  std::vector<std::jthread> threads;
  for (int rank = 0; rank < ranks; ++rank)
    threads.emplace_back([&, rank] {
      RankThread communicator(rank, point);
      try {
        task(communicator);
      } catch (const Communicator::Parted&) {
      }
      communicator.end();
    });
}

}  // namespace gamut::testing
