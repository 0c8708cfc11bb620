// The ranges of φ(0) and of the Jacobian by polynomials in the parameters, on parts of their box where the whole is too
// wide.
#include "analyses/roots/root_family.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <utility>
#include <vector>

#include "analyses/flow/flow.hpp"
#include "analyses/flow/image.hpp"
#include "scalars/program/differentiation.hpp"

namespace gamut {
namespace {

/// The degree up to which so many symbols have some `most` monomials.
int degreeOf(const Box& box, int quantities, double most) {
  constexpr int highest = 10;
  const auto wide = std::count_if(box.begin(), box.begin() + quantities, [](const Interval& x) { return !isThin(x); });
  int degree = 1;
  for (double count = 1.0 + static_cast<double>(wide); degree < highest; ++degree) {
    count *= static_cast<double>(wide + degree + 1) / (degree + 1);
    if (count > most) break;
  }
  return degree;
}

constexpr double mostMonomials = 500;

double largestOf(const Box& box) {
  double largest = 0;
  for (const Interval& each : box) largest = std::max(largest, magnitude(each));
  return largest;
}

class Prover {
 public:
  Prover(const Program& newton, const Box& parameters, int quantities, double enough,
         const std::function<bool(double)>& goesOn)
      : newton_(newton),
        slopes_(forwardDifferentiated(newton)),
        whole_(parameters),
        enough_(enough),
        goesOn_(goesOn),
        n_(newton.states()),
        quantities_(quantities < 0 ? newton.parameters() : quantities),
        radii_(n_, 0.0) {
    for (int i = n_ + quantities_; i < n_ + newton.parameters(); ++i) narrow_.push_back(i);
    all_ = narrow_;
    for (int i = 0; i < n_; ++i) all_.push_back(i);
    for (const Node& node : newton.nodes())
      if (node.op == Op::parameter) asked_.insert(node.a);
  }

  /// Roots of neighbouring parts are of one family where each lies in what the other's is alone in: else once more,
  /// with boxes of the widest there was.
  RootFamily prove() {
    constexpr int rounds = 4;
    for (int round = 0; round < rounds; ++round) {
      parts_.clear();
      done_ = 0;
      if (std::optional<Box> open = proveParts()) return {{}, {}, std::move(open)};
      refine();
      const RootFamily family = together();
      bool all = true;
      for (int k = 0; k < n_; ++k) all = all && isSubset(family.remainder[k], family.alone[k]);
      if (all) return family;
    }
    return {{}, {}, whole_};
  }

 private:
  static constexpr int mostHalvings = 256;

  struct Part {
    Box parameters, image, delta;
    double largest() const { return largestOf(image); }
  };

  /// One that is not proved; nothing where all are.
  std::optional<Box> proveParts() {
    int halvings = 0;
    std::vector<Box> open{whole_};
    while (!open.empty()) {
      const Box part = std::move(open.back());
      open.pop_back();
      if (std::optional<Part> proved = prove(part)) {
        done_ += shareOf(part);
        parts_.push_back(std::move(*proved));
        continue;
      }
      const int widest = widestOf(part);
      if (widest < 0 || ++halvings > mostHalvings || isOver()) return part;
      for (const Box& half : halvesOf(part, widest)) open.push_back(half);
    }
    return {};
  }

  /// Halves parts of which much is left open, while that costs little and helps.
  void refine() {
    constexpr int most = 24;
    constexpr double inVain = 0.9;  // of what was left open before
    for (int i = 0; i < most; ++i) {
      const auto loosest = std::ranges::max_element(parts_, {}, &Part::largest);
      const int widest = widestOf(loosest->parameters);
      if (widest < 0 || loosest->largest() <= enough_ || isOver()) return;
      const std::array<Box, 2> halves = halvesOf(loosest->parameters, widest);
      std::optional<Part> lower = prove(halves[0]), upper = prove(halves[1]);
      if (!lower || !upper || std::max(lower->largest(), upper->largest()) > inVain * loosest->largest()) return;
      *loosest = std::move(*lower);
      parts_.push_back(std::move(*upper));
    }
  }

  RootFamily together() const {
    RootFamily family{parts_.front().image, parts_.front().delta, {}};
    for (const Part& part : parts_)
      for (int k = 0; k < n_; ++k) {
        family.remainder[k] = hull(family.remainder[k], part.image[k]);
        family.alone[k] = intersection(family.alone[k], part.delta[k]);
      }
    return family;
  }

  static std::array<Box, 2> halvesOf(const Box& part, int component) {
    std::array<Box, 2> both{part, part};
    const auto [lower, upper] = bisect(part[component]);
    both[0][component] = lower;
    both[1][component] = upper;
    return both;
  }

  /// Of the whole box.
  double shareOf(const Box& part) const {
    double share = 1;
    for (int i = 0; i < quantities_; ++i)
      if (!isThin(whole_[i])) share *= width(part[i]) / width(whole_[i]);
    return share;
  }

  /// Of what is wide, as a part of what it was, and moves the roots.
  int widestOf(const Box& part) const {
    int widest = -1;
    double most = 0x1p-8;
    for (int i = 0; i < quantities_; ++i) {
      if (!asked_.contains(i)) continue;
      const double share = width(part[i]) / width(whole_[i]);
      if (share > most) {
        most = share;
        widest = i;
      }
    }
    return widest;
  }

  bool isOver() const { return goesOn_ && !goesOn_(done_); }

  static Box joined(Box delta, const Box& part) {
    delta.insert(delta.end(), part.begin(), part.end());
    return delta;
  }

