#pragma once
// The files of a trajectory in a run folder: its parts, and the index that shows them as one.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "clca/store/output_folder.hpp"
#include "store/trajectory_part.hpp"

namespace clca::store {

inline constexpr const char* kTrajectoryFolder = "trajectory";
inline constexpr const char* kTrajectoryIndex = "trajectory.h5";

/// `part-000012.h5`.
std::string part_name(std::uint64_t number);

/// The parts of a run folder, in order. Throws StoreError if there are none or one is missing in
/// between.
std::vector<std::filesystem::path> find_parts(const std::filesystem::path& run_folder);

/// Removes the parts written by clca from number `kept` on, last first; also the index if no part
/// is kept. Throws StoreError.
void remove_parts(const OutputFolder& run_folder, std::uint64_t kept);

/// Writes `trajectory.h5`: virtual datasets over parts with these extents, and a link to group
/// `scene` of the first part. At least one part. Throws StoreError.
void write_index(const OutputFolder& run_folder, const std::vector<Extents>& parts,
                 const Layout& layout);

}  // namespace clca::store
