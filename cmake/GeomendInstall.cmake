# SPDX-License-Identifier: AGPL-3.0-or-later
get_property(rooms GLOBAL PROPERTY GEOMEND_ROOMS)
install(TARGETS ${rooms} geomend EXPORT geomendTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY src/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/geomend FILES_MATCHING PATTERN "*.h" PATTERN "cli" EXCLUDE)
install(DIRECTORY formats DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/geomend FILES_MATCHING PATTERN "*.h")
install(EXPORT geomendTargets NAMESPACE geomend:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/geomend)
configure_package_config_file(cmake/geomendConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/geomendConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/geomend)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/geomendConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/geomendConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/geomendConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/geomend)
