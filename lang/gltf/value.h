// A value of a glTF file's JSON and its place, so that messages say where something is wrong: "materials/3/alphaCutoff:
// a number is expected".
#pragma once

#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace dspm::gltf {

using Json = nlohmann::json;

class Value {
 public:
  /// `json` is null if there is no such value.
  Value(const Json* json, std::string place) : json_(json), place_(std::move(place)) {}

  bool exists() const { return json_ != nullptr; }
  const std::string& place() const { return place_; }
  const Json& json() const { return *json_; }

  /// Returns a member of an object, or an element of an array; a value that does not exist has none.
  Value operator[](const std::string& key) const;
  Value operator[](std::size_t index) const;
  /// Returns the size of an array, or the number of an object's members; 0 if it does not exist.
  std::size_t size() const;
  std::vector<std::string> keys() const;
  Value extension(const std::string& name) const { return (*this)["extensions"][name]; }

  // Each throws std::runtime_error if the value exists and is of another kind.
  double number(double fallback) const;
  bool flag(bool fallback) const;
  std::string text(const std::string& fallback) const;
  std::vector<double> numbers() const;
  /// Returns as many numbers as there are in `fallback`.
  template <std::size_t N>
  std::array<double, N> numbers(const std::array<double, N>& fallback) const {
    if (!exists()) return fallback;
    const std::vector<double> all = numbers();
    if (all.size() != N) fail(std::to_string(N) + " numbers are expected");
    std::array<double, N> result{};
    std::copy(all.begin(), all.end(), result.begin());
    return result;
  }
  /// Returns a whole number of at least 0.
  std::size_t count(std::size_t fallback) const;
  /// Returns the index of one of `count` things; nullopt if it does not exist.
  std::optional<std::size_t> index(std::size_t count) const;
  /// Returns the index of something that must be given.
  std::size_t required_index(std::size_t count) const;

  /// Throws std::runtime_error.
  [[noreturn]] void fail(const std::string& sentence) const;

 private:
  const Json* json_;
  std::string place_;
};

}  // namespace dspm::gltf
