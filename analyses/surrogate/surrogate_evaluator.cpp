// Output times whose parts are the same are evaluated together: for the samples in a part, all monomials, then the
// product of the matrix of all coefficients with theirs.
#include "analyses/surrogate/surrogate_evaluator.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "analyses/flow/series/error_bounds.hpp"

namespace gamut {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Values of a monomial: those of an earlier one times a symbol.
struct Step {
  std::size_t from, quantity;
};

}  // namespace

double bytesOf(const Surrogate& surrogate, const std::vector<std::size_t>& rows) {
  double bytes = 0;
  for (std::size_t r = 0; r < surrogate.rows.size(); ++r)
    if (std::ranges::binary_search(rows, surrogate.rows[r]))
      for (const SurrogatePart& part : surrogate.at[r]) {
        bytes += 16.0 * static_cast<double>(part.part.half.size() + 1);
        for (const OutputModel& model : part.outputs) bytes += 8.0 * static_cast<double>(model.c.size() + 3);
      }
  return bytes;
}

PackedSurrogate pack(const Surrogate& surrogate, const std::vector<std::size_t>& rows, const std::vector<int>& outputs,
                     std::size_t all) {
  PackedSurrogate packed;
  const std::size_t quantities = surrogate.quantities.size();
  for (const FlowSymbol& of : surrogate.quantities) {
    packed.centre.push_back(of.symbol < 0 ? 0 : of.centre);
    packed.half.push_back(of.symbol < 0 ? 0 : of.half);
  }
  const auto own = [&](const std::vector<double>& of, double otherwise, std::vector<double>& to) {
    for (const FlowSymbol& quantity : surrogate.quantities)
      to.push_back(quantity.symbol < 0 ? otherwise : of[quantity.symbol]);
  };
  std::map<const Monomials*, std::size_t> firstTerm;
  for (std::size_t r = 0; r < surrogate.rows.size(); ++r) {
    if (!std::ranges::binary_search(rows, surrogate.rows[r])) continue;
    for (const SurrogatePart& part : surrogate.at[r]) {
      const Monomials& m = *part.monomials;
      const auto [place, isNew] =
          firstTerm.try_emplace(&m, packed.exponent.size() / std::max<std::size_t>(quantities, 1));
      for (int g = 0; isNew && g < m.count(); ++g)
        for (const FlowSymbol& quantity : surrogate.quantities)
          packed.exponent.push_back(quantity.symbol < 0 ? 0 : m.exponent(g, quantity.symbol));
      packed.row.push_back(static_cast<double>(surrogate.rows[r]));
      packed.firstTerm.push_back(static_cast<double>(place->second));
      own(part.part.centre, 0, packed.partCentre);
      own(part.part.half, 1, packed.partHalf);
      const std::size_t begin = packed.first.size();
      for (std::vector<double>* numbers : {&packed.first, &packed.count}) numbers->resize(begin + all, 0.0);
      packed.radius.resize(begin + all, std::numeric_limits<double>::quiet_NaN());
      for (std::size_t k = 0; k < outputs.size(); ++k) {
        const OutputModel& model = part.outputs[k];
        const std::size_t at = begin + static_cast<std::size_t>(outputs[k]);
        packed.first[at] = static_cast<double>(packed.coefficient.size());
        if (model.c.empty() || !std::isfinite(model.radius)) continue;
        packed.count[at] = static_cast<double>(model.c.size());
        packed.radius[at] = model.radius;
        packed.coefficient.insert(packed.coefficient.end(), model.c.begin(), model.c.end());
      }
    }
  }
  return packed;
}

/// Output times with the same parts, one behind the other.
struct SurrogateEvaluator::Group {
  struct Part {
    std::vector<double> centre, half;
    double firstTerm;
    std::vector<Step> steps;    // of all monomials but the first, the constant
    Eigen::MatrixXd c;          // [time · output][monomial]
    std::vector<double> error;  // [time · output]
  };
  std::size_t firstRow, rows;
  std::vector<Part> parts;
};

