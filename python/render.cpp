// Rendering: all frames together, one iteration after the other.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "dspm/image/encoding.h"
#include "dspm/image/image.h"
#include "dspm/output/joint_files.h"
#include "dspm/output/view.h"
#include "dspm/session/joint_render.h"
#include "python/arrays.h"
#include "python/module.h"
#include "python/scene.h"

namespace dspm::python {
namespace {

/// The scene of a render goes first in its state, so that another is refused.
class Render : public JointRender {
 public:
  Render(const ReadScene& scene, const Warn& warn) : JointRender(scene.loaded, warn), digest_(scene.digest) {}

  std::string state() { return digest_ + JointRender::state(); }
  void load_state(std::string_view state) {
    if (!state.starts_with(digest_)) throw UsageError("state: it is of another scene, or of other choices");
    JointRender::load_state(state.substr(digest_.size()));
  }

 private:
  std::string digest_;
};

std::unique_ptr<Render> render_of(const ReadScene& scene, const std::optional<py::bytes>& bytes) {
  const std::optional<std::string> state = bytes ? std::optional(std::string(*bytes)) : std::nullopt;
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

py::bytes state(Render& render) {
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

Image image_of(const Render& renderer, int frame, const std::string& output, bool is_denoised = false) {
  const py::gil_scoped_release without_python;
  if (is_denoised && output != kRadiance) throw UsageError("denoised: only radiance is, not \"" + output + "\"");
  return is_denoised ? denoised(renderer, frame) : renderer.image(frame, output);
}

py::array image(const Render& renderer, int frame, const std::string& output, bool is_denoised) {
  Image image = image_of(renderer, frame, output, is_denoised);
  const py::ssize_t height = image.height, width = image.width;
  return array_of(std::move(image.pixels)).reshape({height, width, py::ssize_t{3}});
}

/// As the program's PNGs show it.
py::array screen_bytes(const Render& renderer, int frame, const std::string& name, double exposure, bool is_denoised) {
  const View view(ViewSettings{.view = name, .stops = exposure});
  Image image = image_of(renderer, frame, kRadiance, is_denoised);
  const py::ssize_t height = image.height, width = image.width;
  std::vector<std::uint8_t> bytes;
  {
    const py::gil_scoped_release without_python;
    const auto samples = encoded(view.shown(std::move(image)), 256, view.png().space != PngSpace::linear);
    bytes.assign(samples.begin(), samples.end());
  }
  return array_of(std::move(bytes)).reshape({height, width, py::ssize_t{3}});
}

std::vector<std::filesystem::path> write_files(const Render& renderer, const std::filesystem::path& outfile,
                                               std::vector<int> frames, bool png, std::optional<bool> half,
                                               const std::string& view, double exposure,
                                               const std::string& contact_sheet) {
  std::sort(frames.begin(), frames.end());
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  ImageFiles files{outfile.string(), frames, half, {}};
  files.settings.png = png, files.settings.contact_sheet = contact_sheet;
  files.settings.view = {.view = view, .stops = exposure};
  KeptWarnings warnings;
  std::vector<std::filesystem::path> written;
  {
    const py::gil_scoped_release without_python;
    written = write(renderer, files, warnings.keeper());
  }
  warnings.raise();
  return written;
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

std::string words_of(const Render& render) {
  const Job& job = render.scene().job;
  const std::string wanted = render.wanted() > 0 ? fmt::format(" of {}", render.wanted()) : "";
  return fmt::format("<dspm.Render {}: {} of {} x {} pixels, {}, {}{} iterations done>", job.scene_file,
                     job.frames_in_words(), job.settings.crop.width(), job.settings.crop.height(), job.integrator,
                     render.iterations(), wanted);
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
      .def("image", image, py::arg("frame") = 0, py::arg("output") = kRadiance, py::arg("denoised") = false,
           R"(A new array of shape (height, width, 3): the estimate so far, float32.

denoised=True gives radiance with less noise, if the scene was loaded with denoise=True. Raises RuntimeError before the first
iteration.)")
      .def(
          "view", screen_bytes, py::arg("frame") = 0, py::kw_only(), py::arg("view") = "", py::arg("exposure") = 0,
          py::arg("denoised") = false,
          R"(A new array of shape (height, width, 3) and eight bits per channel: radiance as a screen shows it, in sRGB.

view is "agx" (the default), "filmic", "standard", "raw" or "ocio:DISPLAY/VIEW", exposure in stops; as of --view and --exposure.)")
      .def("write", write_files, py::arg("outfile"), py::kw_only(), py::arg("frames") = std::vector<int>(),
           py::arg("png") = false, py::arg("half") = std::nullopt, py::arg("view") = "", py::arg("exposure") = 0,
           py::arg("contact_sheet") = "",
           R"(Writes the images so far as the program does, and returns the names of the files.

outfile is .exr, .hdr, .pfm or .png, with names as of --outfile: "ball.####.exr" or "{legs}_{frame}.exr".
EXR files have the outputs as layers. A scene that was loaded with denoise=True also gets images with less noise.
frames are indices; without them all frames are written. png=True also writes PNGs.)")
      .def("__repr__", words_of)
      .def(
          "__len__", [](const Render& r) { return r.labels().size(); }, "How many frames it has.")
      .def("alpha", alpha, py::arg("frame") = 0, "A new array of shape (height, width), or None if the Film is opaque.")
      .def_property_readonly("statistics", statistics, R"(Work and time so far: a dict.

`done` is work that was done, `separate` what separate renders of the frames would have done; `errors` are estimates by frame,
if the integrator makes them.)");
}

}  // namespace dspm::python
