# cmake --install, and what find_package(saltus) reads afterwards.
include(CMakePackageConfigHelpers)
set(config ${CMAKE_INSTALL_LIBDIR}/cmake/saltus)

install(TARGETS saltus saltus_sundials EXPORT saltusTargets FILE_SET HEADERS)
set(SALTUS_NEEDS_SUNDIALS ON)
if(SALTUS_SUNDIALS_WHEEL)
  set(SALTUS_NEEDS_SUNDIALS OFF)
  # Static libraries link against SUNDIALS only in the user's program: its archives go with ours, and its licence with them.
  install(TARGETS saltus_sundials_hooks EXPORT saltusTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/saltus)
  install(FILES ${SALTUS_SUNDIALS_ARCHIVES} DESTINATION ${CMAKE_INSTALL_LIBDIR}/saltus)
  file(GLOB licenses ${SALTUS_SUNDIALS_WHEEL}/*.dist-info/licenses/*)
  install(FILES ${licenses} DESTINATION ${CMAKE_INSTALL_LIBDIR}/saltus/sundials)
endif()
install(EXPORT saltusTargets NAMESPACE saltus:: DESTINATION ${config})

configure_package_config_file(cmake/saltusConfig.cmake.in saltusConfig.cmake INSTALL_DESTINATION ${config})
write_basic_package_version_file(saltusConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/saltusConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/saltusConfigVersion.cmake
  DESTINATION ${config})
