#pragma once
// What the library has of particles, as NumPy arrays.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "clca/contact/force.hpp"
#include "clca/grains/state.hpp"
#include "clca/record/quantity.hpp"
#include "clca/scene/scene.hpp"
#include "clca/store/summary.hpp"
#include "clca/store/trajectory.hpp"
#include "python/body.hpp"

namespace clca::python {

namespace py = pybind11;

/// A read-only array over the items of `owner`, which it keeps.
template <class Owner, class Item>
py::array view(std::shared_ptr<Owner> owner, const std::vector<Item>& items,
               const py::dtype& type) {
  const py::capsule base(new std::shared_ptr<Owner>(std::move(owner)), [](void* pointer) {
    delete static_cast<std::shared_ptr<Owner>*>(pointer);
  });
  py::array array(type, {static_cast<py::ssize_t>(items.size())}, {}, items.data(), base);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// The same, of items that nobody else has.
template <class Item>
py::array array_of(std::vector<Item> items, const py::dtype& type) {
  auto owner = std::make_shared<std::vector<Item>>(std::move(items));
  const std::vector<Item>& all = *owner;
  return view(std::move(owner), all, type);
}

/// Positions in lattice spacings, one a row.
py::array points(const std::vector<Eigen::Vector2d>& points);

/// grains::Particle as it is in memory.
py::dtype particle_type();

/// What a frame shows of a state.
struct FrameData {
  FrameData(const scene::Scene& scene, const grains::State& state, store::ContactFrame contact);

  std::uint64_t step;
  std::vector<Body> bodies;
  std::vector<std::optional<Eigen::Vector2d>> walls;  ///< from home; none: not there
  std::vector<contact::Force> forces;

  /// (step, particles, walls, contacts); needs the interpreter.
  py::tuple to_python() &&;
};

/// (name, species, degrees, outline) of each kind.
py::list kinds(const scene::Scene& scene, const std::vector<grains::Kind>& kinds);
/// Of time and velocity, by these names: (unit, what a step or a spacing a step is in it).
py::dict units(const scene::Scene& scene);
/// By the number in a contact: the names of the walls and the sides of the box.
py::dict body_names(const scene::Scene& scene);
/// (name, positions of its sites at home) of each wall.
py::list walls(const scene::Scene& scene, const grains::State& state);

/// (name, unit, meaning); empty for what is not known.
pybind11::tuple quantity(const std::string& key, const record::KnownQuantities& known);

/// (key, value or None, quantity) of each.
pybind11::list measures(const std::vector<store::NamedMeasure>& measures,
                        const record::KnownQuantities& known);

}  // namespace clca::python
