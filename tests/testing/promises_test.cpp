// The checks of promises find an integrator that breaks them.
#include "dspm/testing/promises.h"

#include <gtest/gtest.h>

#include <memory>
#include <utility>

#include "tests/support/idle_integrator.h"

namespace dspm::test {
namespace promises_test {

/// Its images are even, of a colour that the scene and the crop decide.
template <class Colour>
class Even : public IdleIntegrator {
 public:
  Even(const Scene& scene, const RenderSettings& render) : scene_(scene), render_(render) {}
  Image estimate(Frame frame, const std::string&) const override {
    Image image(render_.crop.width(), render_.crop.height());
    for (Rgb& pixel : image.pixels) pixel = Rgb(Colour()(scene_, render_, frame));
    return image;
  }

 private:
  const Scene& scene_;
  RenderSettings render_;
};

struct OfItsFrame {
  float operator()(const Scene& scene, const RenderSettings&, Frame frame) const {
    return static_cast<float>(scene.file_frames[static_cast<std::size_t>(frame)].index());
  }
};
struct OfAllFrames {
  float operator()(const Scene& scene, const RenderSettings&, Frame) const {
    return static_cast<float>(scene.frame_count());
  }
};
struct OfTheCrop {
  float operator()(const Scene&, const RenderSettings& render, Frame) const {
    return static_cast<float>(render.crop.count());
  }
};

template <class Colour>
std::unique_ptr<Integrator> make(ParamReader& params, const Scene& scene, const RenderSettings& render) {
  params.finish();
  return std::make_unique<Even<Colour>>(scene, render);
}

std::string scene(const std::string& integrator) {
  static const bool added = [] {
    integrator_plugins().add({{"honest", "", make<OfItsFrame>}});
    integrator_plugins().add({{"crowd", "", make<OfAllFrames>}});
    integrator_plugins().add({{"frame", "", make<OfTheCrop>}});
    return true;
  }();
  static_cast<void>(added);
  return "Frames 3 Integrator \"" + integrator +
         "\" Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8 WorldBegin LightSource \"point\" "
         "Shape \"sphere\"";
}

TEST(Promises, AreKeptByAnHonestIntegrator) {
  EXPECT_TRUE(check_joint(scene("honest")).passed);
  EXPECT_TRUE(check_crop(scene("honest")).passed);
}

TEST(Promises, FramesThatChangeWithOthersAreFound) {
  const Verdict verdict = check_joint(scene("crowd"));
  EXPECT_FALSE(verdict.passed);
  EXPECT_NE(verdict.message.find("frame 1 of the joint render has (3, 3, 3) in pixel 0, alone (1, 1, 1)"),
            std::string::npos)
      << verdict.message;
  EXPECT_TRUE(check_crop(scene("crowd")).passed);
}

TEST(Promises, PixelsThatChangeWithTheCropAreFound) {
  EXPECT_FALSE(check_crop(scene("frame")).passed);
  EXPECT_TRUE(check_joint(scene("frame")).passed);
}

}  // namespace promises_test
}  // namespace dspm::test
