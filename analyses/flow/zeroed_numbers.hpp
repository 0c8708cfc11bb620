// Many numbers that are 0 until they are written: pages that nobody touches take neither memory nor time.
#pragma once

#include <cstdlib>
#include <new>
#include <vector>

namespace gamut {

/// Of memory that comes zeroed; nothing is written when elements are value-initialised.
template <class T>
struct ZeroedAllocator {
  using value_type = T;

  ZeroedAllocator() = default;
  template <class U>
  ZeroedAllocator(const ZeroedAllocator<U>&) {}

  T* allocate(std::size_t count) {
    void* memory = std::calloc(count, sizeof(T));
    if (memory == nullptr) throw std::bad_alloc();
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t) { std::free(memory); }
  void construct(T*) {}
  template <class Value>
  void construct(T* place, Value&& value) {
    ::new (static_cast<void*>(place)) T(value);
  }

  friend bool operator==(const ZeroedAllocator&, const ZeroedAllocator&) { return true; }
};

/// `ZeroedNumbers(count)` is of zeros; not so what comes back within a capacity, by clear() and resize(), say.
using ZeroedNumbers = std::vector<double, ZeroedAllocator<double>>;

}  // namespace gamut
