// The monomials ξ^α of the polynomials that a flow keeps: all with weighted degree (grade) Σ w_l α_l ≤ d. A weight
// above one keeps a symbol to low powers. The set is closed under division, so truncated products are sums over pairs.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace gamut {

/// Monomials in `symbols` symbols, grades rising; number 0 is the constant 1.
class Monomials {
 public:
  static constexpr int mostDegree = 40;  ///< that a flow may be asked for

  struct Pair {
    std::int32_t a, b;
  };

  /// One positive weight a symbol; degree ≥ 0. Throws std::invalid_argument beyond 20000 monomials.
  Monomials(std::vector<int> weights, int degree);
  /// The same, enumerated once for all who ask for them: their tables take longer than many a step. Of any thread.
  static std::shared_ptr<const Monomials> of(std::vector<int> weights, int degree);

  int symbols() const { return static_cast<int>(weight_.size()); }
  int degree() const { return degree_; }
  int count() const { return static_cast<int>(grade_.size()); }
  /// Number of monomials of grade ≤ q.
  int countUpTo(int q) const { return countUpTo_[q < degree_ ? q : degree_]; }
  /// The first monomial of grade q.
  int firstOf(int q) const { return q == 0 ? 0 : countUpTo(q - 1); }
  int weight(int symbol) const { return weight_[symbol]; }
  int grade(int g) const { return grade_[g]; }
  int exponent(int g, int symbol) const {
    return exponent_[static_cast<std::size_t>(g) * weight_.size() + static_cast<std::size_t>(symbol)];
  }
  /// Adds `size` to what `mass` has of each symbol in the monomial.
  void addMass(int g, double size, std::vector<double>& mass) const {
    for (std::size_t l = 0; l < mass.size(); ++l)
      if (exponent(g, static_cast<int>(l)) > 0) mass[l] += size;
  }
  /// ∏(α_l + 1): how many pairs of monomials have product g.
  double multiplicity(int g) const { return static_cast<double>(first_[static_cast<std::size_t>(g) + 1] - first_[g]); }
  /// The number of the monomial g·ξ_symbol^by, or -1 if it is not kept.
  int shifted(int g, int symbol, int by) const;
  /// The number of the monomial of `other` numbered g, whose symbols are the first ones here; -1 if it is not kept.
  int find(const Monomials& other, int g) const;
  /// The number of ξ_symbol itself, or -1 if it is not kept.
  int linear(int symbol) const { return linear_[symbol]; }

  /// pairs()[first()[g]] … pairs()[first()[g+1]-1]: every (a, b) with a·b = g.
  const std::vector<Pair>& pairs() const { return pairs_; }
  const std::vector<std::int32_t>& first() const { return first_; }
  /// products(a)[b] is the number of a·b, for as many b as have such; it rises with b.
  const std::uint16_t* products(int a) const { return &products_[firstProduct_[a]]; }
  int productCount(int a) const { return countUpTo(degree_ - grade(a)); }

 private:
  std::vector<int> weight_;
  int degree_;
  std::vector<int> grade_, countUpTo_;
  std::vector<std::uint8_t> exponent_;
  std::vector<Pair> pairs_;
  std::vector<std::int32_t> first_;
  std::vector<std::uint16_t> products_;
  std::vector<std::size_t> firstProduct_;
  std::vector<int> linear_;
  std::map<std::vector<std::uint8_t>, int> number_;
};

/// Which of these numbers is the greatest; -1 where none is above zero.
inline int greatestOf(const std::vector<double>& mass) {
  const auto most = std::ranges::max_element(mass);
  return most == mass.end() || !(*most > 0) ? -1 : static_cast<int>(most - mass.begin());
}

}  // namespace gamut
