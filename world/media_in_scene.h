// A scene's media, and what parts them.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/lang/description.h"
#include "dspm/world/lighting/lighting.h"
#include "dspm/world/objects/geometry.h"
#include "dspm/world/objects/media.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// Returns the shapes of MediumBoundaries in these frames.
std::vector<const WorldShape*> boundary_shapes(const Media& media, const Geometry& geometry,
                                               const std::vector<FileFrame>& frames);

/// Gives the scene its media, which of its shapes part them, and their boundaries. `there` are the scene's shapes.
void add_media(Scene& scene, const Media& media, const Geometry& geometry, const std::vector<const WorldShape*>& there,
               const std::function<std::unique_ptr<Accel>(std::span<const PlacedShape>)>& make_accel);

/// Notes the media that lights are in, and which of them are media; `lights` are those of the scene, in its order.
void add_media_of_lights(Scene& scene, const std::vector<WorldLight>& lights, const Media& media);

/// Notes the media that the camera is in; call it when the bodies around it are known.
void add_media_around_camera(Scene& scene, const SceneDescription& description, const Media& media);

}  // namespace dspm
