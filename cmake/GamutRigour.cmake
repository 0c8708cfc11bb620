# Refuses flags under which no bound of Gamut is a bound any more: they let the compiler re-associate sums, assume that
# there are no infinities or NaN, or flush subnormals. The headers refuse -ffast-math once more where they are compiled.
function(gamut_refuse_fast_math)
  get_directory_property(options COMPILE_OPTIONS)
  set(flags "${options}")
  foreach(language C CXX)
    string(APPEND flags " ${CMAKE_${language}_FLAGS}")
    foreach(config DEBUG RELEASE RELWITHDEBINFO MINSIZEREL ${CMAKE_BUILD_TYPE})
      string(TOUPPER "${config}" config)
      string(APPEND flags " ${CMAKE_${language}_FLAGS_${config}}")
    endforeach()
  endforeach()
  string(REGEX MATCH
    "-(Ofast|ffast-math|funsafe-math-optimizations|fassociative-math|freciprocal-math|ffinite-math-only|fno-signed-zeros)"
    unsafe "${flags}")
  if(unsafe)
    message(FATAL_ERROR "${unsafe} is refused: under it no enclosure would be guaranteed. Remove it from the compiler flags.")
  endif()
endfunction()
