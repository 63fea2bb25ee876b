# The rooms, from the bottom up; docs/design.md says what lives in each and what it may include.
foreach(room
    base/math base/colour base/system base/params base/grid
    lang/gltf lang image image/denoise image/film
    textures media shapes materials lights cameras accel world/scene
    integrators integrators/transport integrators/photons integrators/waves
    integrators/guiding integrators/beside integrators/methods
    world/objects world/lighting world
    session/job session/modules session session/checkpoint session/machines
    output/report output looking looking/serve testing app)
  add_subdirectory(${room} rooms/${room})
endforeach()
