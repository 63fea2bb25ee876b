#include "dspm/shapes/plain_shape.h"

#include "dspm/shapes/shape.h"

namespace dspm {

std::optional<PlainShape> Shape::plain() const { return std::nullopt; }

}  // namespace dspm
