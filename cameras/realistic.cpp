// Camera "realistic" "string lensfile" "gauss.50mm.dat" "float aperturediameter" 12 "float focusdistance" 2.5
//
// A lens of glass: rays start on the film and are bent by each of its surfaces, so that distortion, vignetting, the
// shape of what is out of focus and all aberrations of one colour are the lens' own. The film lies at the origin of
// camera space and looks along +z; its size is the Film's "diagonal". Scenes are in metres, lens files in millimetres.
//
// | parameter        | default  | meaning |
// | ---------------- | -------- | ------- |
// | lensfile         | required | the lens: for each surface, from the scene to the film, its radius (0: a stop), the thickness of what follows, the index of that, and the diameter of its aperture; # begins a comment |
// | aperturediameter | 1        | of the stop, in mm; at most what the lens file says |
// | focusdistance    | 10       | from the film to the plane that is sharp |
// | aperture         | a circle | gaussian, square, pentagon, star, or a picture of what the stop lets through; as bright as the circle |
// | simpleweighting  | false    | pbrt-v3's exposure: the middle of the film is as bright whatever the aperture |
// | shutteropen, shutterclose | 0, 0 | frames: what moves between them blurs; in .pbrt files seconds, 0 and 1 |
//
// A pixel's value is the film's irradiance there, in pbrt-v4's way: an aperture of twice the diameter makes it four
// times as bright ("iso" of the Film evens that out). Light that is traced towards the camera does not reach it.
//
// [Kolb, Mitchell, Hanrahan 1995, A Realistic Camera Model for Computer Graphics; Pharr, Jakob, Humphreys, Physically
// Based Rendering, 3rd ed., 6.4]
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "dspm/base/math/ray.h"
#include "dspm/base/math/rounded.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/params.h"
#include "dspm/base/system/plain_text.h"
#include "dspm/cameras/camera.h"
#include "dspm/cameras/camera_space.h"
#include "dspm/cameras/exit_pupil.h"
#include "dspm/cameras/lens_file.h"
#include "dspm/cameras/projection.h"
#include "dspm/image/image.h"

namespace dspm {
namespace {

/// The film in metres, around the axis.
struct FilmSize {
  Vec2 size, pixels;

  explicit FilmSize(const CameraContext& context)
      : pixels{static_cast<float>(context.width), static_cast<float>(context.height)} {
    size = pixels * (context.film_diagonal / rounded::hypot(pixels.x, pixels.y));
  }
  /// Returns the place on the film; a lens turns its image by half a turn.
  Vec2 at(Vec2 film) const { return {(0.5f - film.x / pixels.x) * size.x, (film.y / pixels.y - 0.5f) * size.y}; }
  Vec2 pixel() const { return {size.x / pixels.x, size.y / pixels.y}; }
  /// The largest distance from the axis, including what a pixel's filter reaches beyond the edge.
  float radius() const { return rounded::hypot(size.x, size.y) / 2 + 8 * pixel().x; }
  friend bool operator==(const FilmSize&, const FilmSize&) = default;
};

/// The parameters, before the lens is made.
struct Settings {
  std::vector<LensSurface> surfaces;
  Diaphragm diaphragm;
  float focus_distance = 10;
  bool relative = false;
  friend bool operator==(const Settings&, const Settings&) = default;
};

/// The camera in its own space, wherever it is.
class Optics {
 public:
  /// Takes a focused lens, with the film at that distance from its principal plane.
  Optics(const FilmSize& film, LensSystem lens, float to_film, bool relative)
      : film_(film), lens_(std::move(lens)), to_film_(to_film), pupil_(lens_, film_.radius()) {
    if (const float middle = relative ? irradiance_in_the_middle() : 0; middle > 0) exposure_ = kPi / 4 / middle;
  }

  const FilmSize& film() const { return film_; }
  float to_film() const { return to_film_; }

  Ray ray(Vec2 film, Vec2 lens) const {
    const Start start = start_at(film, lens);
    const auto passage = lens_.from_film(start.ray);
    return passage ? passage->ray : start.ray;
  }

  float weight(Vec2 film, Vec2 lens) const {
    const Start start = start_at(film, lens);
    if (!(start.weight > 0)) return 0;
    const auto passage = lens_.from_film(start.ray);
    return passage ? start.weight * passage->share * exposure_ : 0;
  }

 private:
  struct Start {
    Ray ray;           // in camera space
    float weight = 0;  // cos^4 / z^2 over the density; 0: no light comes there
  };

  Start start_at(Vec2 film, Vec2 lens) const {
    const Vec2 place = film_.at(film);
    const Vec3 origin{place.x, place.y, 0};
    const auto sample = pupil_.sample(place, lens);
    if (!sample) return {{origin, {0, 0, 1}}};
    const Vec3 direction = normalize(sample->p - origin);
    const float cosine_over_z = direction.z * direction.z / sample->p.z;
    return {{origin, direction}, cosine_over_z * cosine_over_z * sample->area};
  }

  /// Returns the irradiance in the middle of the film if everything has a radiance of 1.
  float irradiance_in_the_middle() const {
    constexpr int kSide = 64;
    float sum = 0;
    for (int i = 0; i < kSide * kSide; ++i)
      sum += weight(film_.pixels * 0.5f,
                    {(static_cast<float>(i % kSide) + 0.5f) / kSide, (static_cast<float>(i / kSide) + 0.5f) / kSide});
    return sum / (kSide * kSide);
  }

