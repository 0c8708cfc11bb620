# Finds MPFR and GMP: target MPFR::MPFR, variable MPFR_FOUND.
find_path(GMP_INCLUDE_DIR gmp.h)
find_path(MPFR_INCLUDE_DIR mpfr.h)
find_library(GMP_SHARED_LIBRARY gmp)
find_library(MPFR_SHARED_LIBRARY mpfr)
mark_as_advanced(GMP_INCLUDE_DIR GMP_SHARED_LIBRARY MPFR_INCLUDE_DIR MPFR_SHARED_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(MPFR REQUIRED_VARS MPFR_SHARED_LIBRARY MPFR_INCLUDE_DIR GMP_SHARED_LIBRARY GMP_INCLUDE_DIR)

if(MPFR_FOUND AND NOT TARGET MPFR::MPFR)
  set(mpfr ${MPFR_SHARED_LIBRARY} ${GMP_SHARED_LIBRARY})
  # With GAMUT_STATIC_MPFR static ones where there are such: operations read their thread's flags without a call then,
  # which is a third of what they take. For programs alone: Debian's are not made for shared objects.
  if(GAMUT_STATIC_MPFR)
    find_library(GMP_STATIC_LIBRARY libgmp.a)
    find_library(MPFR_STATIC_LIBRARY libmpfr.a)
    mark_as_advanced(GMP_STATIC_LIBRARY MPFR_STATIC_LIBRARY)
    if(GMP_STATIC_LIBRARY AND MPFR_STATIC_LIBRARY)
      set(mpfr $<IF:$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>,${MPFR_STATIC_LIBRARY},${MPFR_SHARED_LIBRARY}>
               $<IF:$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>,${GMP_STATIC_LIBRARY},${GMP_SHARED_LIBRARY}>)
    endif()
  endif()
  add_library(MPFR::MPFR INTERFACE IMPORTED)
  set_target_properties(MPFR::MPFR PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${MPFR_INCLUDE_DIR};${GMP_INCLUDE_DIR}" INTERFACE_LINK_LIBRARIES "${mpfr}")
endif()
