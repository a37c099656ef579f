#pragma once
// The final pictures of a sweep side by side.

#include <optional>
#include <string>
#include <vector>

#include "clca/render/image.hpp"
#include "clca/sweep/plan.hpp"
#include "sweep/folder.hpp"
#include "sweep/result.hpp"

namespace clca::sweep {

/// Which runs are shown, by rows.
struct Selection {
  std::vector<std::size_t> runs;
  int columns = 1;
};

/// A row for each combination and a column for each of the first seeds; when nothing varies the
/// seeds fill the rows.
Selection selection(const Plan& plan);

/// Reads the pictures back from the run folders; an empty box stands for a run without. Nothing if
/// the scenes ask for no pictures.
std::optional<render::Image> overview(const Plan& plan, const std::vector<Result>& results,
                                      const Folder& folder);

}  // namespace clca::sweep
