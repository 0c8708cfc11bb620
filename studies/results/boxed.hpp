// A value of a class that others are derived from; copies are of what it really is.
#pragma once

#include <memory>
#include <utility>

namespace gamut {

/// T has `std::unique_ptr<T> copy() const`. Empty only when it was moved from.
template <class T>
class Boxed {
 public:
  explicit Boxed(std::unique_ptr<T> value) : value_(std::move(value)) {}
  Boxed(const Boxed& other) : value_(other.value_->copy()) {}
  Boxed(Boxed&&) noexcept = default;
  Boxed& operator=(const Boxed& other) {
    value_ = other.value_->copy();
    return *this;
  }
  Boxed& operator=(Boxed&&) noexcept = default;
  ~Boxed() = default;

  T& operator*() { return *value_; }
  const T& operator*() const { return *value_; }
  T* operator->() { return value_.get(); }
  const T* operator->() const { return value_.get(); }

 private:
  std::unique_ptr<T> value_;
};

}  // namespace gamut
