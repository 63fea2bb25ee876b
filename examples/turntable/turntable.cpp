// turntable scene.dsc roughness 0.05 0.1 0.2
//
// Renders all frames of a scene for each value of one of its parameters ("Default roughness 0.1" in the scene), and
// prints the mean radiance of every frame: a program that uses dspm as a library.
#include <dspm/session/renderer.h>

#include <cstdlib>
#include <iostream>
#include <stdexcept>
#include <string>

namespace {

double mean(const dspm::Image& image) {
  double sum = 0;
  for (const dspm::Rgb& pixel : image.pixels) sum += (pixel.r + pixel.g + pixel.b) / 3;
  return sum / static_cast<double>(image.pixels.size());
}

void render(const std::string& scene, const std::string& parameter, const std::string& value) {
  dspm::Choices choices;
  choices.quick = true;
  choices.defines = {parameter + "=" + value};
  dspm::Renderer renderer(dspm::load_scene({scene}, choices, [](const std::string& warning) { std::cerr << warning; }));
  while (renderer.iterations() < renderer.wanted()) renderer.iterate();
  for (std::size_t frame = 0; frame < renderer.labels().size(); ++frame)
    std::cout << parameter << " " << value << ", frame " << renderer.labels()[frame] << ": "
              << mean(renderer.image(static_cast<int>(frame))) << "\n";
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 4) {
    std::cerr << "usage: turntable SCENE PARAMETER VALUE...\n";
    return 2;
  }
  try {
    for (int i = 3; i < count; ++i) render(arguments[1], arguments[2], arguments[i]);
    return 0;
  } catch (const std::runtime_error& error) {
    std::cerr << error.what();
    return 1;
  }
}
