#include "python/rays.h"

#include <pybind11/stl.h>

#include "dspm/base/math/vec.h"
#include "python/arrays.h"
#include "python/module.h"

namespace dspm::python {
namespace {

Rays rays_of(const Rows<Vec3>& origin, const Rows<Vec3>& direction, const std::optional<Rows<FrameSet>>& frames,
             const std::optional<Rows<float>>& t_max) {
  const std::span<const Vec3> origins = values_of<Vec3>(origin, "origin");
  const auto count = static_cast<py::ssize_t>(origins.size());
  const std::span<const Vec3> directions = values_of<Vec3>(direction, "direction", count);
  const std::vector<float> t = copy_of<float>(t_max, "t_max", count, kInfinity);
  const std::vector<FrameSet> in = copy_of<FrameSet>(frames, "frames", count, FrameSet::first(kMaxFrames));
  Rays rays;
  for (std::size_t i = 0; i < origins.size(); ++i)
    rays.add({origins[i], normalize(directions[i]), t[i]}, in[i], static_cast<int>(i));
  return rays;
}

/// image[frame, row] += value for the frames of each value.
template <class Float>
void add(py::array_t<Float, py::array::c_style>& image, const Rows<int>& row, const Rows<FrameSet>& frames,
         const Rows<Vec3>& value) {
  if (image.ndim() != 3 || image.shape(2) != 3)
    throw py::value_error("image: expected an array of shape (frames, pixels, 3)");
  const std::span<const int> rows = values_of<int>(row, "row");
  const auto count = static_cast<py::ssize_t>(rows.size());
  const std::span<const FrameSet> in = values_of<FrameSet>(frames, "frames", count);
  const std::span<const Vec3> values = values_of<Vec3>(value, "value", count);
  const FrameSet all = FrameSet::first(static_cast<int>(std::min<py::ssize_t>(image.shape(0), kMaxFrames)));
  auto to = image.template mutable_unchecked<3>();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i] < 0 || rows[i] >= image.shape(1))
      throw py::index_error(fmt::format("row: {} is none of the image's {} pixels", rows[i], image.shape(1)));
    (in[i] & all).for_each([&](Frame frame) {
      for (int c = 0; c < 3; ++c) to(frame, rows[i], c) += static_cast<Float>(values[i][c]);
    });
  }
}

}  // namespace

void add_rays(py::module_& module) {
  py::class_<Rays> rays(module, "Rays", R"(Rays as arrays, a row each; their arrays can be written to.

Directions have unit length; hits lie at t in (0, t_max). Bit f of `frames` (uint64): the ray exists in frame f of the query.)");
  rays.def(py::init(&rays_of), py::arg("origin"), py::arg("direction"), py::arg("frames") = py::none(),
           py::arg("t_max") = py::none(), "Directions are normalised. Without frames: in all; without t_max: infinite.")
      .def("__len__", &Rays::size);
  def_field(rays, "origin", &Rays::rays, &Ray::origin, "(n, 3)");
  def_field(rays, "direction", &Rays::rays, &Ray::direction, "(n, 3)");
  def_field(rays, "t_max", &Rays::rays, &Ray::t_max, "(n,)");
  def_repr(rays, "Rays", &Rays::size);
  def_array(rays, "frames", &Rays::frames, "(n,), uint64");
  def_array(rays, "row", &Rays::row, "(n,): of what each ray was made from: of the film points, or of the surfaces.");

  py::class_<Radiance> radiance(module, "Radiance", "Radiance by rows, in groups of frames that agree.");
  radiance.def("__len__", [](const Radiance& r) { return r.row.size(); });
  def_repr(radiance, "Radiance", [](const Radiance& r) { return r.row.size(); });
  def_array(radiance, "row", &Radiance::row, "(n,): of the rays, or of the surfaces that emit.");
  def_array(radiance, "frames", &Radiance::frames, "(n,), uint64");
  def_array(radiance, "radiance", &Radiance::radiance, "(n, 3)");
  def_array(radiance, "pdf_w", &Radiance::pdf_w,
            "(n,): by solid angle, with which sample_lights() at the ray's origin draws this direction.");

  constexpr const char* kAdd =
      R"(image[f, row] += value for all frames f of each row; image has shape (frames, pixels, 3).)";
  module.def("add", add<float>, py::arg("image").noconvert(), py::arg("row"), py::arg("frames"), py::arg("value"),
             kAdd);
  module.def("add", add<double>, py::arg("image").noconvert(), py::arg("row"), py::arg("frames"), py::arg("value"),
             kAdd);
}

}  // namespace dspm::python
