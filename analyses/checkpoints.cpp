#include "analyses/checkpoints.hpp"

#include <algorithm>

#include "analyses/work.hpp"
#include "scalars/archive.hpp"

namespace gamut {

CheckpointedTask::CheckpointedTask(Checkpoints* memory)
    : memory_(memory != nullptr && memory->owner_ == std::this_thread::get_id() ? memory : nullptr) {
  if (memory_ == nullptr) return;
  number_ = memory_->next_++;
  counted_ = Work::counted();
  cpu_ = memory_->cpuSeconds();
  began_ = std::chrono::steady_clock::now();
}

CheckpointedTask::Recalled CheckpointedTask::recall(const Content& end, const Content& state) {
  const std::optional<Checkpoints::Note> note = memory_ == nullptr ? std::nullopt : memory_->find(number_);
  if (!note) return Recalled::nothing;
  memory_->read(number_, note->hasEnded ? end : state);
  memory_->next_ = note->next;
  memory_->addCpuSeconds(note->cpu);
  Work::add(note->work);
  return note->hasEnded ? Recalled::end : Recalled::state;
}

bool CheckpointedTask::isDue() const {
  return memory_ != nullptr && memory_->mayWrite() && memory_->since(memory_->last_) >= memory_->interval_;
}

bool CheckpointedTask::isWorth() const {
  constexpr double share = 0.01;  // of the interval
  return memory_ != nullptr && memory_->mayWrite() &&
         memory_->since(std::max(began_, memory_->last_)) >= share * memory_->interval_;
}

void CheckpointedTask::record(const Content& state, std::optional<std::uint64_t> work) {
  if (memory_ != nullptr && memory_->mayWrite()) write(state, false, work ? *work : Work::counted() - counted_);
}

void CheckpointedTask::end(const Content& content) {
  if (isWorth()) write(content, true, Work::counted() - counted_);
}

void CheckpointedTask::write(const Content& content, bool hasEnded, std::uint64_t work) {
  memory_->write(number_, {hasEnded, memory_->next_, work, memory_->cpuSeconds() - cpu_}, content);
  memory_->last_ = Checkpoints::Clock::now();
}

}  // namespace gamut
