# Comparing intervals with == < <=> and the like may not compile, and what the compiler says names the predicates.
file(MAKE_DIRECTORY ${BINARY})
foreach(compiler ${COMPILERS})
  foreach(comparison "isDisjoint(x, y)" "x == y" "x != 1.0" "x < y" "2 >= x" "(x <=> y) < 0")
    file(WRITE ${BINARY}/comparison.cpp
      "#include \"scalars/interval.hpp\"\nbool f(gamut::Interval x, gamut::Interval y) { return ${comparison} && isThin(y); }\n")
    execute_process(COMMAND ${compiler} -std=c++20 -I${SOURCE} -fsyntax-only ${BINARY}/comparison.cpp
      RESULT_VARIABLE status OUTPUT_QUIET ERROR_VARIABLE errors)
    if(comparison MATCHES "isDisjoint")
      if(NOT status EQUAL 0)
        message(FATAL_ERROR "${compiler}: not even a predicate compiles: ${errors}")
      endif()
    elseif(status EQUAL 0)
      message(FATAL_ERROR "${compiler} compiles ${comparison}")
    elseif(NOT errors MATCHES "NoYesOrNo_use_isEqual_isSubset_isDisjoint_certainlyLess")
      message(FATAL_ERROR "${compiler} does not name the predicates where it refuses ${comparison}: ${errors}")
    endif()
  endforeach()
endforeach()
