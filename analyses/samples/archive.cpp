// Member by member, in the order in which they are declared.
#include "analyses/samples/archive.hpp"

#include <algorithm>
#include <span>

#include "analyses/communicator.hpp"
#include "analyses/samples/first_order.hpp"
#include "analyses/samples/influence.hpp"

namespace gamut {

void archive(Archive& all, Table& table) { all(table.times, table.outputs, table.data); }

void archive(Archive& all, Envelope& envelope) { all(envelope.lower, envelope.upper); }

void archive(Archive& all, Integration& run) { all(run.times, run.reached, run.why); }

void archive(Archive& all, FailedSample& sample) { all(sample.number, sample.times, sample.reached, sample.why); }

void archive(Archive& all, Convergence& first) { all(first.samples, first.width, first.meanError); }

void archive(Archive& all, SwitchingCourse& course) { all(course.from, course.values); }

void SampleBlock::archive(Archive& all) {
  all(runs, levels, first_, hasWeight_, quantities_, outputs_, cells_, values_, rows_);
}

void SampleBlock::archiveValues(Archive& all, std::size_t first, std::size_t count) {
  for (std::size_t i = first; i < first + count; ++i) {
    all(runs[i], levels[i]);
    all.bytes(values(i));
  }
}

void SampleBlock::archiveMotions(Archive& all, std::size_t first, std::size_t count) {
  if (count > 0 && first % packWidth == 0 && first + count == std::min(first + packWidth, size())) {
    all.bytes(pack(first / packWidth));
    return;
  }
  for (std::size_t i = first; i < first + count; ++i) {
    std::vector<double> alone = trajectory(i);
    all(alone);
    setTrajectory(i, alone);
  }
}

void SampleBlock::archiveRows(Archive& all, std::size_t number, std::size_t from, std::size_t to) {
  const std::size_t row = outputs_ * packWidth;
  all.bytes(pack(number).subspan(from * row, (to - from) * row));
}

bool SampleBlock::isHere(std::size_t number) const { return spread == nullptr || spread->isMine(number); }

void SampleBlock::fetch(std::vector<std::size_t>& samples) {
  constexpr int fetched = 100;
  if (spread == nullptr) return;
  std::vector<std::size_t> theirs;
  spread->exchange(
      fetched,
      [&](Archive& all) {
        all(samples);
        for (const std::size_t i : samples) archiveMotions(all, i, 1);
      },
      [&](int, Archive& all) {
        std::vector<std::size_t> some;
        all(some);
        for (const std::size_t i : some) archiveMotions(all, i, 1);
        theirs.insert(theirs.end(), some.begin(), some.end());
      });
  samples.insert(samples.end(), theirs.begin(), theirs.end());
  std::ranges::sort(samples);
}

void Counts::archive(Archive& all) { all(few_, many_); }

void Counts::archive(Archive& all, std::size_t first, std::size_t count) {
  if (!few_.empty()) all.bytes(std::span(few_).subspan(first, count));
  if (!many_.empty()) all.bytes(std::span(many_).subspan(first, count));
}

void BatchStatistics::archiveCells(Archive& all, std::size_t first, std::size_t count) {
  all.bytes(std::span(cells_).subspan(first, count));
  shares_.archive(all, placeOf(first), placeOf(first + count) - placeOf(first));
}

void EnsembleStatistics::archiveTimes(Archive& all, std::size_t from, std::size_t to) {
  const std::size_t first = from * outputs_, count = (to - from) * outputs_;
  all.bytes(std::span(cells_).subspan(first, count));
  for (std::vector<double>* ends : {&least_, &greatest_})
    all.bytes(std::span(*ends).subspan(first * (levels_ + 1), count * (levels_ + 1)));
  counts_.archive(all, first * (bins_ + 2), count * (bins_ + 2));
  batches_.archiveCells(all, first, count);
  for (Convergence& growth : first_)
    for (Table* table : {&growth.width, &growth.meanError}) all.bytes(std::span(table->data).subspan(first, count));
}

void BatchStatistics::archive(Archive& all) { all(parts_, cells_, shares_); }

void EnsembleStatistics::archive(Archive& all) {
  all(times_, outputs_, levels_, bins_, cells_, least_, greatest_, counts_, batches_, first_, kept_);
}

void TurnScan::archive(Archive& all) { all(turns_, line_, place_, width_, noise_, courses_); }

void InfluenceMeasures::archive(Archive& all) { all(sums_); }

void FirstOrder::archive(Archive& all) { all(products_, right_, count_); }

}  // namespace gamut
