#pragma once
// The trajectory of a run: where everything was, frame by frame.
//
// A folder `trajectory/` of parts, each a whole HDF5 file that never changes, and `trajectory.h5`
// beside it, which shows all of them as one. Parts come one after the other while the run goes on,
// so that any reader may look at any time. docs/trajectory.md has the layout.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "clca/automaton/state.hpp"
#include "clca/scene/scene.hpp"

namespace clca::store {

/// Writes the trajectory of a run. Not for several threads at once.
class TrajectoryWriter {
 public:
  /// What the run so far has written: goes into its checkpoint.
  struct Written {
    std::uint64_t parts = 0;
    std::uint64_t frames = 0;

    static constexpr auto fields();
  };

  /// Keeps the first `kept.parts` parts of the run folder and removes later ones, so that a run
  /// goes on where its checkpoint was; a new run keeps none. Throws StoreError.
  TrajectoryWriter(const std::filesystem::path& run_folder, const scene::Scene& scene,
                   const automaton::State& state, const Written& kept);
  ~TrajectoryWriter();
  TrajectoryWriter(const TrajectoryWriter&) = delete;
  TrajectoryWriter& operator=(const TrajectoryWriter&) = delete;

  /// Takes a frame of the stage `stage` (from 0) into memory; `stage_begins` in the first frame of
  /// a stage, where all origins are marked anew. Writes a part when enough has come together.
  void add(const automaton::State& state, std::size_t stage, bool stage_begins);
  /// Writes what is in memory, if anything, as a part, and the index anew.
  void flush();
  /// After flush().
  Written written() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Reads the trajectory of a run folder, also of one that is still written.
class Trajectory {
 public:
  struct Frame {
    std::uint64_t step = 0;
    std::size_t stage = 0;      ///< index into Scene::stages
    std::size_t particles = 0;  ///< present
  };

  /// `fixed`: a state of the scene as it begins (run::initial_state), for all that no run changes.
  /// Throws StoreError for a folder without a trajectory, for files that are not whole or not of
  /// this scene, and where a part would need more than `most_bytes` of memory.
  Trajectory(const std::filesystem::path& run_folder, automaton::State fixed, double most_bytes);
  ~Trajectory();
  Trajectory(const Trajectory&) = delete;
  Trajectory& operator=(const Trajectory&) = delete;

  const std::vector<Frame>& frames() const;
  /// The state of a frame as it was: particles with their last moves, origins, walls, pushes,
  /// sources and outlets apart, of which only what is needed to draw is kept. Particles that had
  /// left are there without being present. Fast when frames are asked for in order. Throws
  /// StoreError.
  automaton::State state(std::size_t frame) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace clca::store
