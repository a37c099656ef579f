// A scene step by step.

#include "clca/run/simulation.hpp"

#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <type_traits>

#include "clca/measure/profile.hpp"
#include "clca/record/quantity.hpp"
#include "clca/scene/format.hpp"
#include "clca/scene/parse.hpp"
#include "clca/scene/units.hpp"
#include "clca/text/read.hpp"
#include "python/binding.hpp"
#include "python/interpreter.hpp"

namespace clca::python {

namespace {

class Simulation : public run::Simulation, public HeldByPython {
 public:
  Simulation(const scene::Scene& scene, int threads, const std::shared_ptr<SignalWatch>& by)
      : run::Simulation(scene, threads, [by] { by->throw_if_stopped(); }), interrupt(by) {}

  std::shared_ptr<SignalWatch> interrupt;
  bool busy = false;
};

std::uint64_t step(Simulation& simulation, std::uint64_t steps) {
  const BusyScope change(simulation.busy);
  SignalWatch& interrupt = *simulation.interrupt;
  std::uint64_t taken = 0;
  interrupt.run_without_interpreter([&] {
    while (taken < steps && !simulation.is_over() && *interrupt.stop_signal() == 0) {
      simulation.step();
      ++taken;
      if (taken < steps) {  // between two calls Python looks itself
        interrupt.check_signals_at_intervals();
      }
    }
  });
  return taken;
}

void next_stage(Simulation& simulation) {
  const BusyScope change(simulation.busy);
  if (simulation.stage_index() + 1 == simulation.scene().stages.size()) {
    throw text::InputError(fmt::format("{} is the last stage",
                                       simulation.scene().stages[simulation.stage_index()].name));
  }
  simulation.interrupt->run_without_interpreter([&] { simulation.begin_next_stage(); });
}

py::list measures_now(const Simulation& simulation, const std::optional<std::string>& name) {
  const std::vector<scene::Measure>& asked = simulation.scene().measures;
  std::optional<scene::Measure> wanted;
  if (name) {
    const auto found = std::ranges::find(asked, *name, scene::name_of_measure);
    if (found == asked.end()) {
      throw text::InputError(
          fmt::format("the scene does not measure '{}'; add it to its key measure", *name));
    }
    wanted = *found;
  }
  const record::KnownQuantities known = {.units = scene::unit_conversion(simulation.scene()),
                                         .derived_measures = simulation.scene().derived_measures};
  py::list result;
  for (const auto& [key, value] : simulation.measures(wanted)) {
    const auto what = known.find(key).value_or(store::ColumnSummary());
    result.append(py::make_tuple(key, value, what.name, what.unit, what.meaning));
  }
  return result;
}

/// Texts in UTF-8, or rows of numbers.
py::object values_of(const store::Dataset& dataset) {
  const auto to_python = [&]<class Item>(const std::vector<Item>& items) -> py::object {
    if constexpr (std::is_same_v<Item, std::string>) {
      py::list texts;
      for (const std::string& text : items) {
        texts.append(py::bytes(text));
      }
      return texts;
    } else {
      py::array numbers = py::array_t<Item>(static_cast<py::ssize_t>(items.size()), items.data());
      if (dataset.numbers_per_row > 1) {
        numbers =
            numbers.reshape({py::ssize_t{-1}, static_cast<py::ssize_t>(dataset.numbers_per_row)});
      }
      return numbers;
    }
  };
  return std::visit(to_python, dataset.values);
}

/// What a trajectory with the state as it is now would have, by path.
py::dict datasets_now(const Simulation& simulation) {
  std::vector<store::Dataset> datasets;
  {
    const ReleasedInterpreter free;
    datasets = store::datasets(simulation.scene(), simulation.state(), simulation.stage_index(),
                               simulation.contact_frame());
  }
  py::dict result;
  for (const store::Dataset& dataset : datasets) {
    result[py::str(dataset.path)] = values_of(dataset);
  }
  return result;
}

/// As run.json has it: what frames need of it.
py::dict summary(const Simulation& simulation) {
  using py::literals::operator""_a;
  py::list kinds;
  for (const int degrees :
       scene::orientation_degrees(simulation.scene(), simulation.state().kinds)) {
    kinds.append(py::dict("degrees"_a = degrees));
  }
  py::dict result("kinds"_a = kinds);
  if (const auto units = scene::unit_conversion(simulation.scene())) {
    result["units"] = py::dict("time"_a = units->time_unit, "time_step"_a = units->time_step,
                               "velocity"_a = units->velocity_unit, "spacing"_a = units->spacing);
  }
  return result;
}

/// `output.frames` of the scene with these overrides; defaults where it has none. Throws
/// scene::SceneError.
scene::PictureOutput frames_of(const scene::Scene& scene, std::vector<std::string> overrides) {
  if (!scene.output.frames) {
    overrides.insert(overrides.begin(), "output.frames={}");
  }
  return *scene::parse(scene::to_yaml(scene), scene.name, {overrides.begin(), overrides.end()})
              .output.frames;
}

py::array picture_now(Simulation& simulation, const std::vector<std::string>& overrides) {
  const BusyScope change(simulation.busy);
  image::Image image;
  {
    const ReleasedInterpreter free;
    image = simulation.picture(frames_of(simulation.scene(), overrides));
  }
  return pixel_array(image);
}

/// All particles as the model has them.
py::array particles(const Simulation& simulation) {
  const auto state = simulation.shared_state();
  return readonly_array(state, state->particles.data(), py::dtype::of<grains::Particle>(),
                        {static_cast<py::ssize_t>(state->particles.size())});
}

}  // namespace

void add_simulation(py::module_& module) {
  PYBIND11_NUMPY_DTYPE_EX(grains::Particle, column, "column", row, "row", kind, "kind", previous,
                          "move", present, "present");
  const auto make = [](const LoadedScene& loaded, int threads) {
    const scene::Scene& scene = loaded.grains_scene();
    const auto interrupt = std::make_shared<SignalWatch>();
    std::unique_ptr<Simulation> made;
    interrupt->run_without_interpreter(
        [&] { made = std::make_unique<Simulation>(scene, threads, interrupt); });
    return made;
  };
  py::class_<Simulation>(module, "Simulation")
      .def(py::init(make), py::arg("scene"), py::arg("threads") = 1)
      .def("__reduce__", refuse_pickle)
      .def("_step", step)
      .def("next_stage", next_stage,
           "Ends the stage here and begins the next one. Throws Error in the last one.")
      .def_property_readonly(
          "steps", [](const Simulation& simulation) { return simulation.state().step; },
          "Taken so far.")
      .def_property_readonly(
          "stage",
          [](const Simulation& simulation) {
            return simulation.scene().stages[simulation.stage_index()].name;
          },
          "The name of the stage.")
      .def_property_readonly(
          "ended",
          [](const Simulation& simulation) -> py::object {
            const std::string how = simulation.stage_end_text();
            return how.empty() ? py::object(py::none()) : py::str(how);
          },
          "How the stage has ended (settled, steps ...); None while it goes on.")
      .def_property_readonly("over", &Simulation::is_over, "Whether the last stage has ended.")
      .def_property_readonly(
          "state_hash",
          [](const Simulation& simulation) {
            return fmt::format("{:016x}", simulation.state_hash());
          },
          "As `state_hash` of a run: equal for equal bits.")
      .def_property_readonly(
          "particles", particles,
          "N: all particles as the model has them, by id: column and row of the reference site "
          "(the column counts on across a periodic boundary), kind, move (0 to 5 clockwise from "
          "up, 6 none) and present.\n\nCannot be written, is no copy and follows the steps, up to "
          "the end of the stage; while a source is open it is a copy.")
      .def("_measures", measures_now)
      .def(
          "_heights",
          [](const Simulation& simulation) { return measure::surface_profile(simulation.state()); })
      .def("_datasets", datasets_now)
      .def("_summary", summary)
      .def("_picture", picture_now);
}

}  // namespace clca::python
