// A gas, advanced at will.

#include "clca/boltzmann/gas.hpp"

#include <fmt/format.h>
#include <pybind11/pybind11.h>

#include <exception>
#include <memory>
#include <stdexcept>

#include "clca/boltzmann/observation.hpp"
#include "clca/boltzmann/scheme.hpp"
#include "clca/parallel/team.hpp"
#include "clca/run/setup.hpp"
#include "clca/scene/boltzmann.hpp"
#include "python/binding.hpp"
#include "python/interpreter.hpp"

namespace clca::python {

namespace {

class Gas : public HeldByPython {
 public:
  Gas(const LoadedScene& loaded, std::optional<int> threads)
      : process_(scene::gas_process(loaded.gas_scene(), loaded.gas_scene().restitutions.front())),
        seed_(loaded.gas_scene().seed),
        threads_(threads.value_or(run::machine_thread_count())),
        gas_(std::make_shared<boltzmann::Gas>(
            boltzmann::make_gas(scene::initial_condition(loaded.gas_scene()), seed_))) {}

  const boltzmann::Gas& now() const {
    BusyScope::check(busy_);
    if (failure_) {
      std::rethrow_exception(failure_);
    }
    return *gas_;
  }

  /// Arrays of before keep what they had.
  void advance(double time) {
    now();
    const BusyScope change(busy_);
    SignalWatch interrupt;
    interrupt.run_without_interpreter([&] {
      if (gas_.use_count() > 1) {
        gas_ = std::make_shared<boltzmann::Gas>(*gas_);
      }
      try {
        boltzmann::advance(*gas_, process_, seed_, time, parallel::start_team(threads_),
                           [&](const boltzmann::Gas& /*gas*/) {
                             interrupt.check_signals_at_intervals();
                             return *interrupt.stop_signal() == 0;
                           });
      } catch (const std::invalid_argument&) {
        throw;
      } catch (...) {
        failure_ = std::current_exception();  // particles have gone different ways
        throw;
      }
    });
  }

  /// Rows `first` and the two after it of the motions, one particle a row; no copy.
  py::array motion_rows(int first) const {
    const boltzmann::Gas& gas = now();
    constexpr auto kNumber = static_cast<py::ssize_t>(sizeof(double));
    return readonly_array(gas_, gas.motions.data() + first, py::dtype::of<double>(),
                          {gas.particle_count(), py::ssize_t{3}},
                          {gas.motions.rows() * kNumber, kNumber});
  }

 private:
  boltzmann::Dynamics process_;
  std::uint64_t seed_;
  int threads_;
  std::shared_ptr<boltzmann::Gas> gas_;
  bool busy_ = false;
  std::exception_ptr failure_;
};

py::dict moments(const Gas& gas) {
  const boltzmann::Moments moments = boltzmann::moments(gas.now().motions);
  py::dict result;
  reflection::for_each_field<boltzmann::Moments>(
      [&](std::string_view name, auto part) { result[py::str(name)] = *part(moments); });
  return result;
}

}  // namespace

void add_gas(py::module_& module) {
  constexpr int kSpin = 3;  // first row of spins
  py::class_<Gas>(module, "Gas")
      .def(py::init<const LoadedScene&, std::optional<int>>(), py::arg("scene"),
           py::arg("threads") = py::none())
      .def("__reduce__", refuse_pickle)
      .def("_advance", &Gas::advance)
      .def_property_readonly(
          "time", [](const Gas& gas) { return gas.now().time; }, "Of the gas.")
      .def_property_readonly(
          "collisions", [](const Gas& gas) { return gas.now().collisions_per_particle(); },
          "Per particle, so far.")
      .def_property_readonly(
          "velocities", [](const Gas& gas) { return gas.motion_rows(0); },
          "N x 3, in v0; no copy. `advance` leaves it as it is.")
      .def_property_readonly(
          "spins", [](const Gas& gas) { return gas.motion_rows(kSpin); },
          "N x 3: surface velocities, in v0; no copy. `advance` leaves it as it is.")
      .def_property_readonly("moments", moments,
                             "By name: translational, rotational (<v^2>/3, <w^2>/3) ...")
      .def_property_readonly(
          "state_hash",
          [](const Gas& gas) { return fmt::format("{:016x}", boltzmann::hash(gas.now())); },
          "Equal for equal bits.");
}

}  // namespace clca::python
