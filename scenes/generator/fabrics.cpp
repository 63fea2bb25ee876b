// Woven cloth. linen.png, tweed.png and so on, in linear values: 0 where a thread of the first colour lies on top, 1
// where one of the second does. The pictures repeat and stand for 16 cm. fabrics.dsc: 500 variations, each weave in
// each of 25 dyes with a light and with a dark second colour; they replace the texture "fabric".
#include <fmt/format.h>

#include <array>
#include <cstdint>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/system/atomic_file.h"
#include "dspm/image/png.h"
#include "scenes/generator/noise.h"
#include "scenes/generator/picture.h"
#include "scenes/generator/subjects.h"

namespace dspm {
namespace {

constexpr int kThreads = 64, kPixels = 4 * kThreads;

/// Which threads have the second colour, and where a warp thread (running up) lies over the weft.
struct Weave {
  std::string_view name;
  bool (*warp_colour)(int thread);
  bool (*weft_colour)(int thread);
  bool (*warp_on_top)(int warp, int weft);
  float melange;  // how much the threads' colours vary
};

bool always(int) { return true; }
bool never(int) { return false; }
bool plain(int warp, int weft) { return (warp + weft) % 2 == 0; }
bool twill(int warp, int weft) { return (warp + weft) % 4 < 2; }
bool fours(int thread) { return thread % 8 < 4; }
bool eights(int thread) { return thread % 16 < 8; }
bool sett(int thread) { return thread < 22 || (thread >= 26 && thread < 28) || (thread >= 32 && thread < 34); }

constexpr std::array<Weave, 10> kWeaves{{
    {"linen", always, never, plain, 0.9f},
    {"tweed", eights, fours,
     [](int warp, int weft) {
       return noise(5, static_cast<float>(warp) / kThreads, static_cast<float>(weft) / kThreads, kThreads, kThreads) >
              0.5f;
     },
     0.8f},
    {"twill", always, never, twill, 0.35f},
    {"herringbone", always, never,
     [](int warp, int weft) { return twill(warp % 16 < 8 ? warp : 15 - warp % 16, weft); }, 0.35f},
    {"houndstooth", fours, fours, twill, 0.25f},
    {"hopsack", always, never, [](int warp, int weft) { return plain(warp / 4, weft / 4); }, 0.5f},
    {"stripe", eights, never, [](int, int) { return true; }, 0.25f},
    {"ticking", [](int thread) { return thread % 16 == 4 || thread % 16 == 5 || thread % 16 == 8; }, never,
     [](int, int) { return true; }, 0.25f},
    {"gingham", eights, eights, plain, 0.2f},
    {"tartan", sett, sett, twill, 0.2f},
}};

/// A thread varies in thickness and shade along its length.
float thread_shade(const Weave& weave, int thread, float along, bool is_warp) {
  const float across = (static_cast<float>(thread) + 0.5f) / kThreads;
  const float slub = is_warp ? noise(21, across, along, kThreads, 6) : noise(22, along, across, 6, kThreads);
  return weave.melange * (slub - 0.5f);
}

float amount(const Weave& weave, float x, float y) {
  const int warp = static_cast<int>(x * kThreads), weft = static_cast<int>(y * kThreads);
  const bool top = weave.warp_on_top(warp, weft);
  const float colour = top ? weave.warp_colour(warp) : weave.weft_colour(weft);
  const float shade = top ? thread_shade(weave, warp, y, true) : thread_shade(weave, weft, x, false);
  return std::clamp(0.1f + 0.8f * colour + shade, 0.f, 1.f);
}

struct Dye {
  std::string_view name;
  Rgb colour;
};

constexpr std::array<Dye, 25> kDyes{{
    {"chalk", {.66f, .63f, .57f}},   {"sand", {.53f, .43f, .29f}},     {"straw", {.6f, .46f, .19f}},
    {"mustard", {.5f, .29f, .035f}}, {"ochre", {.42f, .2f, .04f}},     {"apricot", {.6f, .28f, .12f}},
    {"rust", {.34f, .085f, .025f}},  {"brick", {.3f, .06f, .035f}},    {"cherry", {.32f, .018f, .03f}},
    {"rose", {.55f, .2f, .2f}},      {"plum", {.13f, .025f, .07f}},    {"lilac", {.33f, .25f, .44f}},
    {"violet", {.12f, .06f, .25f}},  {"indigo", {.025f, .035f, .15f}}, {"navy", {.012f, .022f, .07f}},
    {"denim", {.07f, .13f, .26f}},   {"sky", {.22f, .39f, .55f}},      {"teal", {.02f, .16f, .19f}},
    {"mint", {.28f, .5f, .39f}},     {"moss", {.13f, .17f, .05f}},     {"olive", {.2f, .19f, .05f}},
    {"bottle", {.015f, .08f, .04f}}, {"cocoa", {.11f, .05f, .028f}},   {"slate", {.1f, .12f, .14f}},
    {"coal", {.025f, .025f, .028f}},
}};

std::string variation(const Weave& weave, const Dye& dye, bool light) {
  const Rgb partner = light ? dye.colour * 0.3f + Rgb(.5f, .475f, .43f) : dye.colour * 0.3f;
  const auto rgb = [](const Rgb& c) { return fmt::format("[{:.3f} {:.3f} {:.3f}]", c.r, c.g, c.b); };
  return fmt::format(
      "VariationBegin \"{0}-{1}-{2}\"\n"
      "  Texture \"fabric\" \"spectrum\" \"mix\" \"rgb tex1\" {3} \"rgb tex2\" {4} \"texture amount\" \"{0}\"\n"
      "VariationEnd\n",
      weave.name, dye.name, light ? "light" : "dark", rgb(dye.colour), rgb(partner));
}

}  // namespace

void make_fabrics(const std::filesystem::path& directory) {
  std::string variations = "# Made by the generator of the scenes; chair-fabrics.dsc includes it.\n";
  for (const Weave& weave : kWeaves) {
    const auto woven = [&](float x, float y) { return amount(weave, x, y); };
    write_png(directory / fmt::format("{}.png", weave.name), picture(kPixels, kPixels, woven));
    for (const Dye& dye : kDyes)
      for (const bool light : {true, false}) variations += variation(weave, dye, light);
  }
  write_file(directory / "fabrics.dsc", variations);
}

}  // namespace dspm
