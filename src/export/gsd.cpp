#include <fmt/format.h>

#include <algorithm>

#include "export/formats.hpp"

namespace clca::exports {

namespace {

/// In the order of chunk_names(), in which a frame is written.
enum class Chunk : std::uint16_t {
  step,
  count,
  position,
  type_id,
  velocity,
  image,
  id,
  displacement,
  force,
  dimensions,
  box,
  types,
  type_shapes,
  angular_velocity  // of the contact model only
};

std::vector<std::string> chunk_names(bool is_contact) {
  std::vector<std::string> names = {"configuration/step",   "particles/N",
                                    "particles/position",   "particles/typeid",
                                    "particles/velocity",   "particles/image",
                                    "log/particles/id",     "log/particles/displacement",
                                    "log/particles/force",  "configuration/dimensions",
                                    "configuration/box",    "particles/types",
                                    "particles/type_shapes"};
  if (is_contact) {
    names.emplace_back("log/particles/angular_velocity");
  }
  return names;
}

GsdChunk chunk(Chunk name, GsdType type, std::uint64_t rows, std::uint32_t columns = 1) {
  return {static_cast<std::uint16_t>(name), type, rows, columns};
}

/// Texts as rows of equal length, padded with zeros.
void write_texts(GsdFile& file, Chunk name, const std::vector<std::string>& texts) {
  std::size_t length = 0;
  for (const std::string& text : texts) {
    length = std::max(length, text.size() + 1);
  }
  Bytes bytes(texts.size() * length);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    std::copy(texts[i].begin(), texts[i].end(),
              bytes.begin() + static_cast<std::ptrdiff_t>(i * length));
  }
  file.write(chunk(name, GsdType::int8, texts.size(), static_cast<std::uint32_t>(length)), bytes);
}

std::string shape_json(const std::vector<Eigen::Vector2d>& outline) {
  std::string corners;
  for (const Eigen::Vector2d& corner : outline) {
    corners += fmt::format("{}[{:.7g},{:.7g}]", corners.empty() ? "" : ",", corner.x(), corner.y());
  }
  return fmt::format(R"({{"type":"Polygon","rounding_radius":0,"vertices":[{}]}})", corners);
}

/// A column of the particles: `append_to(bytes, body)` for each.
template <class Append>
Bytes column(const std::vector<Body>& all, Append append_to) {
  Bytes bytes;
  for (const Body& body : all) {
    append_to(bytes, body);
  }
  return bytes;
}

}  // namespace

GsdWriter::GsdWriter(const store::OutputFile& file, const scene::Scene& scene,
                     const std::vector<grains::Kind>& kinds)
    : file_(file.create(), chunk_names(scene.model == scene::Model::contact)),
      units_(scene::conversion(scene)),
      kinds_(kind_appearances(scene, kinds)) {}

void GsdWriter::add(const grains::State& state, const store::ContactFrame& contact) {
  const std::vector<Body> all = bodies(state, contact, units_);
  file_.write(chunk(Chunk::step, GsdType::uint64, 1), bytes_of(state.step));
  file_.write(chunk(Chunk::count, GsdType::uint32, 1),
              bytes_of(static_cast<std::uint32_t>(all.size())));
  add_particles(state.lattice, all);
  if (first_) {
    add_fixed(state.lattice);
    first_ = false;
  }
  if (units_) {
    file_.write(chunk(Chunk::angular_velocity, GsdType::float32, all.size()),
                column(all, [](Bytes& to, const Body& body) {
                  append(to, static_cast<float>(body.angular_velocity));
                }));
  }
  file_.end_frame();
}

void GsdWriter::add_particles(const lattice::Lattice& lattice, const std::vector<Body>& all) {
  const Eigen::Vector2d middle = lattice::Lattice::corner() + lattice.size() / 2;
  const std::size_t count = all.size();
  file_.write(chunk(Chunk::position, GsdType::float32, count, 3),
              column(all, [&](Bytes& to, const Body& body) {
                append_vector(to, body.centre.x() - middle.x(), body.centre.y() - middle.y());
              }));
  file_.write(
      chunk(Chunk::type_id, GsdType::uint32, count),
      column(all, [](Bytes& to, const Body& body) { append(to, std::uint32_t{body.kind}); }));
  file_.write(chunk(Chunk::velocity, GsdType::float32, count, 3),
              column(all, [](Bytes& to, const Body& body) {
                append_vector(to, body.velocity.x(), body.velocity.y());
              }));
  if (lattice.periodic()) {
    file_.write(chunk(Chunk::image, GsdType::int32, count, 3),
                column(all, [](Bytes& to, const Body& body) {
                  append(to, std::int32_t{body.image});
                  append(to, std::int32_t{0});
                  append(to, std::int32_t{0});
                }));
  }
  file_.write(chunk(Chunk::id, GsdType::uint32, count),
              column(all, [](Bytes& to, const Body& body) { append(to, body.id); }));
  file_.write(chunk(Chunk::displacement, GsdType::float32, count, 3),
              column(all, [](Bytes& to, const Body& body) {
                append_vector(to, body.displacement.x(), body.displacement.y());
              }));
  file_.write(chunk(Chunk::force, GsdType::float32, count),
              column(all, [](Bytes& to, const Body& body) { append(to, body.force); }));
}

// One layer of height 1, so that readers can invert the box matrix.
void GsdWriter::add_fixed(const lattice::Lattice& lattice) {
  Bytes box;
  for (const double length : {lattice.size().x(), lattice.size().y(), 1.0, 0.0, 0.0, 0.0}) {
    append(box, static_cast<float>(length));
  }
  std::vector<std::string> names;
  std::vector<std::string> shapes;
  for (const KindAppearance& kind : kinds_) {
    names.push_back(kind.name);
    shapes.push_back(shape_json(kind.outline));
  }
  file_.write(chunk(Chunk::dimensions, GsdType::uint8, 1), bytes_of(std::uint8_t{2}));
  file_.write(chunk(Chunk::box, GsdType::float32, 6), box);
  write_texts(file_, Chunk::types, names);
  write_texts(file_, Chunk::type_shapes, shapes);
}

}  // namespace clca::exports
