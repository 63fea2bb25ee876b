#include "dspm/image/exr.h"

#include <ImathMatrix.h>
#include <ImfChannelList.h>
#include <ImfChromaticities.h>
#include <ImfDoubleAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfFramesPerSecond.h>
#include <ImfHeader.h>
#include <ImfIntAttribute.h>
#include <ImfMatrixAttribute.h>
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "dspm/base/colour/colour_space.h"
#include "dspm/base/colour/rgb.h"
#include "dspm/base/system/read_file.h"
#include "dspm/image/decoders.h"
#include "dspm/image/exr_channels.h"
#include "dspm/image/exr_compression.h"
#include "dspm/image/exr_file.h"

namespace dspm {

namespace {

// OpenEXR registers its types of attributes at first use, and cannot do so again if memory ran out halfway: nothing
// could be written after that.
[[maybe_unused]] const bool attributes_are_registered = (Imf::staticInitialize(), true);

/// Returns an image of the data window's size, once that is known to be sane; whole rows of tiles are in memory while
/// they are read.
Image image_for(const Imf::Header& header, std::size_t file_bytes) {
  const Imath::Box2i& window = header.dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
  if (header.hasTileDescription() && width * header.tileDescription().ySize > static_cast<std::int64_t>(kMaxPixels)) {
    throw std::runtime_error("its rows of tiles are too large");
  }
  return sized_image(width, height, file_bytes);
}

/// Tells the library where to write a channel's values: to every `stride`-th byte.
Imf::Slice slice(const Imf::Header& header, const std::string& name, float* first, std::size_t stride) {
  const Imf::Channel* channel = header.channels().findChannel(name);
  if (channel == nullptr) throw std::runtime_error("it has no channel " + name);
  if (channel->xSampling != 1 || channel->ySampling != 1) throw std::runtime_error("its channels are subsampled");
  const Imath::Box2i& window = header.dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  return Imf::Slice::Make(Imf::FLOAT, first, window, stride, stride * static_cast<std::size_t>(width));
}

/// Reads the channels' values into the pixels' r, g and b. Colours stay what they are in the file: by convention,
/// multiplied by alpha.
Image decode(Imf::InputFile& file, const std::vector<std::string>& channels, std::size_t file_bytes) {
  static_assert(sizeof(Rgb) == 3 * sizeof(float));
  Image image = image_for(file.header(), file_bytes);
  const Imath::Box2i& window = file.header().dataWindow();
  Imf::FrameBuffer buffer;
  float* first = &image.pixels.front().r;
  for (const std::string& name : channels) buffer.insert(name, slice(file.header(), name, first++, sizeof(Rgb)));
  const std::string& colour = channels.front();
  const auto has = [&](const std::string& name) { return file.header().channels().findChannel(name) != nullptr; };
  const std::string alpha = has("A") ? "A" : colour.substr(0, colour.rfind('.') + 1) + "A";  // of the same layer
  const bool has_alpha = has(alpha) && colour != alpha;
  if (has_alpha) {
    image.alpha.resize(image.pixels.size());
    buffer.insert(alpha, slice(file.header(), alpha, image.alpha.data(), sizeof(float)));
  }
  file.setFrameBuffer(buffer);
  file.readPixels(window.min.y, window.max.y);
  if (std::all_of(image.alpha.begin(), image.alpha.end(), [](float a) { return a == 1; })) image.alpha.clear();
  return image;
}

/// Converts colours of the file's primaries to those of Rec. 709, by way of XYZ and without adaptation to its white, as
/// in pbrt.
void convert_to_rec709(Image& image, const Imf::Header& header) {
  const Imf::Chromaticities rec709;  // the library's default
  if (!Imf::hasChromaticities(header) || Imf::chromaticities(header) == rec709) return;
  const Imath::M44f m = Imf::RGBtoXYZ(Imf::chromaticities(header), 1) * Imf::XYZtoRGB(rec709, 1);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      if (!std::isfinite(m[row][column])) throw std::runtime_error("its chromaticities are no colour space");
  }
  for (Rgb& pixel : image.pixels) {
    const Rgb from = pixel;
    for (int c = 0; c < 3; ++c) pixel[c] = from.r * m[0][c] + from.g * m[1][c] + from.b * m[2][c];
  }
}

/// Reads Y, and RY and BY for every second pixel of every second row. The library fills in what is between them.
Image decode_luminance_chroma(const Imf::Header& header, std::string_view bytes) {
  Image image = image_for(header, bytes.size());
  MemoryInput input(bytes);
  Imf::RgbaInputFile file(input);
  const Imath::Box2i& window = header.dataWindow();
  std::vector<Imf::Rgba> row(static_cast<std::size_t>(image.width));
  const bool has_alpha = (file.channels() & Imf::WRITE_A) != 0;
  if (has_alpha) image.alpha.resize(image.pixels.size());
  for (int y = 0; y < image.height; ++y) {
    file.setFrameBuffer(row.data() - window.min.x, 1, 0);
    file.readPixels(window.min.y + y);
    for (int x = 0; x < image.width; ++x) {
      const Imf::Rgba& pixel = row[static_cast<std::size_t>(x)];
      image.at(x, y) = {pixel.r, pixel.g, pixel.b};
      if (has_alpha) image.alpha[image.index(x, y)] = pixel.a;
    }
  }
  if (std::all_of(image.alpha.begin(), image.alpha.end(), [](float a) { return a == 1; })) image.alpha.clear();
  convert_to_rec709(image, header);
  return image;
}

ExrFormat format_of(const Imf::Header& header) {
  const int tile = header.hasTileDescription() ? static_cast<int>(header.tileDescription().xSize) : 0;
  return {exr_compression(header.compression()), tile};
}

/// Returns the one of the spaces that we write that has these primaries, else that of Rec. 709.
ColourSpace space_of(const Imf::Header& header) {
  if (!Imf::hasChromaticities(header)) return ColourSpace::srgb;
  const Imf::Chromaticities& is = Imf::chromaticities(header);
  const auto near = [](const Imath::V2f& a, const Chromaticity& b) {
    return std::abs(static_cast<double>(a.x) - b.x) < 1e-5 && std::abs(static_cast<double>(a.y) - b.y) < 1e-5;
  };
  for (const std::string& word : colour_space_words()) {
    const Chromaticities& c = chromaticities(*colour_space(word));
    if (near(is.red, c.red) && near(is.green, c.green) && near(is.blue, c.blue) && near(is.white, c.white))
      return *colour_space(word);
  }
  return ColourSpace::srgb;
}

}  // namespace

