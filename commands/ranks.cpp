#include "commands/ranks.hpp"

#include <fmt/format.h>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include "scalars/archive.hpp"
#include "studies/atomic_file.hpp"
#include "studies/printable.hpp"
#include "studies/results/results_file.hpp"
#include "studies/study.hpp"

namespace gamut {
namespace {

Communicator* all = nullptr;
int errorStream = STDERR_FILENO;

/// -1 where there is no such number.
int numberIn(const char* name) {
  const char* text = std::getenv(name);
  if (text == nullptr || *text == '\0') return -1;
  char* end = nullptr;
  const long number = std::strtol(text, &end, 10);
  return *end == '\0' && number >= 0 && number < 1 << 24 ? static_cast<int>(number) : -1;
}

}  // namespace

Communicator* ranks() { return all; }
void setRanks(Communicator* communicator) { all = communicator; }

StartedAs startedAs() {
  // Open MPI; MPICH and what srun does by PMI; srun by PMIx.
  constexpr std::pair<const char*, const char*> known[] = {
      {"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"}, {"PMI_RANK", "PMI_SIZE"}, {"PMIX_RANK", "SLURM_NTASKS"}};
  for (const auto& [rank, count] : known)
    if (numberIn(rank) >= 0 && numberIn(count) > 1) return {numberIn(rank), numberIn(count)};
  return {};
}

bool isRefusal(const std::exception& error) {
  return dynamic_cast<const UsageError*>(&error) != nullptr || dynamic_cast<const StudyError*>(&error) != nullptr ||
         dynamic_cast<const ResultsFileError*>(&error) != nullptr ||
         dynamic_cast<const OutputRefused*>(&error) != nullptr;
}

void onAllRanks(const std::function<void()>& task) {
  struct Found {
    std::string why;
    bool isRefused = true;
  } own, others;
  std::exception_ptr failure;
  try {
    task();
  } catch (const std::exception& error) {
    failure = std::current_exception();
    own = {error.what(), isRefusal(error)};
    if (own.why.empty()) own.why = "an exception without words";
  }
  SharedWork shared(ranks());
  shared.exchange(
      0, [&](Archive& told) { told(own.why, own.isRefused); },
      [&](int rank, Archive& told) {
        Found found;
        told(found.why, found.isRefused);
        if (others.why.empty() && !found.why.empty())
          others = {fmt::format("rank {}: {}", rank, found.why), found.isRefused};
      });
  shared.end();
  if (failure && isFirstRank()) std::rethrow_exception(failure);
  if (failure) throw UsageError(own.why);
  if (others.why.empty()) return;
  if (isFirstRank() && !others.isRefused) throw RankFailed(others.why);
  throw UsageError(others.why);
}

void fallSilent() {
  errorStream = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
  if (errorStream < 0 || std::freopen("/dev/null", "w", stdout) == nullptr ||
      std::freopen("/dev/null", "w", stderr) == nullptr)
    throw std::system_error(errno, std::generic_category(), "/dev/null");
}

void sayLast(const std::string& line) {
  if (!isFirstRank()) std::this_thread::sleep_for(std::chrono::seconds(2));
  const std::string who = ranks() != nullptr ? fmt::format("rank {}: ", ranks()->rank()) : "";
  const std::string whole = printable("gamut: " + who + line) + "\n";
  // Nothing can be done where nobody reads it.
  if (::write(errorStream, whole.data(), whole.size()) < 0) return;
}

}  // namespace gamut
