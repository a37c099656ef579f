// The module _clca: what the Python package needs of the library, in plain tuples and arrays.

#include "python/binding.hpp"

#include <pybind11/pybind11.h>

#include <exception>
#include <stdexcept>

#include "clca/text/message.hpp"
#include "python/interpreter.hpp"

namespace {

void raise(const char* type, const std::exception& error) {
  const auto found = pybind11::module_::import("clca._error").attr(type);
  PyErr_SetString(found.ptr(), clca::text::printable(error.what()).c_str());
}

/// Whatever the library reports is a clca.Error.
void translate(std::exception_ptr failure) {
  try {
    std::rethrow_exception(std::move(failure));
  } catch (const pybind11::builtin_exception&) {
    throw;
  } catch (const std::runtime_error& error) {
    raise("Error", error);
  } catch (const std::invalid_argument& error) {
    raise("ArgumentError", error);
  }
}

}  // namespace

PYBIND11_MODULE(_clca, module) {
  pybind11::register_local_exception_translator(translate);
  clca::python::watch_end();
  clca::python::add_scene(module);
  clca::python::add_run(module);
  clca::python::add_pictures(module);
  clca::python::add_simulation(module);
  clca::python::add_gas(module);
}