  FilmSize film_;
  LensSystem lens_;
  float to_film_;
  ExitPupil pupil_;
  float exposure_ = 1;
};

class Realistic final : public Camera {
 public:
  Realistic(const Transform& to_world, std::shared_ptr<const Optics> optics)
      : to_world_(to_world),
        optics_(std::move(optics)),
        spacing_at_1_(mean_spacing(to_world_, optics_->film().pixel() * (1 / optics_->to_film())) /
                      length(to_world_.vector({0, 0, 1}))) {}

  Ray ray(Vec2 film, Vec2 lens) const override { return carried(to_world_, optics_->ray(film, lens)); }
  float weight(Vec2 film, Vec2 lens) const override { return optics_->weight(film, lens); }
  float pixel_spacing(float path_length) const override { return path_length * spacing_at_1_; }

 private:
  Transform to_world_;
  std::shared_ptr<const Optics> optics_;
  float spacing_at_1_;  // of neighbouring pixels at distance 1, by the thick lens
};

std::vector<LensSurface> read_lens(ParamReader& reader, const std::filesystem::path& file) {
  if (file.empty()) return {};
  try {
    return parse_lens(read_text(file));
  } catch (const std::runtime_error& e) {
    reader.error("lensfile", "cannot read the lens \"" + file.string() + "\": " + e.what(),
                 "a lens file has four numbers for each surface: radius, thickness, index and diameter");
    return {};
  }
}

Diaphragm read_diaphragm(ParamReader& reader) {
  const std::string name =
      reader.text("aperture", "", "gaussian, square, pentagon, star or a picture: what the stop lets through");
  if (name.empty()) return {};
  if (const auto named = Diaphragm::named(name)) return *named;
  const std::filesystem::path file = reader.optional_file("aperture", "");
  try {
    if (!file.empty()) return Diaphragm::of(read_image(file));
  } catch (const std::runtime_error& e) {
    reader.error("aperture", std::string("the aperture's picture: ") + e.what());
  }
  return {};
}

/// Makes the stop as wide as the scene says.
void set_stop(ParamReader& reader, std::vector<LensSurface>& surfaces, float diameter) {
  bool has_stop = false;
  for (LensSurface& surface : surfaces) {
    if (surface.curvature != 0) continue;
    has_stop = true;
    if (diameter / 2 > surface.aperture && reader.has("aperturediameter"))
      reader.warning("aperturediameter", fmt::format("the lens' stop opens to {:g} mm only, so that is its diameter",
                                                     surface.aperture * 2000));
    surface.aperture = std::min(surface.aperture, diameter / 2);
  }
  if (!has_stop && !surfaces.empty() && (reader.has("aperturediameter") || reader.has("aperture")))
    reader.warning("aperturediameter", "the lens has no stop, so its aperture cannot be changed",
                   "a stop is a surface of radius 0");
}

Settings read_settings(ParamReader& reader) {
  Settings settings;
  const std::filesystem::path file = reader.file("lensfile", "the lens: surfaces from the scene to the film, in mm");
  const float stop =
      read_positive(reader, "aperturediameter", 1, "mm", "diameter of the stop, at most that of the lens file") / 1000;
  settings.focus_distance = read_positive(reader, "focusdistance", 10, "m", "from the film to the plane that is sharp");
  settings.diaphragm = read_diaphragm(reader);
  settings.relative =
      reader.flag("simpleweighting", false, "pbrt-v3's exposure: the film's middle is as bright whatever the aperture");
  read_shutter(reader);
  reader.finish();
  settings.surfaces = read_lens(reader, file);
  set_stop(reader, settings.surfaces, stop);
  if (settings.surfaces.empty()) settings.surfaces = {{0, 1, 1, 1}};  // after an error
  return settings;
}

std::shared_ptr<const Optics> make_optics(const Settings& settings, const FilmSize& film, ParamReader& reader) {
  const bool has_errors = reader.diagnostics().error_count() > 0;
  LensSystem lens(settings.surfaces, settings.diaphragm);
  float to_film = 1;
  try {
    to_film = lens.focus(settings.focus_distance);
  } catch (const std::runtime_error& e) {
    if (!has_errors) reader.error("focusdistance", std::string("the lens cannot be focused: ") + e.what());
  }
  return std::make_shared<const Optics>(film, std::move(lens), to_film, settings.relative);
}

/// Makes the optics, or returns those that were made last if they are the same: a camera that moves has a state for
/// each frame, and its exit pupil takes thousands of rays.
std::shared_ptr<const Optics> shared_optics(Settings settings, const FilmSize& film, ParamReader& reader) {
  struct Made {
    Settings settings;
    std::weak_ptr<const Optics> optics;
  };
  static std::mutex mutex;
  static Made last;
  const std::lock_guard lock(mutex);
  if (auto known = last.optics.lock(); known != nullptr && last.settings == settings && known->film() == film)
    return known;
  auto made = make_optics(settings, film, reader);
  last = {std::move(settings), made};
  return made;
}

}  // namespace

std::unique_ptr<Camera> make_realistic(ParamReader& reader, const CameraContext& context) {
  Settings settings = read_settings(reader);
  return std::make_unique<Realistic>(context.to_world, shared_optics(std::move(settings), FilmSize(context), reader));
}

}  // namespace dspm
