#pragma once
// A part of a trajectory in memory: the datasets of docs/trajectory.md; the files of parts.

#include <array>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "clca/grains/state.hpp"
#include "clca/scene/scene.hpp"
#include "clca/store/trajectory.hpp"
#include "store/hdf5.hpp"

namespace clca::store {

inline constexpr FileKind kTrajectoryKind{.name = "trajectory", .version = 1};
inline constexpr const char* kTrajectoryFolder = "trajectory";

/// Throws StoreError: `cannot read PATH: REASON`.
[[noreturn]] void refuse_part(const std::filesystem::path& path, std::string_view reason);

/// `part-000012.h5`.
std::string part_name(std::uint64_t number);

/// The numbers of the parts in a folder; none if it does not exist.
std::set<std::uint64_t> part_numbers(const std::filesystem::path& folder);
/// The parts of a run folder, in order. Throws StoreError if there are none or one is missing in
/// between.
std::vector<std::filesystem::path> find_parts(const std::filesystem::path& run_folder);

/// Concatenated sets of sites.
struct SiteSets {
  std::vector<std::uint64_t> first_sites;  ///< by set: number of its first site
  std::vector<std::uint32_t> site_counts;  ///< by set
  std::vector<std::int32_t> sites;         ///< of all sets: two numbers each

  void begin_set();
  void add_site(int one, int other);
  bool operator==(const SiteSets&) const = default;
};

/// Group `scene` of each part: what is constant.
struct SceneTables {
  std::string name;
  std::string units;  ///< of all that is in the trajectory, in words
  std::vector<std::uint64_t> seed;
  std::vector<std::uint32_t> lattice;  ///< columns, rows, 1 if periodic
  std::vector<std::string> species;
  std::vector<std::string> stages;
  std::vector<std::uint16_t> kind_species;
  std::vector<double> kind_centre;  ///< x, y from the reference site
  SiteSets kind_sites;              ///< axial x, q from the reference site
  std::vector<std::string> walls;
  SiteSets wall_sites;  ///< column, row at home

  SceneTables() = default;
  SceneTables(const scene::Scene& scene, const grains::State& state);

  std::vector<Hdf5Dataset> datasets();  ///< this object must outlive the list
  /// Throws StoreError with the difference unless those read from `path` are of the same scene.
  void require_same(const SceneTables& read, const std::filesystem::path& path) const;
};

struct OptionalDatasets {
  std::size_t wall_count = 0;
  bool has_velocities = false;
  bool has_contacts = false;
};

OptionalDatasets optional_datasets(const scene::Scene& scene);

enum class RowKind : std::uint8_t { frames, particles, origins, pushes, contacts };
inline constexpr std::array kRowKindNames = {"frames", "particles", "origins", "pushes",
                                             "contacts"};
/// Kinds of which each frame has a range of rows.
inline constexpr std::array kKindsInFrames = {RowKind::particles, RowKind::origins, RowKind::pushes,
                                              RowKind::contacts};

template <class T>
class ByRowKind {
 public:
  T& operator[](RowKind row_kind) { return values_.at(static_cast<std::size_t>(row_kind)); }
  const T& operator[](RowKind row_kind) const {
    return values_.at(static_cast<std::size_t>(row_kind));
  }

 private:
  std::array<T, kRowKindNames.size()> values_ = {};
};

using RowCounts = ByRowKind<std::uint64_t>;
RowCounts& operator+=(RowCounts& row_counts, const RowCounts& more);

/// When a dataset is read.
enum class DatasetUse : std::uint8_t {
  index,   ///< with the list of frames
  rows,    ///< with the state of a frame
  derived  ///< never; for the convenience of other readers
};

/// A dataset with the meaning of its rows, and their shape (none: one number). The numbers of a row
/// are contiguous.
struct TrajectoryDataset : Hdf5Dataset {
  RowKind row_kind;
  DatasetUse use;
  std::vector<std::size_t> row_shape;
};

struct RowSpan {
  std::size_t first = 0;
  std::size_t end = 0;
};

/// Rows of each frame: first row, counted over all parts, and number of rows.
struct RowRanges {
  std::vector<std::uint64_t> first_rows;
  std::vector<std::uint32_t> row_counts;

  /// Ends a frame: the part has this many rows now, and the parts before it have `before`.
  void end_frame(std::uint64_t before, std::size_t rows);
  RowSpan rows_of(std::size_t frame) const;
};

/// One entry per frame.
struct PartFrames {
  std::vector<std::uint64_t> step;
  std::vector<std::uint32_t> stage;
  std::vector<std::uint32_t> entered_particles;  ///< particles so far, whether still present or not
  ByRowKind<RowRanges> row_ranges;  ///< of kKindsInFrames; that of RowKind::frames stays empty

  RowCounts total_rows() const;  ///< rows of the part, by the counts of its frames
};

/// Origins of particles new since the last frame; of all in the first frame of a stage.
struct PartOrigins {
  std::vector<std::uint32_t> id;
  std::vector<std::int32_t> site;  ///< column, row
};

struct PartRows {
  std::vector<std::uint32_t> id;
  std::vector<std::int32_t> site;  ///< column, row
  std::vector<std::uint16_t> kind;
  std::vector<std::uint8_t> last_move;
  std::vector<std::uint32_t> pushed;
  std::vector<std::int32_t> pusher;
  std::vector<std::uint32_t> push_source;
  std::vector<std::uint8_t> push_direction;
  std::vector<std::uint8_t> wall_present;  ///< frames x walls
  std::vector<std::int32_t> wall_offset;   ///< frames x walls, sites along the motion
  std::vector<double> velocity;            ///< x, y
  std::vector<double> spin;
  // Of contacts: see contact::Force.
  std::vector<std::uint32_t> contact_upper;
  std::vector<std::int32_t> contact_other;
  std::vector<double> contact_point;   ///< x, y
  std::vector<double> contact_normal;  ///< x, y
  std::vector<double> contact_branch;  ///< x, y
  std::vector<double> contact_force;   ///< along the normal, along the shear
  // Derived, for other readers.
  std::vector<std::uint16_t> species;
  std::vector<double> position;       ///< x, y of the centre of mass
  std::vector<double> wall_position;  ///< frames x (walls x 2): x, y from home
};

struct TrajectoryPart {
  PartFrames frames;
  PartOrigins origins;
  PartRows rows;

  /// Adds a frame. `before`: numbers of rows of the previous parts. Stores origins of the particles
  /// with ids from `first_origin` on.
  void add_frame(const grains::State& state, std::size_t stage, std::size_t first_origin,
                 const RowCounts& before, const ContactFrame& contact);
  /// This object must outlive the list. Earlier versions did not write what may be missing.
  std::vector<TrajectoryDataset> datasets(const OptionalDatasets& layout);
};

/// The frames and origins of a file. Throws StoreError unless it is of the scene of `tables`, and
/// has frames and the rows that they say.
TrajectoryPart read_index(const std::filesystem::path& path, const SceneTables& tables,
                          const OptionalDatasets& layout, double max_bytes);
/// The rows of these frames of a file. Throws StoreError, likewise.
PartRows read_rows(const std::filesystem::path& path, const PartFrames& frames,
                   const OptionalDatasets& layout, double max_bytes);

}  // namespace clca::store
