// Rows are counted before any is kept: what is kept never takes more than the storage, whatever comes.
#include "studies/running/sample_keeper.hpp"

#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace gamut {
namespace {

/// Bytes of a sample's number and so many numbers of its own.
double rowBytes(std::size_t numbers) { return static_cast<double>(sizeof(double) * (1 + numbers)); }

/// How many samples are kept at this distance: those whose number it divides, and the last.
std::size_t rowsAt(std::size_t samples, std::int64_t distance) {
  if (distance == 0) return 0;
  const auto last = static_cast<std::int64_t>(samples) - 1;
  return static_cast<std::size_t>(last / distance + (last % distance == 0 ? 1 : 2));
}

/// The least distance, a multiple of `unit`, at which no more than `rows` are kept; 0 if not even the first and the
/// last sample may be.
std::int64_t distanceFor(std::size_t samples, double rows, std::int64_t unit) {
  if (!(rows >= 2) || unit == 0) return 0;
  const auto last = static_cast<std::int64_t>(samples) - 1;
  // last / distance + 2 <= rows
  const std::int64_t least =
      rows >= static_cast<double>(samples) ? 1 : last / (static_cast<std::int64_t>(rows) - 1) + 1;
  return (least + unit - 1) / unit * unit;
}

template <class T>
void append(std::vector<T>& list, std::vector<T>&& more) {
  list.insert(list.end(), more.begin(), more.end());
  more = {};
}

}  // namespace

SampleKeeper::SampleKeeper(std::size_t samples, std::size_t quantities, std::size_t cells, double storage)
    : centre_(samples - 1) {
  samples_.present = true;
  samples_.storage = storage;
  samples_.valuesEvery = distanceFor(samples, std::floor(0.5 * storage / rowBytes(quantities)), 1);
  const std::size_t values = rowsAt(samples, samples_.valuesEvery);
  const double left = storage - static_cast<double>(values) * rowBytes(quantities);
  samples_.motionsEvery = distanceFor(samples, std::floor(left / rowBytes(cells)), samples_.valuesEvery);
  samples_.values.reserve(values * quantities);
  samples_.motions.reserve(rowsAt(samples, samples_.motionsEvery) * cells);
}

void SampleKeeper::keep(SampleBlock& block) {
  KeptSamples& kept = block.hasWeight() ? samples_ : beside_;
  std::vector<std::size_t> fetched;
  const auto isKept = [&](std::size_t number, std::int64_t every) {
    return every > 0 && (number == centre_ || number % static_cast<std::size_t>(every) == 0);
  };
  for (std::size_t i = 0; i < block.size(); ++i)
    if (isKept(block.first() + i, samples_.motionsEvery) && block.isHere(i / packWidth)) fetched.push_back(i);
  block.fetch(fetched);
  for (std::size_t i = 0; i < block.size(); ++i) {
    const std::size_t number = block.first() + i;
    if (isKept(number, samples_.valuesEvery)) {
      kept.number.push_back(static_cast<std::int64_t>(number));
      const std::span<const double> values = block.values(i);
      kept.values.insert(kept.values.end(), values.begin(), values.end());
    }
    if (isKept(number, samples_.motionsEvery)) {
      kept.motionNumber.push_back(static_cast<std::int64_t>(number));
      const std::vector<double> motion = block.trajectory(i);
      kept.motions.insert(kept.motions.end(), motion.begin(), motion.end());
    }
  }
}

KeptSamples SampleKeeper::take() {
  append(samples_.number, std::move(beside_.number));
  append(samples_.values, std::move(beside_.values));
  append(samples_.motionNumber, std::move(beside_.motionNumber));
  append(samples_.motions, std::move(beside_.motions));
  return std::move(samples_);
}

}  // namespace gamut
