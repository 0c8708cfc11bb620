// The scalars that class templates of mechanics are compiled for, each once, in the library.
#pragma once

#include "scalars/interval.hpp"

namespace gamut {

class Fuzzy;
class Recorded;
class Samples;

}  // namespace gamut

/// MACRO(X, double) MACRO(X, Interval) …
#define GAMUT_FOR_EVERY_SCALAR(MACRO, X) \
  MACRO(X, double) MACRO(X, gamut::Interval) MACRO(X, gamut::Samples) MACRO(X, gamut::Fuzzy) MACRO(X, gamut::Recorded)

/// Behind a class template, in its header; and behind the members of it, in its source.
#define GAMUT_COMPILED_ELSEWHERE(CLASS) GAMUT_FOR_EVERY_SCALAR(GAMUT_DECLARE_CLASS, CLASS)
#define GAMUT_COMPILED_HERE(CLASS) GAMUT_FOR_EVERY_SCALAR(GAMUT_COMPILE_CLASS, CLASS)
#define GAMUT_DECLARE_CLASS(CLASS, SCALAR) extern template class CLASS<SCALAR>;
#define GAMUT_COMPILE_CLASS(CLASS, SCALAR) template class CLASS<SCALAR>;
