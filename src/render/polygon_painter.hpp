#pragma once
// Draws each particle as an instance of the mesh of its kind.

#include <cstdint>
#include <span>
#include <vector>

#include "clca/grains/state.hpp"
#include "clca/render/body.hpp"
#include "clca/render/coloring.hpp"
#include "render/gl.hpp"
#include "render/graphics.hpp"
#include "render/projection.hpp"

namespace clca::render {

/// A point of the body, or one moved inwards by the outline's width times `inward`.
struct MeshVertex {
  std::int32_t u = 0;  ///< as GridPoint, from the reference site
  std::int32_t v = 0;
  float inward_x = 0;  ///< lattice spacings in the plane
  float inward_y = 0;
  float edge = 0;  ///< 1 in the colour of the outline
};

struct Mesh {
  std::vector<MeshVertex> vertices;
  std::vector<std::uint32_t> indices;  ///< of triangles; first those of the fill
  std::size_t fill_indices = 0;
  GridPoint low, high;  ///< smallest box around the body
};

Mesh mesh(const lattice::Shape& shape);

class PolygonPainter {
 public:
  PolygonPainter(const Gl& gl, const lattice::Lattice& lattice,
                 std::span<const grains::Kind> kinds);

  /// A particle in view.
  struct Instance {
    std::int32_t u = 0;  ///< of the reference site from the anchor, as GridPoint
    std::int32_t v = 0;
    std::uint8_t red = 0, green = 0, blue = 0, alpha = 255;
  };
  using Instances = std::vector<std::vector<Instance>>;  ///< by kind

  /// Whether drawing all particles takes at most this many triangles. Returns early if not.
  bool need_at_most(std::size_t triangles, const Projection& projection,
                    const grains::State& state) const;
  /// Does not call OpenGL.
  Instances instances(const Projection& projection, const grains::State& state,
                      const grains::Occupancy& occupancy, const Coloring& coloring) const;
  void draw(const Projection& projection, const Instances& instances) const;
  /// The same as vector graphics.
  void draw(Graphics& graphics, const Projection& projection, const PanelScale& panel,
            const Instances& instances) const;

 private:
  struct Model {
    Mesh mesh;
    Outline outline;
    GLuint vertex_array = 0;
    GLuint instance_buffer = 0;
  };

  Model model(const lattice::Shape& shape) const;
  static std::size_t index_count(const Mesh& mesh, const Projection& projection);
  void draw(const Model& model, std::size_t index_count, std::span<const Instance> instances) const;
  GLint uniform(const char* name) const { return gl_->GetUniformLocation(program_, name); }

  const Gl* gl_;
  lattice::Lattice lattice_;
  GLuint program_;
  std::vector<Model> models_;
};

}  // namespace clca::render
