#pragma once
// The trajectory of a run: the state of the grains frame by frame.
// A folder `trajectory/` of parts, each a complete HDF5 file that never changes, and an index
// `trajectory.h5` that shows them as one.
// Parts are added during the run, so it can be read at any time. See docs/trajectory.md.

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "clca/contact/force.hpp"
#include "clca/grains/state.hpp"
#include "clca/reflection/reflection.hpp"
#include "clca/scene/scene.hpp"
#include "clca/store/output_folder.hpp"

namespace clca::store {

/// Additional data of a contact model frame; empty for the automaton.
struct ContactFrame {
  std::vector<Eigen::Vector2d> velocities = {};  ///< by id, lattice spacings a step
  /// By id, lattice spacings a step: see contact::Velocity. NaN if read from a file of an earlier
  /// version, which has none.
  std::vector<double> spins = {};
  std::vector<contact::Force> forces = {};  ///< with TrajectoryOutput::has_contacts

  bool operator==(const ContactFrame&) const = default;
};

/// The datasets of a trajectory as a table in Markdown: dataset, rows, type, unit, what.
std::string datasets_markdown_table();

/// A dataset of docs/trajectory.md, in memory.
struct Dataset {
  std::string path;
  std::size_t numbers_per_row = 1;  ///< numbers in a row
  std::variant<std::vector<std::uint8_t>, std::vector<std::uint16_t>, std::vector<std::uint32_t>,
               std::vector<std::uint64_t>, std::vector<std::int32_t>, std::vector<double>,
               std::vector<std::string>>
      values;
};

/// The datasets of a trajectory with this frame alone, with contacts; without `scene/name` and
/// `scene/units`.
std::vector<Dataset> datasets(const scene::Scene& scene, const grains::State& state,
                              std::size_t stage, const ContactFrame& contact);

/// Writes the trajectory of a run. Not for several threads at once. Copies share what they write.
class TrajectoryWriter {
 public:
  /// What has been written so far; part of the checkpoint.
  struct Written {
    std::uint64_t parts = 0;
    std::uint64_t frames = 0;

    CLCA_FIELDS(parts, frames);
  };

  /// Keeps the first `kept.parts` parts in the run folder and removes later ones written by clca,
  /// so that a run resumes at its checkpoint. Throws StoreError.
  TrajectoryWriter(const OutputFolder& run_folder, const scene::Scene& scene,
                   const grains::State& state, const Written& kept);
  /// Most bytes of memory for so many particles.
  static double bytes_for(const scene::Scene& scene, double particles);

  /// Adds a frame of the stage `stage` (from 0) in memory; writes a part when enough has
  /// accumulated.
  /// `stage_begins`: first frame of a stage, where all origins are marked anew. Forces are between
  /// present grains, or grains and other bodies.
  void add_frame(const grains::State& state, std::size_t stage, bool stage_begins,
                 const ContactFrame& contact = {});
  void flush();             ///< writes the frames in memory as a part, and the index
  Written written() const;  ///< after flush()

 private:
  class Impl;
  std::shared_ptr<Impl> impl_;
};

/// Reads the trajectory of a run folder, also during the run. Copies share what they hold.
class Trajectory {
 public:
  struct Frame {
    std::uint64_t step = 0;
    std::size_t stage = 0;      ///< index into Scene::stages
    std::size_t particles = 0;  ///< present
  };

  /// `fixed`: the initial state of the scene (model::initial_state), for everything that a run does
  /// not change. Reads the list of parts once; open again for later frames.
  /// Throws StoreError if there is no trajectory, if files are missing, incomplete or of another
  /// scene, or if a part or a state needs more than `max_bytes` of memory.
  Trajectory(const std::filesystem::path& run_folder, const scene::Scene& scene,
             grains::State fixed, double max_bytes);

  const std::vector<Frame>& frames() const;
  /// The state of a frame: step, present particles with last moves and origins, pushes, presence
  /// and offset of walls; all else as in `fixed`. Removed particles are only marked as not present.
  /// An Automaton can be made of it. Fast for frames in order; not thread-safe. Throws StoreError,
  /// also for data that no run can have written.
  grains::State state(std::size_t frame) const;
  /// Velocities, spins and forces of a frame; 0 for removed grains. Throws as state().
  ContactFrame contact_frame(std::size_t frame) const;

 private:
  class Impl;
  std::shared_ptr<Impl> impl_;
};

/// Throws StoreError unless all parts of a trajectory are there and have their checksums.
void check_trajectory_parts(const std::filesystem::path& run_folder);

/// Keeps the HDF5 library from writing the rest of failed files at the end of the process, where it
/// would crash. For a program that owns its process, before it uses the library.
void disable_hdf5_exit();

}  // namespace clca::store
