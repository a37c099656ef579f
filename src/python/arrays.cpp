#include "python/arrays.hpp"

#include <cstddef>

#include "clca/record/quantity.hpp"
#include "clca/scene/units.hpp"

namespace clca::python {

namespace {

struct Field {
  const char* name;
  const char* format;
  std::size_t offset;
};

py::dtype struct_type(const std::vector<Field>& fields, std::size_t size) {
  py::list names;
  py::list formats;
  py::list offsets;
  for (const Field& field : fields) {
    names.append(field.name);
    formats.append(field.format);
    offsets.append(field.offset);
  }
  return {std::move(names), std::move(formats), std::move(offsets), static_cast<py::ssize_t>(size)};
}

py::dtype body_type() {
  return struct_type({{"id", "u4", offsetof(Body, id)},
                      {"kind", "u2", offsetof(Body, kind)},
                      {"position", "(2,)f8", offsetof(Body, centre)},
                      {"velocity", "(2,)f8", offsetof(Body, velocity)},
                      {"displacement", "(2,)f8", offsetof(Body, displacement)},
                      {"angular_velocity", "f8", offsetof(Body, angular_velocity)},
                      {"image", "i4", offsetof(Body, image)},
                      {"force", "f4", offsetof(Body, force)}},
                     sizeof(Body));
}

py::dtype force_type() {
  using contact::Force;
  static_assert(offsetof(Force, along_shear) ==
                offsetof(Force, along_normal) + sizeof(double));  // one field of two numbers
  return struct_type({{"upper", "u4", offsetof(Force, upper)},
                      {"other", "i4", offsetof(Force, other)},
                      {"place", "(2,)f8", offsetof(Force, point)},
                      {"normal", "(2,)f8", offsetof(Force, normal)},
                      {"branch", "(2,)f8", offsetof(Force, branch)},
                      {"force", "(2,)f8", offsetof(Force, along_normal)}},
                     sizeof(Force));
}

}  // namespace

py::array points(const std::vector<Eigen::Vector2d>& points) {
  py::array_t<double> array({static_cast<py::ssize_t>(points.size()), py::ssize_t{2}});
  auto cells = array.mutable_unchecked<2>();
  for (std::size_t i = 0; i < points.size(); ++i) {
    cells(static_cast<py::ssize_t>(i), 0) = points[i].x();
    cells(static_cast<py::ssize_t>(i), 1) = points[i].y();
  }
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

py::dtype particle_type() {
  using grains::Particle;
  return struct_type({{"column", "i4", offsetof(Particle, column)},
                      {"row", "i4", offsetof(Particle, row)},
                      {"kind", "u2", offsetof(Particle, kind)},
                      {"move", "u1", offsetof(Particle, previous)},
                      {"present", "?", offsetof(Particle, present)}},
                     sizeof(Particle));
}

FrameData::FrameData(const scene::Scene& scene, const grains::State& state,
                     store::ContactFrame contact)
    : step(state.step),
      bodies(python::bodies(state, contact, scene::conversion(scene))),
      forces(std::move(contact.forces)) {
  for (const grains::Wall& wall : state.walls) {
    walls.push_back(wall.present ? std::optional(lattice::position(wall.shift())) : std::nullopt);
  }
}

py::tuple FrameData::to_python() && {
  py::list shifts;
  for (const auto& shift : walls) {
    shifts.append(shift ? py::object(py::make_tuple(shift->x(), shift->y())) : py::none());
  }
  return py::make_tuple(step, array_of(std::move(bodies), body_type()), shifts,
                        array_of(std::move(forces), force_type()));
}

py::list kinds(const scene::Scene& scene, const std::vector<grains::Kind>& kinds) {
  py::list result;
  for (const KindAppearance& kind : kind_appearances(scene, kinds)) {
    result.append(py::make_tuple(kind.name, scene.species[kind.species].name, kind.degrees,
                                 points(kind.outline)));
  }
  return result;
}

py::dict units(const scene::Scene& scene) {
  const auto conversion = scene::conversion(scene);
  py::dict result;
  const std::string time = conversion ? conversion->time_unit : "steps";
  result["time"] = py::make_tuple(time, time_step(scene));
  result["velocity"] = py::make_tuple(conversion ? conversion->velocity_unit : "spacings/step",
                                      conversion ? conversion->velocity(1) : 1.0);
  return result;
}

py::dict body_names(const scene::Scene& scene) {
  std::vector<grains::Owner> bodies = {contact::kFloor, contact::kCeiling, contact::kLeftSide,
                                       contact::kRightSide};
  for (std::size_t wall = 0; wall < scene.walls.size(); ++wall) {
    bodies.push_back(grains::wall_code(wall));
  }
  py::dict names;
  for (const grains::Owner body : bodies) {
    names[py::int_(body)] = record::body_name(scene, body);
  }
  return names;
}

py::list walls(const scene::Scene& scene, const grains::State& state) {
  py::list result;
  for (std::size_t number = 0; number < scene.walls.size(); ++number) {
    std::vector<Eigen::Vector2d> positions;
    for (const lattice::Site site : state.walls[number].sites) {
      positions.push_back(lattice::position(site));
    }
    result.append(py::make_tuple(scene.walls[number].name, points(positions)));
  }
  return result;
}

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

py::tuple quantity(const std::string& key, const record::KnownQuantities& known) {
  // STAGE.MEASURE, as in tables of sweeps, or KEY.OUTLET.
  const auto of_stage = known.find(key.substr(key.find('.') + 1));
  const record::ShownQuantity found =
      of_stage ? *of_stage : known.find(key).value_or(record::ShownQuantity());
  return py::make_tuple(found.name, found.unit, found.meaning);
}

py::list measures(const std::vector<store::NamedMeasure>& measures,
                  const record::KnownQuantities& known) {
  py::list result;
  for (const auto& [key, number] : measures) {
    result.append(py::make_tuple(key, value(number), quantity(key, known)));
  }
  return result;
}

}  // namespace clca::python
