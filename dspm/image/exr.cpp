#include "dspm/image/exr.h"

#include <ImfChannelList.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfDoubleAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfFramesPerSecond.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfIntAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <half.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "dspm/colour/rgb.h"
#include "dspm/image/decoders.h"
#include "dspm/system/atomic_file.h"

namespace dspm {

namespace {

class MemoryInput : public Imf::IStream {
 public:
  explicit MemoryInput(std::string_view bytes) : Imf::IStream("OpenEXR"), bytes_(bytes) {}
  bool read(char* to, int count) override {
    const auto size = static_cast<std::size_t>(count);
    if (count < 0 || position_ > bytes_.size() || size > bytes_.size() - position_) {
      throw std::runtime_error("the file ends too early");
    }
    std::memcpy(to, bytes_.data() + position_, size);
    position_ += size;
    return position_ < bytes_.size();
  }
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override { position_ = position; }

 private:
  std::string_view bytes_;
  std::uint64_t position_ = 0;
};

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

/// The size of an attribute of that type in bytes, if it is always the same. [OpenEXR File Layout, openexr.com]
std::optional<std::size_t> bytes_of(std::string_view type) {
  static constexpr std::pair<std::string_view, std::size_t> table[] = {{"box2f", 16},
                                                                       {"box2i", 16},
                                                                       {"chromaticities", 32},
                                                                       {"compression", 1},
                                                                       {"deepImageState", 1},
                                                                       {"double", 8},
                                                                       {"envmap", 1},
                                                                       {"float", 4},
                                                                       {"int", 4},
                                                                       {"keycode", 28},
                                                                       {"m33d", 72},
                                                                       {"m33f", 36},
                                                                       {"m44d", 128},
                                                                       {"m44f", 64},
                                                                       {"lineOrder", 1},
                                                                       {"rational", 8},
                                                                       {"tiledesc", 9},
                                                                       {"timecode", 8},
                                                                       {"v2d", 16},
                                                                       {"v2f", 8},
                                                                       {"v2i", 8},
                                                                       {"v3d", 24},
                                                                       {"v3f", 12},
                                                                       {"v3i", 12}};
  for (const auto& [name, bytes] : table)
    if (name == type) return bytes;
  return std::nullopt;
}

/// A list of channels ends with an empty name, which must be at its end. Each name is followed by 16 bytes.
bool is_channel_list(std::string_view value) {
  while (true) {
    const std::size_t name = value.find('\0');
    if (name == std::string_view::npos) return false;
    if (name == 0) return value.size() == 1;
    if (value.size() < name + 17) return false;
    value.remove_prefix(name + 17);
  }
}

bool is_whole(std::string_view type, std::string_view value) {
  return type == "chlist" ? is_channel_list(value) : value.size() == bytes_of(type).value_or(value.size());
}

/// The library allocates what a header's attributes claim before it finds the file to be shorter, and for most types it
/// relies on what it has read, not on the size that the file states. So they are checked here first, and both must
/// agree. An attribute is a name and a type, both ended by a zero byte, a size, and that many bytes; an empty name ends
/// the attributes of an EXR part.
void check_attributes(std::string_view bytes) {
  const auto damaged = [] { return std::runtime_error("its header is damaged"); };
  if (bytes.size() < 8) throw damaged();
  const bool several_parts = (bytes[5] & 0x10) != 0;
  bytes.remove_prefix(8);
  while (true) {
    const std::size_t name = bytes.find('\0'), type = bytes.find('\0', name == 0 ? 0 : name + 1);
    if (name == std::string_view::npos || type == std::string_view::npos) throw damaged();
    if (name == 0) {
      bytes.remove_prefix(1);
      if (!several_parts || bytes.starts_with('\0')) return;
      continue;
    }
    std::uint32_t size = 0;
    const std::string_view type_name = bytes.substr(name + 1, type - name - 1);
    bytes.remove_prefix(type + 1);
    if (bytes.size() < sizeof size) throw damaged();
    std::memcpy(&size, bytes.data(), sizeof size);  // little endian, as we are
    if (size > bytes.size() - sizeof size || !is_whole(type_name, bytes.substr(sizeof size, size))) throw damaged();
    bytes.remove_prefix(sizeof size + size);
  }
}

/// The library also allocates tables by the image's size before we see it: these bounds make it refuse absurd sizes.
void bound_sizes() {
  constexpr int kMaxSide = 1 << 17, kMaxTile = 1 << 12;
  Imf::Header::setMaxImageSize(kMaxSide, kMaxSide);
  Imf::Header::setMaxTileSize(kMaxTile, kMaxTile);
}

/// An image of the data window's size, once that is known to be sane; whole rows of tiles are in memory while they are
/// read.
Image image_for(const Imf::Header& header, std::size_t file_bytes) {
  const Imath::Box2i& window = header.dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
  if (header.hasTileDescription() && width * header.tileDescription().ySize > static_cast<std::int64_t>(kMaxPixels)) {
    throw std::runtime_error("its rows of tiles are too large");
  }
  return sized_image(width, height, file_bytes);
}

/// R, G and B, or Y alone if they are incomplete.
std::vector<const char*> channels_to_read(const Imf::ChannelList& channels) {
  std::vector<const char*> names = {"R", "G", "B"};
  const auto missing = [&](const char* name) { return channels.findChannel(name) == nullptr; };
  if (std::any_of(names.begin(), names.end(), missing)) names = {"Y"};
  if (missing(names.front())) {
    std::string there;
    for (auto c = channels.begin(); c != channels.end(); ++c) there += std::string(" ") + c.name();
    throw std::runtime_error("it has neither the channels R, G, B nor Y, only:" + there);
  }
  for (const char* name : names) {
    const Imf::Channel& channel = channels[name];
    if (channel.xSampling != 1 || channel.ySampling != 1) throw std::runtime_error("its channels are subsampled");
  }
  return names;
}

/// `first` is the value of one channel in the first pixel of the data window; pixels are `stride` bytes apart.
template <class T>
Imf::Slice slice_of(Imf::PixelType type, T* first, std::size_t stride, const Imath::Box2i& window) {
  const auto width = static_cast<std::size_t>(std::int64_t{window.max.x} - window.min.x + 1);
  return Imf::Slice::Make(type, first, window, stride, stride * width);
}

Imf::Header imf_header(const Image& image, const ExrHeader& header, Imf::PixelType type) {
  const int width = header.full_width > 0 ? header.full_width : image.width;
  const int height = header.full_height > 0 ? header.full_height : image.height;
  const Imath::Box2i display({0, 0}, {width - 1, height - 1});
  const Imath::Box2i data({header.x, header.y}, {header.x + image.width - 1, header.y + image.height - 1});
  Imf::Header result(display, data);
  for (const char* name : {"R", "G", "B"}) result.channels().insert(name, Imf::Channel(type));
  Imf::addChromaticities(result, Imf::Chromaticities());  // the default: Rec. 709
  if (header.frames_per_second > 0) {
    Imf::addFramesPerSecond(result, Imf::guessExactFps(header.frames_per_second));
  }
  for (const auto& [name, value] : header.texts) result.insert(name, Imf::StringAttribute(value));
  for (const auto& [name, value] : header.integers) result.insert(name, Imf::IntAttribute(value));
  for (const auto& [name, value] : header.numbers) result.insert(name, Imf::DoubleAttribute(value));
  return result;
}

/// Comparisons with NaN are false, so NaN stays visible in the file.
half to_half(float value) {
  if (value > HALF_MAX) value = HALF_MAX;
  if (value < -HALF_MAX) value = -HALF_MAX;
  return half(value);
}

template <class T>
void write_pixels(Imf::OutputFile& file, Imf::PixelType type, const T* values) {
  const Imath::Box2i& window = file.header().dataWindow();
  Imf::FrameBuffer buffer;
  int component = 0;
  for (const char* name : {"R", "G", "B"}) {
    buffer.insert(name, slice_of(type, values + component++, 3 * sizeof(T), window));
  }
  file.setFrameBuffer(buffer);
  file.writePixels(window.max.y - window.min.y + 1);
}

std::string encode(const Image& image, const ExrHeader& header, ExrPixels pixels) {
  MemoryOutput output;
  {
    const Imf::PixelType type = pixels == ExrPixels::half ? Imf::HALF : Imf::FLOAT;
    Imf::OutputFile file(output, imf_header(image, header, type));
    if (pixels == ExrPixels::half) {
      std::vector<half> halves;
      halves.reserve(image.pixels.size() * 3);
      for (const Rgb& pixel : image.pixels) {
        for (int c = 0; c < 3; ++c) halves.push_back(to_half(pixel[c]));
      }
      write_pixels(file, type, halves.data());
    } else {
      write_pixels(file, type, &image.pixels.front().r);
    }
  }  // the file's destructor writes the table of rows
  return std::move(output.bytes);
}

}  // namespace

bool is_exr(std::string_view bytes) { return bytes.starts_with("\x76\x2f\x31\x01"); }

Image decode_exr(std::string_view bytes) {
  static_assert(sizeof(Rgb) == 3 * sizeof(float));
  bound_sizes();
  check_attributes(bytes);
  MemoryInput input(bytes);
  Imf::InputFile file(input);
  Image image = image_for(file.header(), bytes.size());
  const Imath::Box2i& window = file.header().dataWindow();

  const std::vector<const char*> channels = channels_to_read(file.header().channels());
  Imf::FrameBuffer buffer;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    buffer.insert(channels[c], slice_of(Imf::FLOAT, &image.pixels.front().r + c, sizeof(Rgb), window));
  }
  file.setFrameBuffer(buffer);
  file.readPixels(window.min.y, window.max.y);
  if (channels.size() == 1) {
    for (Rgb& pixel : image.pixels) pixel = Rgb(pixel.r);
  }
  return image;
}

