#pragma once
// The owners of a part of the lattice as a texture, and the parts that a view is drawn in.

#include <span>
#include <vector>

#include "clca/automaton/occupancy.hpp"
#include "clca/lattice/region.hpp"
#include "render/gl.hpp"

namespace clca::render {

/// Sites of the box and its border, all bounds inclusive.
struct SiteWindow {
  int first_column = 0;
  int last_column = 0;
  int first_row = 0;
  int last_row = 0;

  int columns() const { return last_column - first_column + 1; }
  int rows() const { return last_row - first_row + 1; }
};

/// A part of the plane and the sites around it.
struct Tile {
  lattice::Rectangle area;
  SiteWindow sites;
};

/// Cuts `area` so that no side of a tile's window is longer than `largest`, at least 8.
std::vector<Tile> tiles(const lattice::Lattice& lattice, const lattice::Rectangle& area,
                        int largest);

/// Stands in the texture for a wall that moves; the code of no wall.
inline constexpr automaton::Owner kMovingWall = automaton::kBorder + 1;

/// Texel (row, column) of the window holds the owner. The lid of the box is free, and in a
/// periodic box the border columns repeat those at the other end.
class SiteTexture {
 public:
  SiteTexture(const Gl& gl, const lattice::Lattice& lattice);

  void upload(const automaton::Occupancy& occupancy, const SiteWindow& window);
  /// Sets the texels of these sites of the box (up the columns) to kMovingWall.
  void mark(std::span<const lattice::Site> sites, const SiteWindow& window);

 private:
  void upload_block(int column, int row, int columns, int rows, const automaton::Owner* owners);
  void repeat_seam(const automaton::Occupancy& occupancy, const SiteWindow& window);
  void mark_run(lattice::Site lowest, int length, const SiteWindow& window);
  void open_lid(const SiteWindow& window);

  const Gl* gl_;
  lattice::Lattice lattice_;
  GLint stride_;
  GLuint name_;
  int columns_ = 0;
  int rows_ = 0;
};

}  // namespace clca::render
