#include "render/polygon_painter.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "render/colors.hpp"

namespace clca::render {

namespace {

constexpr const char* kPolygonVertexSource = R"(
layout(location = 0) in ivec2 point;
layout(location = 1) in vec2 inward;
layout(location = 2) in float edge;
layout(location = 3) in ivec2 place;
layout(location = 4) in vec4 fill;
uniform vec4 clip_from_grid;
uniform vec2 clip_from_inward;
uniform float outline_strength;
flat out vec4 color;
void main() {
  // The sum is an exact integer, so bodies that share a corner agree on it to the last bit.
  vec2 grid = vec2(point + place);
  vec2 clip = grid * clip_from_grid.xy + clip_from_grid.zw + inward * clip_from_inward;
  gl_Position = vec4(clip, 0.0, 1.0);
  color = vec4(edge > 0.5 ? outline_color(fill.rgb, outline_strength) : fill.rgb, 1.0);
}
)";

constexpr const char* kPolygonFragmentSource = R"(
flat in vec4 color;
out vec4 result;
void main() { result = color; }
)";

const void* byte_offset(std::size_t bytes) {
  // NOLINTNEXTLINE(performance-no-int-to-ptr): OpenGL takes offsets into buffers as pointers
  return reinterpret_cast<const void*>(bytes);
}

/// The grid points on the canvas, relative to the anchor.
struct GridWindow {
  GridPoint low, high;

  explicit GridWindow(const Projection& projection) {
    const Eigen::Vector2d unit = position(GridPoint{1, 1});
    const Eigen::Vector2d corner = projection.corner_from_anchor();
    const Eigen::Vector2d size(projection.width / projection.scale,
                               projection.height / projection.scale);
    const auto bounded = [](double value) {
      return static_cast<int>(std::clamp(value, -1e9, 1e9));
    };
    low = {bounded(std::floor(corner.x() / unit.x())), bounded(std::floor(corner.y() / unit.y()))};
    high = {bounded(std::ceil((corner.x() + size.x()) / unit.x())),
            bounded(std::ceil((corner.y() + size.y()) / unit.y()))};
  }

  bool shows(GridPoint point, const Mesh& mesh) const {
    return point.u + mesh.high.u >= low.u && point.u + mesh.low.u <= high.u &&
           point.v + mesh.high.v >= low.v && point.v + mesh.low.v <= high.v;
  }
};

}  // namespace

PolygonPainter::PolygonPainter(const Gl& gl, const lattice::Lattice& lattice,
                               std::span<const grains::Kind> kinds)
    : gl_(&gl),
      lattice_(lattice),
      program_(gl.program({kOutlineColorSource, kPolygonVertexSource}, {kPolygonFragmentSource})) {
  for (const grains::Kind& kind : kinds) {
    models_.push_back(model(kind.shape));
  }
}

PolygonPainter::Model PolygonPainter::model(const lattice::Shape& shape) const {
  Model result;
  result.mesh = mesh(shape);
  result.outline = outlines(shape).front();
  result.vertex_array = gl_->vertex_array();
  gl_->BindVertexArray(result.vertex_array);
  const auto fill_buffer = [&](GLenum target, const auto& values) {
    gl_->BindBuffer(target, gl_->buffer());
    gl_->BufferData(target, static_cast<GLsizeiptr>(values.size() * sizeof(values[0])),
                    values.data(), GL_STATIC_DRAW);
  };
  fill_buffer(GL_ELEMENT_ARRAY_BUFFER, result.mesh.indices);
  fill_buffer(GL_ARRAY_BUFFER, result.mesh.vertices);
  constexpr GLsizei kVertexBytes = sizeof(MeshVertex);
  gl_->VertexAttribIPointer(0, 2, GL_INT, kVertexBytes, byte_offset(offsetof(MeshVertex, u)));
  gl_->VertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, kVertexBytes,
                           byte_offset(offsetof(MeshVertex, inward_x)));
  gl_->VertexAttribPointer(2, 1, GL_FLOAT, GL_FALSE, kVertexBytes,
                           byte_offset(offsetof(MeshVertex, edge)));
  result.instance_buffer = gl_->buffer();
  gl_->BindBuffer(GL_ARRAY_BUFFER, result.instance_buffer);
  constexpr GLsizei kInstanceBytes = sizeof(Instance);
  gl_->VertexAttribIPointer(3, 2, GL_INT, kInstanceBytes, byte_offset(offsetof(Instance, u)));
  gl_->VertexAttribPointer(4, 4, GL_UNSIGNED_BYTE, GL_TRUE, kInstanceBytes,
                           byte_offset(offsetof(Instance, red)));
  for (GLuint attribute = 0; attribute <= 4; ++attribute) {
    gl_->EnableVertexAttribArray(attribute);
    gl_->VertexAttribDivisor(attribute, attribute >= 3 ? 1 : 0);
  }
  return result;
}

