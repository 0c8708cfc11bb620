// Outputs for given values of the uncertain quantities, each with its proved error: many a microsecond.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "analyses/surrogate/packed_surrogate.hpp"
#include "analyses/surrogate/surrogate.hpp"

namespace gamut {

/// Outputs numbered as `outputs` says, of so many in all; of others there is nothing. Rows whose number is not among
/// `rows` (rising) are left out.
PackedSurrogate pack(const Surrogate& surrogate, const std::vector<std::size_t>& rows, const std::vector<int>& outputs,
                     std::size_t all);

/// About as many bytes as the rows take.
double bytesOf(const Surrogate& surrogate, const std::vector<std::size_t>& rows);

class SurrogateEvaluator {
 public:
  /// Of these output times, which the surrogate has, and these outputs. Throws std::invalid_argument for a time that it
  /// has not, and for numbers that make no surrogate.
  SurrogateEvaluator(const PackedSurrogate& surrogate, const std::vector<std::size_t>& rows,
                     const std::vector<std::size_t>& outputs);
  ~SurrogateEvaluator();
  SurrogateEvaluator(SurrogateEvaluator&&) noexcept;

  /// Moves values (one a quantity) that lie where parts of the box meet by some roundings, so that each lies in one.
  void settle(std::span<double> values) const;

  /// `values`: of settled samples, [sample][quantity]. `outputs` and `errors` become [sample][time][output]: the output
  /// is not farther from that than its error; infinite where nothing is known.
  void evaluate(std::span<const double> values, std::span<double> outputs, std::span<double> errors) const;

  /// Output times that are evaluated together: so many from `first` on. Slices follow one another.
  struct Slice {
    std::size_t first, count;
  };
  std::vector<Slice> slices() const;
  /// The outputs of one slice, by its number, without their errors, [sample][time of the slice][output]: bit for bit
  /// what `evaluate` gives, also of blocks of samples one by one, so long as all but the last hold a multiple of
  /// `together`.
  void evaluate(std::size_t slice, std::span<const double> values, std::span<double> outputs) const;
  static constexpr std::size_t together = 256;

 private:
  struct Group;
  class Block;
  class Unpacking;
  std::size_t quantities_, rows_, outputs_;
  std::vector<double> centre_, half_;
  std::vector<std::vector<double>> borders_;  // [quantity]: ξ inside [-1,1] where parts meet, rising
  std::vector<Group> groups_;
};

}  // namespace gamut
