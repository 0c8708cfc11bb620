// Enumerates the monomials by grade and lists, for each, the pairs that multiply to it.
#include "analyses/flow/series/monomials.hpp"

#include <functional>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>

namespace gamut {

namespace {
constexpr std::size_t most = 20000;
}

Monomials::Monomials(std::vector<int> weights, int degree) : weight_(std::move(weights)), degree_(degree) {
  const std::size_t k = weight_.size();
  for (int q = 0; q <= degree; ++q) {
    std::vector<std::uint8_t> e(k, 0);
    const std::function<void(std::size_t, int)> fill = [&](std::size_t symbol, int left) {
      if (symbol == k) {
        if (left != 0) return;
        number_[e] = count();
        grade_.push_back(q);
        exponent_.insert(exponent_.end(), e.begin(), e.end());
        if (grade_.size() > most)
          throw std::invalid_argument("polynomials of degree " + std::to_string(degree) + " in " + std::to_string(k) +
                                      " uncertain quantities have more than " + std::to_string(most) +
                                      " terms; expected a lower degree");
        return;
      }
      for (int power = left / weight_[symbol]; power >= 0; --power) {
        e[symbol] = static_cast<std::uint8_t>(power);
        fill(symbol + 1, left - power * weight_[symbol]);
      }
      e[symbol] = 0;
    };
    fill(0, q);
    countUpTo_.push_back(count());
  }
  std::vector<std::uint8_t> a(k), b(k);
  for (int g = 0; g < count(); ++g) {
    first_.push_back(static_cast<std::int32_t>(pairs_.size()));
    // All a that divide g, by counting in mixed base.
    std::fill(a.begin(), a.end(), std::uint8_t{0});
    for (bool more = true; more;) {
      for (std::size_t l = 0; l < k; ++l) b[l] = static_cast<std::uint8_t>(exponent(g, static_cast<int>(l)) - a[l]);
      pairs_.push_back({number_.at(a), number_.at(b)});
      more = false;
      for (std::size_t l = 0; l < k && !more; ++l) {
        if (a[l] < exponent(g, static_cast<int>(l))) {
          ++a[l];
          more = true;
        } else {
          a[l] = 0;
        }
      }
    }
  }
  first_.push_back(static_cast<std::int32_t>(pairs_.size()));
  // Multiplying keeps the order of monomials, so products are met in the order of their other factor.
  firstProduct_.push_back(0);
  for (int g = 0; g < count(); ++g)
    firstProduct_.push_back(firstProduct_.back() + static_cast<std::size_t>(productCount(g)));
  products_.resize(pairs_.size());
  for (int g = 0; g < count(); ++g)
    for (auto q = static_cast<std::size_t>(first_[g]);
         q < static_cast<std::size_t>(first_[static_cast<std::size_t>(g) + 1]); ++q)
      products_[firstProduct_[pairs_[q].a] + static_cast<std::size_t>(pairs_[q].b)] = static_cast<std::uint16_t>(g);
  for (int l = 0; l < symbols(); ++l) linear_.push_back(shifted(0, l, 1));
}

std::shared_ptr<const Monomials> Monomials::of(std::vector<int> weights, int degree) {
  constexpr std::size_t mostPairs = 1'000'000;  // kept, some 10 MB
  static std::mutex mutex;
  static std::map<std::pair<std::vector<int>, int>, std::shared_ptr<const Monomials>> kept;
  static std::size_t pairs = 0;
  std::pair key(std::move(weights), degree);
  {
    const std::scoped_lock lock(mutex);
    if (const auto found = kept.find(key); found != kept.end()) return found->second;
  }
  auto made = std::make_shared<const Monomials>(key.first, degree);
  const std::scoped_lock lock(mutex);
  if (pairs + made->pairs().size() > mostPairs) {
    kept.clear();
    pairs = 0;
  }
  if (made->pairs().size() <= mostPairs && kept.emplace(std::move(key), made).second) pairs += made->pairs().size();
  return made;
}

int Monomials::shifted(int g, int symbol, int by) const {
  std::vector<std::uint8_t> e(weight_.size());
  for (std::size_t l = 0; l < e.size(); ++l) e[l] = static_cast<std::uint8_t>(exponent(g, static_cast<int>(l)));
  const int power = e[symbol] + by;
  if (power < 0) return -1;
  e[symbol] = static_cast<std::uint8_t>(power);
  const auto found = number_.find(e);
  return found == number_.end() ? -1 : found->second;
}

int Monomials::find(const Monomials& other, int g) const {
  if (other.weight_ == weight_) return g < count() ? g : -1;  // enumerated alike
  std::vector<std::uint8_t> e(weight_.size(), 0);
  for (int l = 0; l < other.symbols(); ++l) e[l] = static_cast<std::uint8_t>(other.exponent(g, l));
  const auto found = number_.find(e);
  return found == number_.end() ? -1 : found->second;
}

}  // namespace gamut
