// What is probable: many samples of the uncertain quantities, integrated by the witness (CVODE), by Adams's method in
// packs, and what they say together: envelope, moments, quantiles, inner alpha-cuts, and the witness's own error.
// Samples are looked at as they arrive, block by block, and not kept: memory does not grow with their number.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "analyses/dependence.hpp"
#include "analyses/samples/courses.hpp"
#include "analyses/samples/ensemble_statistics.hpp"
#include "analyses/samples/sample_block.hpp"
#include "analyses/samples/sampling.hpp"
#include "analyses/samples/witness.hpp"
#include "analyses/table.hpp"
#include "analyses/uncertainty.hpp"

namespace gamut {

class Archive;
class Communicator;
class SharedWork;

/// Courses of what varies in time that switch from end to end, each a sample of its own: chosen by the number
/// numberOfSwitching of each quantity that varies.
struct SwitchingCourses {
  Motion motion;                                      ///< of what varies itself, instead of the number drawn
  std::vector<std::size_t> quantities;                ///< that vary
  std::vector<double> rates;                          ///< of each, as of VaryingQuantity
  std::vector<std::vector<SwitchingCourse>> courses;  ///< [which][quantity that varies]
};

/// A motion whose start values are partly uncertain.
struct UncertainMotion {
  Motion motion;
  std::vector<double> nominal;       ///< initial values, then parameters
  std::vector<Uncertain> uncertain;  ///< the uncertain quantities
  std::vector<int> slot;             ///< of each uncertain quantity: its place in `nominal`
  QuantityDependence dependence;     ///< of them; those of which it is unknown are sampled as if independent
  SwitchingCourses switching;        ///< in motions without equations that jump

  /// The start values for these values of the uncertain quantities.
  std::vector<double> start(std::span<const double> values) const;
  /// Which switching courses these values choose; null if what varies follows the motion's own.
  const std::vector<SwitchingCourse>* switchingAt(std::span<const double> values) const;
  /// Motion and start of these values, whose equations jump where their courses do.
  Motion motionAt(std::span<const double> values) const;
  /// Throws std::invalid_argument, saying what does not fit together.
  void check() const;
};

/// Along switching courses, by a witness of system.switching.motion. `start`: what varies may have any number.
Integration integrateAlong(Witness& witness, const UncertainMotion& system, const std::vector<SwitchingCourse>& courses,
                           std::vector<double> start, const Tolerance& tolerance, std::span<double> trajectory,
                           double seconds = std::numeric_limits<double>::infinity());

struct EnsembleOptions {
  Plan plan = Plan::sobol;
  std::size_t samples = 4096;
  std::uint64_t seed = 1;
  Tolerance tolerance;
  Method method = Method::adams;
  /// CPU time after which a sample fails; a pack that takes longer than sixteen samples may is given up, and its
  /// samples are integrated one by one
  double secondsPerSample = std::numeric_limits<double>::infinity();
  std::vector<double> alpha;  ///< rising membership levels, of which inner cuts are wanted
  Transformation transformation = Transformation::reduced;  ///< where points are put for these
  /// By the extended method, in which quantities outputs turn, rising, where that is known already
  std::optional<std::vector<std::size_t>> turning;
  /// Values of the quantities at further points, the last of all; those on switching courses behind all others
  std::vector<std::vector<double>> extremes;
  int jobs = 1;                                  ///< threads
  std::function<void(double)> progress;          ///< called with the fraction done (0 … 1), from any thread
  const std::atomic<bool>* cancelled = nullptr;  ///< set from outside to end early; what has ended is kept
  Communicator* communicator = nullptr;          ///< of the ranks that share it out, if any
  bool spreads = false;  ///< of blocks of the plan's samples each rank then has whole only what it integrated: who
                         ///< looks at them knows that (SampleBlock::spread)
};

/// A sample that CVODE could not follow to the horizon.
struct FailedSample {
  std::size_t number = 0;
  std::size_t times = 0;  ///< number of output times reached
  double reached = 0;     ///< s
  std::string why;
};

/// The samples of `system` on their way into the statistics: all samples of the plan, the corners, the corners of the
/// alpha-cuts, the centre, the points of the transformation, and the extremes. Every number depends on the options'
/// plan, samples, seed, tolerance, method and alpha alone, but which samples took too long. By Adams's method the
/// samples of one number / packWidth are integrated together (corners and centre, which follow the samples, counted
/// from the first corner; points of the transformation from the first that looks for turns, and from the first behind
/// these), in the steps of the one that needs the shortest: a sample's trajectory is what its pack gave. Packs of so
/// few samples that they would cost more than the samples alone, packs of which a sample fails, all samples by
/// Method::bdf and those of a motion whose equations jump are integrated one by one. Samples that fail are named.
class EnsembleRun {
 public:
  /// Looks at samples before they count, and may put better trajectories in their place. Called from one thread, block
  /// by block in one order.
  using Look = std::function<void(SampleBlock&)>;

