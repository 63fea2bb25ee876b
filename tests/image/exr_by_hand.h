// OpenEXR files put together byte by byte from the description of the file layout, without the library: uncompressed
// scan lines of single precision floats. [OpenEXR File Layout, openexr.com]
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

namespace dspm::test {

template <class T>
std::string little_endian(T value) {
  std::string bytes;
  for (std::size_t i = 0; i < sizeof value; ++i) bytes.push_back(static_cast<char>(value >> (8 * i) & 0xff));
  return bytes;
}
inline std::string float_bytes(float value) { return little_endian(std::bit_cast<std::uint32_t>(value)); }
inline std::string zero_ended(const std::string& text) { return text + '\0'; }

struct ExrByHand {
  std::vector<std::string> channels;  // in alphabetical order
  int x = 0, y = 0, width = 0, height = 0;
  std::vector<float> values;  // row by row, in a row channel by channel
  std::string more;           // further attributes

  static std::string attribute(const std::string& name, const std::string& type, const std::string& value) {
    return zero_ended(name) + zero_ended(type) + little_endian(static_cast<std::uint32_t>(value.size())) + value;
  }
  static std::string integers(std::initializer_list<int> numbers) {
    std::string bytes;
    for (const int number : numbers) bytes += little_endian(static_cast<std::uint32_t>(number));
    return bytes;
  }

  /// Without the zero byte that ends it.
  std::string header() const {
    std::string list;
    for (const std::string& channel : channels) list += zero_ended(channel) + integers({2, 0, 1, 1});  // float
    const std::string display = integers({0, 0, 9, 9}), data = integers({x, y, x + width - 1, y + height - 1});
    return attribute("channels", "chlist", zero_ended(list)) + more +
           attribute("compression", "compression", zero_ended("")) + attribute("dataWindow", "box2i", data) +
           attribute("displayWindow", "box2i", display) + attribute("lineOrder", "lineOrder", zero_ended("")) +
           attribute("pixelAspectRatio", "float", float_bytes(1)) +
           attribute("screenWindowCenter", "v2f", float_bytes(0) + float_bytes(0)) +
           attribute("screenWindowWidth", "float", float_bytes(1));
  }
  /// One a row; `prefix` is the part's number in files of several parts. Rows without values are left out.
  std::vector<std::string> chunks(const std::string& prefix) const {
    std::vector<std::string> result;
    const std::size_t row = channels.size() * static_cast<std::size_t>(width);
    for (std::size_t i = 0; row > 0 && (i + 1) * row <= values.size(); ++i) {
      std::string chunk = prefix + integers({y + static_cast<int>(i), static_cast<int>(4 * row)});
      for (std::size_t j = 0; j < row; ++j) chunk += float_bytes(values[i * row + j]);
      result.push_back(chunk);
    }
    return result;
  }
  std::string bytes() const {
    std::string file = integers({20000630, 2}) + zero_ended(header());
    const std::vector<std::string> rows = chunks("");
    std::uint64_t offset = file.size() + 8 * rows.size();
    std::string table, data;
    for (const std::string& row : rows) {
      table += little_endian(offset);
      offset += row.size();
      data += row;
    }
    return file + table + data;
  }
};

/// The same picture in tiles of 2 x 2, with mip levels whose values are all 99.
inline std::string tiled(const ExrByHand& picture) {
  constexpr int kTiled = 0x200, kSide = 2;
  const std::string tiles = ExrByHand::integers({kSide, kSide}) + '\1';  // mip levels, sizes rounded down
  std::string file = ExrByHand::integers({20000630, 2 | kTiled}) + picture.header() +
                     ExrByHand::attribute("tiles", "tiledesc", tiles) + '\0';
  std::vector<std::string> chunks;
  const auto add_tile = [&](int level, int width, int height, int column, int row) {
    std::string data;
    for (int y = row * kSide; y < std::min(height, (row + 1) * kSide); ++y)
      for (std::size_t channel = 0; channel < picture.channels.size(); ++channel)
        for (int x = column * kSide; x < std::min(width, (column + 1) * kSide); ++x)
          data += float_bytes(
              level > 0 ? 99
                        : picture.values[static_cast<std::size_t>(y * width) * picture.channels.size() +
                                         channel * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)]);
    chunks.push_back(ExrByHand::integers({column, row, level, level, static_cast<int>(data.size())}) + data);
  };
  for (int level = 0, size = std::max(picture.width, picture.height); size >= 1; ++level, size /= 2) {
    const int width = std::max(1, picture.width >> level), height = std::max(1, picture.height >> level);
    for (int row = 0; row * kSide < height; ++row)
      for (int column = 0; column * kSide < width; ++column) add_tile(level, width, height, column, row);
  }
  std::string table, data;
  for (const std::string& chunk : chunks) {
    table += little_endian(std::uint64_t{file.size() + 8 * chunks.size() + data.size()});
    data += chunk;
  }
  return file + table + data;
}

inline std::string multi_part(const std::vector<ExrByHand>& parts) {
  constexpr int kMultiPart = 0x1000;
  std::string file = ExrByHand::integers({20000630, 2 | kMultiPart}), table, data;
  std::vector<std::string> chunks;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    file += parts[i].header() + ExrByHand::attribute("name", "string", "part" + std::to_string(i)) +
            ExrByHand::attribute("type", "string", "scanlineimage") +
            ExrByHand::attribute("chunkCount", "int", ExrByHand::integers({parts[i].height})) + '\0';
    for (std::string& chunk : parts[i].chunks(ExrByHand::integers({static_cast<int>(i)}))) chunks.push_back(chunk);
  }
  file += '\0';
  std::uint64_t offset = file.size() + 8 * chunks.size();
  for (const std::string& chunk : chunks) {
    table += little_endian(offset);
    offset += chunk.size();
    data += chunk;
  }
  return file + table + data;
}

}  // namespace dspm::test
