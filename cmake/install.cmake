# The installed package: the program, libdspm, the headers for modules, find_package(dspm) with dspm_add_plugin, and what
# desktops and shells find.
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
foreach(module dspm_mpi dspm_openvdb)  # loaded if they are needed
  if(TARGET ${module})
    install(TARGETS ${module} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
  endif()
endforeach()
if(TARGET dspm_cuda)
  install(FILES ${CMAKE_BINARY_DIR}/libdspm_cuda.so DESTINATION ${CMAKE_INSTALL_LIBDIR})
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
file(RELATIVE_PATH prefix_from_pc /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
list(JOIN dspm_code_options " " flags)
configure_file(cmake/dspm.pc.in dspm.pc @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/dspm.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT Development)
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

# What the program writes about itself.
set(manual ${CMAKE_BINARY_DIR}/dspm.1)
add_custom_command(OUTPUT ${manual} DEPENDS dspm COMMAND dspm --man-page > ${manual})
install(FILES ${manual} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
foreach(shell_and_file bash=bash-completion/completions/dspm zsh=zsh/vendor-completions/_dspm
    fish=fish/vendor_completions.d/dspm.fish)
  string(REPLACE "=" ";" shell_and_file ${shell_and_file})
  list(GET shell_and_file 0 shell)
  list(GET shell_and_file 1 file)
  get_filename_component(folder ${file} DIRECTORY)
  get_filename_component(name ${file} NAME)
  set(completion ${CMAKE_BINARY_DIR}/completion/${shell}/${name})
  file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/completion/${shell})
  add_custom_command(OUTPUT ${completion} DEPENDS dspm COMMAND dspm --completion ${shell} > ${completion})
  list(APPEND completions ${completion})
  install(FILES ${completion} DESTINATION ${CMAKE_INSTALL_DATADIR}/${folder})
endforeach()
add_custom_target(self_description ALL DEPENDS ${manual} ${completions})

# What desktops read.
install(FILES cmake/package/dspm.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
install(FILES cmake/package/dspm.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages)
install(FILES cmake/package/dspm.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)

# All that is installed.
add_custom_target(packaged DEPENDS dspm blender_addon self_description)
foreach(part dspm_mpi dspm_openvdb dspm_cuda python_stubs)
  if(TARGET ${part})
    add_dependencies(packaged ${part})
  endif()
endforeach()
