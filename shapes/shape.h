// The interface of geometry: primitives that a tree can bound and a ray can hit, and the surface at a hit. Plugins:
// sphere.cpp, with sphere.h and quadric_shape.h, is the shortest to copy; plugins.cpp is the table.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "dspm/base/colour/palette.h"
#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/wavelength.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/math/vertex_data.h"
#include "dspm/base/params/params.h"
#include "dspm/base/params/registry.h"
#include "dspm/shapes/surface_geometry.h"

namespace dspm {

class PlainShape;
class TriangleMesh;

/// The surface at a hit.
struct SurfacePoint : SurfaceGeometry {
  // The footprint, which texture lookups average over: the axes of an ellipse in the surface; zero for a point.
  Vec3 dpdx{}, dpdy{};
  // The shading normal without the material's relief; zero: there is none. A coat may lie smoothly over a rough base.
  Vec3 smooth_ns{};
  // The surface turns to each ray, as a curve does, so ng belongs to the ray that met it here, and there is no area on
  // which photons could be counted.
  bool turns = false;
  // The index of refraction around the body that the surface bounds, over that for which the body's own is given: 1
  // unless it lies in another body, of lower priority.
  float outside_eta = 1;
  // That index at the wavelength below, over outside_eta.
  float outside_dispersion = 1;
  Wavelength wavelength{};                   // of the path that has met the surface
  const Palette* palette = &Palette::rgb();  // likewise
  VertexPlace vertices{};                    // of a mesh with colours of vertices or second texture coordinates

  /// Makes the footprint what a disk of this diameter, perpendicular to w (unit length), covers of the surface.
  void cover(const Vec3& w, float diameter);
};

/// The strip that a surface that turns to each ray shows to one of them, near a primitive: with coordinates u along it
/// and v across it, both in [0, 1]; the surface turns about the line v = 1/2.
struct Strip {
  int number = 0;                // equal for primitives whose uv are coordinates of the same strip
  Vec3 along = {}, across = {};  // derivatives of p by u and v
};

/// Geometry in its own (object) space. Once it is constructed and has absorbed others, a Shape is finished and const.
class Shape {
 public:
  virtual ~Shape() = default;

  virtual int primitive_count() const { return 1; }
  /// Returns a box that contains the primitive, rounding included.
  virtual Bounds3 bounds(int primitive) const = 0;
  /// Returns the nearest hit with t in (0, ray.t_max). This is the one routine that decides where a ray hits this
  /// shape: every tree and every frame calls it (or its SIMD twin, which gives equal bits). It is watertight.
  virtual std::optional<PrimitiveHit> intersect(int primitive, const Ray& ray) const = 0;
  virtual SurfacePoint surface_point(int primitive, Vec2 uv) const = 0;
  /// Returns the surface there, as a ray of that direction (of any length) sees it; differs from surface() if the
  /// surface turns to rays.
  virtual SurfacePoint seen(int primitive, Vec2 uv, const Vec3& /*direction*/) const {
    return surface_point(primitive, uv);
  }
  /// Returns whether the surface turns to rays (SurfacePoint::turns). It cannot emit light then.
  virtual bool turns() const { return false; }
  /// The area of the primitive in object space.
  virtual float area(int primitive) const = 0;
  /// Returns the parameters of a point distributed uniformly over the primitive's area in object space.
  virtual Vec2 sample_area(int primitive, Vec2 u) const = 0;
  /// Returns the numbers for which sample_area() gives the point p of the primitive, in object space, up to rounding;
  /// nullopt if they are not known.
  virtual std::optional<Vec2> area_numbers(int /*primitive*/, const Vec3& /*p*/) const { return std::nullopt; }

  /// Returns the radius if the shape is a whole sphere around its origin: as a light it is sampled by the cone that it
  /// fills.
  virtual std::optional<float> sphere_radius() const { return std::nullopt; }

  /// Takes over the primitives of `next` and returns true, if it can: shapes of directives that follow one another and
  /// are alike in all but their geometry, such as the strands of hair, become one.
  virtual bool absorb(Shape& /*next*/) { return false; }
  /// Finishes the shape, once it has absorbed all that it will; may renumber its primitives.
  virtual void settle() {}

  /// Returns the shape as a plain value, which a device can have; nullopt if it is none of that kind. Meshes are not.
  virtual std::optional<PlainShape> plain() const;

  /// Returns the mesh, which trees treat specially; null if the shape is anything else.
  virtual const TriangleMesh* triangles() const { return nullptr; }

  /// Returns what a ray of that direction (of any length) sees around that place of a surface that turns. No photons
  /// are counted on a strip without width.
  virtual Strip strip(int /*primitive*/, Vec2 /*uv*/, const Vec3& /*direction*/) const { return {}; }
};

/// An imagemap that a material from a geometry file names among its parameters.
struct FileTexture {
  std::string name;
  std::filesystem::path file;
  bool is_spectrum = true;  // else numbers
};

/// A material from a geometry file (MTL): plain data that world turns into objects.
struct FileMaterial {
  std::filesystem::path file;
  std::string name;  // unique within the file
  std::string type;
  ParamList params;
  std::vector<FileTexture> textures;
  std::optional<Rgb> radiance;       // of an area light, on both sides
  std::filesystem::path alpha = {};  // a picture of the shape's holes; empty: none
};

/// Moves a mesh's surface along its normals, once its edges are short enough: see displace.h.
struct Displacement {
  ValueOrTexture<float> distance;
  float edge_length = 1;
};

/// One shape of a Shape directive (a mesh file may hold several).
struct MadeShape {
  std::unique_ptr<Shape> shape;
  std::optional<FileMaterial> material;
  bool repair = false;  // the scene asks for mesh repair
  std::optional<Displacement> displacement = std::nullopt;
};

using MakeShape = std::vector<MadeShape>(ParamReader&);
PluginTable<Plugin<MakeShape>>& shape_plugins();

}  // namespace dspm
