# cmake --install: the program, the rooms as libraries with users' headers under include/gamut, and the package Gamut.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Gamut)

# Gamut::gamut is what a program outside links to: the flow and all that is left of it; <gamut/flow.hpp> is its header.
file(GLOB doors CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/include/gamut/*.hpp)
add_library(gamut_library INTERFACE)
add_library(Gamut::gamut ALIAS gamut_library)
set_target_properties(gamut_library PROPERTIES EXPORT_NAME gamut)
target_link_libraries(gamut_library INTERFACE gamut_analyses)
target_sources(gamut_library PUBLIC
  FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR}/include FILES ${doors})
install(TARGETS gamut_library EXPORT Gamut-analyses FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
get_property(doors GLOBAL PROPERTY GAMUT_DOORS)
install(CODE "set(DOORS \"${doors}\")\nset(SOURCE \"${PROJECT_SOURCE_DIR}\")
  set(DESTINATION \"${CMAKE_INSTALL_INCLUDEDIR}/gamut\")\ninclude(\"${CMAKE_CURRENT_LIST_DIR}/GamutInstallHeaders.cmake\")")

install(TARGETS gamut RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT gamut)
foreach(room scalars mechanics analyses studies reports)
  install(EXPORT Gamut-${room} NAMESPACE Gamut:: DESTINATION ${package_dir})
endforeach()
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/GamutConfig.cmake.in ${PROJECT_BINARY_DIR}/GamutConfig.cmake
  INSTALL_DESTINATION ${package_dir} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/GamutConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/GamutConfig.cmake ${PROJECT_BINARY_DIR}/GamutConfigVersion.cmake
  ${CMAKE_CURRENT_LIST_DIR}/FindMPFR.cmake ${CMAKE_CURRENT_LIST_DIR}/GamutRigour.cmake DESTINATION ${package_dir})
# The README's links lead to the same places there as in the sources.
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CONTRIBUTING.md
  ${PROJECT_SOURCE_DIR}/CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT gamut)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT gamut FILES_MATCHING PATTERN *.md PATTERN *.png PATTERN *.ipynb
  PATTERN site EXCLUDE)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/studies/examples DESTINATION ${CMAKE_INSTALL_DOCDIR}/studies COMPONENT gamut)
