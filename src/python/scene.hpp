#pragma once
// Scenes as Python gives them.

#include <pybind11/pybind11.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "clca/scene/parse.hpp"

namespace clca::python {

namespace py = pybind11;

/// A scene with all checks of the command line done.
struct LoadedScene {
  /// `source`: a file or a name; with a `given` text, the file that it is from or what messages
  /// call it.
  LoadedScene(const std::string& source, const std::optional<std::string>& given,
              const std::vector<scene::Override>& overrides);

  std::string file;  ///< for messages
  std::string text;  ///< as it was read
  std::filesystem::path absolute;
  scene::AnyScene scene;

  /// `file`, if that still leads to the same file, else `absolute`.
  std::string place() const;

  // Throw scene::SceneError for one of the other kind.
  const scene::Scene& of_grains() const;
  const scene::BoltzmannScene& of_gas() const;
};

/// What casts objects of Python to T: not those that __new__ alone has made, which hold no T.
template <class T>
class HeldCaster : public py::detail::type_caster_base<T> {
 public:
  bool load(py::handle source, bool convert) {
    if (py::isinstance<T>(source) && !reinterpret_cast<py::detail::instance*>(source.ptr())
                                          ->get_value_and_holder()
                                          .holder_constructed()) {
      throw py::type_error("an object whose __init__ has not been called");
    }
    return py::detail::type_caster_base<T>::load(source, convert);
  }
};

/// Refuses pickle, whose older protocols end the process for classes of pybind11.
template <class Class>
void refuse_pickle(Class& bound) {
  bound.def("__reduce__", [](const py::object& self) -> py::object {
    throw py::type_error("cannot pickle " +
                         py::str(py::type::of(self).attr("__name__")).cast<std::string>());
  });
}

void add_scene(py::module_& module);
void add_run(py::module_& module);
void add_gas(py::module_& module);
void add_pictures(py::module_& module);
void add_simulation(py::module_& module);
void add_sweep(py::module_& module);

}  // namespace clca::python

template <>
class pybind11::detail::type_caster<clca::python::LoadedScene>
    : public clca::python::HeldCaster<clca::python::LoadedScene> {};
