// Independent pieces of work that ranks share out, each on a few threads (workers.hpp).
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "analyses/communicator.hpp"
#include "analyses/workers.hpp"
#include "scalars/archive.hpp"

namespace gamut {

/// As forEachIndex, but each index on one rank alone: `result(all, i)` writes what it gave there, and reads it on the
/// others. What others left, because they were told to stop, the first does itself.
template <class MakeWorker, class Result>
void forEachShared(Communicator* communicator, int jobs, std::size_t count, const std::atomic<bool>* cancelled,
                   const MakeWorker& makeWorker, const Result& result) {
  std::vector<char> isDone(count, 0);
  std::vector<std::size_t> these;
  SharedWork shared(communicator);
  const auto doThese = [&](bool all) {
    these.clear();
    for (std::size_t i = 0; i < count; ++i)
      if (isDone[i] == 0 && (all || shared.isMine(i))) these.push_back(i);
    const std::uint64_t before = Work::counted();
    forEachIndex(jobs, these.size(), cancelled, [&] {
      return [&, worker = makeWorker()](std::size_t k) mutable {
        worker(these[k]);
        isDone[these[k]] = cancelled != nullptr && *cancelled ? 0 : 1;
      };
    });
    return Work::counted() - before;
  };
  std::uint64_t work = doThese(false);
  shared.exchange(
      0,
      [&](Archive& all) {
        std::vector<std::size_t> done;
        for (const std::size_t i : these)
          if (isDone[i] != 0) done.push_back(i);
        all(work, done);
        for (const std::size_t i : done) result(all, i);
      },
      [&](int, Archive& all) {
        std::vector<std::size_t> done;
        all(work, done);
        for (const std::size_t i : done) {
          result(all, i);
          isDone[i] = 1;
        }
        Work::add(work);
      });
  const bool isAlone = shared.isOver();
  shared.end();
  if (isAlone) doThese(true);
}

}  // namespace gamut
