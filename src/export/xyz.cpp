#include <fmt/format.h>

#include <iterator>

#include "export/formats.hpp"

namespace clca::exports {

namespace {

using Text = fmt::memory_buffer;

/// Six decimals, or 0: most particles are at rest.
void append_number(Text& text, double value) {
  if (value == 0) {
    fmt::format_to(std::back_inserter(text), " 0");
  } else {
    fmt::format_to(std::back_inserter(text), " {:.6f}", value);
  }
}

void append_vector(Text& text, const Eigen::Vector2d& vector) {
  append_number(text, vector.x());
  append_number(text, vector.y());
  append_number(text, 0);
}

/// The comment line of a frame. The box is one layer, half on either side of the plane.
void append_comment(Text& text, const grains::State& state,
                    const std::optional<scene::Conversion>& units) {
  const Eigen::Vector2d corner = lattice::Lattice::corner();
  const Eigen::Vector2d size = state.lattice.size();
  fmt::format_to(std::back_inserter(text),
                 "Lattice=\"{:.6f} 0 0 0 {:.6f} 0 0 0 1\" Origin=\"{:.6f} {:.6f} -0.5\" "
                 "Properties=species:S:1:pos:R:3:id:I:1:velo:R:3:displacement:R:3:force:R:1{} "
                 "Time={} Step={} pbc=\"{} F F\"\n",
                 size.x(), size.y(), corner.x(), corner.y(), units ? ":angular_velocity:R:1" : "",
                 units ? units->time(state.step) : static_cast<double>(state.step), state.step,
                 state.lattice.periodic() ? 'T' : 'F');
}

}  // namespace

XyzWriter::XyzWriter(const store::OutputFile& file, const scene::Scene& scene,
                     const std::vector<grains::Kind>& kinds)
    : file_(file.create()), units_(scene::conversion(scene)) {
  for (const grains::Kind& kind : kinds) {
    species_.push_back(scene.species[kind.species].name);
  }
}

void XyzWriter::add(const grains::State& state, const store::ContactFrame& contact) {
  const std::vector<Body> all = bodies(state, contact, units_);
  Text text;
  fmt::format_to(std::back_inserter(text), "{}\n", all.size());
  append_comment(text, state, units_);
  for (const Body& body : all) {
    text.append(species_[body.kind]);
    append_vector(text, body.centre);
    fmt::format_to(std::back_inserter(text), " {}", body.id);
    append_vector(text, body.velocity);
    append_vector(text, body.displacement);
    fmt::format_to(std::back_inserter(text), " {:.7g}", body.force);
    if (units_) {
      fmt::format_to(std::back_inserter(text), " {:.7g}", body.angular_velocity);
    }
    text.push_back('\n');
  }
  file_.write(std::string_view(text.data(), text.size()));
}

}  // namespace clca::exports
