#include "python/surfaces.h"

#include <pybind11/stl.h>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/transport/direct_light.h"
#include "dspm/integrators/transport/path_step.h"
#include "python/arrays.h"
#include "python/module.h"

namespace dspm::python {
namespace {

/// fn(i, surface) for each row of `row`; without it, for each surface.
template <class Fn>
void for_each_row(const Surfaces& surfaces, const std::optional<Rows<int>>& row, std::size_t count, Fn&& fn) {
  const std::span<const int> rows =
      row ? values_of<int>(*row, "row", static_cast<py::ssize_t>(count)) : std::span<const int>();
  if (!row && count != surfaces.size())
    throw py::value_error(fmt::format("expected as many rows as surfaces, {}, not {}", surfaces.size(), count));
  for (const int i : rows)
    if (i < 0 || static_cast<std::size_t>(i) >= surfaces.size())
      throw py::index_error(fmt::format("row: {} is none of {} surfaces", i, surfaces.size()));
  const py::gil_scoped_release without_python;
  parallel_for(static_cast<std::int64_t>(count), kRowsOfAChunk, [&](std::int64_t i) {
    const auto at = static_cast<std::size_t>(i);
    fn(at, row ? static_cast<std::size_t>(rows[at]) : at);
  });
}

/// What fn(bsdf, wo, wi) says of each row's direction.
template <class T, class Fn>
py::array of_directions(const Surfaces& s, const Rows<Vec3>& wi, const std::optional<Rows<int>>& row, Fn&& fn) {
  const std::span<const Vec3> directions = values_of<Vec3>(wi, "wi");
  std::vector<T> values(directions.size());
  for_each_row(s, row, directions.size(),
               [&](std::size_t i, std::size_t at) { values[i] = fn(*s.bsdfs[at], s.wo[at], directions[i]); });
  return array_of(std::move(values));
}

py::array evaluate(const Surfaces& s, const Rows<Vec3>& wi, const std::optional<Rows<int>>& row) {
  return of_directions<Rgb>(s, wi, row, [](const Bsdf& bsdf, const Vec3& wo, const Vec3& w) {
    return Palette::rgb().seen(bsdf.evaluate(wo, w, Transport::radiance, bsdf.all_lobes()));
  });
}

py::array pdf_w(const Surfaces& s, const Rows<Vec3>& wi, const std::optional<Rows<int>>& row) {
  return of_directions<float>(s, wi, row, [](const Bsdf& bsdf, const Vec3& wo, const Vec3& w) {
    return bsdf.pdf_w(wo, w, Transport::radiance, bsdf.all_lobes());
  });
}

Scattered sample(const Surfaces& s, const Rows<Vec3>& u) {
  const std::span<const Vec3> numbers = values_of<Vec3>(u, "u", static_cast<py::ssize_t>(s.size()));
  const py::gil_scoped_release without_python;
  return in_chunks<Scattered>(s.size(), [&](std::size_t i, Scattered& chunk) {
    const Bsdf& bsdf = *s.bsdfs[i];
    const auto drawn = bsdf.sample(s.wo[i], numbers[i], Transport::radiance, bsdf.all_lobes());
    if (!drawn) return;
    chunk.rays.add(s.points[i].spawn(drawn->wi), s.frames[i], static_cast<int>(i));
    chunk.weight.push_back(Palette::rgb().seen(drawn->weight)), chunk.pdf_w.push_back(drawn->pdf_w);
    chunk.specular.push_back(drawn->specular);
  });
}

/// By power.
LightChoice light_choice(const Scene& scene) {
  std::vector<float> probability;
  for (const SceneLight& light : scene.lights) probability.push_back(light.probability);
  return LightChoice(std::move(probability));
}

LightSamples sample_lights(const Surfaces& s, const Rows<Vec3>& u) {
  const std::span<const Vec3> numbers = values_of<Vec3>(u, "u", static_cast<py::ssize_t>(s.size()));
  const py::gil_scoped_release without_python;
  if (s.size() == 0) return {};
  const LightChoice choice = light_choice(*s.scene);
  return in_chunks<LightSamples>(s.size(), [&](std::size_t i, LightSamples& chunk) {
    const ChosenLight chosen = choice.choose(numbers[i].x);
    if (!(chosen.probability > 0)) return;
    const SceneLight& light = s.scene->lights[static_cast<std::size_t>(chosen.index)];
    light.states.for_each(s.frames[i], [&](FrameSet frames, const Light& state) {
      const auto lit = state.illuminate(s.points[i].p, {numbers[i].y, numbers[i].z});
      if (!lit) return;
      const float pdf = chosen.probability * (lit->pdf_w > 0 ? lit->pdf_w : 1);
      chunk.rays.add(shadow_ray(s.points[i], *lit), frames, static_cast<int>(i));
      chunk.wi.push_back(lit->wi), chunk.weight.push_back(lit->radiance / pdf);
      chunk.pdf_w.push_back(lit->pdf_w > 0 ? pdf : 0), chunk.light.push_back(chosen.index);
    });
  });
}

Radiance emitted(const Surfaces& s) {
  const py::gil_scoped_release without_python;
  return in_chunks<Radiance>(s.size(), [&](std::size_t i, Radiance& chunk) {
    const Ray ray{s.points[i].p + s.wo[i] * s.hits[i].t, -s.wo[i]};
    const Vertex vertex(*s.scene, ray, {s.frames[i], s.hits[i]});
    if (vertex.shape.light < 0) return;
    const float chance = s.scene->lights[static_cast<std::size_t>(vertex.shape.light)].probability;
    for_each_emission(*s.scene, vertex, s.frames[i],
                      [&](FrameSet frames, const Spectrum& radiance, const Light& state) {
                        chunk.add(static_cast<int>(i), frames, Palette::rgb().seen(radiance),
                                  chance * state.pdf_w(ray.origin, vertex.point, vertex.hit.primitive));
                      });
  });
}

Rays spawn(const Surfaces& s, const Rows<Vec3>& w) {
  const std::span<const Vec3> directions = values_of<Vec3>(w, "w", static_cast<py::ssize_t>(s.size()));
  const py::gil_scoped_release without_python;
  return in_chunks<Rays>(s.size(), [&](std::size_t i, Rays& chunk) {
    chunk.add(s.points[i].spawn(normalize(directions[i])), s.frames[i], static_cast<int>(i));
  });
}

}  // namespace

void add_surfaces(py::module_& module) {
  py::class_<Scattered> scattered(module, "Scattered",
                                  "Directions that were drawn at surfaces; those absorbed are left out.");
  scattered.def_readonly("rays", &Scattered::rays, "Rays on; their rows are surfaces.");
  def_repr(scattered, "Scattered", [](const Scattered& s) { return s.rays.size(); });
  def_array(scattered, "weight", &Scattered::weight, "(n, 3): f |cos| / pdf_w.");
  def_array(scattered, "pdf_w", &Scattered::pdf_w, "(n,): by solid angle; 0: specular.");
  def_array(scattered, "specular", &Scattered::specular, "(n,): 1 if the direction was the only possible one.");

  py::class_<LightSamples> lights(module, "LightSamples", "Light that may arrive at surfaces, by samples.");
  lights.def_readonly("rays", &LightSamples::rays, "Shadow rays; their rows are surfaces.");
  def_repr(lights, "LightSamples", [](const LightSamples& l) { return l.rays.size(); });
  def_array(lights, "wi", &LightSamples::wi, "(n, 3): towards the light.");
  def_array(lights, "weight", &LightSamples::weight,
            "(n, 3): radiance over pdf_w. Times f |cos| it is what the surface scatters.");
  def_array(lights, "pdf_w", &LightSamples::pdf_w,
            "(n,): by solid angle, with the light's choice; 0: no ray can hit the light.");
  def_array(lights, "light", &LightSamples::light, "(n,): into Query.light_names.");

  py::class_<Surfaces> surfaces(module, "Surfaces",
                                R"(Where rays meet surfaces, a row for frames that see the same scattering.

Textures are looked up at points, without a footprint. Light that a body absorbs or scatters inside is not accounted for.)");
  surfaces.def("__len__", &Surfaces::size)
      .def("evaluate", evaluate, py::arg("wi"), py::arg("row") = py::none(),
           "(n, 3): f(wo, wi) in 1/sr, without the cosine, at all surfaces or those of `row`; specular lobes add "
           "nothing.")
      .def("pdf_w", pdf_w, py::arg("wi"), py::arg("row") = py::none(), "(n,): the density of sample() by solid angle.")
      .def("sample", sample, py::arg("u"), "Draws directions with numbers in [0, 1), (n, 3): Scattered.")
      .def("sample_lights", sample_lights, py::arg("u"),
           "Chooses one light by its power, and a point on it, with numbers in [0, 1), (n, 3): LightSamples.")
      .def("emitted", emitted, "Radiance that surfaces emit back along the rays; rows are surfaces.")
      .def("spawn", spawn, py::arg("w"), "Rays in these directions, (n, 3), that start safely off the surfaces.");
  def_repr(surfaces, "Surfaces", &Surfaces::size);
  def_array(surfaces, "ray", &Surfaces::ray, "(n,): row of the ray.");
  def_array(surfaces, "frames", &Surfaces::frames, "(n,), uint64");
  def_field(surfaces, "p", &Surfaces::points, &SurfacePoint::p, "(n, 3)");
  def_field(surfaces, "ng", &Surfaces::points, &SurfacePoint::ng, "(n, 3): the geometric normal, outward.");
  def_field(surfaces, "ns", &Surfaces::points, &SurfacePoint::ns, "(n, 3): the shading normal.");
  def_array(surfaces, "wo", &Surfaces::wo, "(n, 3): back along the ray.");
  def_field(surfaces, "uv", &Surfaces::points, &SurfacePoint::uv, "(n, 2): texture coordinates.");
  def_field(surfaces, "t", &Surfaces::hits, &RayHit::t, "(n,): the distance.");
  def_field(surfaces, "shape", &Surfaces::hits, &RayHit::shape, "(n,): the number of the placed shape.");
  def_array(surfaces, "material", &Surfaces::material, "(n,): into Query.material_names.");
  def_array(surfaces, "object", &Surfaces::object, "(n,): into Query.object_names; -1: none.");
}

}  // namespace dspm::python
