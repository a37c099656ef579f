#pragma once
// The index of a trajectory: all its parts as one.

#include <cstdint>
#include <filesystem>
#include <vector>

#include "clca/store/output_folder.hpp"
#include "store/trajectory_part.hpp"

namespace clca::store {

/// Writes `trajectory.h5`: virtual datasets over parts with these extents, and a link to group
/// `scene` of the first part. At least one part. Throws StoreError.
void write_index(const OutputFolder& run_folder, const std::vector<Extents>& parts,
                 const Layout& layout);

}  // namespace clca::store
