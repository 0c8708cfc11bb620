// Ranks: several processes that do one computation, each all of it and in the same order, but for what is worth sharing
// out. Of that each does its share, tells the others what it found, and hears what they found before it goes on. So all
// come to the same bits, for any number of ranks and whichever did what.
//
// What is told to stop does less than the others from then on, and may be out of step. So where somebody is to stop all
// part: the first rank goes on alone with what it has heard, the others end there (Parted) until it calls them back.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace gamut {

class Archive;

class Communicator {
 public:
  /// Writes or reads what is told.
  using Content = std::function<void(Archive&)>;
  /// Thrown where a rank that is not the first has no part in what follows.
  struct Parted {};

  /// Made by the thread that does the computation: what others do is not shared out.
  Communicator(int rank, int count) : rank_(rank), count_(count) {}
  virtual ~Communicator() = default;
  Communicator(const Communicator&) = delete;
  Communicator& operator=(const Communicator&) = delete;

  int rank() const { return rank_; }
  int count() const { return count_; }
  bool isFirst() const { return rank_ == 0; }
  /// Whether the others have ended until they are called back.
  bool areParted() const { return areParted_; }

  /// `hasStopped`: set from when on this rank may do less than it would; null: never. `stop`: called on the first rank,
  /// with the reason, where another one is to stop; `why`: the reason why this one is.
  void heed(const std::atomic<bool>* hasStopped, std::function<void(const std::string&)> stop,
            std::function<std::string()> why);

  /// The first calls the others back, which are to be as `state` says. Only where they are parted.
  void callBack(const Content& state);
  /// Where another one waits until it is called back, and becomes as the first is. False: it is over.
  bool wait(const Content& state);
  /// It has ended here. The first ends all others, whatever they do; those have no part in anything until then.
  void end();

  /// The first rank's number, on all of them.
  double agreed(double own);

 protected:
  /// What each of them gives, in their order, to all, until the next call; `own` may be changed. Called from one thread
  /// at a time. Waits for all.
  virtual std::vector<std::string_view> gather(std::string& own) = 0;
  /// Likewise, to each of them something else: own[rank].
  virtual std::vector<std::string_view> scatter(std::vector<std::string>& own) = 0;

 private:
  friend class SharedWork;
  enum class Kind : std::uint8_t { work, state, end };
  struct Heard {
    Kind kind = Kind::work;
    bool isToStop = false, isAstray = false;
    std::uint64_t number = 0;
    std::string why;
    std::string_view content = {};  // until the next is told
  };
  std::vector<Heard> tell(const Heard& own, const Content& content = {});
  std::vector<Heard> tell(Kind kind, const Content& content = {});
  bool mayHaveStopped() const { return hasStopped_ != nullptr && *hasStopped_; }

  const int rank_, count_;
  const std::thread::id owner_ = std::this_thread::get_id();
  const std::atomic<bool>* hasStopped_ = nullptr;
  std::function<void(const std::string&)> stop_;
  std::function<std::string()> why_;
  std::uint64_t number_ = 0;  // of what was shared out
  std::string message_;
  bool areParted_ = false, isBusy_ = false, isLost_ = false, hasEnded_ = false;
};

/// Something that is shared out, from its begin to its end. Without others, where they are parted, on a thread that is
/// not theirs, and within something else that is shared out, one rank does all.
class SharedWork {
 public:
  using Content = Communicator::Content;
  using Heard = std::function<void(int rank, Archive& all)>;

  explicit SharedWork(Communicator* communicator);
  /// Where it was left before its end, this rank has lost its way.
  ~SharedWork();
  SharedWork(const SharedWork&) = delete;
  SharedWork& operator=(const SharedWork&) = delete;

  int rank() const { return others_ != nullptr ? others_->rank_ : 0; }
  int count() const { return others_ != nullptr ? others_->count_ : 1; }
  bool isMine(std::size_t number) const {
    return number % static_cast<std::size_t>(count()) == static_cast<std::size_t>(rank());
  }
  /// Tells the others what this rank found, and reads what each of them did, by rank; not of those that are out of
  /// step, or have ended. `what`: the same of all that is written and read alike. From any thread, one at a time. Does
  /// nothing where one rank does all.
  void exchange(int what, const Content& own, const Heard& heard);
  /// Likewise, to each of them something else; nothing where one of them does not.
  void exchangeEach(int what, const std::function<void(int to, Archive& all)>& own, const Heard& heard);
  /// From now on each rank holds something alone, which it writes at the end, when it reads what others do besides.
  void hold(Content lastWords);
  /// Somebody is to stop: all are to come to the end.
  bool isOver() const { return isOver_; }
  /// So is this rank.
  void giveUp() { hasGivenUp_ = true; }
  /// All hear the last words of all, unless nothing was exchanged before. Where it is over, all but the first part
  /// (Parted), which is alone then. Throws std::bad_alloc where one left with what it held: nothing else makes it
  /// leave.
  void end();

 private:
  Communicator* others_;
  Content lastWords_;
  const bool isAstray_;
  bool isOver_ = false, hasGivenUp_ = false, hasEnded_ = false, isHeld_ = false, isLost_ = false;
  int gone_ = 0;  // so many have said their last words, or are out of step, since the last exchange
  std::string why_;
};

}  // namespace gamut
