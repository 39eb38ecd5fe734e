# What `cmake --install` and the Debian package hold: the program with its run files, completion and manual page, and
# the floors core, tracer and design as libraries with their headers (`find_package(Evenglow)`).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(evenglow_headers ${CMAKE_INSTALL_INCLUDEDIR}/evenglow)
set(evenglow_cmake ${CMAKE_INSTALL_LIBDIR}/cmake/Evenglow)

install(TARGETS evenglow)
install(TARGETS evenglow_core evenglow_tracer evenglow_design evenglow_flags EXPORT EvenglowTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
foreach(floor core tracer design)
  set_target_properties(evenglow_${floor} PROPERTIES EXPORT_NAME ${floor})
  install(DIRECTORY ${CMAKE_SOURCE_DIR}/${floor} DESTINATION ${evenglow_headers} FILES_MATCHING PATTERN "*.h")
endforeach()
set_target_properties(evenglow_flags PROPERTIES EXPORT_NAME flags)
install(EXPORT EvenglowTargets NAMESPACE Evenglow:: DESTINATION ${evenglow_cmake})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/EvenglowConfig.cmake.in EvenglowConfig.cmake
                              INSTALL_DESTINATION ${evenglow_cmake})
write_basic_package_version_file(EvenglowConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/EvenglowConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/EvenglowConfigVersion.cmake
        DESTINATION ${evenglow_cmake})

install(DIRECTORY ${CMAKE_SOURCE_DIR}/configs DESTINATION ${CMAKE_INSTALL_DATADIR}/evenglow)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR} FILES_MATCHING PATTERN "*.md"
        PATTERN "*.png" PATTERN "*.svg")
install(FILES ${CMAKE_CURRENT_LIST_DIR}/evenglow.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
        RENAME evenglow)
install(FILES ${CMAKE_CURRENT_LIST_DIR}/evenglow.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)

# The bill of materials of the program that is installed, from the packages of the machine that built it.
install(CODE "execute_process(COMMAND \"${CMAKE_SOURCE_DIR}/scripts/sbom\" \"$<TARGET_FILE:evenglow>\"
                              OUTPUT_FILE \"${CMAKE_CURRENT_BINARY_DIR}/sbom.spdx.json\" COMMAND_ERROR_IS_FATAL ANY)")
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/sbom.spdx.json DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME evenglow)
set(CPACK_PACKAGE_VENDOR "Evenglow")
set(CPACK_PACKAGE_CONTACT "The Evenglow developers <evenglow@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS fonts-dejavu-core)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
include(CPack)
