# cpack: the Debian packages gamut (program, guides, examples, man page, completions), libgamut-dev (libraries, headers)
# and, with GAMUT_PYTHON, python3-gamut. cpack --config CPackSourceConfig.cmake: an archive of the sources.
set(GAMUT_MAINTAINER "the Gamut authors <maintainers@users.noreply.github.com>" CACHE STRING "Of the packages: name <address>")
find_program(HELP2MAN help2man REQUIRED)
set(made ${PROJECT_BINARY_DIR}/package)
file(MAKE_DIRECTORY ${made})
set(script ${CMAKE_CURRENT_LIST_DIR}/package_files.sh)
add_custom_command(OUTPUT ${made}/changelog.gz
  COMMAND ${script} $<TARGET_FILE:gamut> ${PROJECT_SOURCE_DIR}/CHANGELOG.md ${GAMUT_MAINTAINER} ${made}
  DEPENDS gamut ${script} ${PROJECT_SOURCE_DIR}/CHANGELOG.md VERBATIM)
add_custom_target(gamut_package_files ALL DEPENDS ${made}/changelog.gz)

install(DIRECTORY ${made}/ DESTINATION share/man/man1 COMPONENT gamut FILES_MATCHING PATTERN *.1.gz)
install(FILES ${made}/gamut.bash DESTINATION share/bash-completion/completions RENAME gamut COMPONENT gamut)
install(FILES ${made}/_gamut DESTINATION share/zsh/vendor-completions COMPONENT gamut)
install(FILES ${made}/gamut.fish DESTINATION share/fish/vendor_completions.d COMPONENT gamut)
set(packages gamut libgamut-dev)
if(GAMUT_PYTHON)
  list(APPEND packages python3-gamut)
endif()
foreach(package ${packages})
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION share/doc/${package} RENAME copyright COMPONENT ${package})
  install(FILES ${made}/changelog.gz ${made}/changelog.Debian.gz DESTINATION share/doc/${package} COMPONENT ${package})
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL ${packages})
set(CPACK_PACKAGE_CONTACT ${GAMUT_MAINTAINER})
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_PACKAGE_FILE_NAME gamut-${PROJECT_VERSION})
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_GAMUT_PACKAGE_NAME gamut)
set(CPACK_DEBIAN_GAMUT_PACKAGE_SECTION science)
set(CPACK_COMPONENT_GAMUT_DESCRIPTION "One description of a mechanism, three answers: which motion is guaranteed
whatever its uncertain numbers are within their intervals, which is probable
if they follow distributions, which is possible to each degree of
membership; and the check that the answers agree. Needs an x86-64-v2
processor.")
set(CPACK_DEBIAN_LIBGAMUT-DEV_PACKAGE_NAME libgamut-dev)
set(CPACK_DEBIAN_LIBGAMUT-DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBGAMUT-DEV_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_LIBGAMUT-DEV_PACKAGE_DEPENDS
  "libboost-dev, libeigen3-dev, libmpfr-dev, libgmp-dev, libgsl-dev, libsundials-dev, libhdf5-dev, libssl-dev, libfmt-dev, libtomlplusplus-dev, libtinyxml2-dev, nlohmann-json3-dev")
set(CPACK_COMPONENT_LIBGAMUT-DEV_DESCRIPTION "Static libraries and headers of Gamut: intervals, recorded programs with
their derivatives, enclosures of all solutions of differential equations.")
set(CPACK_DEBIAN_PYTHON3-GAMUT_PACKAGE_NAME python3-gamut)
set(CPACK_DEBIAN_PYTHON3-GAMUT_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON3-GAMUT_PACKAGE_DEPENDS "python3 (>= 3.11), python3 (<< 3.12), python3-numpy")
set(CPACK_DEBIAN_PYTHON3-GAMUT_PACKAGE_RECOMMENDS "python3-pandas, python3-xarray, python3-matplotlib")
set(CPACK_COMPONENT_PYTHON3-GAMUT_DESCRIPTION "For Python: studies as files or dictionaries, results as labelled
arrays and tables, enclosures of plain differential equations.")

set(CPACK_SOURCE_GENERATOR TXZ)
set(CPACK_SOURCE_PACKAGE_FILE_NAME gamut-${PROJECT_VERSION})
set(CPACK_SOURCE_IGNORE_FILES /build/ /\\.git/ /\\.cache/ /node_modules/ /__pycache__/)
include(CPack)
