// Plain textures, against those that they are of: at points, they have the same, to the bit.
#include "dspm/textures/plain_texture.h"

#include <bit>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <random>

#include "dspm/image/exr.h"
#include "dspm/textures/image_lookup.h"
#include "tests/support/temporary_directory.h"
#include "tests/textures/make.h"

namespace dspm {
namespace plain_texture_test {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

std::uint32_t bits(float x) { return std::bit_cast<std::uint32_t>(x); }
std::vector<std::uint32_t> bits(const Rgb& c) { return {bits(c.r), bits(c.g), bits(c.b)}; }
std::vector<std::uint32_t> bits(const Spectrum& s) { return {bits(s[0]), bits(s[1]), bits(s[2])}; }

class Draw {
 public:
  float real(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  float share() { return real(0, 1); }
  Vec3 vec3(float most) { return {real(-most, most), real(-most, most), real(-most, most)}; }

  TexturePoint point() {
    TexturePoint at{vec3(4), {real(-3, 3), real(-3, 3)}};
    if (whole(0, 3) == 0) at.uv.x = static_cast<float>(whole(-2, 2));
    if (whole(0, 9) == 0) at.uv.y = 1e20f;
    return at;
  }
  Transform placement() {
    if (whole(0, 2) == 0) return {};
    return Transform(Matrix4::translate(real(-2, 2), 1, 0) * Matrix4::rotate(real(0, 360), 1, real(-1, 1), 2) *
                     Matrix4::scale(real(0.5f, 2), real(0.5f, 2), -1));
  }
  std::vector<Param> with_mapping(std::vector<Param> params) {
    const char* kinds[] = {"uv", "uv", "spherical", "cylindrical", "planar"};
    params.push_back(text_param("mapping", kinds[whole(0, 4)]));
    for (const char* name : {"uscale", "vscale", "udelta", "vdelta"}) params.push_back(number_param(name, real(-3, 3)));
    if (whole(0, 1) == 0) params.push_back(number_param("rotation", real(0, 360)));
    for (const char* name : {"v1", "v2"}) {
      const Vec3 v = vec3(2);
      params.push_back(triple_param(ParamType::vector3, name, v.x, v.y, v.z));
    }
    return params;
  }
  template <class T>
  Param value(const std::string& name) {
    if constexpr (std::is_same_v<T, float>)
      return number_param(name, share());
    else
      return triple_param(ParamType::rgb, name, share(), share(), share());
  }

 private:
  std::mt19937 random_{5};
};

template <class T>
void expect_same(const Texture<T>& texture, Draw& draw, const std::string& name) {
  const std::optional<PlainTexture<T>> plain = texture.plain();
  ASSERT_TRUE(plain) << name;
  for (int i = 0; i < 60; ++i) {
    const TexturePoint at = draw.point();
    const T value = plain->at({at.p, at.uv});
    ASSERT_EQ(bits(value), bits(texture.evaluate(at))) << name << " " << i;
    ASSERT_EQ(bits(value), bits(texture.carried(at))) << name << " " << i;
  }
}

/// Calls fn(T, the texture's type) for textures of numbers and of colours.
template <class Fn>
void for_both(Fn&& fn) {
  for (int i = 0; i < 12; ++i) fn(float{}), fn(Rgb{});
}

TEST(PlainTexture, Constant) {
  Draw draw;
  Workshop w;
  for_both([&]<class T>(T) { expect_same(*w.make<T>("constant", {draw.value<T>("value")}), draw, "constant"); });
}

TEST(PlainTexture, Checkerboard) {
  Draw draw;
  for_both([&]<class T>(T) {
    Workshop w;
    w.textures.add<T>("inner", w.make<T>("checkerboard", draw.with_mapping({draw.value<T>("tex1")})));
    const auto params = draw.with_mapping({draw.value<T>("tex1"),
                                           draw.whole(0, 1) ? texture_param("tex2", "inner") : draw.value<T>("tex2"),
                                           integer_param("dimension", draw.whole(2, 3))});
    expect_same(*w.make<T>("checkerboard", params, draw.placement()), draw, "checkerboard");
    EXPECT_EQ(w.message(), "");
  });
}

TEST(PlainTexture, Dots) {
  Draw draw;
  for_both([&]<class T>(T) {
    Workshop w;
    const auto params = draw.with_mapping({draw.value<T>("inside"), draw.value<T>("outside")});
    expect_same(*w.make<T>("dots", params, draw.placement()), draw, "dots");
  });
}

TEST(PlainTexture, Bilerp) {
  Draw draw;
  for_both([&]<class T>(T) {
    Workshop w;
    const auto params =
        draw.with_mapping({draw.value<T>("v00"), draw.value<T>("v01"), draw.value<T>("v10"), draw.value<T>("v11")});
    expect_same(*w.make<T>("bilerp", params, draw.placement()), draw, "bilerp");
  });
}

TEST(PlainTexture, Noise) {
  Draw draw;
  for_both([&]<class T>(T) {
    Workshop w;
    for (const char* type : {"fbm", "wrinkled"})
      expect_same(
          *w.make<T>(type, {integer_param("octaves", draw.whole(0, 8)), number_param("roughness", draw.share())},
                     draw.placement()),
          draw, type);
    expect_same(*w.make<T>("windy", {}, draw.placement()), draw, "windy");
  });
}

TEST(PlainTexture, ScaleAndMix) {
  Draw draw;
  for_both([&]<class T>(T) {
    Workshop w;
    w.textures.add<T>("board", w.make<T>("checkerboard", draw.with_mapping({draw.value<T>("tex1")})));
    w.textures.add<float>("rust", w.make<float>("wrinkled", {}));
    w.textures.add<T>("scaled", w.make<T>("scale", {texture_param("tex", "board"), texture_param("scale", "rust")}));
    expect_same(*w.textures.find<T>("scaled"), draw, "scale");
    expect_same(*w.make<T>("scale", {draw.value<T>("tex"), number_param("scale", draw.share())}), draw, "scale");
    expect_same(*w.make<T>("mix", {texture_param("tex1", "scaled"), draw.value<T>("tex2"),
                                   draw.whole(0, 1) ? texture_param("amount", "rust") : draw.value<float>("amount")}),
                draw, "mix");
    EXPECT_EQ(w.message(), "");
  });
}

Image random_image(Draw& draw, int width, int height) {
  Image image(width, height);
  for (Rgb& c : image.pixels) c = {draw.share(), draw.share(), 2 * draw.share()};
  return image;
}

TEST(PlainTexture, Imagemap) {
  test::TemporaryDirectory directory;
  Draw draw;
  write_exr(directory / "p.exr", random_image(draw, 7, 4), {}, ExrPixels::single);
  const char *wraps[] = {"repeat", "mirror", "black", "clamp", "octahedralsphere"},
             *filters[] = {"point", "bilinear", "trilinear", "ewa"},
             *channels[] = {"", "red", "green", "blue", "alpha"};
  for (const char* filter : filters)
    for (const char* wrap : wraps)
      for_both([&]<class T>(T) {
        Workshop w;
        std::vector<Param> params =
            draw.with_mapping({text_param("filename", (directory / "p.exr").string()), text_param("wrap", wrap),
                               text_param("filter", filter), text_param("channel", channels[draw.whole(0, 4)]),
                               number_param("scale", draw.real(0.3f, 2)), flag_param("invert", draw.whole(0, 1) == 0)});
        if (draw.whole(0, 1) == 0) params.push_back(text_param("wrapv", wraps[draw.whole(0, 3)]));
        expect_same(*w.make<T>("imagemap", params, draw.placement()), draw, wrap);
        EXPECT_EQ(w.message(), "");
      });
}

TEST(PlainTexture, PicturesAtAnyPoint) {
  Draw draw;
  Image image = random_image(draw, 5, 3);
  image.alpha.resize(15);
  for (float& alpha : image.alpha) alpha = draw.share();
  const auto map = std::make_shared<MipMap>(image);
  for (const ImageFilter filter : {ImageFilter::point, ImageFilter::bilinear, ImageFilter::trilinear, ImageFilter::ewa})
    for (const Wrap wrap : {Wrap::repeat, Wrap::mirror, Wrap::black, Wrap::clamp, Wrap::octahedral_sphere})
      for (const Channel channel : {Channel::usual, Channel::red, Channel::green, Channel::blue, Channel::alpha})
        for (const float s : {0.f, -0.f, 1.f, -1.f, 0.3f, 2.7f, -8.1f, 3e38f, kInfinity, -kInfinity, kNaN}) {
          const ImageLookup lookup(map, {.filter = filter, .wrap = wrap, .wrap_v = {}, .channel = channel});
          for (const Vec2 st : {Vec2{s, draw.share()}, Vec2{draw.share(), s}}) {
            EXPECT_EQ(bits(lookup.plain().at<float>(st)), bits(lookup.at<float>({st})));
            EXPECT_EQ(bits(lookup.plain().at<Rgb>(st)), bits(lookup.at<Rgb>({st})));
          }
        }
}

TEST(PlainTexture, NoneOfWhatTakesMoreThanAPoint) {
  Workshop w;
  for (const Plugin<MakeTexture<Rgb>>& plugin : texture_plugins<Rgb>()) {
    if (plugin.name == "imagemap") continue;
    const bool is_plain = plugin.name == "constant" || plugin.name == "checkerboard" || plugin.name == "dots" ||
                          plugin.name == "bilerp" || plugin.name == "fbm" || plugin.name == "wrinkled" ||
                          plugin.name == "windy" || plugin.name == "scale" || plugin.name == "mix";
    const auto texture = w.make<Rgb>(std::string(plugin.name), {});
    EXPECT_EQ(texture->plain().has_value(), is_plain || texture->is_uniform()) << plugin.name;
  }
  w.textures.add<Rgb>("marble", w.make<Rgb>("marble", {}));
  for (const char* type : {"checkerboard", "mix"})
    for (const char* param : {"tex1", "tex2"})
      EXPECT_FALSE(w.make<Rgb>(type, {texture_param(param, "marble")})->plain());
  for (const char* type : {"checkerboard", "bilerp", "dots"})
    EXPECT_FALSE(w.make<Rgb>(type, {integer_param("uvset", 2)})->plain());
}

TEST(PlainTexture, NoneOfDeepNests) {
  Workshop w;
  w.textures.add<Rgb>("0", w.make<Rgb>("constant", {}));
  for (int depth = 1; depth < 10; ++depth) {
    const auto texture = w.make<Rgb>("scale", {texture_param("tex", std::to_string(depth - 1))});
    EXPECT_EQ(texture->plain().has_value(), depth < PlainTexture<Rgb>::kMaxDepth) << depth;
    w.textures.add<Rgb>(std::to_string(depth), texture);
  }
}

}  // namespace plain_texture_test
}  // namespace dspm
