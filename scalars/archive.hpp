// Exact copies of objects as bytes, and the same objects from these: every number bit for bit. A class says once what
// it consists of, and is written and read by that:
//
//     void Piece::archive(Archive& all) { all(set, layout, path); }
//
// or by a function `archive(Archive&, Piece&)` beside it. What several pointers share they share in the copy too. The
// bytes are for the program that wrote them, on the machine on which it did: they say nothing of themselves.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "scalars/interval.hpp"

namespace gamut {

class Archive {
 public:
  using Put = std::function<void(const void* bytes, std::size_t size)>;
  using Take = std::function<void(void* bytes, std::size_t size)>;

  static Archive writing(Put put) { return {std::move(put), {}}; }
  static Archive reading(Take take) { return {{}, std::move(take)}; }

  bool isReading() const { return static_cast<bool>(take_); }

  /// Before all else: an object that writer and reader have already. Pointers to it are to that one again.
  template <class T>
  void share(const std::shared_ptr<T>& pointer) {
    if (numbers_.try_emplace(pointer.get(), numbers_.size() + 1).second && isReading())
      objects_.push_back(std::const_pointer_cast<std::remove_const_t<T>>(pointer));
  }

  /// Writes or reads these, one after the other: plain numbers and structures of such, what says itself how, and the
  /// standard library's containers, shared pointers and optionals of all these. A T that is shared and cannot be made
  /// of nothing is read by `std::shared_ptr<T> archived(Archive&, const T*)`; the pointer is null.
  template <class... T>
  void operator()(T&... values) {
    (value(values), ...);
  }

  /// Writes or reads what lies in these places, which are there.
  template <class T>
  void bytes(std::span<T> places) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes(places.data(), places.size_bytes());
  }

 private:
  Archive(Put put, Take take) : put_(std::move(put)), take_(std::move(take)) {}

  template <class T>
  static constexpr bool hasMember = requires(T& x, Archive& all) {
    x.archive(all);
  };
  template <class T>
  static constexpr bool hasFunction = requires(T& x, Archive& all) {
    archive(all, x);
  };
  template <class T>
  static constexpr bool isPlain =
      std::is_trivially_copyable_v<T> && !std::is_pointer_v<T> && !hasMember<T> && !hasFunction<T>;

  void bytes(void* at, std::size_t size) {
    if (size == 0) return;
    isReading() ? take_(at, size) : put_(at, size);
  }
  std::size_t sizeOf(std::size_t size) {
    std::uint64_t count = size;
    bytes(&count, sizeof count);
    return count;
  }

  template <class T>
  void value(T& x) {
    if constexpr (hasMember<T>) {
      x.archive(*this);
    } else if constexpr (hasFunction<T>) {
      archive(*this, x);
    } else {
      static_assert(isPlain<T>, "does not say what it consists of");
      bytes(&x, sizeof x);
    }
  }

  void value(Interval& x) {
    double lower = x.lower(), upper = x.upper();
    (*this)(lower, upper);
    if (isReading()) x = std::isnan(lower) ? Interval::empty() : Interval(lower, upper);
  }

  void value(std::string& text) {
    text.resize(sizeOf(text.size()));
    bytes(text.data(), text.size());
  }

  template <class T>
  void value(std::vector<T>& list) {
    static_assert(!std::is_same_v<T, bool>);
    list.resize(sizeOf(list.size()));
    if constexpr (isPlain<T>)
      bytes(list.data(), list.size() * sizeof(T));
    else
      for (T& x : list) value(x);
  }

  template <class T, std::size_t size>
  void value(std::array<T, size>& list) {
    for (T& x : list) value(x);
  }

  template <class A, class B>
  void value(std::pair<A, B>& both) {
    (*this)(both.first, both.second);
  }

  template <class K, class V>
  void value(std::map<K, V>& map) {
    std::size_t size = sizeOf(map.size());
    if (!isReading()) {
      for (auto& [key, of] : map) (*this)(const_cast<K&>(key), of);
      return;
    }
    for (map.clear(); size > 0; --size) {
      std::pair<K, V> entry;
      value(entry);
      map.insert(map.end(), std::move(entry));
    }
  }

  template <class T>
  void value(std::optional<T>& x) {
    bool isThere = x.has_value();
    value(isThere);
    if (!isThere) x.reset();
    if (isThere && !x) x.emplace();
    if (isThere) value(*x);
  }

  template <class T>
  void value(std::shared_ptr<T>& pointer) {
    using Object = std::remove_const_t<T>;
    if (isReading()) {
      read<Object>(pointer);
      return;
    }
    const auto [found, isNew] =
        pointer ? numbers_.try_emplace(pointer.get(), numbers_.size() + 1) : std::pair(numbers_.end(), false);
    std::uint64_t number = pointer ? found->second : 0;
    value(number);
    if (isNew) value(const_cast<Object&>(*pointer));
  }

  template <class Object, class Pointer>
  void read(Pointer& pointer) {
    std::uint64_t number = 0;
    value(number);
    pointer.reset();
    if (number == 0) return;
    if (number > objects_.size() + 1) throw std::runtime_error("a shared object is missing");
    if (number <= objects_.size()) {
      pointer = std::static_pointer_cast<Object>(objects_[number - 1]);
      return;
    }
    if constexpr (std::is_default_constructible_v<Object>) {
      const auto object = std::make_shared<Object>();
      objects_.push_back(object);
      value(*object);
      pointer = object;
    } else {
      const std::shared_ptr<Object> object = archived(*this, static_cast<const Object*>(nullptr));
      objects_.push_back(object);
      pointer = object;
    }
  }

  Put put_;
  Take take_;
  std::unordered_map<const void*, std::uint64_t> numbers_;  // of what was written, from 1 on
  std::vector<std::shared_ptr<void>> objects_;              // that were read
};

}  // namespace gamut