bool PolygonPainter::need_at_most(std::size_t triangles, const Projection& projection,
                                  const grains::State& state) const {
  // With more particles than that there is no need to test each.
  if (state.particles.size() > triangles) {
    return false;
  }
  std::size_t indices = 0;
  for (const grains::Particle& particle : state.particles) {
    indices += particle.present ? index_count(models_[particle.kind].mesh, projection) : 0;
  }
  return indices <= 3 * triangles;
}

PolygonPainter::Instances PolygonPainter::instances(const Projection& projection,
                                                    const grains::State& state,
                                                    const grains::Occupancy& occupancy,
                                                    const Coloring& coloring) const {
  Instances result(models_.size());
  const GridWindow window(projection);
  const GridPoint anchor = grid_point(projection.anchor);
  const int columns = lattice_.columns();
  // Overlapping particles of a kind: the lower id lies on top, as in the lookup.
  const bool downwards = grains::may_overlap(state);
  const std::size_t count = state.particles.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t id = downwards ? count - 1 - i : i;
    const grains::Particle& particle = state.particles[id];
    if (!particle.present) {
      continue;
    }
    const Mesh& mesh = models_[particle.kind].mesh;
    const GridPoint home = grid_point({lattice_.wrapped(particle.column), particle.row});
    // At a periodic boundary a particle appears at both sides.
    const int first = lattice_.periodic() && home.u + mesh.high.u >= 2 * columns ? -1 : 0;
    const int last = lattice_.periodic() && home.u + mesh.low.u < -1 ? 1 : 0;
    for (int image = first; image <= last; ++image) {
      const GridPoint point = {home.u + 2 * columns * image - anchor.u, home.v - anchor.v};
      if (window.shows(point, mesh)) {
        const Rgb fill = color(coloring, state, occupancy, id);
        result[particle.kind].push_back({point.u, point.v, fill.red, fill.green, fill.blue, 255});
      }
    }
  }
  return result;
}

std::size_t PolygonPainter::index_count(const Mesh& mesh, const Projection& projection) {
  return projection.outline_strength > 0 ? mesh.indices.size() : mesh.fill_indices;
}

void PolygonPainter::draw(const Model& model, std::size_t index_count,
                          std::span<const Instance> instances) const {
  if (instances.empty()) {
    return;
  }
  gl_->BindVertexArray(model.vertex_array);
  gl_->BindBuffer(GL_ARRAY_BUFFER, model.instance_buffer);
  gl_->BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(instances.size_bytes()),
                  instances.data(), GL_STREAM_DRAW);
  gl_->DrawElementsInstanced(GL_TRIANGLES, static_cast<GLsizei>(index_count), GL_UNSIGNED_INT,
                             nullptr, static_cast<GLsizei>(instances.size()));
}

void PolygonPainter::draw(const Projection& projection, const Instances& instances) const {
  gl_->UseProgram(program_);
  const auto clip = projection.clip_from_grid();
  gl_->Uniform4f(uniform("clip_from_grid"), static_cast<float>(clip[0]),
                 static_cast<float>(clip[1]), static_cast<float>(clip[2]),
                 static_cast<float>(clip[3]));
  const double inset = 2 * projection.outline_width * projection.scale;
  gl_->Uniform2f(uniform("clip_from_inward"), static_cast<float>(inset / projection.width),
                 static_cast<float>(inset / projection.height));
  gl_->Uniform1f(uniform("outline_strength"), static_cast<float>(projection.outline_strength));
  for (std::size_t kind = 0; kind < models_.size(); ++kind) {
    draw(models_[kind], index_count(models_[kind].mesh, projection), instances[kind]);
  }
  gl_->check("drawing polygons");
}

void PolygonPainter::draw(Graphics& graphics, const Projection& projection, const PanelScale& panel,
                          const Instances& instances) const {
  const GridPoint anchor = grid_point(projection.anchor);
  const double line = projection.outline_width * panel.scale;
  std::vector<Eigen::Vector2d> corners;
  for (std::size_t kind = 0; kind < models_.size(); ++kind) {
    for (const Instance& body : instances[kind]) {
      corners.clear();
      for (const GridPoint corner : models_[kind].outline) {
        corners.push_back(panel.pixel(
            position(GridPoint{anchor.u + body.u + corner.u, anchor.v + body.v + corner.v})));
      }
      const Rgb fill = {body.red, body.green, body.blue};
      graphics.fill_polygon(corners, fill, line, outline_color(fill, projection.outline_strength));
    }
  }
}

}  // namespace clca::render
