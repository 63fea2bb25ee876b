#include "dspm/cameras/diaphragm.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/rounded.h"

namespace dspm {
namespace {

Vec2 on_circle(float radius, float degrees) {
  const float angle = degrees * (kPi / 180);
  return {radius * rounded::cos(angle), radius * rounded::sin(angle)};
}

float area_of(const std::vector<Vec2>& corners) {
  float twice = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 a = corners[i], b = corners[(i + 1) % corners.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return std::abs(twice) / 2;
}

// Of pbrt's sizes, and as they stand there once its pictures have been turned over: a corner at the bottom.
std::vector<Vec2> pentagon() {
  std::vector<Vec2> corners;
  for (int i = 0; i < 5; ++i) corners.push_back(on_circle(0.8f, -90 + 72 * static_cast<float>(i)));
  return corners;
}

// Five points of radius 1, and between them the corners of the pentagon within.
std::vector<Vec2> star() {
  const float inner = rounded::cos(kPi * 0.4f) / rounded::cos(kPi * 0.2f);
  std::vector<Vec2> corners;
  for (int i = 0; i < 10; ++i) corners.push_back(on_circle(i % 2 == 1 ? 1 : inner, -36 * static_cast<float>(i)));
  return corners;
}

}  // namespace

std::optional<Diaphragm> Diaphragm::named(std::string_view name) {
  Diaphragm d;
  if (name == "gaussian") {
    d.kind_ = Kind::gaussian, d.scale_ = 1 / (1 - 2 / rounded::exp(1.f));  // pi over the integral on the disk
  } else if (name == "square") {
    d.kind_ = Kind::square, d.scale_ = kPi;
  } else if (name == "pentagon" || name == "star") {
    d.kind_ = Kind::polygon, d.corners_ = name == "star" ? star() : pentagon();
    d.scale_ = kPi / area_of(d.corners_);
  } else {
    return std::nullopt;
  }
  return d;
}

Diaphragm Diaphragm::of(const Image& picture) {
  Diaphragm d;
  d.kind_ = Kind::picture, d.width_ = picture.width, d.height_ = picture.height;
  double sum = 0;
  for (const Rgb& colour : picture.pixels) {
    const float value = (colour.r + colour.g + colour.b) / 3;
    if (!(value >= 0) || !std::isfinite(value))
      throw std::runtime_error("it has values that are negative, infinite or no number");
    d.values_.push_back(value), sum += static_cast<double>(value);
  }
  if (!(sum > 0)) throw std::runtime_error("it is black, so no light would pass");
  d.scale_ = static_cast<float>(static_cast<double>(kPi / 4) * static_cast<double>(d.values_.size()) / sum);
  return d;
}

float Diaphragm::share(Vec2 place) const {
  const float r2 = place.x * place.x + place.y * place.y;
  switch (kind_) {
    case Kind::circle: return r2 <= 1 ? 1 : 0;
    case Kind::gaussian: return r2 < 1 ? scale_ * (rounded::exp(-r2) - rounded::exp(-1.f)) : 0;
    case Kind::square: return std::max(std::abs(place.x), std::abs(place.y)) <= 0.5f ? scale_ : 0;
    case Kind::polygon: return is_in_polygon(place) ? scale_ : 0;
    case Kind::picture: return scale_ * of_picture(place);
  }
  return 0;
}

float Diaphragm::reach() const {
  if (kind_ != Kind::picture) return 1;
  return rounded::hypot(1 + 1 / static_cast<float>(width_), 1 + 1 / static_cast<float>(height_));
}

bool Diaphragm::is_in_polygon(Vec2 p) const {
  bool inside = false;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Vec2 a = corners_[i], b = corners_[(i + 1) % corners_.size()];
    // Whether a ray from p along x crosses the edge.
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  }
  return inside;
}

// Bilinear, black outside.
float Diaphragm::of_picture(Vec2 place) const {
  const float x = (place.x + 1) / 2 * static_cast<float>(width_) - 0.5f,
              y = (1 - place.y) / 2 * static_cast<float>(height_) - 0.5f;
  if (!(x > -1 && y > -1 && x < static_cast<float>(width_) && y < static_cast<float>(height_))) return 0;
  const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(std::floor(y));
  const float dx = x - static_cast<float>(left), dy = y - static_cast<float>(top);
  const auto at = [&](int column, int row) {
    const bool inside = column >= 0 && row >= 0 && column < width_ && row < height_;
    return inside ? values_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                            static_cast<std::size_t>(column)]
                  : 0;
  };
  return std::lerp(std::lerp(at(left, top), at(left + 1, top), dx),
                   std::lerp(at(left, top + 1), at(left + 1, top + 1), dx), dy);
}

}  // namespace dspm