bool is_exr(std::string_view bytes) { return bytes.starts_with("\x76\x2f\x31\x01"); }

Image decode_exr(std::string_view bytes) {
  OpenExr exr(bytes);
  const std::vector<std::string> channels = colour_channels(exr.header().channels());
  if (channels.front() == "Y" && channels.size() == 3) return decode_luminance_chroma(exr.header(), bytes);
  Image image = decode(exr.file, channels, bytes.size());
  if (channels.size() == 1) {
    for (Rgb& pixel : image.pixels) pixel = Rgb(pixel.r);
  } else {
    convert_to_rec709(image, exr.header());
  }
  return image;
}

Image read_exr_channels(const std::filesystem::path& path, const std::vector<std::string>& channels) {
  const std::string bytes = read_bytes(path);
  OpenExr exr(bytes);
  return decode(exr.file, channels, bytes.size());
}

ExrHeader read_exr_header(const std::filesystem::path& path) {
  const std::string bytes = read_bytes(path);
  const OpenExr exr(bytes);
  const Imf::Header& from = exr.header();
  const Imath::Box2i &display = from.displayWindow(), &data = from.dataWindow();

  ExrHeader header;
  for (auto c = from.channels().begin(); c != from.channels().end(); ++c) {
    header.channels.emplace_back(c.name());
    header.precisions.push_back(c.channel().type == Imf::HALF ? ExrPixels::half : ExrPixels::single);
  }
  header.format = format_of(from);
  header.space = space_of(from);
  header.x = data.min.x - display.min.x, header.y = data.min.y - display.min.y;
  header.full_width = display.max.x - display.min.x + 1, header.full_height = display.max.y - display.min.y + 1;
  if (Imf::hasFramesPerSecond(from)) header.frames_per_second = Imf::framesPerSecond(from);
  for (auto a = from.begin(); a != from.end(); ++a) {
    if (auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute())) header.texts[a.name()] = text->value();
    if (auto* integer = dynamic_cast<const Imf::IntAttribute*>(&a.attribute()))
      header.integers[a.name()] = integer->value();
    if (auto* number = dynamic_cast<const Imf::DoubleAttribute*>(&a.attribute()))
      header.numbers[a.name()] = number->value();
    if (auto* matrix = dynamic_cast<const Imf::M44fAttribute*>(&a.attribute()))
      std::copy_n(matrix->value().getValue(), 16, header.matrices[a.name()].begin());
  }
  return header;
}

}  // namespace dspm