  Box imageAt0(const Box& part, int degree) const {
    return encloseImage(newton_, 0.0, joined(Box(n_, Interval(0.0)), part), {}, degree, nullptr, narrow_)[0];
  }

  /// ∂φ/∂δ row by row, for all δ of this box; without a degree, δ are symbols too.
  Box slopesOn(const Box& delta, const Box& part, int degree) const {
    const Box all =
        encloseImage(slopes_, 0.0, joined(delta, part), {}, degree, nullptr, degree < 0 ? narrow_ : all_)[0];
    return {all.begin() + n_, all.end()};
  }

  /// φ(δ) of all δ of a box that holds 0, by the mean value theorem.
  Box imageOf(const Box& at0, const Box& slopes, const Box& delta) const {
    Box image = at0;
    for (int i = 0; i < n_; ++i)
      for (int j = 0; j < n_; ++j) image[i] += slopes[i * n_ + j] * delta[j];
    return image;
  }

  static bool isKnown(const Box& box) {
    return std::ranges::all_of(box, [](const Interval& each) { return isBounded(each) && !isEmpty(each); });
  }

  /// Nothing where it is not proved.
  std::optional<Part> prove(const Box& part) {
    constexpr int low = 4;  // is enough of narrow tolerances
    const int high = degreeOf(part, quantities_, mostMonomials);
    Box at0 = imageAt0(part, std::min(low, high));
    if (high > low && (!isKnown(at0) || largestOf(at0) > enough_)) at0 = imageAt0(part, high);
    if (!isKnown(at0)) return {};
    std::vector<double> r = radii_;
    const auto widen = [&](const Box& image) {  // what is 0 gets room to map into too
      const double least = 0x1p-10 * largestOf(image);
      for (int k = 0; k < n_; ++k) r[k] = std::max({r[k], 2 * magnitude(image[k]), least, 0x1p-1000});
    };
    widen(at0);
    constexpr int tries = 12;
    constexpr double narrow = 1e-5;   // where symbols would tell little more
    constexpr double hopeless = 100;  // times what it began with
    std::vector<int> degrees{std::min(degreeOf(part, quantities_, mostMonomials), 3)};
    if (std::ranges::any_of(r, [](double radius) { return radius > narrow; })) degrees.push_back(-1);
    auto degree = degrees.begin();
    for (int i = 0; i < tries && !isOver(); ++i) {
      Box delta;
      for (const double radius : r) delta.emplace_back(-radius, radius);
      const Box slopes = slopesOn(delta, part, *degree);
      const Box image = isKnown(slopes) ? imageOf(at0, slopes, delta) : slopes;
      if (isKnown(image) && mapsInside(image, r) && contracts(slopes, r)) {
        radii_ = r;
        Box around0;  // once more, of the image
        for (const Interval& each : image) around0.push_back(hull(each, Interval(0.0)));
        const bool isEnough = largestOf(image) <= enough_;
        return Part{part, imageOf(at0, isEnough ? slopes : slopesOn(around0, part, *degree), around0), delta};
      }
      if (degree + 1 != degrees.end()) {
        ++degree;
        continue;
      }
      if (!isKnown(image) || largestOf(image) > hopeless * largestOf(at0)) return {};
      widen(image);
    }
    return {};
  }

  bool mapsInside(const Box& image, const std::vector<double>& r) const {
    for (int k = 0; k < n_; ++k)
      if (!(magnitude(image[k]) < r[k])) return false;
    return true;
  }

  bool contracts(const Box& slopes, const std::vector<double>& r) const {
    for (int i = 0; i < n_; ++i) {
      Interval sum(0.0);
      for (int j = 0; j < n_; ++j) sum += Interval(magnitude(slopes[i * n_ + j])) * Interval(r[j]);
      if (!(sum.upper() < r[i])) return false;
    }
    return true;
  }

  const Program& newton_;
  Program slopes_;
  Box whole_;
  double enough_;
  const std::function<bool(double)>& goesOn_;
  int n_, quantities_;
  std::set<int> asked_;            // parameters that the map asks for
  std::vector<int> narrow_, all_;  // what carries no symbol: parameters that are none, δ too
  std::vector<double> radii_;      // of the box about 0, the widest so far
  std::vector<Part> parts_;
  double done_ = 0;  // share of the box that is proved
};

}  // namespace

RootFamily proveRoots(const Program& newton, const Box& parameters, int quantities, double enough,
                      const std::function<bool(double)>& goesOn) {
  return Prover(newton, parameters, quantities, enough, goesOn).prove();
}

Program approximated(const Program& steps, const Box& parameters, double share) {
  return recordPolynomials(steps, parameters, degreeFor(parameters, share));
}

int degreeFor(const Box& parameters, double share) {
  return degreeOf(parameters, static_cast<int>(parameters.size()), share * mostMonomials);
}

Program approached(const Program& step, const Box& parameters) {
  constexpr int highest = 6;
  const int k = step.parameters(), degree = std::min(degreeOf(parameters, k, mostMonomials), highest);
  Program at = record(0, k, step.outputs(), [](auto, const auto&, const auto&, auto&) {});
  for (int power = 1; power <= degree; ++power) {
    const Program next = record(0, k, step.outputs(), [&](auto t, const auto&, const auto& p, auto& y) {
      const std::vector<Recorded> all(p.begin(), p.end());
      std::ranges::copy(written(step, written(at, {}, all, t), all, t), y.begin());
    });
    at = recordPolynomials(next, parameters, power);
  }
  return at;
}

}  // namespace gamut
