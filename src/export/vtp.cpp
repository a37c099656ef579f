#include <fmt/format.h>

#include <algorithm>

#include "clca/render/body.hpp"
#include "clca/store/file.hpp"
#include "clca/text/message.hpp"
#include "export/formats.hpp"
#include "export/vtp_file.hpp"

namespace clca::exports {

namespace {

std::vector<std::optional<lattice::Axial>> shifts_of(const std::vector<grains::Wall>& walls) {
  std::vector<std::optional<lattice::Axial>> shifts;
  for (const grains::Wall& wall : walls) {
    shifts.push_back(wall.present ? std::optional(wall.shift()) : std::nullopt);
  }
  return shifts;
}

/// Sites as vectors from the first site of the lattice, sorted.
std::vector<lattice::Axial> from_origin(const std::vector<lattice::Site>& sites) {
  std::vector<lattice::Axial> result;
  for (const lattice::Site site : sites) {
    result.push_back(site - lattice::Site());
  }
  std::sort(result.begin(), result.end());
  return result;
}

/// A trapezoid may be a triangle.
void add_polygon(VtpFile& file, const render::Trapezoid& piece) {
  file.add_corner(render::position(piece.left_low));
  file.add_corner(render::position(piece.right_low));
  if (piece.right_high != piece.right_low) {
    file.add_corner(render::position(piece.right_high));
  }
  if (piece.left_high != piece.left_low) {
    file.add_corner(render::position(piece.left_high));
  }
  file.end_polygon();
}

/// Escapes text for an attribute.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char character : text) {
    switch (character) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += character;
    }
  }
  return result;
}

}  // namespace

VtpWriter::VtpWriter(store::OutputFile collection, const scene::Scene& scene,
                     const std::vector<grains::Kind>& kinds)
    : collection_(std::move(collection)),
      time_step_(time_step(scene)),
      units_(scene::conversion(scene)),
      species_names_(text::names_of<std::string>(scene.species)),
      wall_names_(text::names_of<std::string>(scene.walls)),
      step_digits_(scene::step_digits(scene)),
      kinds_(kind_appearances(scene, kinds)) {
  collection_.create();  // throws where it cannot be written, before anything else is
}

std::string VtpWriter::beside(const std::string& part, std::uint64_t step) const {
  const std::string repeat = earlier_ > 0 ? fmt::format("-{}", earlier_ + 1) : "";
  return fmt::format("{}{}-{:0{}}{}.vtp", collection_.path().stem().string(), part, step,
                     step_digits_, repeat);
}

double VtpWriter::time(std::uint64_t step) const {
  return time_step_ * (static_cast<double>(step) + static_cast<double>(earlier_) / (earlier_ + 1));
}

// The end of a stage and the beginning of the next one are at the same step.
void VtpWriter::count_frame(std::uint64_t step) {
  earlier_ = step_ == step ? earlier_ + 1 : 0;
  step_ = step;
}

void VtpWriter::add(const grains::State& state, const store::ContactFrame& contact) {
  count_frame(state.step);
  const std::string file = beside("", state.step);
  write_particles(file, state, contact);
  collect(state.step, 0, "particles", file);
  if (state.walls.empty()) {
    return;
  }
  std::vector<Shift> shifts = shifts_of(state.walls);
  if (wall_file_.empty() || shifts != seen_) {
    wall_file_ = beside("-walls", state.step);
    write_walls(wall_file_, state);
    seen_ = std::move(shifts);
  }
  collect(state.step, 1, "walls", wall_file_);
}

void VtpWriter::write_particles(const std::string& file, const grains::State& state,
                                const store::ContactFrame& contact) const {
  VtpFile polygons;
  Bytes id;
  Bytes species;
  Bytes velocity;
  Bytes displacement;
  Bytes force;
  Bytes angular_velocity;
  for (const Body& body : bodies(state, contact, units_)) {
    const KindAppearance& look = kinds_[body.kind];
    for (const Eigen::Vector2d& corner : look.outline) {
      polygons.add_corner(body.centre + corner);
    }
    polygons.end_polygon();
    append(id, body.id);
    append(species, look.species);
    append_vector(velocity, body.velocity.x(), body.velocity.y());
    append_vector(displacement, body.displacement.x(), body.displacement.y());
    append(force, body.force);
    append(angular_velocity, static_cast<float>(body.angular_velocity));
  }
  polygons.set_time(time(state.step));
  polygons.set_names("species_names", species_names_);
  polygons.add_cell_data("id", "UInt32", 1, std::move(id));
  polygons.add_cell_data("species", "UInt16", 1, std::move(species));
  polygons.add_cell_data("velocity", "Float32", 3, std::move(velocity));
  polygons.add_cell_data("displacement", "Float32", 3, std::move(displacement));
  polygons.add_cell_data("force", "Float32", 1, std::move(force));
  if (units_) {
    polygons.add_cell_data("angular_velocity", "Float32", 1, std::move(angular_velocity));
  }
  polygons.write(collection_.folder.create(file));
}

void VtpWriter::write_walls(const std::string& file, const grains::State& state) const {
  VtpFile polygons;
  Bytes number;
  for (std::size_t i = 0; i < state.walls.size(); ++i) {
    const grains::Wall& wall = state.walls[i];
    if (!wall.present) {
      continue;
    }
    const auto sites = from_origin(grains::sites_now(state.lattice, wall));
    for (const render::Trapezoid& piece : render::trapezoids(sites)) {
      add_polygon(polygons, piece);
      append(number, static_cast<std::uint32_t>(i));
    }
  }
  polygons.set_time(time(state.step));
  polygons.set_names("wall_names", wall_names_);
  polygons.add_cell_data("wall", "UInt32", 1, std::move(number));
  polygons.write(collection_.folder.create(file));
}

void VtpWriter::collect(std::uint64_t step, int part, const std::string& name,
                        const std::string& file) {
  entries_ += fmt::format("<DataSet timestep=\"{}\" part=\"{}\" name=\"{}\" file=\"{}\"/>\n",
                          time(step), part, name, escaped(file));
}

void VtpWriter::finish() {
  store::AtomicFile file = collection_.create();
  file.write(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" "
      "byte_order=\"LittleEndian\">\n<Collection>\n" +
      entries_ + "</Collection>\n</VTKFile>\n");
  file.finish();
}

}  // namespace clca::exports
