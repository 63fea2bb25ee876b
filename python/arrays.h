// Between numpy's arrays and vectors of values: a row is a value, and nothing is copied on the way out.
#pragma once

#include <fmt/format.h>
#include <pybind11/numpy.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/math/frames.h"
#include "dspm/base/math/vec.h"

namespace dspm::python {

namespace py = pybind11;

/// How numpy sees a value: as `columns` numbers; 0: as one number, without an axis of its own.
template <class T>
struct Row {
  using Number = T;
  static constexpr py::ssize_t columns = 0;
};
template <py::ssize_t count>
struct FloatRow {
  using Number = float;
  static constexpr py::ssize_t columns = count;
};
template <>
struct Row<Vec2> : FloatRow<2> {};
template <>
struct Row<Vec3> : FloatRow<3> {};
template <>
struct Row<Rgb> : FloatRow<3> {};
template <>
struct Row<FrameSet> {  // bit f: frame f
  using Number = std::uint64_t;
  static constexpr py::ssize_t columns = 0;
};

template <class T>
using Rows = py::array_t<typename Row<T>::Number, py::array::c_style | py::array::forcecast>;

/// The memory of `count` values that lie `stride` bytes apart, which `owner` keeps alive.
template <class T>
py::array view(T* first, std::size_t count, std::size_t stride, py::handle owner) {
  using Number = typename Row<T>::Number;
  std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(count)}, strides = {static_cast<py::ssize_t>(stride)};
  if constexpr (Row<T>::columns > 0) shape.push_back(Row<T>::columns), strides.push_back(sizeof(Number));
  return py::array_t<Number>(shape, strides, reinterpret_cast<Number*>(first), owner);
}

/// An array that owns the vector.
template <class T>
py::array array_of(std::vector<T> values) {
  auto* kept = new std::vector<T>(std::move(values));
  const py::capsule owner(kept, [](void* memory) { delete static_cast<std::vector<T>*>(memory); });
  return view(kept->data(), kept->size(), sizeof(T), owner);
}

/// The values of an array, as long as it lives. Throws ValueError if it has not this shape. `count`: of rows; below 0:
/// any.
template <class T>
std::span<const T> values_of(const Rows<T>& array, const char* name, py::ssize_t count = -1) {
  constexpr py::ssize_t columns = Row<T>::columns;
  const bool fits = array.ndim() == (columns > 0 ? 2 : 1) &&
                    (columns == 0 || array.shape(array.ndim() - 1) == columns) &&
                    (count < 0 || array.shape(0) == count);
  if (!fits) {
    const std::string rows = count < 0 ? "n" : fmt::format("{}", count);
    throw py::value_error(columns > 0 ? fmt::format("{}: expected an array of shape ({}, {})", name, rows, columns)
                                      : fmt::format("{}: expected an array of shape ({},)", name, rows));
  }
  return {reinterpret_cast<const T*>(array.data()), static_cast<std::size_t>(array.shape(0))};
}

/// The same as a vector; without an array, `count` times `otherwise`.
template <class T>
std::vector<T> copy_of(const std::optional<Rows<T>>& array, const char* name, py::ssize_t count, T otherwise) {
  if (!array) return std::vector<T>(static_cast<std::size_t>(count), otherwise);
  const std::span<const T> values = values_of<T>(*array, name, count);
  return {values.begin(), values.end()};
}

/// A property whose array is the vector itself.
template <class Class, class T>
void def_array(py::class_<Class>& of, const char* name, std::vector<T> Class::*member, const char* doc) {
  const auto get = [member](const py::object& self) {
    std::vector<T>& values = self.cast<Class&>().*member;
    return view(values.data(), values.size(), sizeof(T), self);
  };
  of.def_property_readonly(name, get, doc);
}
/// The same of one field of its values, or of their base.
template <class Class, class S, class Base, class T>
void def_field(py::class_<Class>& of, const char* name, std::vector<S> Class::*member, T Base::*field,
               const char* doc) {
  const auto get = [member, field](const py::object& self) {
    std::vector<S>& values = self.cast<Class&>().*member;
    return view(values.empty() ? nullptr : &(values.front().*field), values.size(), sizeof(S), self);
  };
  of.def_property_readonly(name, get, doc);
}

/// How it is shown: by its name and its length. `count`: of a const Class&.
template <class Class, class Count>
void def_repr(py::class_<Class>& of, const char* name, const Count& count) {
  of.def("__repr__",
         [=](const Class& self) { return fmt::format("<dspm.{} of {} rows>", name, std::invoke(count, self)); });
}

}  // namespace dspm::python
