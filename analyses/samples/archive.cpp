// Member by member, in the order in which they are declared.
#include "analyses/samples/archive.hpp"

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

void Counts::archive(Archive& all) { all(few_, many_); }

void BatchStatistics::archive(Archive& all) { all(parts_, cells_, shares_); }

void EnsembleStatistics::archive(Archive& all) {
  all(times_, outputs_, levels_, bins_, cells_, least_, greatest_, counts_, batches_, first_, kept_);
}

void TurnScan::archive(Archive& all) { all(turns_, line_, place_, width_, noise_, courses_); }

void InfluenceMeasures::archive(Archive& all) { all(sums_); }

void FirstOrder::archive(Archive& all) { all(products_, right_, count_); }

}  // namespace gamut
