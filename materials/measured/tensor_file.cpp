// A header of 12 bytes, a version, the number of fields; of each field its name, type, offset and shape. Little-endian.
#include "dspm/materials/measured/tensor_file.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace dspm {
namespace {

constexpr std::string_view kMagic{"tensor_file\0", 12};
constexpr std::uint8_t kVersion = 1, kByte = 1, kFloat = 10;

static_assert(std::endian::native == std::endian::little);

class TensorReader {
 public:
  explicit TensorReader(std::string_view bytes) : bytes_(bytes), left_(bytes.size()) {
    if (take(kMagic.size()) != kMagic) throw std::runtime_error("it is not a .bsdf file of RGL");
    if (number<std::uint8_t>() != kVersion) throw std::runtime_error("it has another version than 1");
    number<std::uint8_t>();
  }

  template <class T>
  T number() {
    T value;
    std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
    return value;
  }

  std::string_view take(std::size_t count) {
    if (count > bytes_.size() - at_) throw std::runtime_error("the file ends too early");
    at_ += count;
    return bytes_.substr(at_ - count, count);
  }

  /// Reads a field. If the type of the next one is unknown, it has no values.
  Tensor tensor() {
    const auto dimensions = number<std::uint16_t>();
    const auto type = number<std::uint8_t>();
    const auto offset = number<std::uint64_t>();
    const std::size_t size = type == kFloat ? sizeof(float) : 1;
    Tensor tensor;
    std::size_t count = 1;
    for (int i = 0; i < dimensions; ++i) {
      const auto extent = number<std::uint64_t>();
      if (extent > bytes_.size() || count * extent > bytes_.size()) throw std::runtime_error("an array is too large");
      tensor.shape.push_back(static_cast<std::size_t>(extent)), count *= extent;
    }
    if (type != kFloat && type != kByte) return tensor;
    if (offset > bytes_.size() || count * size > bytes_.size() - offset)
      throw std::runtime_error("an array lies beyond the end of the file");
    if (count * size > left_) throw std::runtime_error("its arrays overlap");
    left_ -= count * size;
    tensor.values.resize(count);
    const char* data = bytes_.data() + offset;
    for (std::size_t i = 0; i < count; ++i) {
      if (type == kFloat)
        std::memcpy(&tensor.values[i], data + i * size, size);
      else
        tensor.values[i] = static_cast<float>(static_cast<unsigned char>(data[i]));
    }
    return tensor;
  }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
  std::size_t left_;  // bytes that no array has taken yet
};

}  // namespace

std::map<std::string, Tensor> decode_tensors(std::string_view bytes) {
  TensorReader reader(bytes);
  std::map<std::string, Tensor> all;
  const auto fields = reader.number<std::uint32_t>();
  for (std::uint32_t i = 0; i < fields; ++i) {
    const auto length = reader.number<std::uint16_t>();
    std::string name(reader.take(length));
    all[std::move(name)] = reader.tensor();
  }
  return all;
}

}  // namespace dspm
