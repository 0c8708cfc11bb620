// Corners, centre and points follow the plan's samples: with more of these, they have other numbers.
#include "studies/running/former_samples.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "analyses/communicator.hpp"

namespace gamut {
namespace {

bool isSameNumber(double one, double other) {
  return std::bit_cast<std::uint64_t>(one) == std::bit_cast<std::uint64_t>(other) ||
         (std::isnan(one) && std::isnan(other));
}

}  // namespace

FormerSamples::FormerSamples(const Results& results, std::size_t samples)
    : before_(static_cast<std::size_t>(results.stochastic.samples)),
      samples_(samples),
      packWidth_(static_cast<std::size_t>(results.stochastic.packWidth)),
      kept_(results.stochastic.kept),
      error_(results.stochastic.error) {
  for (const DisputedSample& sample : results.comparison.disputed) settled_.insert(sample.number);
}

/// Samples of one number / packWidth share their steps; the last of a plan may be fewer.
bool FormerSamples::hasSamePack(std::size_t number) const {
  if (number >= before_) return true;
  const std::size_t end = number / packWidth_ * packWidth_ + packWidth_;
  return std::min(end, before_) == std::min(end, samples_);
}

/// One of the motions that are here.
void FormerSamples::meet(const SampleBlock& block, std::size_t i, const std::vector<DisputedSample>& disputed,
                         Met& met) const {
  const std::size_t number = block.first() + i, outputs = error_.outputs;
  if (block.hasWeight() && number >= before_) return;
  const std::size_t former = block.hasWeight() ? number : number - samples_ + before_;
  const auto signedFormer = static_cast<std::int64_t>(former);
  const auto place = std::ranges::lower_bound(kept_.motionNumber, signedFormer);
  if (place == kept_.motionNumber.end() || *place != signedFormer) return;
  const auto isIt = [&](const DisputedSample& sample) { return sample.number == static_cast<std::int64_t>(number); };
  if (!hasSamePack(former) || settled_.contains(signedFormer) || std::ranges::any_of(disputed, isIt)) return;
  const auto row = static_cast<std::size_t>(place - kept_.motionNumber.begin());
  ++met.met;
  bool isSame = true;
  for (std::size_t cell = 0; cell < error_.data.size(); ++cell) {
    const double was = kept_.motions[row * error_.data.size() + cell], is = block(i, cell / outputs, cell % outputs);
    if (isSameNumber(was, is)) continue;
    isSame = false;
    constexpr double ulps = 4, errors = 100;
    const double rounding = ulps * std::numeric_limits<double>::epsilon() * std::max(std::fabs(was), std::fabs(is));
    if (met.fault.empty() && std::fabs(is - was) > errors * (error_.data[cell] + rounding))  // unknown is no reason
      met.fault = fmt::format(
          "sample {} is {:.9g} where it was {:.9g}, farther than errors of integration explain: its motion is "
          "another one; expected results by this version of Gamut, or run the study again",
          number, is, was);
  }
  met.changed += isSame ? 0 : 1;
}

void FormerSamples::meet(const SampleBlock& block, const std::vector<DisputedSample>& disputed) {
  Met all;
  for (std::size_t i = 0; i < block.size(); ++i)
    if (block.isHere(i / packWidth)) meet(block, i, disputed, all);
  if (block.spread != nullptr) {
    constexpr int met = 102;
    Met own = all;
    block.spread->exchange(
        met, [&](Archive& to) { to(own.met, own.changed, own.fault); },
        [&](int, Archive& from) {
          Met theirs;
          from(theirs.met, theirs.changed, theirs.fault);
          all.met += theirs.met, all.changed += theirs.changed;
          if (all.fault.empty()) all.fault = theirs.fault;
        });
  }
  if (!all.fault.empty()) throw std::invalid_argument(all.fault);
  met_ += all.met, changed_ += all.changed;
}

}  // namespace gamut