void write_exr(const std::filesystem::path& path, const Image& image, const ExrHeader& header, ExrPixels pixels) {
  std::string bytes;
  try {
    if (image.empty()) throw std::runtime_error("the image has no pixels");
    bytes = encode(image, header, pixels);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw WriteError(path, error.what());
  }
  write_file(path, bytes);
}

ExrHeader read_exr_header(const std::filesystem::path& path) {
  bound_sizes();
  Imf::InputFile file(path.c_str());
  const Imf::Header& from = file.header();
  const Imath::Box2i &display = from.displayWindow(), &data = from.dataWindow();

  ExrHeader header;
  header.x = data.min.x - display.min.x, header.y = data.min.y - display.min.y;
  header.full_width = display.max.x - display.min.x + 1, header.full_height = display.max.y - display.min.y + 1;
  if (Imf::hasFramesPerSecond(from)) header.frames_per_second = Imf::framesPerSecond(from);
  for (auto a = from.begin(); a != from.end(); ++a) {
    if (auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute())) header.texts[a.name()] = text->value();
    if (auto* integer = dynamic_cast<const Imf::IntAttribute*>(&a.attribute()))
      header.integers[a.name()] = integer->value();
    if (auto* number = dynamic_cast<const Imf::DoubleAttribute*>(&a.attribute()))
      header.numbers[a.name()] = number->value();
  }
  return header;
}

}  // namespace dspm
