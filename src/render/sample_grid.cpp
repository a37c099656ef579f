#include "render/sample_grid.hpp"

#include <utility>

#include "render/colors.hpp"

namespace clca::render {

std::shared_ptr<SampleGrid> GridPool::take() {
  std::unique_ptr<SampleGrid> grid;
  {
    const std::lock_guard lock(shared_->mutex);
    if (!shared_->grids.empty()) {
      grid = std::move(shared_->grids.back());
      shared_->grids.pop_back();
    }
  }
  if (!grid) {
    grid = std::make_unique<SampleGrid>(shared_->width, shared_->height);
  }
  return {grid.release(), [spare = shared_](SampleGrid* used) {
            std::unique_ptr<SampleGrid> back(used);
            const std::lock_guard lock(spare->mutex);
            spare->grids.push_back(std::move(back));
          }};
}

std::vector<Rgb> colors_by_code(std::span<const Rgb> palette, double outline_strength) {
  std::vector<Rgb> colors = {kPaper, kWallColor, kMovingWallColor};
  for (const Rgb fill : palette) {
    colors.push_back(fill);
    colors.push_back(outline_color(fill, outline_strength));
  }
  return colors;
}

}  // namespace clca::render
