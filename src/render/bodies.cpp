#include "render/bodies.hpp"

#include <algorithm>

#include "render/colors.hpp"

namespace clca::render {

std::vector<Body> bodies_in_view(const Projection& projection, const grains::State& state,
                                 const grains::Occupancy& occupancy, const Coloring& coloring) {
  const lattice::Rectangle view = projection.view();
  const double width = state.lattice.size().x();
  std::vector<Body> bodies;
  for (std::size_t id = state.particles.size(); id-- > 0;) {
    const grains::Particle& particle = state.particles[id];
    if (!particle.present) {
      continue;
    }
    const lattice::Site home = {state.lattice.wrapped(particle.column), particle.row};
    const Eigen::Vector2d at = lattice::position(home);
    const double reach = state.shape(particle).diameter() + 1;
    // At a periodic boundary a particle appears at both sides.
    const int images = state.lattice.periodic() ? 1 : 0;
    for (int image = -images; image <= images; ++image) {
      const double x = at.x() + image * width;
      const bool in_box = images == 0 || (x + reach > -1 && x - reach < width);
      if (in_box && x + reach > view.left && x - reach < view.right &&
          at.y() + reach > view.bottom && at.y() - reach < view.top) {
        GridPoint place = grid_point(home);
        place.u += 2 * state.lattice.columns() * image;
        bodies.push_back({particle.kind, place, color(coloring, state, occupancy, id)});
      }
    }
  }
  return bodies;
}

void draw(Graphics& graphics, std::span<const Body> bodies, std::span<const Outline> outlines,
          const Projection& projection, const PanelScale& panel) {
  std::vector<Eigen::Vector2d> corners;
  for (const Body& body : bodies) {
    corners.clear();
    for (const GridPoint corner : outlines[body.kind]) {
      corners.push_back(
          panel.pixel(position(GridPoint{body.place.u + corner.u, body.place.v + corner.v})));
    }
    graphics.fill_polygon(corners, body.fill, projection.outline_width * panel.scale,
                          outline_color(body.fill, projection.outline_strength));
  }
}

}  // namespace clca::render
