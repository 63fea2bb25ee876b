// Files for random scenes: pictures, an environment, meshes that change from frame to frame. Made once, gone with the
// test.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "dspm/image/exr.h"
#include "dspm/image/png.h"
#include "tests/materials/bsdf_file.h"
#include "tests/support/temporary_directory.h"

namespace dspm::test {

class SceneFiles {
 public:
  static constexpr int kFrames = 33;

  SceneFiles() {
    write_png(directory_ / "picture.png", picture(16, 8, 1));
    write_png(directory_ / "normals.png", normals(8, 8));
    test::put_file(directory_ / "ggx.bsdf", bsdf_file(ggx_tables(0.3f, {0.8f, 0.6f}, 16)));
    write_exr(directory_ / "square.exr", picture(8, 8, 3), {}, {});
    write_exr(directory_ / "sky.exr", picture(16, 8, 3), {}, {});
    for (int frame = 1; frame <= kFrames; ++frame) {
      test::put_file(directory_ / fmt::format("blob.{:03d}.ply", frame), ply(frame));
      write_png(directory_ / fmt::format("page.{:02d}.png", frame),
                picture(8, 8, 1 / static_cast<float>(1 + frame % 3)));
    }
    test::put_file(directory_ / "box.mtl", "newmtl red\nKd .8 .2 .1\nnewmtl printed\nKd 1 1 1\nmap_Kd picture.png\n");
    test::put_file(directory_ / "box.obj", obj());
    test::put_file(directory_ / "signed.ply", signed_tangents());
    test::put_file(directory_ / "pair.dat", "55 5 1.6 24\n-400 6 1 24\n0 6 0 14\n400 5 1.6 24\n-55 40 1 24\n");
  }

  /// For the text of a scene.
  std::string operator[](const std::string& name) const { return fmt::format("\"{}\"", (directory_ / name).string()); }

  /// A square with tangents and their signs.
  static std::string signed_tangents() {
    std::string s = "ply\nformat ascii 1.0\nelement vertex 4\n";
    for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "u", "v", "tx", "ty", "tz", "tw"})
      s += fmt::format("property float {}\n", name);
    return s +
           "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
           "-.5 -.5 0  0 .1 1  0 0  1 .2 0 1\n.5 -.5 .1  .1 0 1  1 .1  1 0 .1 -1\n"
           ".5 .5 0  0 -.1 1  .9 1  .9 .1 0 -1\n-.5 .5 0  0 0 1  .1 1  1 -.2 0 1\n3 0 1 2\n3 2 3 0\n";
  }

 private:
  static Image picture(int width, int height, float scale) {
    Image image(width, height);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        image.at(x, y) = Rgb(0.3f + 0.6f * static_cast<float>(x) / static_cast<float>(width),
                             0.2f + 0.7f * static_cast<float>(y) / static_cast<float>(height), 0.5f) *
                         scale;
    return image;
  }

  /// Of waves; a picture is stored as sRGB, so the numbers lean upward.
  static Image normals(int width, int height) {
    Image image(width, height);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        image.at(x, y) = {0.25f + 0.1f * std::sin(0.8f * static_cast<float>(x)),
                          0.2f + 0.1f * std::cos(0.8f * static_cast<float>(y)), 0.9f};
    return image;
  }

  /// An octahedron whose corners wander.
  static std::string ply(int frame) {
    std::string s =
        "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 8\nproperty list uchar int vertex_indices\nend_header\n";
    for (int corner = 0; corner < 6; ++corner) {
      const double size = 0.5 + 0.15 * std::sin(0.9 * frame + corner), sign = corner % 2 == 0 ? size : -size;
      s += fmt::format("{} {} {}\n", corner / 2 == 0 ? sign : 0., corner / 2 == 1 ? sign : 0.,
                       corner / 2 == 2 ? sign : 0.);
    }
    return s + "3 0 2 4\n3 2 1 4\n3 1 3 4\n3 3 0 4\n3 2 0 5\n3 1 2 5\n3 3 1 5\n3 0 3 5\n";
  }

  static std::string obj() {
    return "mtllib box.mtl\n"
           "v -.4 -.4 -.4\nv .4 -.4 -.4\nv .4 .4 -.4\nv -.4 .4 -.4\nv -.4 -.4 .4\nv .4 -.4 .4\nv .4 .4 .4\nv -.4 .4 "
           ".4\n"
           "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
           "g sides\nusemtl red\nf 1/1 4/2 3/3 2/4\nf 5/1 6/2 7/3 8/4\nf 1/1 5/2 8/3 4/4\nf 2/1 3/2 7/3 6/4\n"
           "g ends\nusemtl printed\nf 4/1 8/2 7/3 3/4\nf 1/1 2/2 6/3 5/4\n";
  }

  test::TemporaryDirectory directory_;
};

}  // namespace dspm::test
