// A scene step by step.

#include "clca/run/simulation.hpp"

#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <memory>

#include "clca/measure/profile.hpp"
#include "clca/scene/format.hpp"
#include "clca/scene/units.hpp"
#include "clca/text/input_error.hpp"
#include "python/arrays.hpp"
#include "python/interrupt.hpp"
#include "python/picture.hpp"
#include "python/scene.hpp"

namespace clca::python {

namespace {

class Simulation : public run::Simulation {
 public:
  Simulation(const scene::Scene& scene, int threads, const std::shared_ptr<Interrupt>& by)
      : run::Simulation(scene, threads, [by] { by->check(); }), interrupt(by) {}

  std::shared_ptr<Interrupt> interrupt;
  bool busy = false;
};

std::uint64_t step(Simulation& simulation, std::uint64_t steps) {
  const Change change(simulation.busy);
  Interrupt& interrupt = *simulation.interrupt;
  std::uint64_t taken = 0;
  interrupt.during([&] {
    while (taken < steps && !simulation.is_over() && *interrupt.stop() == 0) {
      simulation.step();
      ++taken;
      if (taken < steps) {  // between two calls Python looks itself
        interrupt.look_at_times();
      }
    }
  });
  return taken;
}

void next_stage(Simulation& simulation) {
  const Change change(simulation.busy);
  if (simulation.stage() + 1 == simulation.scene().stages.size()) {
    throw text::InputError(
        fmt::format("{} is the last stage", simulation.scene().stages[simulation.stage()].name));
  }
  simulation.interrupt->during([&] { simulation.next_stage(); });
}

/// Columns as of a table: positions and heights of the free surface, by lattice column.
py::list profile(const grains::State& state) {
  const std::vector<double> heights = measure::surface_profile(state);
  std::vector<double> positions;
  for (std::size_t column = 0; column < heights.size(); ++column) {
    positions.push_back(lattice::kColumnPitch * static_cast<double>(column));
  }
  const auto array = [](const std::vector<double>& values) {
    return py::array(static_cast<py::ssize_t>(values.size()), values.data());
  };
  py::list columns;
  columns.append(py::make_tuple("x", array(positions), py::make_tuple("Position", "spacings", "")));
  columns.append(py::make_tuple("height", array(heights),
                                py::make_tuple("Height of the surface", "spacings", "")));
  return columns;
}

py::list measures_now(const Simulation& simulation, const std::optional<std::string>& name) {
  const std::vector<scene::Measure>& asked = simulation.scene().measures;
  std::optional<scene::Measure> wanted;
  if (name) {
    const auto found = std::find_if(asked.begin(), asked.end(), [&](scene::Measure measure) {
      return scene::name_of_measure(measure) == *name;
    });
    if (found == asked.end()) {
      throw text::InputError(
          fmt::format("the scene does not measure '{}'; add it to its key measure", *name));
    }
    wanted = *found;
  }
  return python::measures(
      simulation.measures(wanted),
      {.units = scene::conversion(simulation.scene()), .derived = simulation.scene().derived});
}

py::tuple frame_now(const Simulation& simulation) {
  std::optional<FrameData> data;
  {
    const Released free;
    data.emplace(simulation.scene(), simulation.grains(), simulation.contact_frame());
  }
  return std::move(*data).to_python();
}

py::array picture_now(Simulation& simulation, const std::vector<scene::Override>& overrides) {
  const Change change(simulation.busy);
  image::Image image;
  {
    const Released free;
    image = simulation.picture(frames_of(simulation.scene(), overrides));
  }
  return pixels(image);
}

py::array particles(const Simulation& simulation) {
  static const py::handle kType = particle_type().release();
  auto state = simulation.held_grains();
  const std::vector<grains::Particle>& all = state->particles;
  return view(std::move(state), all, py::reinterpret_borrow<py::dtype>(kType));
}

}  // namespace

}  // namespace clca::python

template <>
class pybind11::detail::type_caster<clca::python::Simulation>
    : public clca::python::HeldCaster<clca::python::Simulation> {};

namespace clca::python {

void add_simulation(py::module_& module) {
  const auto make = [](const LoadedScene& loaded, int threads) {
    const scene::Scene& scene = loaded.of_grains();
    const auto interrupt = std::make_shared<Interrupt>();
    std::unique_ptr<Simulation> made;
    interrupt->during([&] { made = std::make_unique<Simulation>(scene, threads, interrupt); });
    return made;
  };
  py::class_<Simulation> bound(module, "Simulation");
  refuse_pickle(bound);
  bound.def(py::init(make), py::arg("scene"), py::arg("threads") = 1)
      .def("_step", step)
      .def("next_stage", next_stage,
           "Ends the stage here and begins the next one. Throws Error in the last one.")
      .def_property_readonly(
          "steps", [](const Simulation& simulation) { return simulation.grains().step; },
          "Taken so far.")
      .def_property_readonly(
          "stage",
          [](const Simulation& simulation) {
            return simulation.scene().stages[simulation.stage()].name;
          },
          "The name of the stage.")
      .def_property_readonly(
          "ended",
          [](const Simulation& simulation) -> py::object {
            const std::string how = simulation.ended();
            return how.empty() ? py::object(py::none()) : py::str(how);
          },
          "How the stage has ended (settled, steps ...); None while it goes on.")
      .def_property_readonly(
          "over", [](const Simulation& simulation) { return simulation.is_over(); },
          "Whether the last stage has ended.")
      .def_property_readonly(
          "state_hash", [](const Simulation& simulation) { return simulation.hash(); },
          "As `state_hash` of a run: equal for equal bits.")
      .def_property_readonly(
          "particles", particles,
          "N: all particles as the model has them, by id: column and row of the reference site "
          "(the column counts on across a periodic boundary), kind, move (0 to 5 clockwise from "
          "up, 6 none) and present.\n\nCannot be written, is no copy and follows the steps, up to "
          "the end of the stage; while a source is open it is a copy.")
      .def("_measures", measures_now)
      .def("_profile", [](const Simulation& simulation) { return profile(simulation.grains()); })
      .def("_frame", frame_now)
      .def("_picture", picture_now)
      .def("_kinds",
           [](const Simulation& simulation) {
             return kinds(simulation.scene(), simulation.grains().kinds);
           })
      .def("_walls",
           [](const Simulation& simulation) {
             return walls(simulation.scene(), simulation.grains());
           })
      .def("_body_names",
           [](const Simulation& simulation) { return body_names(simulation.scene()); })
      .def("_units", [](const Simulation& simulation) { return units(simulation.scene()); });
}

}  // namespace clca::python
