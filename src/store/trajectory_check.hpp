#pragma once
// Rejects trajectory data that no run can have written.

#include <filesystem>
#include <string>

#include "clca/grains/state.hpp"
#include "store/trajectory_part.hpp"
#include "store/trajectory_tables.hpp"

namespace clca::store {

/// Known before a part is read.
struct PartContext {
  std::filesystem::path path;
  Extents before;                ///< of the parts before
  std::uint64_t step = 0;        ///< of the last frame before
  std::uint32_t stage = 0;       ///< likewise
  std::uint32_t entered = 0;     ///< likewise
  std::size_t stages = 0;        ///< of the scene
  std::size_t most_entered = 0;  ///< particles whose state fits into memory
};

/// Throws StoreError: `cannot read FILE: frame of step STEP: REASON`, as all of these functions do.
[[noreturn]] void refuse_frame(const PartContext& context, std::uint64_t step,
                               const std::string& reason);
/// `read`: scene group of the part; `scene`: the expected one.
void check_scene(const std::filesystem::path& path, const SceneTables& scene,
                 const SceneTables& read);
void check_frames(const PartContext& context, const PartFrames& frames, const Layout& layout);
/// Call after check_frames.
void check_origins(const PartContext& context, const PartFrames& frames, const PartOrigins& origins,
                   const lattice::Lattice& lattice);
/// Call after check_frames. `fixed`: a state of the scene.
void check_rows(const PartContext& context, const PartFrames& frames, const PartRows& rows,
                const grains::State& fixed, const Layout& layout);
/// Checks that particles, walls and pushes of a frame are consistent, so that an Automaton can use
/// them.
void check_state(const PartContext& context, const grains::State& state);

}  // namespace clca::store
