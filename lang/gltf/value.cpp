#include "dspm/lang/gltf/value.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace dspm::gltf {
namespace {

constexpr double kMostCount = 1e12;  // far more than any file holds, and exact as a number

std::string below(const std::string& place, const std::string& key) { return place.empty() ? key : place + "/" + key; }

}  // namespace

void Value::fail(const std::string& sentence) const {
  throw std::runtime_error(place_.empty() ? sentence : place_ + ": " + sentence);
}

Value Value::operator[](const std::string& key) const {
  if (!exists()) return {nullptr, below(place_, key)};
  if (!json_->is_object()) fail("an object is expected");
  const auto found = json_->find(key);
  return {found == json_->end() || found->is_null() ? nullptr : &*found, below(place_, key)};
}

Value Value::operator[](std::size_t index) const {
  const std::string place = below(place_, std::to_string(index));
  if (!exists()) return {nullptr, place};
  if (!json_->is_array()) fail("an array is expected");
  return {index < json_->size() ? &(*json_)[index] : nullptr, place};
}

std::size_t Value::size() const {
  if (!exists()) return 0;
  if (!json_->is_array() && !json_->is_object()) fail("an array or an object is expected");
  return json_->size();
}

std::vector<std::string> Value::keys() const {
  std::vector<std::string> keys;
  if (!exists()) return keys;
  if (!json_->is_object()) fail("an object is expected");
  for (const auto& [key, value] : json_->items()) keys.push_back(key);
  return keys;
}

double Value::number(double fallback) const {
  if (!exists()) return fallback;
  if (!json_->is_number()) fail("a number is expected");
  const double number = json_->get<double>();
  if (!std::isfinite(static_cast<float>(number))) fail("the number is too large");
  return number;
}

bool Value::flag(bool fallback) const {
  if (!exists()) return fallback;
  if (!json_->is_boolean()) fail("true or false is expected");
  return json_->get<bool>();
}

std::string Value::text(const std::string& fallback) const {
  if (!exists()) return fallback;
  if (!json_->is_string()) fail("a string is expected");
  return json_->get<std::string>();
}

std::vector<double> Value::numbers() const {
  std::vector<double> numbers(size());
  if (exists() && !json_->is_array()) fail("an array of numbers is expected");
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = (*this)[i].number(0);
  return numbers;
}

std::size_t Value::count(std::size_t fallback) const {
  if (!exists()) return fallback;
  const double number = this->number(0);
  if (!(number >= 0 && number <= kMostCount) || number != std::floor(number)) fail("a whole number is expected");
  return static_cast<std::size_t>(number);
}

std::optional<std::size_t> Value::index(std::size_t count) const {
  if (!exists()) return std::nullopt;
  const std::size_t index = this->count(0);
  if (index >= count) fail(fmt::format("there is no number {}: there are {}", index, count));
  return index;
}

std::size_t Value::required_index(std::size_t count) const {
  if (!exists()) fail("it is missing");
  return *index(count);
}

}  // namespace dspm::gltf
