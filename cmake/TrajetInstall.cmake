# `cmake --install`: headers, libraries, program, documents, and the package that find_package(trajet) reads.

include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/trajet)

set(libraries trajet)
if(TRAJET_BUILD_IO)
  list(APPEND libraries trajet_ensemble trajet_io trajet_viz)
endif()
install(TARGETS ${libraries} EXPORT trajetTargets)
install(EXPORT trajetTargets NAMESPACE trajet:: DESTINATION ${package_folder})
install(DIRECTORY include/ ${PROJECT_BINARY_DIR}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp")
if(TRAJET_BUILD_CLI)
  install(TARGETS trajet_cli)
  find_package(Python3 QUIET COMPONENTS Interpreter)
  set(pages ${PROJECT_BINARY_DIR}/installed_pages)
  install(CODE "execute_process(
    COMMAND \"${CMAKE_COMMAND}\" \"-DPROGRAM=$<TARGET_FILE:trajet_cli>\" \"-DPYTHON=${Python3_EXECUTABLE}\"
      \"-DSOURCE=${PROJECT_SOURCE_DIR}\" -DVERSION=${PROJECT_VERSION} \"-DOUTPUT=${pages}\"
      -P \"${PROJECT_SOURCE_DIR}/cmake/InstalledPages.cmake\"
    COMMAND_ERROR_IS_FATAL ANY)")
  install(FILES ${pages}/trajet.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 OPTIONAL)
  set(completion ${pages}/completion)
  install(FILES ${completion}/trajet DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  install(FILES ${completion}/_trajet DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
  install(FILES ${completion}/trajet.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
endif()
# as in the project's folder, so that their links hold
install(DIRECTORY docs examples DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES README.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

configure_package_config_file(cmake/trajetConfig.cmake.in trajetConfig.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(trajetConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES
  ${PROJECT_BINARY_DIR}/trajetConfig.cmake
  ${PROJECT_BINARY_DIR}/trajetConfigVersion.cmake
  cmake/FindUDUNITS2.cmake
  cmake/Findxsimd.cmake
  DESTINATION ${package_folder})
