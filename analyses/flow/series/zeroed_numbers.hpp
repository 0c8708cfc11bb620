// Many numbers that are 0 until they are written: pages of large blocks take memory only then.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>

namespace gamut {

class ZeroedNumbers {
 public:
  ZeroedNumbers() = default;
  explicit ZeroedNumbers(std::size_t count)
      : numbers_(static_cast<double*>(std::calloc(count, sizeof(double)))), size_(count) {
    if (!numbers_ && count > 0) throw std::bad_alloc();
  }

  double& operator[](std::size_t i) { return numbers_[i]; }
  const double& operator[](std::size_t i) const { return numbers_[i]; }
  double* begin() { return numbers_.get(); }
  double* end() { return numbers_.get() + size_; }
  std::size_t size() const { return size_; }

 private:
  struct Free {
    void operator()(double* numbers) const { std::free(numbers); }
  };

  std::unique_ptr<double[], Free> numbers_;
  std::size_t size_ = 0;
};

}  // namespace gamut
