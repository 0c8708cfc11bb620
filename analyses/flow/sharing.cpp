// How ranks share out a run: from the first turn in which there are several pieces each follows some of them, and all
// hear between two turns the outlines of what these have become. So every rank decides the same of all pieces. The
// pieces themselves stay where they are unless work is to be evened out, what they leave at output times until the end.
#include <algorithm>
#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

#include "analyses/checkpoints.hpp"
#include "analyses/communicator.hpp"
#include "analyses/flow/archive.hpp"
#include "analyses/flow/run.hpp"
#include "analyses/work.hpp"

namespace gamut {
namespace {

enum Told : int { toldMoved, toldPieces, toldTurn, toldCollected, toldDropped };

/// What an exception says; empty: there is none.
std::string textOf(const std::exception_ptr& error) {
  try {
    if (error) std::rethrow_exception(error);
    return "";
  } catch (const std::exception& failure) {
    return failure.what();
  }
}

}  // namespace

/// The first has what all have collected up to now.
void FlowRun::beginSharing() {
  isShared_ = true;
  shared_->hold([this](Archive& all) { archiveCollected(all); });
  if (shared_->rank() != 0) forgetCollected();
}

void FlowRun::forgetCollected() {
  for (FlowCollected& part : collected_) {
    part = FlowCollected(task_.times.size(), task_.levels.size());
    part.influence.resize(static_cast<std::size_t>(task_.embedding.symbols));
    part.narrowing.resize(part.influence.size());
  }
}

void FlowRun::shareOutTurn() {
  shares_.assign(shared_->count(), {});
  if (!isShared_) {
    shares_[shared_->rank()] = turn_;
    return;
  }
  assignTurn();
  isTurnHeard_ = false;
  bytesBefore_ = modelBytes_;
  bytesAtBefore_ = modelAtBytes_;
  if (!shared_->isOver()) return;
  stop_ = true;
  for (const Traveller& traveller : all_) unfinished_ = std::min(unfinished_, traveller.piece.set.t);
}

/// The dearest pieces first, each to the rank that has it, unless that would have much more to do than others then.
void FlowRun::assignTurn() {
  constexpr double more = 1.05;
  Places order = turn_;
  std::ranges::stable_sort(order, std::ranges::greater{}, [this](std::size_t place) { return all_[place].work; });
  double whole = 0;
  const auto workOf = [this](std::size_t place) {
    return static_cast<double>(std::max<std::uint64_t>(all_[place].work, 1));
  };
  for (const std::size_t place : order) whole += workOf(place);
  std::vector<double> work(shares_.size());
  std::vector<int> from;
  for (const Traveller& traveller : all_) from.push_back(traveller.owner);
  for (const std::size_t place : order) {
    int& owner = all_[place].owner;
    if (owner < 0 || work[owner] + workOf(place) > more * whole / static_cast<double>(work.size()))
      owner = static_cast<int>(std::ranges::min_element(work) - work.begin());
    work[owner] += workOf(place);
    shares_[owner].push_back(place);
  }
  for (Places& share : shares_) std::ranges::sort(share);
  movePieces(from);
}

std::string FlowRun::packed(Traveller& traveller) const {
  std::string bytes;
  Archive all =
      Archive::writing([&](const void* from, std::size_t size) { bytes.append(static_cast<const char*>(from), size); });
  for (const FlowLayout& layout : task_.layouts) all.share(layout.monomials);  // some look whether they are the same
  all(traveller.piece);
  return bytes;
}

void FlowRun::unpack(std::string_view bytes, Traveller& traveller) const {
  Archive all = Archive::reading([&](void* to, std::size_t size) {
    if (size > bytes.size()) throw std::runtime_error("less was told of a piece than was expected");
    bytes.copy(static_cast<char*>(to), size);
    bytes.remove_prefix(size);
  });
  for (const FlowLayout& layout : task_.layouts) all.share(layout.monomials);
  all(traveller.piece);
}

/// From the ranks that had them to those that are to follow them.
void FlowRun::movePieces(const std::vector<int>& from) {
  Places moved;
  for (const std::size_t place : turn_)
    if (from[place] >= 0 && from[place] != all_[place].owner) moved.push_back(place);
  if (moved.empty()) return;
  shared_->exchange(
      toldMoved,
      [&](Archive& all) {
        for (const std::size_t place : moved)
          if (from[place] == shared_->rank()) {
            std::string bytes = packed(all_[place]);
            all(bytes);
          }
      },
      [&](int rank, Archive& all) {
        for (const std::size_t place : moved) {
          if (from[place] != rank) continue;
          std::string bytes;
          all(bytes);
          if (all_[place].owner == shared_->rank()) unpack(bytes, all_[place]);
        }
      });
}

/// All of them to the first rank, which is to remember them.
void FlowRun::gatherPieces() {
  if (!isShared_) return;
  shared_->exchange(
      toldPieces,
      [&](Archive& all) {
        for (Traveller& traveller : all_)
          if (traveller.owner == shared_->rank()) {
            std::string bytes = packed(traveller);
            all(bytes);
          }
      },
      [&](int rank, Archive& all) {
        if (shared_->rank() != 0) return;
        for (Traveller& traveller : all_)
          if (traveller.owner == rank) {
            std::string bytes;
            all(bytes);
            unpack(bytes, traveller);
          }
      });
}

/// What these have become, and what was found on the way, which is added to what this rank has found.
void FlowRun::archiveTurn(Archive& all, const Places& places) {
  for (const std::size_t place : places) {
    Traveller lost;  // where there was no memory
    Traveller& traveller = place < all_.size() ? all_[place] : lost;
    if (all.isReading()) {
      lost.owner = traveller.owner;
      traveller = std::exchange(lost, {});
    }
    FlowPiece& piece = traveller.piece;
    FlowHalves& halves = traveller.halves;
    all(piece.set.t, piece.set.centre, piece.path, piece.timeError, piece.truncation, piece.tops, traveller.journey,
        traveller.work);
    if (traveller.journey == FlowJourney::bisected)
      all(halves.first.t, halves.first.centre, halves.second.t, halves.second.centre, halves.areAlternatives);
  }
  std::uint64_t counted = counted_, bytes = modelBytes_ - bytesBefore_, bytesAt = modelAtBytes_ - bytesAtBefore_;
  int degree = degree_, outputDegree = outputDegree_;
  bool outOfMemory = outOfMemory_, isAbandoned = isAbandoned_, areAlternatives = areAlternatives_;
  double unfinished = unfinished_, failedAt = failedAt_;
  std::string failed = failed_, error = textOf(error_);
  FlowCause cause = cause_;
  all(counted, bytes, bytesAt, degree, outputDegree, outOfMemory, isAbandoned, areAlternatives, unfinished, failedAt,
      failed, cause, error);
  if (!all.isReading()) return;
  counted_ += counted;
  modelBytes_ += bytes;
  modelAtBytes_ += bytesAt;
  degree_ = std::max(degree_, degree);
  outputDegree_ = std::max(outputDegree_, outputDegree);
  outOfMemory_ = outOfMemory_ || outOfMemory;
  isAbandoned_ = isAbandoned_ || isAbandoned;
  areAlternatives_ = areAlternatives_ || areAlternatives;
  unfinished_ = std::min(unfinished_, unfinished);
  if (failedAt < failedAt_ || (failedAt == failedAt_ && failed < failed_)) {
    failedAt_ = failedAt;
    failed_ = std::move(failed);
    cause_ = std::move(cause);
  }
  if (!error.empty() && !error_) error_ = std::make_exception_ptr(std::runtime_error(error));
}

/// What pieces have become at other ranks, and at others what they have here. Where somebody is to stop, so are all.
void FlowRun::hearTurn() {
  if (isTurnHeard_) return;
  isTurnHeard_ = true;
  if (stop_ && !error_) shared_->giveUp();
  const std::uint64_t own = counted_;
  isRecordDue_ = checkpoint_->isDue();
  shared_->exchange(
      toldTurn,
      [this](Archive& all) {
        all(isRecordDue_);
        archiveTurn(all, shares_[shared_->rank()]);
      },
      [this](int rank, Archive& all) {
        bool isDue = false;
        all(isDue);
        isRecordDue_ = isRecordDue_ || isDue;
        archiveTurn(all, shares_[rank]);
      });
  Work::add(counted_ - own);
  if (error_) stop_ = true;
  if (!shared_->isOver()) return;
  stop_ = true;
  for (const Traveller& traveller : all_) unfinished_ = std::min(unfinished_, traveller.piece.set.t);
}

/// All that this rank has, or another's beside it.
void FlowRun::archiveCollected(Archive& all) {
  std::size_t parts = collected_.size();
  all(parts);
  if (!all.isReading()) {
    for (FlowCollected& part : collected_) all(part);
    return;
  }
  for (; parts > 0; --parts) {
    FlowCollected part(task_.times.size(), task_.levels.size());
    all(part);
    collected_.front().join(std::move(part));
  }
}

/// To the first, which is to remember all of it.
void FlowRun::handOverCollected() {
  if (!isShared_) return;
  shared_->exchange(
      toldCollected, [this](Archive& all) { archiveCollected(all); },
      [this](int, Archive& all) {
        if (shared_->rank() == 0) archiveCollected(all);
      });
  if (shared_->rank() != 0) forgetCollected();
}

/// By all of them.
double FlowRun::hearDropped(double bytes) {
  double sum = bytes;
  if (isShared_)
    shared_->exchange(
        toldDropped, [&](Archive& all) { all(bytes); },
        [&](int, Archive& all) {
          double more = 0;
          all(more);
          sum += more;
        });
  return sum;
}

}  // namespace gamut
