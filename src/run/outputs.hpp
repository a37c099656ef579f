#pragma once
// Everything that a run writes besides its scene, summary and checkpoints: pictures, tables, the
// trajectory.

#include <optional>

#include "clca/run/run.hpp"
#include "clca/scene/scene.hpp"
#include "clca/store/growing_file.hpp"
#include "clca/store/run_folder.hpp"
#include "clca/store/trajectory.hpp"
#include "run/model.hpp"
#include "run/pictures.hpp"
#include "run/records.hpp"
#include "run/series.hpp"
#include "run/stage_measures.hpp"

namespace clca::run {

/// How far what a run writes step by step has come.
struct OutputHistory {
  std::uint64_t series_bytes = 0;
  std::uint64_t cycles_bytes = 0;
  std::uint64_t fields_bytes = 0;
  std::optional<std::uint64_t> series_step = {};  ///< of the last row
  PictureHistory pictures = {};
  store::TrajectoryWriter::Written trajectory = {};
  std::optional<std::uint64_t> trajectory_step = {};  ///< of the last frame
  bool last_picture_only = false;

  static constexpr auto fields() {
    using fields::field;
    return std::make_tuple(field("series_bytes", &OutputHistory::series_bytes),
                           field("cycles_bytes", &OutputHistory::cycles_bytes),
                           field("fields_bytes", &OutputHistory::fields_bytes),
                           field("series_step", &OutputHistory::series_step),
                           field("pictures", &OutputHistory::pictures),
                           field("trajectory", &OutputHistory::trajectory),
                           field("trajectory_step", &OutputHistory::trajectory_step),
                           field("last_picture_only", &OutputHistory::last_picture_only));
  }
};

class Outputs {
 public:
  /// Finds out whether the pictures can be drawn; touches no file. Throws ScenePlaceError.
  Outputs(const scene::Scene& scene, const grains::State& state, const RunOptions& options);
  /// Names of the tables and of the trajectory that the scene may ask for.
  std::vector<std::string> file_names() const;

  /// From here on files go to `folder`, which must outlive this object; `state` is one of the run.
  void open(const store::RunFolder& folder, const grains::State& state);
  /// The same for a run that goes on: what came after `history` is removed.
  void reopen(const store::RunFolder& folder, const grains::State& state,
              const OutputHistory& history);
  void begin_stage(const scene::Stage& stage, const Model& model, const Records& records);
  void after_step(const scene::Stage& stage, const Model& model, Records& records,
                  std::uint64_t steps_in_stage, std::size_t moving);
  /// The last picture of the stage, its tables, and those of the run so far.
  void end_stage(const scene::Stage& stage, const Model& model, Records& records,
                 std::size_t moving, const StageHistory& history);
  /// Writes all that is waiting and tells how far it has come.
  OutputHistory settle(Records& records);
  /// Has the tables that grow on the disk. May be called from another thread than the rest.
  void sync() const;
  /// Waits until all is written.
  void finish();

 private:
  /// A table that grows row by row.
  struct Growing {
    store::GrowingFile file;

    /// Writes the rows that have come, when there are `least` bytes of them.
    void take(store::Table& table, std::size_t least);
  };

  void write_tables(const scene::Stage& stage, const Model& model, const Records& records,
                    const StageHistory& history);
  void write_rows(Records& records, std::size_t least);
  void add_to_trajectory(const scene::Stage& stage, const Model& model, const Records& records,
                         bool begins);
  bool wants(scene::Measure measure) const;

  const scene::Scene& scene_;
  bool last_picture_only_;
  const store::RunFolder* folder_ = nullptr;
  std::optional<Pictures> pictures_;
  std::optional<SeriesTable> series_;
  std::optional<store::TrajectoryWriter> trajectory_;
  std::optional<std::uint64_t> trajectory_step_;
  std::optional<Growing> series_file_;
  std::optional<Growing> cycles_file_;
  std::optional<Growing> fields_file_;
};

}  // namespace clca::run
