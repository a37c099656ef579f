#include "python/quantities.hpp"

#include "clca/run/quantity.hpp"

namespace clca::python {

namespace py = pybind11;

namespace {

py::object value(const store::MeasureValue& value) {
  if (const auto* answer = std::get_if<bool>(&value)) {
    return py::bool_(*answer);
  }
  const auto* number = std::get_if<double>(&value);
  return number != nullptr ? py::object(py::float_(*number)) : py::none();
}

}  // namespace

py::tuple quantity(const std::string& key, const Declared& declared) {
  const auto find = declared.of_gas ? run::find_gas_quantity : run::find_quantity;
  // STAGE.MEASURE, as in tables of sweeps, or KEY.OUTLET.
  const run::Quantity* found = find(key.substr(key.find('.') + 1));
  if (found == nullptr) {
    found = find(key);
  }
  return found != nullptr
             ? py::make_tuple(found->name, run::shown_unit(found->unit, declared.units),
                              found->meaning)
             : py::make_tuple("", "", "");
}

py::list measures(const std::vector<store::NamedMeasure>& measures, const Declared& declared) {
  py::list result;
  for (const auto& [key, number] : measures) {
    result.append(py::make_tuple(key, value(number), quantity(key, declared)));
  }
  return result;
}

}  // namespace clca::python