SurrogateEvaluator::~SurrogateEvaluator() = default;
SurrogateEvaluator::SurrogateEvaluator(SurrogateEvaluator&&) noexcept = default;

/// What is packed, as it is evaluated. Throws std::invalid_argument where the numbers make no surrogate.
class SurrogateEvaluator::Unpacking {
 public:
  Unpacking(const PackedSurrogate& packed, const std::vector<std::size_t>& outputs)
      : packed_(packed), outputs_(outputs), n_(packed.centre.size()) {
    const std::size_t parts = packed.row.size();
    require(parts > 0 && packed.first.size() % parts == 0);
    all_ = packed.first.size() / parts;
    terms_ = n_ == 0 ? 1 : packed.exponent.size() / n_;
    for (const std::size_t o : outputs) require(o < all_);
  }

  /// The output time of number `number` among those that are evaluated: with the group before, or a new one.
  void addRow(std::size_t number, std::size_t row, std::vector<Group>& groups) {
    const auto [begin, end] = std::ranges::equal_range(packed_.row, static_cast<double>(row));
    if (begin == end) throw std::invalid_argument("no polynomials of that time are kept");
    const std::size_t from = static_cast<std::size_t>(begin - packed_.row.begin()),
                      until = static_cast<std::size_t>(end - packed_.row.begin());
    if (!joins(groups, from, until)) {
      groups.push_back({number, 0, {}});
      for (std::size_t p = from; p < until; ++p)
        groups.back().parts.push_back(
            {slice(packed_.partCentre, p), slice(packed_.partHalf, p), packed_.firstTerm[p], {}, {}, {}});
    }
    ++groups.back().rows;
    for (std::size_t p = from; p < until; ++p) addOutputs(p, groups.back().parts[p - from]);
  }

 private:
  static void require(bool holds) {
    if (!holds) throw std::invalid_argument("the polynomials of its outputs make no sense");
  }
  std::vector<double> slice(const std::vector<double>& numbers, std::size_t place) const {
    const auto first = numbers.begin() + static_cast<std::ptrdiff_t>(place * n_);
    return {first, first + static_cast<std::ptrdiff_t>(n_)};
  }
  std::size_t firstTerm(std::size_t part) const { return static_cast<std::size_t>(packed_.firstTerm[part]); }

  /// The same parts in the same order, and not so many times that the matrices outgrow the caches?
  bool joins(const std::vector<Group>& groups, std::size_t from, std::size_t until) const {
    constexpr std::size_t mostTogether = 512;
    if (groups.empty() || groups.back().parts.size() != until - from ||
        groups.back().rows * outputs_.size() >= mostTogether)
      return false;
    for (std::size_t p = from; p < until; ++p) {
      const Group::Part& before = groups.back().parts[p - from];
      if (before.centre != slice(packed_.partCentre, p) || before.half != slice(packed_.partHalf, p) ||
          before.firstTerm != packed_.firstTerm[p])
        return false;
    }
    return true;
  }

  /// How monomials follow from each other: `count` of them from the first on.
  std::vector<Step> stepsFrom(std::size_t first, std::size_t count) {
    require(first + count <= terms_);
    auto& numbers = known_[first];
    std::vector<Step> steps;
    for (std::size_t t = 0; t < count; ++t) {
      std::vector<double> e = slice(packed_.exponent, first + t);
      numbers.try_emplace(e, t);
      const std::size_t q =
          static_cast<std::size_t>(std::ranges::find_if(e, [](double x) { return x > 0; }) - e.begin());
      require((t == 0) == (q == n_));
      if (t == 0) continue;
      e[q] -= 1;
      const auto found = numbers.find(e);
      require(found != numbers.end() && found->second < t);
      steps.push_back({found->second, q});
    }
    return steps;
  }

  /// The greatest degree of the first monomials of a part.
  double degreeOf(std::size_t part, std::size_t count) const {
    double degree = 0;
    for (std::size_t t = 0; t < count; ++t) {
      double sum = 0;
      for (std::size_t q = 0; q < n_; ++q) sum += packed_.exponent[(firstTerm(part) + t) * n_ + q];
      degree = std::max(degree, sum);
    }
    return degree;
  }

