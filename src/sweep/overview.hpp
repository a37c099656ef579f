#pragma once
// The final pictures of a sweep side by side.

#include <filesystem>
#include <optional>
#include <vector>

#include "clca/render/image.hpp"
#include "clca/sweep/plan.hpp"
#include "sweep/tables.hpp"

namespace clca::sweep {

/// The runs shown, row by row.
struct Selection {
  std::vector<std::size_t> runs;
  int columns = 1;
};

/// A row per combination and a column per seed (the first ones). If nothing varies, the seeds fill
/// the rows; with one seed, the combinations.
Selection selection(const Plan& plan);

/// Reads the pictures from the run folders of the sweep in `folder`; missing ones are empty boxes.
/// None if the scenes request no pictures.
std::optional<render::Image> overview(const Plan& plan, const std::vector<Result>& results,
                                      const std::filesystem::path& folder);

}  // namespace clca::sweep
