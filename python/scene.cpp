#include "python/scene.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <variant>

#include "dspm/base/math/frames.h"
#include "dspm/base/math/moments.h"
#include "dspm/base/system/files_read.h"
#include "dspm/base/system/inner_files.h"
#include "dspm/session/checkpoint/facts.h"
#include "dspm/session/frame_intervals.h"
#include "python/module.h"

namespace dspm::python {

namespace py = pybind11;

void KeptWarnings::raise() const {
  for (const std::string& text : texts_)
    if (PyErr_WarnEx(PyExc_UserWarning, text.c_str(), 2) != 0) throw py::error_already_set();
}

namespace {

using Share = double;
using Size = std::pair<int, int>;
using Number = std::variant<int, double, std::string>;

std::vector<Moment> moments_of(std::vector<int> numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  std::vector<Moment> moments;
  for (const int number : numbers) moments.push_back(Moment::numbered(number));
  return moments;
}

std::string text_of(const Number& value) {
  return std::visit([](const auto& v) { return fmt::format("{}", v); }, value);
}

Resolution resolution_of(const std::variant<Size, Share>& asked) {
  if (const auto* share = std::get_if<Share>(&asked)) {
    if (!(*share > 0)) throw UsageError("resolution: expected a share above 0, or (width, height)");
    return {.share = *share};
  }
  const auto [width, height] = std::get<Size>(asked);
  if (width < 1 || height < 1) throw UsageError("resolution: expected a width and a height of at least one pixel");
  return {.width = width, .height = height};
}

std::optional<Denoiser> denoiser_of(const std::variant<bool, std::string>& asked) {
  if (const auto* yes = std::get_if<bool>(&asked)) return *yes ? std::optional(Denoiser::own) : std::nullopt;
  if (std::get<std::string>(asked) == "oidn") return Denoiser::oidn;
  throw UsageError("denoise: expected True, False or \"oidn\"");
}

/// As long as the scene may read them again.
struct WithFiles {
  explicit WithFiles(std::map<std::filesystem::path, std::string> made) : files(std::move(made)) {}
  FilesInMemory files;
  std::shared_ptr<const LoadedScene> scene;
};

std::string colour_of(const std::string& asked) {
  if (asked.empty() || asked == "rgb" || asked == "spectral") return asked;
  throw UsageError("colour: expected \"rgb\" or \"spectral\"");
}

ReadScene load(const std::variant<std::filesystem::path, std::vector<std::filesystem::path>>& files,
               const std::map<std::string, Number>& define, const std::string& integrator,
               std::optional<int> iterations, std::optional<int> photons, std::optional<int> maxdepth,
               std::optional<std::uint64_t> seed, const std::string& colour, const std::vector<int>& frames,
               const std::vector<std::string>& variations, const std::optional<std::variant<Size, Share>>& resolution,
               const std::vector<std::string>& outputs, const std::variant<bool, std::string>& denoise, bool lenient,
               const std::map<std::filesystem::path, std::variant<py::bytes, std::string>>& made) {
  Choices choices;
  for (const auto& [name, value] : define) choices.defines.push_back(fmt::format("{}={}", name, text_of(value)));
  choices.integrator = integrator, choices.iterations = iterations, choices.photons = photons;
  choices.max_depth = maxdepth, choices.seed = seed, choices.colour = colour_of(colour);
  choices.frames = moments_of(frames), choices.variations = variations, choices.outputs = outputs;
  choices.denoiser = denoiser_of(denoise), choices.lenient = lenient;
  if (resolution) choices.resolution = resolution_of(*resolution);
  std::vector<std::string> names;
  if (const auto* one = std::get_if<std::filesystem::path>(&files))
    names.push_back(one->string());
  else
    for (const auto& file : std::get<1>(files)) names.push_back(file.string());
  std::map<std::filesystem::path, std::string> contents;
  for (const auto& [file, content] : made)
    contents[file] = std::visit([](const auto& each) { return std::string(each); }, content);
  ReadScene scene;
  KeptWarnings warnings;
  {
    const py::gil_scoped_release without_python;
    static std::mutex one_at_a_time;  // a scene's files are those that were read while it was loaded
    const std::lock_guard lock(one_at_a_time);
    forget_files_read();
    const auto all = std::make_shared<WithFiles>(std::move(contents));
    all->scene = load_scene(names, choices, warnings.keeper());
    scene.loaded = {all, all->scene.get()};
    scene.digest = digest_of(scene.loaded->job);
  }
  warnings.raise();
  return scene;
}

std::vector<std::string> labels_of(const ReadScene& scene) {
  std::vector<std::string> labels;
  for (const FileFrame frame : scene.loaded->job.frames)
    labels.push_back(scene.loaded->description->frames.label(frame));
  return labels;
}

/// As templates of file names call it.
std::string name_of_axis(const SceneDescription& description, std::size_t axis) {
  const std::string& name = description.axes[axis].name;
  return name.empty() ? fmt::format("{}", axis + 1) : name;
}

/// In the order of the scene, as are the choices along each.
py::dict axes_of(const ReadScene& scene) {
  const SceneDescription& description = *scene.loaded->description;
  py::dict axes;
  for (std::size_t i = 0; i < description.axes.size(); ++i) {
    py::list names;
    for (const Variation& variation : description.axes[i].variations) names.append(variation.name);
    axes[py::str(name_of_axis(description, i))] = names;
  }
  return axes;
}

using ChoiceByAxis = std::map<std::string, std::string>;

ChoiceByAxis choices_of(const ReadScene& scene, FileFrame frame) {
  const SceneDescription& description = *scene.loaded->description;
  ChoiceByAxis choices;
  for (std::size_t i = 0; i < description.axes.size(); ++i) {
    const auto chosen = static_cast<std::size_t>(description.frames.choice(frame, i));
    choices[name_of_axis(description, i)] = description.axes[i].variations[chosen].name;
  }
  return choices;
}

std::vector<ChoiceByAxis> all_choices(const ReadScene& scene) {
  std::vector<ChoiceByAxis> all;
  for (const FileFrame frame : scene.loaded->job.frames) all.push_back(choices_of(scene, frame));
  return all;
}

std::vector<int> numbers_of(const ReadScene& scene) {
  std::vector<int> numbers;
  for (const FileFrame frame : scene.loaded->job.frames) numbers.push_back(scene.loaded->job.moment(frame).number());
  return numbers;
}

std::vector<int> find(const ReadScene& scene, const std::optional<int>& number, const py::kwargs& choices) {
  const auto wanted = choices.cast<ChoiceByAxis>();
  const py::dict axes = axes_of(scene);
  for (const auto& [axis, choice] : wanted) {
    if (!axes.contains(axis)) throw UsageError(fmt::format("there is no axis \"{}\"", axis));
    if (!axes[py::str(axis)].contains(choice)) throw UsageError(fmt::format("axis \"{}\" has no \"{}\"", axis, choice));
  }
  std::vector<int> found;
  const FrameList& frames = scene.loaded->job.frames;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const ChoiceByAxis chosen = choices_of(scene, frames[i]);
    const auto is_chosen = [&](const auto& each) { return chosen.at(each.first) == each.second; };
    const bool has_number = !number || *number == scene.loaded->job.moment(frames[i]).number();
    if (has_number && std::all_of(wanted.begin(), wanted.end(), is_chosen)) found.push_back(static_cast<int>(i));
  }
  return found;
}

}  // namespace

