#include "dspm/lang/gltf/accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace dspm::gltf {
namespace {

// Elements without bytes of their own are zeros, so a small file may announce any number of them.
constexpr std::size_t kMostZeros = std::size_t{1} << 24;

struct Layout {
  std::size_t count, width, component_size;
  int component;          // as OpenGL numbers them
  std::size_t size;       // bytes of an element
  std::size_t row_bytes;  // of a column of a matrix, which begins at a multiple of four
};

std::size_t size_of_component(const Value& type) {
  switch (type.count(0)) {
    case 5120:
    case 5121: return 1;
    case 5122:
    case 5123: return 2;
    case 5125:
    case 5126: return 4;
    default: type.fail("no such component type");
  }
}

std::size_t width_of(const Value& type) {
  static constexpr std::pair<std::string_view, std::size_t> kWidths[] = {
      {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};
  const std::string name = type.text("");
  for (const auto& [word, width] : kWidths)
    if (name == word) return width;
  type.fail("no such type");
}

Layout layout_of(const Value& accessor) {
  Layout l{};
  l.count = accessor["count"].count(0), l.width = width_of(accessor["type"]);
  l.component_size = size_of_component(accessor["componentType"]);
  l.component = static_cast<int>(accessor["componentType"].count(0));
  const std::size_t rows = l.width == 16 ? 4 : l.width == 9 ? 3 : accessor["type"].text("") == "MAT2" ? 2 : 0;
  l.row_bytes = rows == 0 ? 0 : (rows * l.component_size + 3) / 4 * 4;
  l.size = rows == 0 ? l.width * l.component_size : rows * l.row_bytes;
  return l;
}

template <class T>
double read(const char* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return static_cast<double>(value);
}

double component_at(const char* at, int component) {
  switch (component) {
    case 5120: return read<std::int8_t>(at);
    case 5121: return read<std::uint8_t>(at);
    case 5122: return read<std::int16_t>(at);
    case 5123: return read<std::uint16_t>(at);
    case 5125: return read<std::uint32_t>(at);
    default: return read<float>(at);
  }
}

double largest(int component) {
  switch (component) {
    case 5120: return 127;
    case 5121: return 255;
    case 5122: return 32767;
    case 5123: return 65535;
    case 5125: return 4294967295.0;
    default: return 1;
  }
}

/// Calls put(element, component, value) for the elements of a view.
template <class Put>
void read_view(const View& view, std::size_t offset, const Layout& l, const Value& where, Put&& put) {
  const std::size_t stride = view.stride == 0 ? l.size : view.stride;
  if (l.count == 0) return;
  if (offset > view.bytes.size() || l.size > view.bytes.size() - offset ||
      (l.count - 1) > (view.bytes.size() - offset - l.size) / stride)
    where.fail(fmt::format("{} elements of {} bytes do not fit into the {} bytes of the buffer's view", l.count, l.size,
                           view.bytes.size()));
  for (std::size_t i = 0; i < l.count; ++i) {
    const char* const element = view.bytes.data() + offset + i * stride;
    for (std::size_t c = 0; c < l.width; ++c) {
      const std::size_t rows = l.row_bytes == 0 ? 1 : l.width == 16 ? 4 : l.width == 9 ? 3 : 2;
      const std::size_t at =
          l.row_bytes == 0 ? c * l.component_size : c / rows * l.row_bytes + c % rows * l.component_size;
      put(i, c, component_at(element + at, l.component));
    }
  }
}

template <class Put>
void read_all(const Document& document, const Value& accessor, const Layout& l, Put&& put) {
  const std::size_t views = document["bufferViews"].size();
  if (const auto view = accessor["bufferView"].index(views))
    read_view(document.view(*view), accessor["byteOffset"].count(0), l, accessor, put);
  const Value sparse = accessor["sparse"];
  if (!sparse.exists()) return;
  const std::size_t count = sparse["count"].count(0);
  const Value indices = sparse["indices"], values = sparse["values"];
  Layout of_index{count, 1, size_of_component(indices["componentType"]), 0, 0, 0};
  of_index.component = static_cast<int>(indices["componentType"].count(0)), of_index.size = of_index.component_size;
  std::vector<std::size_t> places;
  read_view(document.view(indices["bufferView"].required_index(views)), indices["byteOffset"].count(0), of_index,
            indices, [&](std::size_t, std::size_t, double index) {
              if (!(index >= 0 && index < static_cast<double>(l.count))) indices.fail("an index is out of range");
              places.push_back(static_cast<std::size_t>(index));
            });
  Layout of_values = l;
  of_values.count = count;
  read_view(document.view(values["bufferView"].required_index(views)), values["byteOffset"].count(0), of_values, values,
            [&](std::size_t i, std::size_t c, double value) { put(places[i], c, value); });
}

Layout checked_layout(const Document& document, const Value& accessor) {
  const Layout l = layout_of(accessor);
  const bool has_bytes = accessor["bufferView"].exists();
  if (!has_bytes && l.count > std::max(kMostZeros, document.bytes()) / l.width)
    accessor.fail(fmt::format("{} elements are too many without a buffer", l.count));
  if (has_bytes &&
      l.count > document.view(accessor["bufferView"].required_index(document["bufferViews"].size())).bytes.size())
    accessor.fail(fmt::format("{} elements are more than its buffer has bytes", l.count));
  return l;
}

}  // namespace

Numbers numbers_of(const Document& document, std::size_t index) {
  const Value accessor = document["accessors"][index];
  const Layout l = checked_layout(document, accessor);
  const double most = accessor["normalized"].flag(false) ? largest(l.component) : 1;
  Numbers numbers{l.count, l.width, std::vector<float>(l.count * l.width)};
  bool finite = true;
  read_all(document, accessor, l, [&](std::size_t i, std::size_t c, double value) {
    const float number = static_cast<float>(most == 1 ? value : std::max(value / most, -1.0));
    finite = finite && std::isfinite(number);
    numbers.values[i * l.width + c] = number;
  });
  if (!finite) accessor.fail("a number is not finite");
  return numbers;
}

std::vector<std::uint32_t> indices_of(const Document& document, std::size_t index) {
  const Value accessor = document["accessors"][index];
  const Layout l = checked_layout(document, accessor);
  if (l.width != 1 || l.component == 5126) accessor.fail("whole numbers are expected");
  std::vector<std::uint32_t> indices(l.count);
  read_all(document, accessor, l, [&](std::size_t i, std::size_t, double value) {
    if (value < 0) accessor.fail("an index is below 0");
    indices[i] = static_cast<std::uint32_t>(value);
  });
  return indices;
}

}  // namespace dspm::gltf
