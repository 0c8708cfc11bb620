// Single motions that violate a requirement: collected from samples, proved one by one by flows of their own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace gamut {

class Archive;
struct Results;
struct Run;
struct SampledMotion;
struct Study;

/// Values that may violate a requirement, one a quantity. Of what varies in time, the number that chooses its course,
/// as samples draw it; NaN: whatever it does.
struct Suspect {
  std::vector<double> values;
  std::int64_t sample = -1;  ///< that has these values; -1: none
  double margin = 0;         ///< its least (greatest of what is to be once), as sampled
  bool violates = false;     ///< at the output times, as sampled
};

/// The samples that violate a requirement, or come closest to that: so many of the worst.
class Suspects {
 public:
  void add(Suspect suspect);
  /// The worst first.
  std::vector<Suspect> sorted() const;
  void archive(Archive& all);

 private:
  std::vector<Suspect> all_;
};

/// Proves by thin flows that requirement `number` is violated: by one of the samples, the worst first, or by one of
/// `others`, whose values models suspect. Fills what is known of the violation; else says why that of the worst sample
/// is not proved, in words, or nothing.
std::string findViolation(const Run& run, const SampledMotion& samples, std::size_t number, std::vector<Suspect> others,
                          Results& results);

/// Whether the worst sample violates it by more than the error of its integration.
bool isViolatedInSimulation(const Study& study, const Results& results, std::size_t number);
/// Whether it comes as near to the limit as that error.
bool isJustMet(const Study& study, const Results& results, std::size_t number);

}  // namespace gamut