void add_scene(py::module_& module) {
  py::class_<ReadScene>(module, "Scene", R"(A scene that was read, with the caller's choices.

load() makes it. It does not change; load it again for other choices.)")
      .def_property_readonly("labels", labels_of, "What its frames are called: '12', 'oak-red' or 'oak-red 12'.")
      .def_property_readonly("axes", axes_of,
                             "The axes along which its variations differ, and the choices of each: a dict of lists.")
      .def_property_readonly("choices", all_choices, "What each frame is along each axis: a list of dicts.")
      .def_property_readonly("numbers", numbers_of, "Each frame's number in the animation, from 1 on.")
      .def("find", find, py::arg("number") = std::nullopt,
           R"(The indices of frames with this number and these choices: scene.find(12), scene.find(legs="oak").

Names that are not Python's go as find(**{"top colour": "red"}). Raises UsageError if there is no such axis or choice.)")
      .def_property_readonly(
          "size", [](const ReadScene& s) { return Size(s.loaded->job.settings.width, s.loaded->job.settings.height); },
          "Width and height of the full image in pixels.")
      .def_property_readonly(
          "shape",
          [](const ReadScene& s) {
            const PixelRect& crop = s.loaded->job.settings.crop;
            return std::pair(crop.height(), crop.width());
          },
          "Height and width of the images: of what the Film crops.")
      .def_property_readonly(
          "integrator", [](const ReadScene& s) { return s.loaded->job.integrator; }, "The integrator's name.")
      .def_property_readonly(
          "fps", [](const ReadScene& s) { return s.loaded->job.fps; }, "Frames a second; 0: no animation.")
      .def(
          "__len__", [](const ReadScene& s) { return s.loaded->job.frames.size(); }, "How many frames it has.")
      .def("__repr__",
           [](const ReadScene& s) {
             return fmt::format("<dspm.Scene {}: {}>", s.loaded->job.scene_file, summary_of(*s.loaded));
           })
      .def(
          "explain",
          [](const ReadScene& s) {
            const FrameList& all = s.loaded->job.frames;
            const std::size_t count = std::min<std::size_t>(all.size(), kMaxFrames);
            return s.loaded->world->explain({all.data(), count});
          },
          "What is shared between the frames and what is not, and why: sentences. Of the first 64 frames.");

  module.def("load", load, py::arg("files"), py::kw_only(), py::arg("define") = std::map<std::string, Number>(),
             py::arg("integrator") = "", py::arg("iterations") = std::nullopt, py::arg("photons") = std::nullopt,
             py::arg("maxdepth") = std::nullopt, py::arg("seed") = std::nullopt, py::arg("colour") = "",
             py::arg("frames") = std::vector<int>(), py::arg("variations") = std::vector<std::string>(),
             py::arg("resolution") = std::nullopt, py::arg("outputs") = std::vector<std::string>(),
             py::arg("denoise") = false, py::arg("lenient") = false,
             py::arg("made") = std::map<std::filesystem::path, std::variant<py::bytes, std::string>>(),
             R"(Reads a scene from a file, or from several that follow one another.

The choices are those of the command line: define={"roughness": 0.1} sets what the scene calls $roughness; frames are
numbers as in the scene, from 1 on; variations are patterns of names ("steel-*"); resolution is a share or (width, height);
outputs are names as of --aov; denoise=True prepares for images with less noise ("oidn": by that program). Without them the scene decides.

made={"room.dsc": text, "seat.ply": dspm.ply(vertices, faces)} are files in memory, in place of those on disk or beside them.

Warnings go to Python's `warnings`. Raises SceneError with the errors of the scene, UsageError if a choice does not fit it.)");
}

}  // namespace dspm::python