  void addOutputs(std::size_t p, Group::Part& part) {
    std::size_t count = 1;
    for (const std::size_t o : outputs_) count = std::max(count, static_cast<std::size_t>(packed_.count[p * all_ + o]));
    if (count > part.steps.size() + 1) part.steps = stepsFrom(firstTerm(p), count);
    const Eigen::Index columns = static_cast<Eigen::Index>(part.steps.size() + 1), before = part.c.rows();
    part.c.conservativeResizeLike(Eigen::MatrixXd::Zero(before + static_cast<Eigen::Index>(outputs_.size()), columns));
    double finest = 1;
    for (const double half : part.half) finest = std::min(finest, half);
    const double degree = degreeOf(p, count);
    for (std::size_t k = 0; k < outputs_.size(); ++k) {
      const std::size_t at = p * all_ + outputs_[k];
      const auto first = static_cast<std::size_t>(packed_.first[at]), own = static_cast<std::size_t>(packed_.count[at]);
      require(first + own <= packed_.coefficient.size());
      double norm = 0;
      for (std::size_t t = 0; t < own; ++t) {
        const double c = packed_.coefficient[first + t];
        part.c(before + static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(t)) = c;
        norm += std::fabs(c);
      }
      // η is off by 4 u (1 + 1/half): its quotient by 2 u, the difference from the part's middle and its quotient by
      // 1 u each; a monomial by `degree` times that and as many roundings, the sum of n products by (n + 1) u.
      const double roundings = (degree * (5 + 4 / finest) + static_cast<double>(own) + 2) * bounds::unit;
      const double error = own == 0 ? infinite : (packed_.radius[at] + roundings * norm) * bounds::up + bounds::tiny;
      part.error.push_back(std::isnan(error) ? infinite : error);
    }
  }

  const PackedSurrogate& packed_;
  const std::vector<std::size_t>& outputs_;
  std::size_t n_, all_ = 0, terms_ = 0;
  std::map<std::size_t, std::map<std::vector<double>, std::size_t>> known_;  // monomials by first term
};

SurrogateEvaluator::SurrogateEvaluator(const PackedSurrogate& surrogate, const std::vector<std::size_t>& rows,
                                       const std::vector<std::size_t>& outputs)
    : quantities_(surrogate.centre.size()),
      rows_(rows.size()),
      outputs_(outputs.size()),
      centre_(surrogate.centre),
      half_(surrogate.half),
      borders_(quantities_) {
  Unpacking unpacking(surrogate, outputs);
  for (std::size_t r = 0; r < rows.size(); ++r) unpacking.addRow(r, rows[r], groups_);
  for (const Group& group : groups_)
    for (const Group::Part& part : group.parts)
      for (std::size_t q = 0; q < quantities_; ++q)
        for (const double border : {part.centre[q] - part.half[q], part.centre[q] + part.half[q]})
          if (std::fabs(border) < 1) borders_[q].push_back(border);
  for (std::vector<double>& borders : borders_) {
    std::ranges::sort(borders);
    borders.erase(std::unique(borders.begin(), borders.end()), borders.end());
  }
}

void SurrogateEvaluator::settle(std::span<double> values) const {
  constexpr double near = 16 * bounds::unit;  // ξ is off by 2 u
  for (std::size_t q = 0; q < quantities_; ++q) {
    const auto xi = [&] { return (values[q] - centre_[q]) / half_[q]; };
    for (const double border : borders_[q])
      while (std::fabs(xi() - border) <= near)  // at least to the next number, which beside 0 is no step at all
        values[q] = std::max(std::nextafter(values[q], infinite), values[q] + near * half_[q]);
  }
}

/// At most `together` samples, and how they are evaluated.
class SurrogateEvaluator::Block {
 public:
  explicit Block(const SurrogateEvaluator& of) : evaluator_(of), xi_(together * of.quantities_) {}

