// The module _clca: what the Python package needs of the library, in plain tuples and arrays.

#include <pybind11/pybind11.h>

#include <exception>
#include <stdexcept>

#include "python/scene.hpp"

namespace {

/// Whatever the library reports is a clca.Error; those for a wrong argument are Python's own.
void translate(std::exception_ptr failure) {
  try {
    std::rethrow_exception(std::move(failure));
  } catch (const pybind11::builtin_exception&) {
    throw;
  } catch (const std::runtime_error& error) {
    const auto type = pybind11::module_::import("clca._error").attr("Error");
    PyErr_SetString(type.ptr(), error.what());
  }
}

}  // namespace

PYBIND11_MODULE(_clca, module) {
  pybind11::register_local_exception_translator(translate);
  clca::python::add_scene(module);
  clca::python::add_run(module);
  clca::python::add_folder(module);
  clca::python::add_pictures(module);
  clca::python::add_simulation(module);
  clca::python::add_gas(module);
  clca::python::add_sweep(module);
}
