# Installs headers, modules (targets isolux::core ... isolux::measure), the program, and what
# find_package(isolux) reads.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

get_property(modules GLOBAL PROPERTY ISOLUX_MODULES)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/isolux)

install(TARGETS ${modules} EXPORT isolux ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT isolux NAMESPACE isolux:: FILE isoluxTargets.cmake DESTINATION ${package_dir})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/isolux ${PROJECT_BINARY_DIR}/generated/isolux
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  FILES_MATCHING PATTERN "*.h")
if(TARGET isolux)
  install(TARGETS isolux RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

configure_package_config_file(
  ${PROJECT_SOURCE_DIR}/cmake/isoluxConfig.cmake.in ${PROJECT_BINARY_DIR}/isoluxConfig.cmake
  INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(
  ${PROJECT_BINARY_DIR}/isoluxConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES
  ${PROJECT_BINARY_DIR}/isoluxConfig.cmake ${PROJECT_BINARY_DIR}/isoluxConfigVersion.cmake
  DESTINATION ${package_dir})
