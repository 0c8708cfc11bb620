# Refuses flags under which no bound of Gamut is a bound any more: they let the compiler re-associate sums, divide by
# reciprocals, assume that there are no infinities, NaN or signed zeros, compute in other precisions, or flush subnormals
# (as a program does that is only linked with -ffast-math). The headers refuse what they can see once more where they
# are compiled (scalars/elementary/rounding.hpp).
function(gamut_refuse_fast_math)
  get_directory_property(compile_options COMPILE_OPTIONS)
  get_directory_property(link_options LINK_OPTIONS)
  set(flags "${compile_options} ${link_options}")
  foreach(kind C_FLAGS CXX_FLAGS EXE_LINKER_FLAGS SHARED_LINKER_FLAGS MODULE_LINKER_FLAGS)
    string(APPEND flags " ${CMAKE_${kind}}")
    foreach(config DEBUG RELEASE RELWITHDEBINFO MINSIZEREL ${CMAKE_BUILD_TYPE} ${CMAKE_CONFIGURATION_TYPES})
      string(TOUPPER "${config}" config)
      string(APPEND flags " ${CMAKE_${kind}_${config}}")
    endforeach()
  endforeach()
  set(math "fast-math|unsafe-math-optimizations|associative-math|reciprocal-math|finite-math-only")
  set(clang_math "fp-model=fast|approx-func|no-honor-nans|no-honor-infinities|denormal-fp-math=p[a-z-]*")
  string(REGEX MATCH "-(Ofast|f(${math}|${clang_math}|no-signed-zeros|single-precision-constant)|mfpmath=[a-z,]*(387|both))"
    unsafe "${flags}")
  if(unsafe)
    message(FATAL_ERROR "${unsafe} is refused: under it no enclosure would be guaranteed. Remove it from the compiler flags.")
  endif()
endfunction()
