// The elementary functions, and pairs of them:
// written by CMakeLists.txt of scalars from what stands in this folder.
#pragma once

// clang-format off
#define GAMUT_FUNCTIONS(each) \
  each(recip) \
  each(sqrt) \
  each(exp) \
  each(log) \
  each(atan) \
  each(sin) \
  each(cos) \
  each(tanh) \
  each(sech2) \
  each(abs) \
  each(sign)

#define GAMUT_TWINS(each) \
  each(sin, cos) \
  each(tanh, sech2)
