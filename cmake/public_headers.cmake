# Headers that modules outside the tree may include, as <dspm/...>. The first two lists, for modules and for their tests,
# are stable within a minor version and include one another only; the third is what dspm's own integrators are made of,
# and may change with any version.
set(public_headers
  accel/accel.h accel/ray_hit.h
  base/colour/colour_space.h base/colour/colour.h base/colour/componentwise.h base/colour/palette.h base/colour/rgb.h base/colour/spectral_curve.h base/colour/spectrum.h base/colour/wavelength.h
  base/math/bins.h base/math/bits.h base/math/distribution.h base/math/elementary.h base/math/frame_array.h base/math/frames.h
  base/math/moments.h
  base/math/owen.h base/math/ray.h base/math/rng.h base/math/rounded.h base/math/sampling.h base/math/simd.h
  base/math/transform.h base/math/vec.h base/math/vertex_data.h
  base/params/errors.h base/params/params.h base/params/registry.h
  base/system/cancellation.h base/system/files_read.h base/system/parallel.h base/system/state_stream.h
  base/system/version.h base/system/work.h
  cameras/camera.h cameras/sighting.h
  image/film/pixel_filter.h image/film/pixel_rect.h
  image/image.h
  integrators/camera_numbers.h integrators/caught_light.h integrators/counters.h integrators/dimension.h integrators/emission_report.h
  integrators/integrator.h integrators/iteration.h integrators/light_groups.h integrators/moment_pixels.h
  integrators/output_info.h
  integrators/pixel_frames.h
  integrators/rejections.h integrators/seen_light.h integrators/statistics.h integrators/summed_iterations.h
  integrators/summing_integrator.h integrators/tiles.h
  lang/file_frames.h
  lights/emission.h lights/four_lamps.h lights/light.h lights/light_bounds.h lights/light_tree.h
  materials/bsdf.h materials/interior.h materials/material.h materials/material_set.h materials/microfacet.h
  materials/parameters.h materials/refractive_index.h materials/shading_frame.h
  media/majorants.h media/medium.h
  session/job/choices.h
  session/modules/module.h session/modules/stamp.h
  session/renderer.h
  shapes/cutout.h shapes/placed_shape.h shapes/shape.h shapes/surface_geometry.h shapes/triangle_mesh.h
  textures/image_cache.h textures/mip_map.h textures/plugins.h textures/texture.h textures/texture_set.h
  world/scene/frame_states.h world/scene/inside.h world/scene/light_samples.h world/scene/scene.h
  world/scene/scene_media.h)
set(testing_headers
  testing/agreement.h testing/checks.h testing/chi2.h testing/furnace.h testing/media.h testing/promises.h testing/scattering.h
  testing/scattering_cases.h testing/scenes.h testing/test_scene.h testing/verdict.h)
set(toolkit_headers
  base/math/double_vec.h base/math/rounding.h
  accel/box_ray.h accel/cut_query.h accel/hits.h accel/meet.h accel/nearest_hit.h
  base/colour/spectrum_lanes.h
  base/system/untouched.h base/grid/buffer.h base/grid/grid_cells.h base/grid/point_grid.h base/grid/points_within.h
  base/math/frame_lanes.h
  cameras/blades.h cameras/camera_space.h cameras/orthographic_rays.h cameras/perspective_rays.h cameras/projection.h cameras/screen.h
  cameras/thin_lens.h
  integrators/guiding/emission_of_file.h integrators/guiding/file_sample.h integrators/guiding/learn_direct.h
  integrators/guiding/learn_emission.h integrators/guiding/pilot_paths.h
  integrators/max_depth.h integrators/possible_state.h integrators/trace_tiles.h
  integrators/methods/estimator.h integrators/methods/photon_batches.h integrators/methods/pixel_sink.h
  integrators/methods/pixel_statistics.h integrators/methods/progressive.h integrators/methods/progressive_settings.h
  integrators/photons/curve_photons.h integrators/photons/direct_balance.h integrators/photons/emission_guide.h
  integrators/photons/final_gather.h integrators/photons/gather.h integrators/photons/hidden_light.h
  integrators/photons/camera_beam.h integrators/photons/gather_beams.h
  integrators/photons/hit_point.h integrators/photons/hit_point_tile.h integrators/photons/medium_photons.h
  integrators/photons/memory_needs.h
  integrators/photons/photon.h integrators/photons/photon_grid.h integrators/photons/photon_kinds.h integrators/photons/photon_map.h
  integrators/photons/plain_photon_map.h integrators/photons/point_flux.h
  integrators/photons/photon_numbers.h
  integrators/photons/radiance_estimate.h integrators/photons/same_surface.h
  integrators/photons/trace_hit_points.h integrators/photons/trace_photons.h
  integrators/transport/balance.h integrators/transport/body.h integrators/transport/branching_path.h
  integrators/transport/camera_path.h integrators/transport/direct_light.h integrators/transport/joint_path.h
  integrators/transport/left_in_media.h integrators/transport/light_value.h integrators/transport/medium_boundary.h
  integrators/transport/medium_flight.h integrators/transport/medium_passage.h integrators/transport/medium_segment.h
  integrators/transport/medium_vertex.h
  integrators/transport/gathering_lobes.h integrators/transport/lobe_choice.h integrators/transport/nesting.h integrators/transport/overlap.h integrators/transport/path_step.h integrators/transport/roulette.h integrators/transport/roulette_chance.h
  integrators/transport/sample_bsdf.h integrators/transport/shading_correction.h integrators/transport/shape_face.h integrators/transport/strand.h integrators/transport/strip_place.h
  integrators/transport/walk.h
  lights/aim.h lights/emitter_light.h lights/point_emitter.h lights/spot_emitter.h lights/strength.h
  materials/albedo_table.h materials/boundary_tables.h materials/brushed_albedo.h materials/brushed_tables.h
  materials/conductor_bsdf.h materials/dielectric_bsdf.h materials/diffuse_bsdf.h materials/coat.h materials/coated_conductor_bsdf.h materials/coated_diffuse_bsdf.h
  materials/diffuse_transmission_bsdf.h materials/small_number.h
  materials/fresnel.h materials/interface.h materials/made_up.h materials/metal_tables.h materials/per_surroundings.h
  materials/plain_bsdf.h materials/plain_material.h materials/plain_parameters.h materials/relief.h materials/rough_boundary.h materials/table_place.h
  materials/thin_dielectric_bsdf.h
  media/henyey_greenstein.h
  shapes/beyond_hole.h shapes/curvature.h shapes/cylinder.h shapes/disk.h shapes/plain_shape.h 
  shapes/quadric.h shapes/quadric_shape.h  shapes/sphere.h shapes/bilinear_patch.h shapes/bilinearmesh.h shapes/triangle.h
  textures/mapping.h textures/noise.h textures/plain_part.h textures/plain_image.h textures/plain_mapping.h
  textures/plain_texture.h textures/plain_value.h)
