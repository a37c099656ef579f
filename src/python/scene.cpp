// Scenes as Python gives them.

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "clca/run/setup.hpp"
#include "clca/scene/resolve.hpp"
#include "python/binding.hpp"
#include "python/interpreter.hpp"

namespace clca::python {

LoadedScene::LoadedScene(const std::string& source, const std::optional<std::string>& given,
                         const std::vector<scene::Override>& overrides)
    : file(given ? source : run::scene_file(source)),
      text(given ? *given : scene::scene_text(file)),
      absolute(std::filesystem::absolute(file)),
      scene(scene::parse_any(text, file, overrides)) {
  run::complete(scene, file, run::default_memory_limit(), run::machine_threads());
}

std::string LoadedScene::place() const {
  return std::filesystem::absolute(file) == absolute ? file : absolute.string();
}

const scene::Scene& LoadedScene::of_grains() const {
  if (const auto* gas = std::get_if<scene::BoltzmannScene>(&scene)) {
    throw scene::SceneError(
        fmt::format("{}: error: expected a scene of grains, found one of a gas", gas->location));
  }
  return std::get<scene::Scene>(scene);
}

const scene::BoltzmannScene& LoadedScene::of_gas() const {
  if (const auto* grains = std::get_if<scene::Scene>(&scene)) {
    throw scene::SceneError(fmt::format("{}: error: expected a scene of a gas, found one of grains",
                                        grains->box.location));
  }
  return std::get<scene::BoltzmannScene>(scene);
}

void add_scene(py::module_& module) {
  py::class_<LoadedScene>(module, "Scene")
      .def(py::init<std::string, std::optional<std::string>, std::vector<scene::Override>>(),
           py::call_guard<Released>())
      .def_property_readonly(
          "name",
          [](const LoadedScene& loaded) {
            return std::visit([](const auto& scene) { return std::string(scene.name); },
                              loaded.scene);
          },
          "That of its file, without `.yaml`, or as it was given.")
      .def(
          "to_yaml",
          [](const LoadedScene& loaded) {
            return std::visit([](const auto& scene) { return scene::to_yaml(scene); },
                              loaded.scene);
          },
          "The scene with every default filled in.")
      .def_property_readonly("_origin", [](const LoadedScene& loaded) {
        return py::make_tuple(py::bytes(loaded.place()), py::bytes(loaded.text));
      });
}

}  // namespace clca::python
