# Finds MPFR and GMP: targets MPFR::MPFR and GMP::GMP, variable MPFR_FOUND.
find_path(GMP_INCLUDE_DIR gmp.h)
# With GAMUT_STATIC_MPFR static ones where there are such: operations read their thread's flags without a call then, which
# is a third of what they take. For programs alone: Debian's are not made for shared objects.
if(GAMUT_STATIC_MPFR)
  set(staticGmp libgmp.a)
  set(staticMpfr libmpfr.a)
endif()
find_library(GMP_LIBRARY NAMES ${staticGmp} gmp NAMES_PER_DIR)
find_path(MPFR_INCLUDE_DIR mpfr.h)
find_library(MPFR_LIBRARY NAMES ${staticMpfr} mpfr NAMES_PER_DIR)
mark_as_advanced(GMP_INCLUDE_DIR GMP_LIBRARY MPFR_INCLUDE_DIR MPFR_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(MPFR REQUIRED_VARS MPFR_LIBRARY MPFR_INCLUDE_DIR GMP_LIBRARY GMP_INCLUDE_DIR)

if(MPFR_FOUND AND NOT TARGET MPFR::MPFR)
  add_library(GMP::GMP UNKNOWN IMPORTED)
  set_target_properties(GMP::GMP PROPERTIES
    IMPORTED_LOCATION "${GMP_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${GMP_INCLUDE_DIR}")
  add_library(MPFR::MPFR UNKNOWN IMPORTED)
  set_target_properties(MPFR::MPFR PROPERTIES IMPORTED_LOCATION "${MPFR_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${MPFR_INCLUDE_DIR}" INTERFACE_LINK_LIBRARIES GMP::GMP)
endif()
