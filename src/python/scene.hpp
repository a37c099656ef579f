#pragma once
// Scenes as Python gives them.

#include <pybind11/pybind11.h>

#include <optional>
#include <string>
#include <vector>

#include "clca/scene/parse.hpp"

namespace clca::python {

namespace py = pybind11;

/// A scene with all checks of the command line done.
struct LoadedScene {
  /// `source`: a file or a name, or the text of a scene that has no file.
  LoadedScene(const std::string& source, const std::optional<std::string>& text,
              const std::vector<scene::Override>& overrides);

  std::string file;  ///< for messages
  scene::AnyScene scene;

  // Throw scene::SceneError for one of the other kind.
  const scene::Scene& of_grains() const;
  const scene::BoltzmannScene& of_gas() const;
};

void add_scene(py::module_& module);
void add_run(py::module_& module);
void add_folder(py::module_& module);
void add_gas(py::module_& module);
void add_pictures(py::module_& module);
void add_simulation(py::module_& module);
void add_sweep(py::module_& module);

}  // namespace clca::python
