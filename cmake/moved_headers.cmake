# Where installed headers were before the rooms had wings, by folder: their old paths still work, and the compiler says
# what to write instead.
set(moved_folders
  math=base/math colour=base/colour system=base/system params=base/params grid=base/grid
  scene=world/scene world=session/job film=image/film output=session modules=session/modules
  integrators=integrators/transport integrators=integrators/photons integrators=integrators/guiding
  integrators=integrators/methods)

# install_from_old_paths(header...): next to what is installed from there.
function(install_from_old_paths)
  foreach(header ${ARGN})
    get_filename_component(folder ${header} DIRECTORY)
    get_filename_component(name ${header} NAME)
    foreach(move ${moved_folders})
      if(move MATCHES "^([a-z]+)=${folder}$")
        set(old ${CMAKE_MATCH_1}/${name})
        file(CONFIGURE OUTPUT made/old_paths/${old} @ONLY CONTENT [[
#pragma once
#pragma message("<dspm/@old@> has moved: write <dspm/@header@>")
#include <dspm/@header@>
]])
        install(FILES ${CMAKE_BINARY_DIR}/made/old_paths/${old}
          DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/dspm/${CMAKE_MATCH_1} COMPONENT Development)
      endif()
    endforeach()
  endforeach()
endfunction()
