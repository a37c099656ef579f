#include "python/quantities.hpp"

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

py::tuple quantity(const std::string& key, const run::KnownQuantities& known) {
  // STAGE.MEASURE, as in tables of sweeps, or KEY.OUTLET.
  const auto of_stage = known.find(key.substr(key.find('.') + 1));
  const run::ShownQuantity found =
      of_stage ? *of_stage : known.find(key).value_or(run::ShownQuantity());
  return py::make_tuple(found.name, found.unit, found.meaning);
}

py::list measures(const std::vector<store::NamedMeasure>& measures,
                  const run::KnownQuantities& known) {
  py::list result;
  for (const auto& [key, number] : measures) {
    result.append(py::make_tuple(key, value(number), quantity(key, known)));
  }
  return result;
}

}  // namespace clca::python