  /// The system and what the options point to must outlive it. Throws std::invalid_argument for options or a system
  /// that make no sense.
  EnsembleRun(const UncertainMotion& system, EnsembleOptions options);
  EnsembleRun(UncertainMotion&& system, EnsembleOptions options) = delete;

  /// Integrates the first samples, at most 256, then the corners and the centre, and keeps them; of outputs at so many
  /// times that these would take more than 512 MiB, as many packs as do not, of the plan's samples one at least. If
  /// that is cancelled, those before the first that has not come to its end are kept, and a second call goes on behind
  /// them.
  void integrateFirst();
  /// What they span, corners and centre too, as far as they came; until they are taken into the statistics.
  Envelope firstEnvelope() const;
  /// What the corners and the centre span, likewise.
  Envelope cornerEnvelope() const;
  /// Takes the first samples into the statistics, with what was still missing of them, then integrates all others,
  /// corners and centre behind the plan's samples, the points of the transformation, the extremes, and takes them.
  /// `expected`: where outputs are expected besides what the first samples say, such as an enclosure; NaN where nothing
  /// is known, or empty. `besides`: what each rank tells the others at the end of what its look has found.
  void integrateOthers(const Envelope& expected = {}, const Look& look = {},
                       const std::function<void(Archive&)>& besides = {});
  /// EnsembleOptions::extremes, which are known only now: before integrateOthers.
  void setExtremes(std::vector<std::vector<double>> extremes);
  /// While samples are integrated: whether it is to pause, asked from any thread, and what is done then, from the
  /// calling thread, with all others at rest: it may be archived. Empty ones: never.
  void pauseWhen(std::function<bool()> isDue, std::function<void()> pause);
  /// Whether others have begun, in a run that goes on from an archive.
  bool hasBegunOthers() const { return statistics_.has_value(); }
  /// All of it, while it pauses or does nothing; it is read into a new run of the same system and options, the
  /// system's switching courses being what they were.
  void archive(Archive& all);

  const EnsembleOptions& options() const { return options_; }
  const Sampling& sampling() const { return sampling_; }
  /// At which levels the cuts are that the sampling has corners of.
  const std::vector<double>& cornerLevels() const { return cornerLevels_; }
  /// So many samples, corners, points and extremes at most, known before all are.
  std::size_t mostSamples() const;
  /// The quantities that the extended method gives values between the ends of their cuts; nothing until its points have
  /// looked for turns, unless they were an option.
  const std::optional<std::vector<std::size_t>>& turning() const { return turning_; }
  /// Points of the sampling that are extremes; none until all others are integrated.
  std::size_t extremes() const { return sampling_.size() - endOfOthers_; }
  /// What these points found of each quantity (TurnScan::turns); empty by other methods.
  const std::vector<double>& turns() const { return scan_.turns(); }
  /// 64, or 1 where samples are integrated one by one.
  std::size_t packWidth() const;
  /// Samples that count in the statistics: those of the plan, unless cancelled.
  std::size_t counted() const { return counted_; }
  /// The same and corners, centre and points.
  std::size_t integrated() const { return counted_ + beside_; }
  /// All of them, and their error measured to the end.
  bool isComplete() const {
    return integrated() == sampling_.size() && extremes() == options_.extremes.size() &&
           measured_ == sampling_.samples();
  }
  /// Output times at which all that were integrated have arrived; envelopes and statistics end there, since beyond they
  /// would be of the survivors alone.
  std::size_t reachedTimes() const { return reachedTimes_; }
  double reached() const;  ///< s
  /// Why that is not all times, naming the first sample that failed; or empty.
  std::string why() const;
  /// The first thousand of the samples that failed, by rising number, and how many did.
  const std::vector<FailedSample>& failed() const { return failed_; }
  std::size_t failures() const { return failures_; }
  /// Witness error: greatest change of a re-integrated sample at a hundred times tighter tolerance. Measured on every
  /// fiftieth sample, integrated once more alone (on at least eight, or all if there are fewer; on 1024 at most;
  /// without states, where nothing is integrated, against 128-bit arithmetic), and on eight on switching courses.
  const Table& error() const { return error_; }

