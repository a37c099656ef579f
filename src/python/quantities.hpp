#pragma once
// Measures with what is declared of them.

#include <pybind11/pybind11.h>

#include <optional>
#include <string>
#include <vector>

#include "clca/scene/units.hpp"
#include "clca/store/summary.hpp"

namespace clca::python {

/// What is declared of the quantities of a run.
struct Declared {
  bool of_gas = false;
  std::optional<scene::Conversion> units = {};
};

/// (name, unit, meaning); empty for what is not declared.
pybind11::tuple quantity(const std::string& key, const Declared& declared);

/// (key, value or None, quantity) of each.
pybind11::list measures(const std::vector<store::NamedMeasure>& measures, const Declared& declared);

}  // namespace clca::python
