// A list of things with names of their own, each found as fast however many there are.
#pragma once

#include <functional>
#include <iterator>
#include <list>
#include <string>
#include <unordered_map>
#include <utility>

namespace gamut {

/// In the order in which they were added. `key`: where a T has its name.
template <class T, std::string T::*key = &T::name>
class Named {
 public:
  Named() = default;
  Named(const Named& other) : things_(other.things_) { index(); }
  Named(Named&& other) noexcept : things_(std::move(other.things_)), places_(std::move(other.places_)) {}
  Named& operator=(Named other) noexcept {
    things_.swap(other.things_);
    places_.swap(other.places_);
    return *this;
  }
  ~Named() = default;

  /// Its name is no other's.
  T& add(T thing) {
    things_.push_back(std::move(thing));
    places_.emplace(things_.back().*key, std::prev(things_.end()));
    return things_.back();
  }
  void erase(const std::string& name) {
    const auto place = places_.find(name);
    if (place == places_.end()) return;
    things_.erase(place->second);
    places_.erase(place);
  }

  /// Null if none has the name.
  T* find(const std::string& name) {
    const auto place = places_.find(name);
    return place == places_.end() ? nullptr : &*place->second;
  }
  const T* find(const std::string& name) const {
    const auto place = places_.find(name);
    return place == places_.end() ? nullptr : &*place->second;
  }

  auto begin() const { return things_.begin(); }
  auto end() const { return things_.end(); }
  auto rbegin() { return things_.rbegin(); }
  auto rend() { return things_.rend(); }
  bool empty() const { return things_.empty(); }
  std::size_t size() const { return things_.size(); }

 private:
  void index() {
    for (auto thing = things_.begin(); thing != things_.end(); ++thing) places_.emplace((*thing).*key, thing);
  }

  std::list<T> things_;  // whose places stay
  std::unordered_map<std::string, typename std::list<T>::iterator> places_;
};

}  // namespace gamut