  void take(std::span<const double> values, std::size_t count) {
    const std::size_t n = evaluator_.quantities_;
    count_ = count;
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t q = 0; q < n; ++q)
        xi_[i * n + q] =
            evaluator_.half_[q] == 0 ? 0.0 : (values[i * n + q] - evaluator_.centre_[q]) / evaluator_.half_[q];
  }

  /// A group's outputs of each sample to where it begins, `stride` behind those of the sample before, and, unless there
  /// is no room for them, their errors.
  void evaluate(const Group& group, double* outputs, double* errors, std::size_t stride) {
    const std::size_t n = evaluator_.quantities_, cells = group.rows * evaluator_.outputs_;
    members_.assign(group.parts.size(), {});
    for (std::size_t i = 0; i < count_; ++i) {
      std::size_t p = 0;
      const auto isIn = [&](const Group::Part& part) {
        for (std::size_t q = 0; q < n; ++q)
          if (std::fabs(xi_[i * n + q] - part.centre[q]) > part.half[q] && part.half[q] < 1) return false;
        return true;
      };
      while (p + 1 < group.parts.size() && !isIn(group.parts[p])) ++p;
      members_[p].push_back(i);
    }
    for (std::size_t p = 0; p < group.parts.size(); ++p) {
      const Group::Part& part = group.parts[p];
      const std::vector<std::size_t>& own = members_[p];
      if (own.empty()) continue;
      const auto m = static_cast<Eigen::Index>(own.size());
      Eigen::MatrixXd eta(m, static_cast<Eigen::Index>(n));
      for (Eigen::Index i = 0; i < m; ++i)
        for (std::size_t q = 0; q < n; ++q)
          eta(i, static_cast<Eigen::Index>(q)) =
              std::clamp((xi_[own[i] * n + q] - part.centre[q]) / part.half[q], -1.0, 1.0);
      monomials_.resize(m, part.c.cols());
      monomials_.col(0).setOnes();
      for (std::size_t t = 0; t < part.steps.size(); ++t)
        monomials_.col(static_cast<Eigen::Index>(t + 1)) =
            monomials_.col(static_cast<Eigen::Index>(part.steps[t].from))
                .cwiseProduct(eta.col(static_cast<Eigen::Index>(part.steps[t].quantity)));
      results_.noalias() = part.c * monomials_.transpose();
      for (Eigen::Index i = 0; i < m; ++i) {
        const std::size_t at = own[i] * stride;
        std::copy_n(results_.col(i).data(), cells, outputs + at);
        if (errors != nullptr) std::ranges::copy(part.error, errors + at);
      }
    }
  }

 private:
  const SurrogateEvaluator& evaluator_;
  std::size_t count_ = 0;
  std::vector<double> xi_;
  std::vector<std::vector<std::size_t>> members_;
  Eigen::MatrixXd monomials_, results_;
};

void SurrogateEvaluator::evaluate(std::span<const double> values, std::span<double> outputs,
                                  std::span<double> errors) const {
  const std::size_t stride = rows_ * outputs_, samples = outputs.size() / std::max<std::size_t>(stride, 1);
  Block block(*this);
  for (std::size_t first = 0; first < samples; first += together) {
    block.take(values.subspan(first * quantities_), std::min(together, samples - first));
    for (const Group& group : groups_) {
      const std::size_t at = first * stride + group.firstRow * outputs_;
      block.evaluate(group, outputs.data() + at, errors.data() + at, stride);
    }
  }
}

std::vector<SurrogateEvaluator::Slice> SurrogateEvaluator::slices() const {
  std::vector<Slice> slices;
  for (const Group& group : groups_) slices.push_back({group.firstRow, group.rows});
  return slices;
}

void SurrogateEvaluator::evaluate(std::size_t slice, std::span<const double> values, std::span<double> outputs) const {
  const Group& group = groups_[slice];
  const std::size_t stride = group.rows * outputs_, samples = outputs.size() / std::max<std::size_t>(stride, 1);
  Block block(*this);
  for (std::size_t first = 0; first < samples; first += together) {
    block.take(values.subspan(first * quantities_), std::min(together, samples - first));
    block.evaluate(group, outputs.data() + first * stride, nullptr, stride);
  }
}

}  // namespace gamut
