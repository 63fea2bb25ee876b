# The installed package: the program, libdspm, the headers for modules, and find_package(dspm) with dspm_add_plugin.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/dspm)

# What modules inherit: the folder of the headers, and the settings under which frames stay equal to the bit.
target_include_directories(libdspm INTERFACE $<BUILD_INTERFACE:${CMAKE_BINARY_DIR}/include>
  $<BUILD_INTERFACE:${CMAKE_BINARY_DIR}/made> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_compile_features(libdspm INTERFACE cxx_std_20)
target_compile_options(libdspm INTERFACE ${dspm_code_options})

set(library_folders "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
if(SKBUILD)
  set(library_folders "$ORIGIN/..")  # of the program in the Python package
endif()
set_target_properties(dspm PROPERTIES INSTALL_RPATH "${library_folders}")
install(TARGETS dspm)
install(TARGETS libdspm EXPORT dspm LIBRARY NAMELINK_COMPONENT Development)
if(TARGET dspm_mpi)
  install(TARGETS dspm_mpi LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
endif()
foreach(header ${public_headers} ${testing_headers} ${toolkit_headers})
  get_filename_component(folder ${header} DIRECTORY)
  install(FILES ${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/dspm/${folder} COMPONENT Development)
endforeach()
include(cmake/moved_headers.cmake)
install_from_old_paths(${public_headers} ${testing_headers} ${toolkit_headers})
install(EXPORT dspm NAMESPACE dspm:: FILE dspmTargets.cmake DESTINATION ${package_folder} COMPONENT Development)
configure_package_config_file(cmake/dspmConfig.cmake.in dspmConfig.cmake INSTALL_DESTINATION ${package_folder}
  PATH_VARS CMAKE_INSTALL_BINDIR CMAKE_INSTALL_INCLUDEDIR)
write_basic_package_version_file(dspmConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/dspmConfig.cmake ${CMAKE_BINARY_DIR}/dspmConfigVersion.cmake
  cmake/public_headers.cmake cmake/interface_digest.cmake
  DESTINATION ${package_folder} COMPONENT Development)

install(FILES ${CMAKE_BINARY_DIR}/made/dspm/session/modules/interface.h
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/dspm/session/modules COMPONENT Development)
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT Development FILES_MATCHING PATTERN "*.md")
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT Development)

install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)

# The Blender add-on as the zip that Blender installs.
set(addon_folder ${CMAKE_SOURCE_DIR}/tools/blender)
set(addon ${CMAKE_BINARY_DIR}/dspm_blender.zip)
file(GLOB addon_files CONFIGURE_DEPENDS RELATIVE ${addon_folder} ${addon_folder}/dspm_blender/*.py)
list(TRANSFORM addon_files PREPEND ${addon_folder}/ OUTPUT_VARIABLE addon_sources)
add_custom_command(OUTPUT ${addon} DEPENDS ${addon_sources} WORKING_DIRECTORY ${addon_folder}
  COMMAND ${CMAKE_COMMAND} -E tar cf ${addon} --format=zip -- ${addon_files})
add_custom_target(blender_addon ALL DEPENDS ${addon})
install(FILES ${addon} DESTINATION ${CMAKE_INSTALL_DATADIR}/dspm)

# cpack makes a .deb that brings its dependencies, as the linked libraries' packages name them.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME dspm)
set(CPACK_PACKAGE_CONTACT "The authors of dspm")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Renders all frames of a scene together, sharing what does not differ between them")
set(CPACK_RESOURCE_FILE_LICENSE ${CMAKE_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_BINARY_DIR})
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "g++, cmake, make, ffmpeg, openmpi-bin")
include(CPack)
