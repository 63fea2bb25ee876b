// The user's choices, which override what the scene says.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dspm/base/math/moments.h"
#include "dspm/lang/file_frames.h"

namespace dspm {

/// A quick look has a quarter of the width, of the height and of the iterations, and as many photons per pixel.
inline constexpr int kQuickShare = 4;

/// The denoiser that makes a second image of each, with less noise.
enum class Denoiser {
  own,
  oidn,  // Intel's Open Image Denoise, as a program
};

/// The size of the full image: a share of the scene's, or pixels.
struct Resolution {
  double share = 0;  // 0: width and height count
  int width = 0, height = 0;
};

struct Choices {
  std::vector<std::string> defines;      // name=value
  bool lenient = false;                  // unsupported features are warnings, not errors
  bool quick = false;                    // see kQuickShare
  std::optional<Resolution> resolution;  // none: as the Film says

  // Of glTF files; see gltf::Settings.
  double page_fps = 0;  // also of images that exist; 0: 24, or as images say
  std::string animation, camera, studio = "auto", hdr, hdr_backdrop = "shown";

  std::string outfile;               // empty: the Film's filename
  std::optional<bool> half;          // none: as the Film says
  bool transparent = false;          // whatever the Film says
  std::vector<std::string> outputs;  // to be written next to radiance, besides those of the Film
  std::optional<Denoiser> denoiser;  // none: no second images

  std::optional<std::uint64_t> seed;
  std::string noise;              // frozen or perframe; empty: what the scene says
  std::string colour;             // rgb or spectral; empty: what the scene says
  std::string device;             // cpu, waves, gpu or auto, see Device; empty: cpu
  std::string integrator, accel;  // empty: what the scene says
  std::optional<int> iterations, photons, max_depth;
  double until_error = 0;                            // relative; 0: the number of iterations decides
  std::vector<Moment> frames;                        // whole ones of the animation, ascending; empty: all
  std::vector<std::string> variations;               // patterns of names; empty: all
  std::optional<KnownFrames> known;                  // of the run that is resumed, whose frames are chosen, too
  bool only_new = false;                             // of the chosen frames, those that it has not rendered
  std::optional<std::array<double, 4>> crop_window;  // x0, x1, y0, y1 as fractions of the image
  std::optional<std::array<int, 4>> pixel_bounds;    // x0, x1, y0, y1 in pixels
  std::optional<double> shutter;  // frames for which it is open; 0: nothing blurs; none: as the camera says
  std::optional<std::array<double, 9>> look_at;  // eye, target, up: where the camera stands in all frames
};

}  // namespace dspm
