// Who waits sleeps: a rank that has done its share leaves the processor to others, and counts no time.
#include "commands/mpi_communicator.hpp"

#define OMPI_SKIP_MPICXX 1
#define MPICH_SKIP_MPICXX 1
#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace gamut {
namespace {

void await(MPI_Request& request) {
  using std::chrono::microseconds;
  constexpr microseconds longest{1000};
  microseconds pause{0};
  for (int isDone = 0; MPI_Test(&request, &isDone, MPI_STATUS_IGNORE), isDone == 0;) {
    if (pause.count() > 0) std::this_thread::sleep_for(pause);
    pause = std::min(longest, pause + microseconds(5));
  }
}

/// Messages are sent in blocks, since MPI counts in int.
class MpiCommunicator final : public Communicator {
 public:
  MpiCommunicator(int rank, int count) : Communicator(rank, count), sizes_(static_cast<std::size_t>(count)) {
    MPI_Type_contiguous(blockSize, MPI_BYTE, &block_);
    MPI_Type_commit(&block_);
  }
  ~MpiCommunicator() override {
    MPI_Type_free(&block_);
    MPI_Finalize();
  }

 protected:
  std::vector<std::string_view> gather(std::string& own) override {
    const std::uint64_t size = own.size();
    own.resize(static_cast<std::size_t>(blocksOf(size)) * blockSize);
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Iallgather(&size, 1, MPI_UINT64_T, sizes_.data(), 1, MPI_UINT64_T, MPI_COMM_WORLD, &request);
    await(request);
    const Places from = placesOf(sizes_);
    makeRoom(from);
    MPI_Iallgatherv(own.data(), blocksOf(size), block_, all_.get(), from.blocks.data(), from.begin.data(), block_,
                    MPI_COMM_WORLD, &request);
    await(request);
    return heard(from);
  }

  std::vector<std::string_view> scatter(std::vector<std::string>& own) override {
    std::vector<std::uint64_t> sizes;
    std::string message;
    for (const std::string& part : own) {
      sizes.push_back(part.size());
      message += part;
      message.resize(static_cast<std::size_t>(blocksOf(message.size())) * blockSize);
    }
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ialltoall(sizes.data(), 1, MPI_UINT64_T, sizes_.data(), 1, MPI_UINT64_T, MPI_COMM_WORLD, &request);
    await(request);
    const Places to = placesOf(sizes), from = placesOf(sizes_);
    makeRoom(from);
    MPI_Ialltoallv(message.data(), to.blocks.data(), to.begin.data(), block_, all_.get(), from.blocks.data(),
                   from.begin.data(), block_, MPI_COMM_WORLD, &request);
    await(request);
    return heard(from);
  }

 private:
  static constexpr int blockSize = 256;
  static int blocksOf(std::uint64_t bytes) { return static_cast<int>((bytes + blockSize - 1) / blockSize); }

  /// Of messages that lie one behind the other, in blocks.
  struct Places {
    std::vector<int> blocks, begin;
    int end = 0;
  };
  static Places placesOf(const std::vector<std::uint64_t>& sizes) {
    Places places;
    for (const std::uint64_t size : sizes) {
      places.blocks.push_back(blocksOf(size));
      places.begin.push_back(places.end);
      places.end += places.blocks.back();
    }
    return places;
  }
  void makeRoom(const Places& places) {
    const std::size_t needed = static_cast<std::size_t>(places.end) * blockSize;
    if (needed <= room_) return;
    all_ = std::make_unique_for_overwrite<char[]>(needed);
    room_ = needed;
  }
  std::vector<std::string_view> heard(const Places& places) const {
    std::vector<std::string_view> all;
    for (std::size_t i = 0; i < sizes_.size(); ++i)
      all.emplace_back(all_.get() + static_cast<std::size_t>(places.begin[i]) * blockSize, sizes_[i]);
    return all;
  }

  MPI_Datatype block_ = MPI_DATATYPE_NULL;
  std::vector<std::uint64_t> sizes_;
  std::unique_ptr<char[]> all_;
  std::size_t room_ = 0;
};

}  // namespace

std::unique_ptr<Communicator> startedByMpi(int& onOneMachine) {
  int provided = 0, rank = 0, count = 1;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
  if (provided < MPI_THREAD_SERIALIZED) throw std::runtime_error("MPI is there without threads");
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &count);
  MPI_Comm here = MPI_COMM_NULL;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here);
  MPI_Comm_size(here, &onOneMachine);
  MPI_Comm_free(&here);
  return std::make_unique<MpiCommunicator>(rank, count);
}

}  // namespace gamut
