#include "commands/ranks.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <string>
#include <utility>

#include "scalars/archive.hpp"

namespace gamut {
namespace {

Communicator* all = nullptr;

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

void onAllRanks(const std::function<void()>& task) {
  std::exception_ptr failure;
  std::string why, others;
  try {
    task();
  } catch (const std::exception& error) {
    failure = std::current_exception();
    why = error.what();
  }
  SharedWork shared(ranks());
  shared.exchange(
      0, [&](Archive& told) { told(why); },
      [&](int rank, Archive& told) {
        std::string text;
        told(text);
        if (others.empty() && !text.empty()) others = fmt::format("rank {}: {}", rank, text);
      });
  shared.end();
  if (failure) std::rethrow_exception(failure);
  if (!others.empty()) throw UsageError(others);
}

}  // namespace gamut
