#pragma once
// The trajectory of a run: where everything was, frame by frame.
//
// A folder `trajectory/` of parts, each a whole HDF5 file that never changes, and `trajectory.h5`
// beside it, which shows all of them as one. Parts come one after the other while the run goes on,
// so that any reader may look at any time. docs/trajectory.md has the layout.

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "clca/contact/force.hpp"
#include "clca/fields/fields.hpp"
#include "clca/grains/state.hpp"
#include "clca/scene/scene.hpp"
#include "clca/store/output_folder.hpp"

namespace clca::store {

/// What a frame of the contact model has beside the state of the grains; empty of the automaton.
struct ContactFrame {
  std::vector<Eigen::Vector2d> velocities = {};  ///< by id, lattice spacings a step
  std::vector<contact::Force> forces = {};       ///< with scene::TrajectoryOutput::contacts

  bool operator==(const ContactFrame&) const = default;
};

/// Writes the trajectory of a run. Not for several threads at once.
class TrajectoryWriter {
 public:
  /// What the run so far has written: goes into its checkpoint.
  struct Written {
    std::uint64_t parts = 0;
    std::uint64_t frames = 0;

    static constexpr auto fields() {
      return std::make_tuple(fields::field("parts", &Written::parts),
                             fields::field("frames", &Written::frames));
    }
  };

  /// Keeps the first `kept.parts` parts of the run folder and removes later ones of clca's, so that
  /// a run goes on where its checkpoint was; a new run keeps none. Throws StoreError.
  TrajectoryWriter(const OutputFolder& run_folder, const scene::Scene& scene,
                   const grains::State& state, const Written& kept);
  ~TrajectoryWriter();
  TrajectoryWriter(const TrajectoryWriter&) = delete;
  TrajectoryWriter& operator=(const TrajectoryWriter&) = delete;

  /// Takes a frame of the stage `stage` (from 0) into memory; `stage_begins` in the first frame of
  /// a stage, where all origins are marked anew. Writes a part when enough has come together.
  /// Forces are those between grains that are present, or grains and what else they touch.
  void add(const grains::State& state, std::size_t stage, bool stage_begins,
           const ContactFrame& contact = {});
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
  /// Takes the list of parts now: of a run that goes on, open it again for later frames. Throws
  /// StoreError for a folder without a trajectory, for files that are not whole or not of this
  /// scene, and where a part or the state of a frame would need more than `most_bytes` of memory.
  Trajectory(const std::filesystem::path& run_folder, const scene::Scene& scene,
             grains::State fixed, double most_bytes);
  ~Trajectory();
  Trajectory(const Trajectory&) = delete;
  Trajectory& operator=(const Trajectory&) = delete;

  const std::vector<Frame>& frames() const;
  /// The state of a frame: step, particles that are present, with their last moves and origins,
  /// pushes, and of the walls whether they are present and where. All else is as in `fixed`: travel
  /// but for its offset, sources, outlets. Of particles that have left there is no more than that
  /// they are not present. An Automaton can be made of it. Fast when frames are asked for in order;
  /// not for several threads at once. Throws StoreError, also for what no run can have written.
  grains::State state(std::size_t frame) const;
  /// Velocities and forces of a frame; a velocity of 0 of grains that have left. Throws as state().
  ContactFrame contact_frame(std::size_t frame) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace clca::store
