#include "python/query.h"

#include <pybind11/stl.h>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/transport/path_step.h"
#include "python/arrays.h"
#include "python/module.h"
#include "python/scene.h"
#include "python/surfaces.h"

namespace dspm::python {
namespace {

std::unique_ptr<Query> query_of(const ReadScene& read, const std::optional<std::vector<int>>& asked) {
  const FrameList& all = read.loaded->job.frames;
  FrameList frames = all;
  if (asked) {
    frames.clear();
    for (const int frame : *asked) {
      if (frame < 0 || frame >= static_cast<int>(all.size()) ||
          (!frames.empty() && all[static_cast<std::size_t>(frame)] <= frames.back()))
        throw py::value_error(fmt::format("frames: expected ascending indices below {}", all.size()));
      frames.push_back(all[static_cast<std::size_t>(frame)]);
    }
  }
  if (frames.empty() || frames.size() > kMaxFrames)
    throw py::value_error(
        fmt::format("frames: a query takes 1 to {} frames together, not {}", kMaxFrames, frames.size()));
  const py::gil_scoped_release without_python;
  return std::make_unique<Query>(Query{read.loaded, read.loaded->world->scene(frames)});
}

void expect_same(std::size_t a, std::size_t b, const char* what) {
  if (a != b) throw py::value_error(fmt::format("{}: expected as many as film points, {}, not {}", what, b, a));
}

py::tuple camera_rays(const Query& query, const Rows<Vec2>& film, const Rows<Vec2>& lens) {
  const std::span<const Vec2> films = values_of<Vec2>(film, "film"), lenses = values_of<Vec2>(lens, "lens");
  expect_same(lenses.size(), films.size(), "lens");
  struct Weighted {
    Rays rays;
    std::vector<float> weight;
    Weighted& operator+=(const Weighted& o) {
      rays += o.rays, append(weight, o.weight);
      return *this;
    }
  };
  Weighted all;
  {
    const py::gil_scoped_release without_python;
    all = in_chunks<Weighted>(films.size(), [&](std::size_t i, Weighted& chunk) {
      query.scene->camera.for_each(query.scene->frames(), [&](FrameSet frames, const Camera& camera) {
        const float weight = camera.weight(films[i], lenses[i]);
        if (!(weight > 0)) return;
        chunk.rays.add(camera.ray(films[i], lenses[i]), frames, static_cast<int>(i));
        chunk.weight.push_back(weight);
      });
    });
  }
  return py::make_tuple(std::move(all.rays), array_of(std::move(all.weight)));
}

Parts partition(const Query& query, const Rays& rays) {
  const py::gil_scoped_release without_python;
  return in_chunks<Parts>(rays.size(), [&](std::size_t i, Parts& chunk) {
    const FrameSet frames = rays.frames[i] & query.scene->frames();
    if (frames.empty()) return;
    for (const FrameHit& part : query.scene->accel->partition(rays.rays[i], frames))
      chunk.add(static_cast<int>(i), part);
  });
}

py::array occluded(const Query& query, const Rays& rays) {
  std::vector<FrameSet> hidden(rays.size());
  {
    const py::gil_scoped_release without_python;
    parallel_for(static_cast<std::int64_t>(rays.size()), kRowsOfAChunk, [&](std::int64_t row) {
      const auto i = static_cast<std::size_t>(row);
      const FrameSet frames = rays.frames[i] & query.scene->frames();
      if (!frames.empty()) hidden[i] = query.scene->accel->occluded(rays.rays[i], frames);
    });
  }
  return array_of(std::move(hidden));
}

Radiance escaped(const Query& query, const Rays& rays, const Parts& parts) {
  const py::gil_scoped_release without_python;
  return in_chunks<Radiance>(parts.size(), [&](std::size_t i, Radiance& chunk) {
    if (!parts.hits[i].missed()) return;
    const Ray& ray = rays.rays[static_cast<std::size_t>(parts.ray[i])];
    constexpr int kBounces = 1;  // the light, whatever the camera sees instead
    for_each_escape(*query.scene, parts.frames[i], ray, kBounces,
                    [&](FrameSet frames, const Spectrum& radiance, const SceneLight& light, const Light& state) {
                      chunk.add(parts.ray[i], frames, Palette::rgb().seen(radiance),
                                light.probability * state.escaped_pdf_w(ray));
                    });
  });
}

Surfaces surfaces(const Query& query, const Rays& rays, const Parts& parts) {
  const py::gil_scoped_release without_python;
  const Scene& scene = *query.scene;
  return in_chunks<Surfaces>(parts.size(), [&](std::size_t i, Surfaces& chunk) {
    if (parts.hits[i].missed()) return;
    chunk.scene = &scene;
    const Vertex vertex(scene, rays.rays[static_cast<std::size_t>(parts.ray[i])], {parts.frames[i], parts.hits[i]});
    if (!is_finite(vertex.point)) return;
    for_each_relief(vertex, [&](const Vertex& shown) {
      for_each_surface(shown, [&](FrameSet frames, const Bsdf& bsdf) {
        chunk.ray.push_back(parts.ray[i]), chunk.frames.push_back(frames), chunk.wo.push_back(shown.wo);
        chunk.material.push_back(shown.shape.material), chunk.object.push_back(shown.shape.object);
        chunk.hits.push_back(shown.hit), chunk.points.push_back(shown.point);
        chunk.bsdfs.push_back(BsdfSlot::copy_of(bsdf));
      });
    });
  });
}

template <class T>
std::vector<T> copied(std::span<const T> values) {
  return {values.begin(), values.end()};
}

}  // namespace

void add_query(py::module_& module) {
  py::class_<Parts> parts(module, "Parts", R"(The partitions of rays by what they meet first, one after the other.

For each ray: parts with disjoint frames, whose union is the frames of the ray; a miss is a part of shape -1.)");
  parts.def("__len__", &Parts::size);
  def_repr(parts, "Parts", &Parts::size);
  def_array(parts, "ray", &Parts::ray, "(n,): row of the ray.");
  def_array(parts, "frames", &Parts::frames, "(n,), uint64");
  def_field(parts, "t", &Parts::hits, &RayHit::t, "(n,): the distance; infinite for a miss.");
  def_field(parts, "shape", &Parts::hits, &RayHit::shape, "(n,): the number of the placed shape; -1 for a miss.");
  def_field(parts, "primitive", &Parts::hits, &RayHit::primitive, "(n,): which of its primitives, such as triangles.");
  def_field(parts, "uv", &Parts::hits, &RayHit::uv, "(n, 2): where on the primitive.");

  py::class_<Query>(module, "Query",
                    R"(What an integrator asks of a scene, for arrays of rays and up to 64 frames together.

Frames are indices into scene.labels; none: all. Bit j of a mask is the j-th of them.)")
      .def(py::init(&query_of), py::arg("scene"), py::arg("frames") = py::none())
      .def(
          "__len__", [](const Query& q) { return q.scene->frame_count(); }, "How many frames it has.")
      .def_property_readonly(
          "center", [](const Query& q) { return std::tuple(q.scene->center.x, q.scene->center.y, q.scene->center.z); },
          "Of a sphere around the scene, over all frames of the file.")
      .def_property_readonly(
          "radius", [](const Query& q) { return q.scene->radius; }, "Its radius.")
      .def("__repr__", [](const Query& q) { return fmt::format("<dspm.Query of {} frames>", q.scene->frame_count()); })
      .def_property_readonly(
          "object_names", [](const Query& q) { return copied(q.scene->object_names); },
          "What numbers of objects stand for.")
      .def_property_readonly(
          "material_names", [](const Query& q) { return copied(q.scene->material_names); },
          "What numbers of materials stand for.")
      .def_property_readonly(
          "light_names", [](const Query& q) { return copied(q.scene->light_names); },
          "What numbers of lights stand for.")
      .def("camera_rays", camera_rays, py::arg("film"), py::arg("lens"),
           R"(Rays (their rows are film points), and what each sees counts by: 1 but for lenses that shade.

film: (n, 2), in pixels of the full image from its upper left corner; lens: (n, 2), in [0, 1). A camera that differs
between frames gives a ray for each of its states.)")
      .def("partition", partition, py::arg("rays"), "What each ray meets first, frame by frame: Parts.")
      .def("occluded", occluded, py::arg("rays"), "(n,), uint64: the frames in which something lies in (0, t_max).")
      .def("escaped", escaped, py::arg("rays"), py::arg("parts"),
           "Radiance of infinite lights along the rays in the parts that missed; rows are rays.")
      .def("surfaces", surfaces, py::arg("rays"), py::arg("parts"), py::keep_alive<0, 1>(),
           "Surfaces at the parts that did not miss; a part whose frames differ in material becomes several.");
}

}  // namespace dspm::python
