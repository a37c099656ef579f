#pragma once
// Measures with what is declared of them.

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "clca/run/quantity.hpp"
#include "clca/store/summary.hpp"

namespace clca::python {

/// (name, unit, meaning); empty for what is not known.
pybind11::tuple quantity(const std::string& key, const run::KnownQuantities& known);

/// (key, value or None, quantity) of each.
pybind11::list measures(const std::vector<store::NamedMeasure>& measures,
                        const run::KnownQuantities& known);

}  // namespace clca::python
