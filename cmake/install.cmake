# What `cmake --install` puts down: the core for find_package(servoid) and pkg-config, and the program.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS servoid_core
  EXPORT servoid-targets
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/servoid"
  DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" FILES_MATCHING PATTERN "*.h")

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/servoid")
install(EXPORT servoid-targets NAMESPACE servoid:: DESTINATION "${package_dir}")
configure_package_config_file(cmake/servoid-config.cmake.in
  "${PROJECT_BINARY_DIR}/servoid-config.cmake" INSTALL_DESTINATION "${package_dir}")
# 0.x: a minor version may break what the one before promised.
write_basic_package_version_file("${PROJECT_BINARY_DIR}/servoid-config-version.cmake"
  VERSION "${PROJECT_VERSION}" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/servoid-config.cmake"
  "${PROJECT_BINARY_DIR}/servoid-config-version.cmake" DESTINATION "${package_dir}")

# servoid.pc finds its prefix from where it lies, so that a staged or moved tree works.
file(RELATIVE_PATH pc_to_prefix
  "/prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/prefix")
configure_file(cmake/servoid.pc.in "${PROJECT_BINARY_DIR}/servoid.pc" @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/servoid.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")

if(TARGET servoid)
  install(TARGETS servoid RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
endif()
