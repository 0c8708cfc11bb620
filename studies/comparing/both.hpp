// Something of the first of two results, and the same of the second.
#pragma once

namespace gamut {

template <class T>
struct Both {
  T first, second;
};

}  // namespace gamut