  Envelope envelope() const;
  SampledShares shares(std::size_t time, std::size_t output) const;
  /// All numbers but the shares at these times, which rise, are forgotten, with most of the memory that they take.
  void keepShares(const std::vector<std::size_t>& times);
  std::vector<Envelope> innerCuts() const;
  Statistics statistics(const std::vector<double>& probabilities = {0.01, 0.05, 0.5, 0.95, 0.99}) const;
  /// What the first of them said already.
  const std::vector<Convergence>& convergence() const { return statistics_->convergence(); }

 private:
  std::size_t placeInPack(std::size_t number) const;
  bool isSwitching(std::size_t number) const;
  SampleBlock nextBlock(std::size_t next, std::size_t end);
  SampleBlock integrateNext(std::size_t next, std::size_t end);
  std::size_t widthFor(const SampleBlock& block) const;
  bool integratePieces(SampleBlock& block, std::vector<std::size_t>& ended);
  void tellErrors(std::size_t compared, std::uint64_t work);
  bool isSpread(const SampleBlock& block) const;
  void spread(SampleBlock& block);
  std::pair<std::size_t, std::size_t> timesOf(int rank) const;
  void archiveOwnTimes(Archive& all);
  void handOverStatistics();
  void integrateKept();
  void goOn(const Envelope& expected, const Look& look);
  void integrate(SampleBlock& block, std::vector<std::size_t>& ended);
  void addInsidePoints();
  void archiveSampling(Archive& all);
  void integrateFirst(std::size_t& next, std::size_t end);
  void takeFirst(const Envelope& expected, const Look& look);
  void integrateRest(std::size_t& next, std::size_t end, const Look& look);
  void beginScan();
  void integratePoints(const Look& look);
  void measureError(const SampleBlock& block);
  void measureSwitchingError(const SampleBlock& block);
  void noteFailures(const SampleBlock& block);
  void take(SampleBlock& block, const Look& look);
  Envelope expectedRange(const Envelope& expected) const;
  bool isCancelled() const;
  bool isStopped() const { return options_.cancelled != nullptr && *options_.cancelled; }
  void completeOne();

  const UncertainMotion& system_;
  EnsembleOptions options_;
  std::vector<double> cornerLevels_;
  Sampling sampling_;
  std::vector<Box> cuts_;  // of each level of alpha
  TurnScan scan_;
  Envelope scanRange_;  // what the scan is to know of outputs, while it is gathered
  std::optional<std::vector<std::size_t>> turning_;
  std::vector<SampleBlock> first_;
  std::optional<EnsembleStatistics> statistics_;
  std::vector<FailedSample> failed_;
  std::size_t failures_ = 0, counted_ = 0, beside_ = 0, reachedTimes_;
  Table error_;
  std::size_t errorStride_;
  std::size_t nextSample_ = 0, nextBeside_,
              nextPoint_;        // to be integrated: of the plan, of the corners with the centre, of the points
  std::size_t endOfOthers_ = 0;  // than extremes, as far as it is known
  std::size_t measured_ = 0;     // so many of the plan's samples have had their share in the error
  std::size_t total_;
  std::atomic<std::size_t> done_{0};
  /// A block, and how many samples of each of its pieces have come to their ends.
  struct Current {
    SampleBlock block;
    std::vector<std::size_t> ended;
  };
  std::optional<Current> current_;
  std::vector<double> spare_;  // memory of the last block
  std::function<bool()> isPauseDue_;
  std::function<void()> pause_;
  SharedWork* shared_ = nullptr;  // while samples are integrated
};

/// How large an EnsembleRun is.
struct EnsembleSize {
  std::size_t times = 1, outputs = 1, quantities = 0, samples = 4096;
  std::size_t levels = 0;  ///< of alpha
};

/// About as many bytes as an EnsembleRun takes at most; beyond some thousands of samples their number hardly matters.
double ensembleBytes(const EnsembleSize& size);

/// As many samples as the options say of the quantities' joint distribution, independent of each other, without
/// corners, centre and points: block by block, in order, as far as that comes before it is cancelled. Which values they
/// have follows from the seed alone. Throws as EnsembleRun does.
void integrateIndependent(const UncertainMotion& system, const EnsembleOptions& options,
                          const std::function<void(const SampleBlock&)>& take);

/// These values of the uncertain quantities, integrated alone: a block of one sample. Throws as EnsembleRun does.
SampleBlock integrateValues(const UncertainMotion& system, const EnsembleOptions& options,
                            const std::vector<double>& values);

/// Sample `number` alone in a block, its trajectory bit for bit as in an EnsembleRun, by integrating its pack alone.
/// Throws as EnsembleRun does, and std::invalid_argument for a number that no sample has.
SampleBlock replaySample(const UncertainMotion& system, const EnsembleOptions& options, std::size_t number);

}  // namespace gamut
