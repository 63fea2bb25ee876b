// A picture on a surface; with a number in the file name, one per frame.
//
//   Texture "label" "spectrum" "imagemap" "string filename" "label.png" "string wrap" "clamp"
//
//   | filename | required   | a picture of any format of image.h; "water.%03d.png" is numbered like the frames |
//   | wrap     | "repeat"   | outside 0..1: repeat, clamp or black |
//   | filter   | "bilinear" | or point; trilinear and ewa are treated as bilinear |
//   | scale    | 1          | multiplies the picture |
//   | invert   | false      | 1 - the scaled picture, not below 0 |
//   | encoding | ""         | sRGB, linear or "gamma 2.2"; by default sRGB for integers, linear for floating point |
//   and the mapping's parameters, see mapping.h.
//
// (0, 0) is the picture's lower left corner. A texture of numbers takes the mean of red, green and blue.
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "dspm/colour/rgb.h"
#include "dspm/image/image.h"
#include "dspm/math/vec.h"
#include "dspm/params/params.h"
#include "dspm/textures/mapping.h"
#include "dspm/textures/plugins.h"

namespace dspm {
namespace {

enum class Wrap { repeat, clamp, black };

Wrap wrap_of(const std::string& word) {
  return word == "repeat" ? Wrap::repeat : word == "black" ? Wrap::black : Wrap::clamp;
}

/// One axis of a lookup: two neighbouring pixels, -1 for none, and the weight of the second.
struct Taps {
  std::array<int, 2> pixel;
  float share;
};

template <class T>
T value_of(const Rgb& c) {
  if constexpr (std::is_same_v<T, float>)
    return (c.r + c.g + c.b) / 3;
  else
    return c;
}

template <class T>
class ImageTexture final : public Texture<T> {
 public:
  struct Look {
    Wrap wrap = Wrap::repeat;
    bool smooth = true;
    float scale = 1;
    bool invert = false;
  };

  ImageTexture(std::shared_ptr<const Image> image, const TextureMapping& mapping, const Look& look)
      : image_(std::move(image)), mapping_(mapping), look_(look) {}

  T evaluate(const TexturePoint& at) const override {
    const Vec2 st = mapping_.at(at);
    const Rgb looked_up = look_up({st.x, 1 - st.y}) * look_.scale;
    const Rgb value = look_.invert ? Rgb(1) - looked_up : looked_up;
    return value_of<T>({std::max(value.r, 0.f), std::max(value.g, 0.f), std::max(value.b, 0.f)});
  }

 private:
  Rgb look_up(Vec2 st) const {
    const Taps x = taps(st.x, image_->width), y = taps(st.y, image_->height);
    if (!look_.smooth) return pixel(x.pixel[0], y.pixel[0]);
    return (pixel(x.pixel[0], y.pixel[0]) * (1 - x.share) + pixel(x.pixel[1], y.pixel[0]) * x.share) * (1 - y.share) +
           (pixel(x.pixel[0], y.pixel[1]) * (1 - x.share) + pixel(x.pixel[1], y.pixel[1]) * x.share) * y.share;
  }

  /// Pixel i covers i .. i + 1, its centre is at i + 1/2.
  Taps taps(float s, int count) const {
    if (look_.wrap == Wrap::repeat) s -= std::floor(s);
    const float n = static_cast<float>(count), centred = s * n - (look_.smooth ? 0.5f : 0.f);
    // In this order of min and max, a coordinate that is NaN becomes -1.
    const float x = std::max(-1.f, std::min(centred, n)), first = std::floor(x);
    const int i = static_cast<int>(first);
    return {{wrapped(i, count), wrapped(i + 1, count)}, x - first};
  }

  int wrapped(int i, int count) const {
    if (0 <= i && i < count) return i;
    switch (look_.wrap) {
      case Wrap::repeat: return i < 0 ? count - 1 : 0;
      case Wrap::clamp: return i < 0 ? 0 : count - 1;
      case Wrap::black: break;
    }
    return -1;
  }

  Rgb pixel(int x, int y) const { return x < 0 || y < 0 ? Rgb() : image_->at(x, y); }

  std::shared_ptr<const Image> image_;
  TextureMapping mapping_;
  Look look_;
};

/// Once per scene, however many textures ask for it.
void note_filter(ParamReader& reader, const std::string& filter) {
  const std::string message = "texture filter \"" + filter + "\" is treated as \"bilinear\"";
  const auto& all = reader.diagnostics().all();
  if (std::none_of(all.begin(), all.end(), [&](const Diagnostic& d) { return d.message == message; }))
    reader.diagnostics().note(reader.where("filter"), message);
}

}  // namespace

template <class T>
TexturePtr<T> make_imagemap(ParamReader& reader, const TextureContext& context) {
  const std::filesystem::path path = reader.file(
      "filename", "PNG, JPEG, TGA, BMP, PNM, QOI, TIFF, WebP, OpenEXR, HDR or PFM; one per frame with %03d");
  const std::string wrap = reader.choice("wrap", "repeat", {"repeat", "clamp", "black", "octahedralsphere"},
                                         "the picture outside 0..1; octahedralsphere is not supported");
  const std::string filter = reader.choice("filter", "bilinear", {"bilinear", "point", "trilinear", "ewa"},
                                           "between pixels; trilinear and ewa are treated as bilinear");
  reader.number("maxanisotropy", 8, {}, "of ewa; without effect");
  typename ImageTexture<T>::Look look{wrap_of(wrap), filter != "point"};
  look.scale = reader.number("scale", 1, {}, "multiplies the picture");
  look.invert = reader.flag("invert", false, "1 - the scaled picture");
  const std::string words = reader.text("encoding", "", "sRGB, linear or gamma 2.2; sRGB for integers, else linear");
  const TextureMapping mapping = TextureMapping::read(reader, context.world_from_texture);
  reader.finish();

  if (wrap == "octahedralsphere") reader.unsupported("wrap", "the octahedral sphere; with --lenient: clamp");
  if (filter == "trilinear" || filter == "ewa") note_filter(reader, filter);
  const std::optional<ColorEncoding> encoding = words.empty() ? ColorEncoding{} : ColorEncoding::parse(words);
  if (!encoding)
    reader.error("encoding", "unknown encoding \"" + words + "\"",
                 "available: sRGB, linear, or gamma with an exponent");
  try {
    if (!path.empty() && encoding)
      return std::make_shared<ImageTexture<T>>(context.images.read(path, *encoding), mapping, look);
  } catch (const std::runtime_error& unreadable) {
    reader.error("filename", unreadable.what());
  }
  return std::make_shared<ConstantTexture<T>>(T(0.5f));
}

template TexturePtr<float> make_imagemap<float>(ParamReader&, const TextureContext&);
template TexturePtr<Rgb> make_imagemap<Rgb>(ParamReader&, const TextureContext&);

}  // namespace dspm
