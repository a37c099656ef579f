#pragma once
// What the library has, as NumPy arrays.

#include <pybind11/numpy.h>

#include <memory>
#include <utility>
#include <vector>

#include "clca/image/image.hpp"

namespace clca::python {

namespace py = pybind11;

/// A read-only array over memory of `owner`, which it keeps. `strides`: in bytes; none: without
/// gaps.
template <class Owner>
py::array view(std::shared_ptr<Owner> owner, const void* memory, const py::dtype& type,
               py::array::ShapeContainer shape, py::array::StridesContainer strides = {}) {
  const py::capsule base(new std::shared_ptr<Owner>(std::move(owner)), [](void* pointer) {
    delete static_cast<std::shared_ptr<Owner>*>(pointer);
  });
  py::array array(type, std::move(shape), std::move(strides), memory, base);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// The same, of numbers that nobody else has.
template <class Number>
py::array array_of(std::vector<Number> numbers) {
  const auto owner = std::make_shared<std::vector<Number>>(std::move(numbers));
  return view(owner, owner->data(), py::dtype::of<Number>(),
              {static_cast<py::ssize_t>(owner->size())});
}

/// Rows from the top x columns x 3, of bytes.
inline py::array pixels(const image::Image& image) {
  static_assert(sizeof(image::Rgb) == 3);
  return py::array_t<std::uint8_t>({image.height, image.width, 3}, &image.pixels.data()->red);
}

}  // namespace clca::python
