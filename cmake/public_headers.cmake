# Headers that modules outside the tree may include, as <dspm/...>. The first two lists, for modules and for their tests,
# are stable within a minor version and include one another only; the third is what dspm's own integrators are made of,
# and may change with any version.
set(public_headers
  accel/accel.h
  cameras/camera.h
  colour/colour_space.h colour/rgb.h colour/spectrum.h
  film/pixel_filter.h film/pixel_rect.h
  image/image.h
  integrators/counters.h integrators/dimension.h integrators/emission_report.h integrators/integrator.h
  integrators/light_groups.h integrators/output_info.h
  integrators/caught_light.h integrators/rejections.h integrators/seen_light.h integrators/statistics.h
  integrators/summed_iterations.h integrators/summing_integrator.h
  integrators/tiles.h
  lights/light.h
  materials/bsdf.h materials/interior.h materials/material.h materials/material_set.h materials/microfacet.h
  materials/parameters.h materials/shading_frame.h
  math/bins.h math/frame_array.h math/frames.h math/ray.h math/rng.h math/sampling.h math/transform.h math/vec.h math/vertex_data.h
  lang/file_frames.h
  modules/module.h modules/stamp.h
  output/renderer.h
  params/errors.h params/params.h params/registry.h
  scene/inside.h scene/scene.h
  shapes/cutout.h shapes/placed_shape.h shapes/shape.h shapes/triangle_mesh.h
  system/cancellation.h system/files_read.h system/parallel.h system/state_stream.h system/version.h
  system/work.h
  textures/image_cache.h textures/mip_map.h textures/plugins.h textures/texture.h textures/texture_set.h
  world/choices.h)
set(testing_headers
  testing/agreement.h testing/checks.h testing/chi2.h testing/furnace.h testing/promises.h testing/scattering.h
  testing/scattering_cases.h testing/scenes.h testing/test_scene.h testing/verdict.h)
set(toolkit_headers
  accel/box_ray.h accel/cut_query.h accel/hits.h accel/meet.h shapes/beyond_hole.h
  cameras/blades.h cameras/projection.h
  colour/rgb_lanes.h
  grid/buffer.h grid/point_grid.h grid/points_within.h
  integrators/balance.h integrators/body.h integrators/branching_path.h integrators/camera_path.h integrators/direct_balance.h
  integrators/direct_light.h
  integrators/estimator.h
  integrators/emission_guide.h integrators/emission_of_file.h integrators/file_sample.h integrators/final_gather.h
  integrators/gather.h
  integrators/gathered_flux.h
  integrators/hit_point.h integrators/joint_path.h integrators/kernel_size.h integrators/learn_direct.h
  integrators/learn_emission.h integrators/light_value.h
  integrators/max_depth.h integrators/memory_needs.h integrators/nesting.h integrators/path_step.h integrators/photon.h
  integrators/photon_batches.h integrators/photon_grid.h integrators/photon_map.h integrators/pilot_paths.h
  integrators/pixel_statistics.h integrators/possible_state.h
  integrators/progressive.h
  integrators/progressive_settings.h integrators/radiance_estimate.h integrators/shape_face.h integrators/strand.h
  integrators/strip_place.h integrators/surface_kernel.h
  integrators/trace_tiles.h integrators/walk.h
  lights/aim.h lights/strength.h
  materials/albedo_table.h materials/boundary_tables.h materials/brushed_albedo.h materials/brushed_tables.h
  materials/fresnel.h materials/interface.h materials/made_up.h materials/per_surroundings.h materials/relief.h
  materials/rough_boundary.h materials/table_place.h
  math/frame_lanes.h
  shapes/curvature.h shapes/double_vec.h shapes/quadric.h shapes/rounding.h shapes/triangle.h
  textures/mapping.h)
