// A picture on a surface; with a number in the file name, one per frame.
//
//   Texture "label" "spectrum" "imagemap" "string filename" "label.png" "string wrap" "clamp"
//
//   | filename      | required   | a picture of any format of image.h; "water.%03d.png" is numbered like the frames |
//   | wrap          | "repeat"   | outside 0..1: repeat, mirror, black, clamp or octahedralsphere |
//   | wrapv         | as wrap    | the same along v alone; not octahedralsphere |
//   | channel       | ""         | of a texture of numbers: red, green, blue or alpha |
//   | filter        | "bilinear" | or point, trilinear, ewa |
//   | maxanisotropy | 8          | of ewa: how much longer than wide the ellipse may be; 1 to 64 |
//   | scale         | 1          | multiplies the picture |
//   | invert        | false      | 1 - the scaled picture, not below 0 |
//   | encoding      | ""         | sRGB, linear or "gamma 2.2"; by default sRGB for integers, linear for floating point |
//   and the mapping's parameters, see mapping.h.
//
// (0, 0) is the picture's lower left corner. A texture of numbers takes the alpha of a picture that has one, else the
// mean of red, green and blue. Filters are for matte colours (Material::averages) of pictures that go on beyond 0..1
// (wrap repeat, mirror or octahedralsphere) and have no values above 1; other lookups take the picture itself. Filters
// but ewa take a size of the picture at which a pixel is at most twice as wide as the footprint is long: point takes
// one pixel of it, bilinear blends four, and trilinear blends two sizes as well. ewa averages over the ellipse that the
// footprint is, and so stays sharp where a surface is seen at a slant.
#include <algorithm>
#include <optional>
#include <stdexcept>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/params/params.h"
#include "dspm/image/image.h"
#include "dspm/textures/image_lookup.h"
#include "dspm/textures/mapping.h"
#include "dspm/textures/plain_texture.h"
#include "dspm/textures/plugins.h"

namespace dspm {
namespace {

Wrap wrap_of(const std::string& word) {
  return word == "repeat"   ? Wrap::repeat
         : word == "mirror" ? Wrap::mirror
         : word == "black"  ? Wrap::black
         : word == "clamp"  ? Wrap::clamp
                            : Wrap::octahedral_sphere;
}

Channel channel_of(const std::string& word) {
  return word == "red"     ? Channel::red
         : word == "green" ? Channel::green
         : word == "blue"  ? Channel::blue
         : word == "alpha" ? Channel::alpha
                           : Channel::usual;
}

ImageFilter filter_of(const std::string& word) {
  return word == "point"                  ? ImageFilter::point
         : word == "bilinear"             ? ImageFilter::bilinear
         : word == "ewa" || word == "EWA" ? ImageFilter::ewa
                                          : ImageFilter::trilinear;
}

template <class T>
class ImageTexture final : public Texture<T> {
 public:
  ImageTexture(const ImageLookup& lookup, const TextureMapping& mapping, const PictureTone& tone, bool averages)
      : lookup_(lookup), mapping_(mapping), tone_(tone), averages_(averages) {}

  T evaluate(const TexturePoint& at) const override {
    TextureCoordinates c = mapping_.map(at);
    c.st.y = 1 - c.st.y, c.dstdx.y = -c.dstdx.y, c.dstdy.y = -c.dstdy.y;
    return tone_.of(lookup_.at<T>(c));
  }
  bool averages() const override { return averages_; }
  std::optional<PlainTexture<T>> plain() const override {
    const auto mapping = mapping_.plain();
    return mapping ? std::optional<PlainTexture<T>>(PlainImagemap<T>{lookup_.plain(), *mapping, tone_}) : std::nullopt;
  }

 private:
  ImageLookup lookup_;
  TextureMapping mapping_;
  PictureTone tone_;
  bool averages_;
};

/// Returns whether the picture has no end, at which smaller ones would blur what it shows into what lies beyond, and
/// whether nothing in it is cut off.
bool averages(const Image& picture, const ImageLookup::Settings& settings, float scale) {
  const auto ends = [](Wrap wrap) { return wrap == Wrap::black || wrap == Wrap::clamp; };
  return !ends(settings.wrap) && !ends(settings.wrap_v.value_or(settings.wrap)) &&
         std::all_of(picture.pixels.begin(), picture.pixels.end(), [&](const Rgb& c) { return is_albedo(c * scale); });
}

/// Reads the lookup. pbrt's word for the filter is also spelt in capitals.
ImageLookup::Settings read_lookup(ParamReader& reader) {
  ImageLookup::Settings settings;
  settings.wrap = wrap_of(reader.choice("wrap", "repeat", {"repeat", "mirror", "black", "clamp", "octahedralsphere"},
                                        "the picture outside 0..1"));
  const std::string along_v =
      reader.choice("wrapv", "", {"", "repeat", "mirror", "black", "clamp"}, "the same along v alone; as wrap if \"\"");
  if (!along_v.empty()) settings.wrap_v = wrap_of(along_v);
  settings.channel = channel_of(
      reader.choice("channel", "", {"", "red", "green", "blue", "alpha"}, "that a texture of numbers takes"));
  settings.filter = filter_of(reader.choice("filter", "bilinear", {"bilinear", "point", "trilinear", "ewa", "EWA"},
                                            "how a lookup averages over what it stands for"));
  settings.max_anisotropy =
      reader.number("maxanisotropy", 8, {}, "of ewa: how much longer than wide an ellipse may be");
  return settings;
}

}  // namespace

template <class T>
TexturePtr<T> make_imagemap(ParamReader& reader, const TextureContext& context) {
  const std::filesystem::path path = reader.file(
      "filename", "PNG, JPEG, TGA, BMP, PNM, QOI, TIFF, WebP, OpenEXR, HDR or PFM; one per frame with %03d");
  const ImageLookup::Settings settings = read_lookup(reader);
  const float scale = reader.number("scale", 1, {}, "multiplies the picture");
  const bool invert = reader.flag("invert", false, "1 - the scaled picture");
  const std::string words = reader.text("encoding", "", "sRGB, linear or gamma 2.2; sRGB for integers, else linear");
  const TextureMapping mapping = TextureMapping::read(reader, context.world_from_texture);
  reader.finish();

  if (!(settings.max_anisotropy >= 1 && settings.max_anisotropy <= 64))
    reader.error("maxanisotropy", "\"maxanisotropy\" must be from 1 to 64");
  const std::optional<ColorEncoding> encoding = words.empty() ? ColorEncoding{} : ColorEncoding::parse(words);
  if (!encoding)
    reader.error("encoding", "unknown encoding \"" + words + "\"",
                 "available: sRGB, linear, or gamma with an exponent");
  try {
    if (!path.empty() && encoding) {
      const auto picture = context.images.read(path, *encoding);
      return std::make_shared<ImageTexture<T>>(ImageLookup(picture, settings), mapping, PictureTone{scale, invert},
                                               averages(picture->level(0), settings, scale));
    }
  } catch (const std::runtime_error& unreadable) {
    reader.error("filename", unreadable.what());
  }
  return std::make_shared<ConstantTexture<T>>(T(0.5f));
}

template TexturePtr<float> make_imagemap<float>(ParamReader&, const TextureContext&);
template TexturePtr<Rgb> make_imagemap<Rgb>(ParamReader&, const TextureContext&);

}  // namespace dspm
