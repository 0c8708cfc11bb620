#include "analyses/communicator.hpp"

#include <cstring>
#include <new>
#include <stdexcept>
#include <utility>

#include "analyses/workers.hpp"
#include "scalars/archive.hpp"

namespace gamut {
namespace {

void write(std::string& bytes, const Communicator::Content& content) {
  Archive all =
      Archive::writing([&](const void* from, std::size_t size) { bytes.append(static_cast<const char*>(from), size); });
  if (content) content(all);
}

/// How many of them it took.
std::size_t read(std::string_view bytes, const Communicator::Content& content) {
  std::size_t at = 0;
  Archive all = Archive::reading([&](void* to, std::size_t size) {
    if (size > bytes.size() - at) throw std::runtime_error("another rank has told less than was expected");
    std::memcpy(to, bytes.data() + at, size);
    at += size;
  });
  if (content) content(all);
  return at;
}

}  // namespace

void Communicator::heed(const std::atomic<bool>* hasStopped, std::function<void(const std::string&)> stop,
                        std::function<std::string()> why) {
  hasStopped_ = hasStopped;
  stop_ = std::move(stop);
  why_ = std::move(why);
}

std::vector<Communicator::Heard> Communicator::tell(const Heard& own, const Content& content) {
  Heard head = own;
  const auto archiveHead = [](Archive& all, Heard& one) {
    all(one.kind, one.isToStop, one.isAstray, one.number, one.why);
  };
  message_.clear();
  write(message_, [&](Archive& all) { archiveHead(all, head); });
  write(message_, content);
  std::vector<Heard> heard;
  for (const std::string_view bytes : gather(message_)) {
    Heard& one = heard.emplace_back();
    one.content = bytes.substr(read(bytes, [&](Archive& all) { archiveHead(all, one); }));
  }
  return heard;
}

std::vector<Communicator::Heard> Communicator::tell(Kind kind, const Content& content) {
  Heard own;
  own.kind = kind;
  return tell(own, content);
}

void Communicator::callBack(const Content& state) {
  tell(Kind::state, state);
  areParted_ = isLost_ = false;
  number_ = 0;
}

bool Communicator::wait(const Content& state) {
  while (!hasEnded_) {
    const Heard first = std::move(tell(Kind::end).front());
    hasEnded_ = first.kind == Kind::end;
    if (first.kind != Kind::state) continue;
    areParted_ = isLost_ = isBusy_ = false;
    number_ = 0;
    read(first.content, state);
    return true;
  }
  return false;
}

void Communicator::end() {
  while (!hasEnded_) hasEnded_ = tell(Kind::end).front().kind == Kind::end;
  areParted_ = true;
}

double Communicator::agreed(double own) {
  SharedWork work(this);
  double first = own;
  work.exchange(
      0, [&](Archive& all) { all(first); },
      [&](int rank, Archive& all) {
        if (rank == 0) all(first);
      });
  work.end();
  return first;
}

SharedWork::SharedWork(Communicator* communicator)
    : others_(communicator != nullptr && communicator->count_ > 1 && !communicator->areParted_ &&
                      !communicator->isBusy_ && !AmongWorkers::isSo() &&
                      communicator->owner_ == std::this_thread::get_id()
                  ? communicator
                  : nullptr),
      isAstray_(others_ != nullptr && (others_->isLost_ || others_->mayHaveStopped())) {
  if (others_ != nullptr) others_->isBusy_ = true;
}

SharedWork::~SharedWork() {
  if (others_ == nullptr) return;
  others_->isBusy_ = false;
  if (!hasEnded_) others_->isLost_ = true;
}

void SharedWork::hold(Content lastWords) {
  if (others_ != nullptr) lastWords_ = std::move(lastWords);
}

namespace {

constexpr int last = -1;  // what is told at the end

}  // namespace

void SharedWork::exchange(int what, const Content& own, const Heard& heard) {
  if (others_ == nullptr) return;
  Communicator::Heard mine;
  mine.isToStop = hasGivenUp_ || others_->mayHaveStopped();
  mine.isAstray = isAstray_;
  mine.number = others_->number_++;
  if (mine.isToStop && others_->why_) mine.why = others_->why_();
  const std::vector<Communicator::Heard> all = others_->tell(mine, [&](Archive& to) {
    to(what);
    if (own) own(to);
  });
  if (!others_->isFirst() && all.front().kind == Communicator::Kind::end) {
    others_->hasEnded_ = others_->areParted_ = true;
    throw Communicator::Parted();
  }
  gone_ = what == last ? 1 : 0;
  for (int rank = 0; rank < others_->count_; ++rank) {
    const Communicator::Heard& one = all[rank];
    const bool isAtWork = one.kind == Communicator::Kind::work && one.number == mine.number;
    isOver_ = isOver_ || one.isToStop || one.isAstray || !isAtWork;
    if (why_.empty()) why_ = one.why;
    if (rank == others_->rank_) continue;
    if (!isAtWork || one.isAstray || isAstray_) {
      isLost_ = isLost_ || isHeld_;
      ++gone_;
      continue;
    }
    read(one.content, [&](Archive& from) {
      int told = 0;
      from(told);
      if (told == last) {
        bool areThere = false;
        from(areThere);
        ++gone_;
        if (areThere) lastWords_(from);
      } else if (told == what) {
        if (heard) heard(rank, from);
      } else {
        isOver_ = true;
      }
    });
  }
  isHeld_ = static_cast<bool>(lastWords_);
}

/// First all hear that all will: MPI does not forgive who takes part in something else.
void SharedWork::exchangeEach(int what, const std::function<void(int to, Archive& all)>& own, const Heard& heard) {
  if (others_ == nullptr) return;
  std::vector<std::string> messages(static_cast<std::size_t>(count()));
  for (int to = 0; to < count(); ++to)
    if (to != rank()) write(messages[to], [&](Archive& all) { own(to, all); });
  int ready = 1;
  exchange(what, {}, [&](int, Archive&) { ++ready; });
  if (ready < count()) return;
  const std::vector<std::string_view> all = others_->scatter(messages);
  for (int from = 0; from < count(); ++from)
    if (from != rank()) read(all[from], [&](Archive& told) { heard(from, told); });
}

void SharedWork::end() {
  if (others_ != nullptr && (lastWords_ || isOver_)) {
    bool isTold = false;
    do {
      exchange(last,
               [&](Archive& all) {
                 bool areThere = lastWords_ && !std::exchange(isTold, true);
                 all(areThere);
                 if (areThere) lastWords_(all);
               },
               {});
    } while (gone_ < others_->count_);
  }
  hasEnded_ = true;
  if (others_ == nullptr) return;
  if (isOver_) {
    others_->areParted_ = true;
    if (!others_->isFirst()) throw Communicator::Parted();
    if (others_->stop_) others_->stop_(why_);
  }
  if (isLost_) throw std::bad_alloc();
}

}  // namespace gamut
