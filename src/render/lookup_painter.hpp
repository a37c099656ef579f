#pragma once
// Draws by looking up, for every sample, who owns the sites around it. What a picture costs
// depends on its size alone, not on the number of particles.

#include <cstdint>
#include <span>
#include <vector>

#include "clca/automaton/occupancy.hpp"
#include "clca/render/image.hpp"
#include "render/gl.hpp"
#include "render/projection.hpp"
#include "render/site_texture.hpp"

namespace clca::render {

class LookupPainter {
 public:
  /// `largest_window`: columns and rows that one texture of sites may hold, 0 for what the driver
  /// allows.
  LookupPainter(const Gl& gl, const lattice::Lattice& lattice, int largest_window = 0);

  /// Walls, floor and side walls inside `clip`; particles too unless `colors` is empty. Walls at
  /// the sites `moving_walls` (up the columns) have a colour of their own. Leaves a scissor box
  /// behind.
  void draw(const Projection& projection, const lattice::Rectangle& clip,
            const automaton::Occupancy& occupancy, std::span<const Rgb> colors,
            std::span<const lattice::Site> moving_walls = {});

 private:
  void upload_colors(std::span<const Rgb> colors);
  void set_view(const Projection& projection, bool particles);
  void draw(const Projection& projection, const Tile& tile);
  GLint place(const char* name) const { return gl_->GetUniformLocation(program_, name); }

  const Gl* gl_;
  lattice::Lattice lattice_;
  int largest_window_;
  GLuint program_;
  GLuint vertex_array_;
  SiteTexture sites_;
  GLuint colors_;
  GLsizei color_rows_ = 0;
  std::vector<std::uint8_t> rgba_;
};

}  // namespace clca::render
