#pragma once
// Pictures, tables and trajectory of a run.

#include <optional>
#include <set>

#include "clca/run/run.hpp"
#include "clca/scene/scene.hpp"
#include "clca/store/growing_file.hpp"
#include "clca/store/run_folder.hpp"
#include "clca/store/trajectory.hpp"
#include "run/model.hpp"
#include "run/pictures.hpp"
#include "run/probe_table.hpp"
#include "run/records.hpp"
#include "run/series.hpp"
#include "run/stage_measures.hpp"

namespace clca::run {

/// How much the run has written; part of a checkpoint.
struct OutputHistory {
  std::uint64_t series_bytes = 0;
  std::uint64_t cycles_bytes = 0;
  std::uint64_t fields_bytes = 0;
  std::uint64_t probes_bytes = 0;
  std::optional<std::uint64_t> series_step = {};  ///< of the last row
  std::optional<measure::Snapshot> probes = {};   ///< at the last row
  PictureHistory pictures = {};
  store::TrajectoryWriter::Written trajectory = {};
  std::optional<std::uint64_t> trajectory_step = {};  ///< of the last frame
  WantedPictures wanted_pictures = WantedPictures::all;

  static constexpr auto fields() {
    using reflection::field;
    return std::make_tuple(field("series_bytes", &OutputHistory::series_bytes),
                           field("cycles_bytes", &OutputHistory::cycles_bytes),
                           field("fields_bytes", &OutputHistory::fields_bytes),
                           field("probes_bytes", &OutputHistory::probes_bytes),
                           field("series_step", &OutputHistory::series_step),
                           field("probes", &OutputHistory::probes),
                           field("pictures", &OutputHistory::pictures),
                           field("trajectory", &OutputHistory::trajectory),
                           field("trajectory_step", &OutputHistory::trajectory_step),
                           field("wanted_pictures", &OutputHistory::wanted_pictures));
  }
};

class Outputs {
 public:
  /// Checks that the pictures can be drawn. Touches no file. Throws SceneRunError.
  Outputs(const scene::Scene& scene, const grains::State& state, const RunOptions& options);
  /// File names of the tables and trajectory that the scene may produce.
  std::vector<std::string> file_names() const;
  /// Those of them that it will write for certain.
  std::set<std::string> planned_names() const;

  /// Whether pictures are drawn.
  bool has_pictures() const { return pictures_.has_value(); }

  /// Starts writing to `folder`, which must outlive this object. `state`: of the run.
  void open(const store::RunFolder& folder, const grains::State& state);
  /// The same for a resumed run: removes what was written after `history`.
  void reopen(const store::RunFolder& folder, const grains::State& state,
              const OutputHistory& history);
  void begin_stage(const scene::Stage& stage, const Model& model, const Records& records);
  void after_step(const scene::Stage& stage, const Model& model, Records& records,
                  std::uint64_t steps_in_stage, std::size_t moving);
  /// Writes the last picture of the stage, its tables, and those of the run so far.
  void end_stage(const scene::Stage& stage, const Model& model, Records& records,
                 std::size_t moving, const StageHistory& history);
  /// Writes all pending output and returns how much has been written.
  OutputHistory flush(Records& records);
  /// Waits until everything is written.
  void finish();

 private:
  /// A table written row by row.
  struct GrowingTable {
    store::GrowingFile file;

    /// Writes pending rows if they have at least `least` bytes.
    void take(store::Table& table, std::size_t least);
  };

  void write_tables(const scene::Stage& stage, const Model& model, const Records& records,
                    const StageHistory& history);
  void write_rows(Records& records, std::size_t least);
  void add_to_trajectory(const scene::Stage& stage, const Model& model, const Records& records,
                         bool begins);
  /// Rows of series.csv and probes.csv.
  void add_rows(const scene::Stage& stage, const Model& model, const Records& records,
                std::size_t moving, bool always);
  bool requests(scene::Measure measure) const;

  const scene::Scene& scene_;
  WantedPictures wanted_pictures_;
  const store::RunFolder* folder_ = nullptr;
  std::optional<Pictures> pictures_;
  std::optional<SeriesTable> series_;
  std::optional<ProbeTable> probes_;
  std::optional<store::TrajectoryWriter> trajectory_;
  std::optional<std::uint64_t> trajectory_step_;
  std::optional<GrowingTable> series_file_;
  std::optional<GrowingTable> cycles_file_;
  std::optional<GrowingTable> fields_file_;
  std::optional<GrowingTable> probes_file_;
};

}  // namespace clca::run
