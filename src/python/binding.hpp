#pragma once
// What the sources of the module share: scenes as Python gives them, arrays of NumPy.

#include <pybind11/numpy.h>

#include <concepts>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "clca/image/image.hpp"
#include "clca/scene/parse.hpp"

namespace clca::python {

namespace py = pybind11;

/// Base of C++ objects in Python objects; the caster below refuses Python objects without one.
struct HeldByPython {};

/// A scene with all checks of the command line done.
struct LoadedScene : HeldByPython {
  /// `source`: a file or a name; with a `given` text, the file that it is from or what messages
  /// call it.
  LoadedScene(const std::string& source, const std::optional<std::string>& given,
              const std::vector<std::string>& overrides);

  std::string file;  ///< for messages
  std::string text;  ///< as it was read
  std::filesystem::path absolute_path;
  scene::AnyScene scene;

  /// `file`, if that still leads to the same file, else `absolute_path`.
  std::string usable_path() const;

  // Throw scene::SceneError for one of the other kind.
  const scene::Scene& grains_scene() const;
  const scene::BoltzmannScene& gas_scene() const;
};

/// A read-only array over memory of `owner`, which it keeps. `strides`: in bytes; none: without
/// gaps.
template <class Owner>
py::array readonly_array(std::shared_ptr<Owner> owner, const void* memory, const py::dtype& type,
                         py::array::ShapeContainer shape,
                         py::array::StridesContainer strides = {}) {
  const py::capsule base(new std::shared_ptr<Owner>(std::move(owner)), [](void* pointer) {
    delete static_cast<std::shared_ptr<Owner>*>(pointer);
  });
  py::array array(type, std::move(shape), std::move(strides), memory, base);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// Rows from the top x columns x 3, of bytes.
inline py::array pixel_array(const image::Image& image) {
  static_assert(sizeof(image::Rgb) == 3);
  return py::array_t<std::uint8_t>({image.height, image.width, 3}, &image.pixels.data()->red);
}

/// Refuses pickle, whose older protocols end the process for classes of pybind11.
inline py::object refuse_pickle(const py::object& self) {
  throw py::type_error("cannot pickle " +
                       py::str(py::type::of(self).attr("__name__")).cast<std::string>());
}

void add_run(py::module_& module);
void add_gas(py::module_& module);
void add_simulation(py::module_& module);

}  // namespace clca::python

/// Casts objects of Python: not those that __new__ alone has made, which hold nothing.
template <std::derived_from<clca::python::HeldByPython> T>
class pybind11::detail::type_caster<T> : public type_caster_base<T> {
 public:
  bool load(handle source, bool convert) {
    if (isinstance<T>(source) &&
        !reinterpret_cast<instance*>(source.ptr())->get_value_and_holder().holder_constructed()) {
      throw type_error("an object whose __init__ has not been called");
    }
    return type_caster_base<T>::load(source, convert);
  }
};
