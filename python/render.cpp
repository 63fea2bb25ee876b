// Rendering: all frames together, one iteration after the other.
#include <pybind11/stl.h>

#include <memory>
#include <string>
#include <vector>

#include "dspm/image/image.h"
#include "dspm/output/renderer.h"
#include "python/arrays.h"
#include "python/module.h"
#include "python/scene.h"

namespace dspm::python {
namespace {

/// The scene of a render goes first in its state, so that another is refused.
class Render : public Renderer {
 public:
  Render(const ReadScene& scene, const Warn& warn) : Renderer(scene.loaded, warn), digest_(scene.digest) {}

  std::string state() const { return digest_ + Renderer::state(); }
  void load_state(std::string_view state) {
    if (!state.starts_with(digest_)) throw UsageError("state: it is of another scene, or of other choices");
    Renderer::load_state(state.substr(digest_.size()));
  }

 private:
  std::string digest_;
};

std::unique_ptr<Render> render_of(const ReadScene& scene, const std::optional<std::string>& state) {
  std::unique_ptr<Render> render;
  KeptWarnings warnings;
  {
    const py::gil_scoped_release without_python;
    render = std::make_unique<Render>(scene, warnings.keeper());
    if (state) render->load_state(*state);
  }
  warnings.raise();
  return render;
}

py::bytes state(const Render& render) {
  std::string bytes;
  {
    const py::gil_scoped_release without_python;
    bytes = render.state();
  }
  return bytes;
}

/// `each`: called with this render after every iteration; False ends it there.
void iterate(const py::object& self, int count, const py::object& each) {
  if (count < 0) throw py::value_error("count: expected a number of iterations from 0 on");
  auto& renderer = self.cast<Render&>();
  for (int i = 0; i < count; ++i) {
    {
      const py::gil_scoped_release without_python;
      renderer.iterate();
    }
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!each.is_none() && each(self).is(py::bool_(false))) return;
  }
}

Image image_of(const Render& renderer, int frame, const std::string& output) {
  const py::gil_scoped_release without_python;
  return renderer.image(frame, output);
}

py::array image(const Render& renderer, int frame, const std::string& output) {
  Image image = image_of(renderer, frame, output);
  const py::ssize_t height = image.height, width = image.width;
  return array_of(std::move(image.pixels)).reshape({height, width, py::ssize_t{3}});
}

py::object alpha(const Render& renderer, int frame) {
  Image image = image_of(renderer, frame, kRadiance);
  if (image.alpha.empty()) return py::none();
  const py::ssize_t height = image.height, width = image.width;
  return array_of(std::move(image.alpha)).reshape({height, width});
}

py::dict shared(const SharedCount& count) {
  return py::dict(py::arg("done") = count.done, py::arg("separate") = count.separate);
}

py::dict statistics(const Render& renderer) {
  py::dict seconds;
  PathCounts camera, photon;
  SharedCount stored, found;
  std::vector<double> errors;
  for (const Statistics& s : renderer.statistics()) {
    for (const StepTime& step : s.steps)
      seconds[py::str(step.name)] =
          step.seconds + (seconds.contains(step.name) ? seconds[py::str(step.name)].cast<double>() : 0);
    camera += s.camera, photon += s.photon, stored += s.photons_stored, found += s.photons_found;
    errors.insert(errors.end(), s.errors.begin(), s.errors.end());
  }
  py::dict all;
  all["iterations"] = renderer.iterations(), all["seconds"] = seconds;
  all["camera segments"] = shared(camera.segments), all["photon segments"] = shared(photon.segments);
  all["camera paths"] = camera.paths, all["photon paths"] = photon.paths, all["shadow rays"] = camera.shadow_rays;
  all["photons stored"] = shared(stored), all["photons found"] = shared(found);
  all["errors"] = errors;
  return all;
}

}  // namespace

void add_render(py::module_& module) {
  py::class_<Render>(module, "Render", R"(Renders all frames of a scene together.

Frames are indices into labels. Images are linear, with Rec. 709 primaries, rows from the top, and have the bits that the
program gives for the same scene, choices and seed. More than 64 frames are rendered in intervals, which all stay in
memory.)")
      .def(py::init(&render_of), py::arg("scene"), py::arg("state") = std::nullopt,
           "Goes on from the state of another render of the same scene with the same choices.")
      .def_property_readonly("state", state, R"(All that the iterations so far have come to: bytes.

Render(scene, state=...) goes on from there, and gets the bits that this one would have got.)")
      .def("iterate", iterate, py::arg("count") = 1, py::arg("each") = py::none(),
           R"(Does more iterations. each(render) is called after every one, and ends it by returning False.

Other threads of Python run meanwhile; Ctrl-C takes effect between iterations.)")
      .def_property_readonly("labels", &Render::labels, "What its frames are called: '12', 'oak-red' or 'oak-red 12'.")
      .def_property_readonly("iterations", &Render::iterations, "Those that were done.")
      .def_property_readonly("wanted", &Render::wanted, "How many the scene or the caller asks for; 0: no end.")
      .def_property_readonly("outputs", &Render::outputs, "What image() gives: radiance, and what was asked for.")
      .def("image", image, py::arg("frame") = 0, py::arg("output") = kRadiance,
           "A new array of shape (height, width, 3): the estimate so far, float32.")
      .def("alpha", alpha, py::arg("frame") = 0, "A new array of shape (height, width), or None if the Film is opaque.")
      .def_property_readonly("statistics", statistics, R"(Work and time so far: a dict.

`done` is work that was done, `separate` what separate renders of the frames would have done; `errors` are estimates by frame,
if the integrator makes them.)");
}

}  // namespace dspm::python
