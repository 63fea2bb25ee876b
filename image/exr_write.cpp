#include <ImfChannelList.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfDoubleAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfFramesPerSecond.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfIntAttribute.h>
#include <ImfMatrixAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>
#include <ImfTiledOutputFile.h>
#include <half.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "dspm/base/colour/colour_space.h"
#include "dspm/base/colour/rgb.h"
#include "dspm/base/system/atomic_file.h"
#include "dspm/base/system/parallel.h"
#include "dspm/base/system/work.h"
#include "dspm/image/exr.h"
#include "dspm/image/exr_compression.h"
#include "dspm/image/image.h"

namespace dspm {

namespace {

class MemoryOutput : public Imf::OStream {
 public:
  MemoryOutput() : Imf::OStream("OpenEXR") {}
  void write(const char* from, int count) override {
    const auto size = static_cast<std::size_t>(count);
    bytes.resize(std::max(bytes.size(), position_ + size));
    std::memcpy(bytes.data() + position_, from, size);
    position_ += size;
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }

  std::string bytes;

 private:
  std::size_t position_ = 0;
};

Imf::PixelType type_of(const ExrLayer& layer) { return layer.pixels == ExrPixels::half ? Imf::HALF : Imf::FLOAT; }

Imf::Chromaticities imf_chromaticities(ColourSpace space) {
  const Chromaticities& c = chromaticities(space);
  const auto at = [](const Chromaticity& xy) { return Imath::V2f(static_cast<float>(xy.x), static_cast<float>(xy.y)); };
  return {at(c.red), at(c.green), at(c.blue), at(c.white)};
}

Imf::Header imf_header(std::span<const ExrLayer> layers, const ExrHeader& header, const ExrFormat& format) {
  const Image& image = *layers.front().image;
  const int width = header.full_width > 0 ? header.full_width : image.width;
  const int height = header.full_height > 0 ? header.full_height : image.height;
  const Imath::Box2i display({0, 0}, {width - 1, height - 1});
  const Imath::Box2i data({header.x, header.y}, {header.x + image.width - 1, header.y + image.height - 1});
  Imf::Header result(display, data);
  for (const ExrLayer& layer : layers)
    for (const std::string& name : layer.channels) result.channels().insert(name, Imf::Channel(type_of(layer)));
  Imf::addChromaticities(result, imf_chromaticities(header.space));
  if (header.frames_per_second > 0) {
    Imf::addFramesPerSecond(result, Imf::guessExactFps(header.frames_per_second));
  }
  for (const auto& [name, value] : header.texts) result.insert(name, Imf::StringAttribute(value));
  for (const auto& [name, value] : header.integers) result.insert(name, Imf::IntAttribute(value));
  for (const auto& [name, value] : header.numbers) result.insert(name, Imf::DoubleAttribute(value));
  for (const auto& [name, value] : header.matrices) {
    Imath::M44f matrix;
    std::copy(value.begin(), value.end(), matrix.getValue());
    result.insert(name, Imf::M44fAttribute(matrix));
  }
  result.compression() = imf_compression(format.compression);
  const auto side = static_cast<unsigned>(format.tile);
  if (side > 0) result.setTileDescription(Imf::TileDescription(side, side, Imf::ONE_LEVEL));
  return result;
}

/// Converts to a half. Comparisons with NaN are false, so NaN stays visible in the file.
half to_half(float value) {
  if (value > HALF_MAX) value = HALF_MAX;
  if (value < -HALF_MAX) value = -HALF_MAX;
  return half(value);
}

std::vector<half> halves_of(const Image& image) {
  std::vector<half> halves;
  halves.reserve(image.pixels.size() * 3);
  for (const Rgb& pixel : image.pixels)
    for (int c = 0; c < 3; ++c) halves.push_back(to_half(pixel[c]));
  return halves;
}

/// Inserts the channels; `first` is the value of the first channel in the first pixel, and three values make a pixel.
template <class T>
void insert(Imf::FrameBuffer& buffer, const ExrLayer& layer, const Imath::Box2i& window, const T* first) {
  constexpr std::size_t kStride = 3 * sizeof(T);
  const auto width = static_cast<std::size_t>(layer.image->width);
  for (const std::string& name : layer.channels)
    buffer.insert(name, Imf::Slice::Make(type_of(layer), first++, window, kStride, kStride * width));
}

/// Returns the library's threads; 0 means the caller's alone. OpenEXR compresses rows on threads of its own, and writes
/// them in order. It keeps two blocks of up to 32 rows for each thread; together they take no more than half of the
/// image.
int threads_for(int rows) {
  constexpr int kRows = 128;
  const int threads = std::clamp(rows / kRows, 1, thread_count());
  if (threads == 1) return 0;
  try {
    if (threads > Imf::globalThreadCount()) Imf::setGlobalThreadCount(threads);
  } catch (const std::exception&) {  // no memory for their stacks
    return 0;
  }
  return threads;
}

std::string encode(std::span<const ExrLayer> layers, const ExrHeader& header, const ExrFormat& format) {
  const Imf::Header imf = imf_header(layers, header, format);
  const Imath::Box2i& window = imf.dataWindow();
  Imf::FrameBuffer buffer;
  std::vector<std::vector<half>> halves;
  for (const ExrLayer& layer : layers)
    if (layer.pixels == ExrPixels::half)
      insert(buffer, layer, window, halves.emplace_back(halves_of(*layer.image)).data());
    else
      insert(buffer, layer, window, &layer.image->pixels.front().r);

  const int threads = format.alone ? 0 : threads_for(window.max.y - window.min.y + 1);
  std::optional<LibraryWork> work;
  if (!format.alone) work.emplace(threads);
  MemoryOutput output;
  if (format.tile > 0) {
    Imf::TiledOutputFile file(output, imf, threads);
    file.setFrameBuffer(buffer);
    file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
  } else {
    Imf::OutputFile file(output, imf, threads);
    file.setFrameBuffer(buffer);
    file.writePixels(window.max.y - window.min.y + 1);
  }  // the files' destructors write the table of rows or tiles
  return std::move(output.bytes);
}

void check(std::span<const ExrLayer> layers) {
  for (const ExrLayer& layer : layers) {
    if (layer.image->empty()) throw std::runtime_error("the image has no pixels");
    if (layer.image->width != layers.front().image->width || layer.image->height != layers.front().image->height)
      throw std::runtime_error("its layers differ in size");
  }
}

}  // namespace

void write_exr(const std::filesystem::path& path, std::span<const ExrLayer> layers, const ExrHeader& header,
               const ExrFormat& format) {
  std::string bytes;
  try {
    check(layers);
    bytes = encode(layers, header, format);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw WriteError(path, error.what());
  }
  write_file(path, bytes);
}

void write_exr(const std::filesystem::path& path, const Image& image, const ExrHeader& header, ExrPixels pixels) {
  const ExrLayer layer{{"R", "G", "B"}, &image, pixels};
  write_exr(path, {&layer, 1}, header);
}

}  // namespace dspm
