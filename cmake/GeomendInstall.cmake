# SPDX-License-Identifier: AGPL-3.0-or-later
get_property(rooms GLOBAL PROPERTY GEOMEND_ROOMS)
install(TARGETS ${rooms} geomend EXPORT geomendTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY src/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/geomend FILES_MATCHING PATTERN "*.h" PATTERN "cli" EXCLUDE)
install(DIRECTORY validators DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/geomend FILES_MATCHING PATTERN "*.h")
# Of the families only what their tables of formats show.
install(FILES formats/format.h formats/mesh_format.h formats/option_row.h formats/options.h formats/registry.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/geomend/formats)

# Builds all that an install needs, and no tests.
add_custom_target(installed DEPENDS ${rooms} geomend)
if(TARGET manual)
  add_dependencies(installed manual)
endif()
install(EXPORT geomendTargets NAMESPACE geomend:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/geomend)
configure_package_config_file(cmake/geomendConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/geomendConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/geomend)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/geomendConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES cmake/FindTetGen.cmake ${CMAKE_CURRENT_BINARY_DIR}/geomendConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/geomendConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/geomend)
