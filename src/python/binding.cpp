// The module _clca: what the Python package needs of the library, in plain tuples and arrays. Here
// scenes; the other sources add what they have.

#include "python/binding.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <exception>
#include <stdexcept>

#include "clca/run/setup.hpp"
#include "clca/scene/parse.hpp"
#include "clca/text/message.hpp"
#include "python/interpreter.hpp"

namespace clca::python {

LoadedScene::LoadedScene(const std::string& source, const std::optional<std::string>& given,
                         const std::vector<std::string>& overrides)
    : file(given ? source : run::scene_file(source)),
      text(given ? *given : scene::read_scene_text(file)),
      absolute_path(std::filesystem::absolute(file)),
      scene(scene::parse_any(text, file, {overrides.begin(), overrides.end()})) {
  run::prepare_scene(scene, file, run::default_memory_limit(), run::machine_thread_count());
}

std::string LoadedScene::usable_path() const {
  return std::filesystem::absolute(file) == absolute_path ? file : absolute_path.string();
}

const scene::Scene& LoadedScene::grains_scene() const {
  if (const auto* gas = std::get_if<scene::BoltzmannScene>(&scene)) {
    throw scene::SceneError(
        fmt::format("{}: error: expected a scene of grains, found one of a gas", gas->location));
  }
  return std::get<scene::Scene>(scene);
}

const scene::BoltzmannScene& LoadedScene::gas_scene() const {
  if (const auto* grains = std::get_if<scene::Scene>(&scene)) {
    throw scene::SceneError(fmt::format("{}: error: expected a scene of a gas, found one of grains",
                                        grains->box.location));
  }
  return std::get<scene::BoltzmannScene>(scene);
}

namespace {

void add_scene(py::module_& module) {
  py::class_<LoadedScene>(module, "Scene")
      .def(py::init<std::string, std::optional<std::string>, std::vector<std::string>>(),
           py::call_guard<ReleasedInterpreter>())
      .def("__reduce__", refuse_pickle)
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
        return py::make_tuple(py::bytes(loaded.usable_path()), py::bytes(loaded.text));
      });
}

void raise(const char* type, const std::exception& error) {
  const auto found = py::module_::import("clca._error").attr(type);
  PyErr_SetString(found.ptr(), text::printable(error.what()).c_str());
}

/// Whatever the library reports is a clca.Error.
void translate(std::exception_ptr failure) {
  try {
    std::rethrow_exception(std::move(failure));
  } catch (const py::builtin_exception&) {
    throw;
  } catch (const std::runtime_error& error) {
    raise("Error", error);
  } catch (const std::invalid_argument& error) {
    raise("ArgumentError", error);
  }
}

}  // namespace

PYBIND11_MODULE(_clca, module) {
  py::register_local_exception_translator(translate);
  watch_for_python_end();
  add_scene(module);
  add_run(module);
  add_simulation(module);
  add_gas(module);
}

}  // namespace clca::python
