# `cmake --install`: headers, libraries, program, and the package that find_package(trajet) reads.

include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/trajet)

set(libraries trajet)
if(TRAJET_BUILD_IO)
  list(APPEND libraries trajet_io trajet_viz)
endif()
install(TARGETS ${libraries} EXPORT trajetTargets)
install(EXPORT trajetTargets NAMESPACE trajet:: DESTINATION ${package_folder})
install(DIRECTORY include/ ${PROJECT_BINARY_DIR}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp")
if(TRAJET_BUILD_CLI)
  install(TARGETS trajet_cli)
endif()

configure_package_config_file(cmake/trajetConfig.cmake.in trajetConfig.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(trajetConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES
  ${PROJECT_BINARY_DIR}/trajetConfig.cmake
  ${PROJECT_BINARY_DIR}/trajetConfigVersion.cmake
  cmake/FindUDUNITS2.cmake
  cmake/Findxsimd.cmake
  DESTINATION ${package_folder})
