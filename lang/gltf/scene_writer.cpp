#include "dspm/lang/gltf/scene_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "dspm/lang/gltf/excerpt.h"
#include "dspm/lang/gltf/exposure.h"
#include "dspm/lang/gltf/lights.h"
#include "dspm/lang/gltf/primitive.h"
#include "dspm/lang/gltf/studio.h"

namespace dspm::gltf {
namespace {

constexpr int kMostFrames = 100'000;
constexpr int kHeight = 720, kMostWidth = 4096;
constexpr double kBesideOwnLights = 0.35;  // of the studio's light, for what the file's own lights leave dark

std::string prefix_of(const Document& document, const Settings& settings) {
  return settings.around ? document.path().stem().string() + ": " : "";
}

}  // namespace

std::shared_ptr<const SceneWriter::Motion> SceneWriter::motion_of(const Document& document, const Settings& settings) {
  auto motion = std::make_shared<Motion>();
  motion->animation = choose_animation(document, settings.animation);
  if (!settings.animation.empty() && motion->animation.played.empty())
    throw std::runtime_error(fmt::format("it has no animation \"{}\"; available: {}", excerpt(settings.animation),
                                         names_in_words(motion->animation.left_out)));
  motion->fps = settings.around ? settings.around->fps.value_or(settings.fps) : settings.fps;
  motion->frames =
      settings.around ? settings.around->frames : frames_of(motion->animation.duration(), motion->fps, kMostFrames);
  motion->poses = std::make_unique<const Poses>(document, motion->animation, motion->frames, motion->fps);
  return motion;
}

SceneWriter::SceneWriter(std::shared_ptr<const Document> document, std::string folder, const Settings& settings)
    : document_(std::move(document)),
      folder_(std::move(folder)),
      settings_(settings),
      motion_(motion_of(*document_, settings_)),
      materials_(*document_, [this](std::size_t image) { return picture_name(image); }),
      uses_(*document_, motion_->animation, motion_->frames, motion_->fps, materials_,
            prefix_of(*document_, settings_)),
      useful_((*document_)["nodes"].size()) {}

std::vector<std::size_t> SceneWriter::roots() const {
  const Value scenes = (*document_)["scenes"], nodes = (*document_)["nodes"];
  std::vector<std::size_t> roots;
  if (scenes.size() == 0) {
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (!motion_->poses->parent(i)) roots.push_back(i);
  } else {
    const Value own = scenes[(*document_)["scene"].index(scenes.size()).value_or(0)]["nodes"];
    for (std::size_t i = 0; i < own.size(); ++i) {
      roots.push_back(own[i].required_index(nodes.size()));
      if (motion_->poses->parent(roots.back())) own[i].fail("the node is the child of another");
      if (std::count(roots.begin(), roots.end(), roots.back()) > 1) own[i].fail("the node is there twice");
    }
  }
  return roots;
}

Translation SceneWriter::write() {
  const std::vector<std::size_t> all = roots();
  for (const std::size_t node : all) visit(node);
  if (std::none_of(all.begin(), all.end(), [&](std::size_t node) { return useful_[node]; }))
    throw std::runtime_error("its scene has nothing to show: no meshes with surfaces, and no lights");
  if (!settings_.around) choose_camera();
  see_corners();
  for (const std::size_t node : all) write_node(node, 1);
  const std::string axis = uses_.axis();

  std::string& text = result_.text;
  if (!settings_.around) text += header();
  if (!settings_.is_defined && !uses_.definitions().empty()) text += "\n" + uses_.definitions();
  if (!objects_text_.empty()) text += "\nAttributeBegin\n  Identity\n" + objects_text_ + "AttributeEnd\n";
  text += "\nAttributeBegin\n  Scale 1 1 -1  # glTF is right-handed\n  CoordinateSystem " + in_quotes(world_name()) +
          "\n" + world_ + "AttributeEnd\n";
  if (!axis.empty() && !settings_.is_defined) text += "\n" + axis;

  const auto& played = motion_->animation.played;
  if (const auto& left_out = motion_->animation.left_out; !left_out.empty() && settings_.animation.empty())
    result_.notes.push_back(fmt::format("of its animations, {} {} shown, and not {}", names_in_words(played),
                                        played.size() == 1 ? "is" : "are", names_in_words(left_out)));
  for (const std::string& note : materials_.notes()) result_.notes.push_back(note);
  return std::move(result_);
}

std::string SceneWriter::name_of(std::size_t node, const char* instead) const {
  const std::string name = (*document_)["nodes"][node]["name"].text("");
  return name.empty() ? fmt::format("{} {}", instead, node) : name;
}

/// Looks at the node before anything is written: what is wrong with it, what it is good for, where its surface is.
void SceneWriter::visit(std::size_t node) {
  const Document& document = *document_;
  const Value own = document["nodes"][node];
  const Poses& poses = *motion_->poses;
  if (own["camera"].exists()) cameras_.push_back(node);
  bool useful = own.extension("KHR_lights_punctual").exists();
  has_light_ = has_light_ || useful;
  if (const auto mesh = own["mesh"].index(document["meshes"].size())) {
    ++mesh_uses_[*mesh];
    const Value primitives = document["meshes"][*mesh]["primitives"];
    for (std::size_t i = 0; i < primitives.size(); ++i) {
      if (has_surface(primitives[i]))
        useful = true;
      else
        result_.notes.push_back(fmt::format("{}: points and lines are left out", primitives[i].place()));
    }
    see(node, *mesh);
  }
  const Value children = own["children"];
  for (std::size_t i = 0; i < children.size(); ++i) {
    const std::size_t child = children[i].required_index(useful_.size());
    visit(child);
    useful = useful || useful_[child];
  }
  useful_[node] = useful && (poses.at(node, 0).visible || poses.changes_visibility(node));
}

void SceneWriter::choose_camera() {
  if (settings_.studio == "on") return;
  const Value cameras = (*document_)["cameras"];
  std::vector<std::string> names;
  for (const std::size_t node : cameras_) {
    const Value own = (*document_)["nodes"][node];
    const std::string name = own["name"].text("");
    names.push_back(name.empty() ? cameras[own["camera"].required_index(cameras.size())]["name"].text("") : name);
    if (names.back().empty()) names.back() = std::to_string(names.size());
    const bool is_wanted = settings_.camera == names.back() || settings_.camera == std::to_string(names.size());
    if (!camera_node_ && (settings_.camera.empty() || is_wanted)) camera_node_ = node;
  }
  if (!settings_.camera.empty() && !camera_node_)
    throw std::runtime_error(
        fmt::format("it has no camera \"{}\"; available: {}", excerpt(settings_.camera), names_in_words(names)));
  if (settings_.camera.empty() && names.size() > 1)
    result_.notes.push_back(fmt::format("of its cameras, {} is shown; --camera chooses among {}",
                                        excerpt(names.front()), names_in_words(names)));
}

std::string SceneWriter::camera(std::size_t node, double& aspect) {
  const Value cameras = (*document_)["cameras"];
  const std::size_t index = (*document_)["nodes"][node]["camera"].required_index(cameras.size());
  std::vector<std::string> views;
  std::vector<Statement> statements;
  Json json = document_->json();
  for (int frame = 0; frame < motion_->frames; ++frame) {
    const Matrix4 place = Matrix4::scale(1, 1, -1) * motion_->poses->world(node, frame);
    const auto& m = place.m;
    std::array<double, 3> eye{}, target{}, up{};
    const double length = std::hypot(m[0][2], m[1][2], m[2][2]);
    for (std::size_t c = 0; c < 3; ++c) eye[c] = m[c][3], target[c] = m[c][3] - m[c][2] / length, up[c] = m[c][1];
    views.push_back(fmt::format("LookAt {}  {}  {}", listed(eye), listed(target), listed(up)));
    if (!motion_->animation.channels.empty()) set_moment(json, motion_->animation, frame / motion_->fps);
    const Sight sight = camera_of(Value(&json, "")["cameras"][index], aspect);
    statements.push_back(sight.camera);
    if (frame == 0) aspect = sight.aspect;
  }
  std::string text;
  if (std::all_of(views.begin(), views.end(), [&](const std::string& v) { return v == views.front(); })) {
    text = views.front() + "\n";
  } else {
    for (std::size_t i = 0; i < views.size(); ++i) text += fmt::format("Keyframe {} {}\n", i + 1, views[i]);
    text += "KeyframeEnd\n";
  }
  return text + text_of(keyed(statements)) + "\n";
}

std::string SceneWriter::header() {
  const std::string stem = document_->path().stem().string();
  double aspect = 4.0 / 3;
  std::string sight;
  if (camera_node_)
    sight = camera(*camera_node_, aspect);
  else
    sight = view_of(subject_, aspect) + fmt::format("Camera \"perspective\" \"float fov\" {}\n", kUsualFov);
  const int width = std::clamp(static_cast<int>(std::lround(kHeight * aspect)), 16, kMostWidth);
  std::string text = fmt::format("# {}, as dspm reads it\n", document_->path().filename().string());
  if (motion_->frames > 1) text += fmt::format("Frames {} \"float fps\" {}\n", motion_->frames, motion_->fps);
  text += sight;
  std::optional<double> factor;
  if (has_light_) factor = exposure();
  text += fmt::format("Film \"rgb\" \"integer xresolution\" {} \"integer yresolution\" {} \"string filename\" {}{}\n",
                      width, kHeight, in_quotes(stem + ".exr"),
                      factor ? fmt::format(" \"float iso\" {}", 100 * *factor) : "");
  text += "\nWorldBegin\n";
  return text + surroundings(1 / factor.value_or(1));
}

/// What the file lacks of light and ground. `strength`: of light that makes the image of a white surface about 1.
std::string SceneWriter::surroundings(double strength) {
  const bool is_whole = settings_.studio == "on", is_off = settings_.studio == "off";
  std::string text;
  if (!settings_.hdr.empty()) {
    text = light_of_picture(settings_.hdr, settings_.backdrop, strength);
  } else if (!is_off) {
    const std::string sky = folder_ + "/" + files_.add("studio-sky", "sky") + ".pfm";
    result_.files[sky] = sky_picture;
    const bool is_beside = has_light_ && !is_whole;
    text = softboxes_around(subject_, sky, strength * (is_beside ? kBesideOwnLights : 1));
    if (is_beside) result_.notes.push_back("softboxes stand beside its lights; --studio off leaves them out");
  }
  if (is_whole || (!is_off && !camera_node_)) text += ground_for(subject_);
  return text;
}

/// What the images are multiplied by for the file's own lights. Nullopt: nothing.
std::optional<double> SceneWriter::exposure() {
  std::vector<std::size_t> nodes;
  for (std::size_t node = 0; node < useful_.size(); ++node)
    if (useful_[node]) nodes.push_back(node);
  const Vec3 middle = subject_.center();
  const double lux = illuminance(*document_, *motion_->poses, nodes, {middle.x, middle.y, -middle.z});
  const std::optional<double> factor = exposure_for(lux);
  if (factor)
    result_.notes.push_back(
        fmt::format("its lights bring {:.4g} lux, so all images are multiplied by {:.3g} (Film's iso)", lux, *factor));
  return factor;
}

std::string SceneWriter::picture_name(std::size_t image) {
  std::string& name = pictures_[image];
  if (!name.empty()) return name;
  const std::string own = for_file((*document_)["images"][image]["name"].text(""));
  const std::string extension = document_->extension_of_picture(image);
  const std::string stem =
      std::filesystem::path(own).extension() == extension ? std::filesystem::path(own).stem().string() : own;
  name = folder_ + "/" + files_.add(stem, fmt::format("picture{}", image + 1)) + extension;
  result_.files[name] = [document = document_, image] { return document->picture(image); };
  return name;
}

}  // namespace dspm::gltf
