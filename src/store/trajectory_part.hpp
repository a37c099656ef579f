#pragma once
// A part of a trajectory in memory: the datasets of docs/trajectory.md.

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "clca/grains/state.hpp"
#include "clca/scene/scene.hpp"
#include "clca/store/trajectory.hpp"
#include "store/hdf5_file.hpp"

namespace clca::store {

inline constexpr FileKind kTrajectoryKind{.name = "trajectory", .version = 1};

/// Concatenated sets of sites.
struct SiteSets {
  std::vector<std::uint64_t> first;
  std::vector<std::uint32_t> size;
  std::vector<std::int32_t> sites;  ///< two numbers each

  void begin();
  void add(int one, int other);
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

  void write(const Hdf5Writer& file) const;
  /// All datasets except name and units. This object must outlive the list.
  std::vector<Hdf5Dataset> datasets();
  /// Throws StoreError with the difference unless those read from `path` are of the same scene.
  void require_same(const SceneTables& read, const std::filesystem::path& path) const;
};

/// Optional datasets of a trajectory.
struct Layout {
  std::size_t walls = 0;
  bool velocities = false;
  bool contacts = false;
};

Layout layout_of(const scene::Scene& scene);

/// What the rows of a dataset are.
enum class Axis : std::uint8_t { frames, particles, origins, pushes, contacts };
inline constexpr std::array kAxisNames = {"frames", "particles", "origins", "pushes", "contacts"};

/// Numbers of rows.
class Extents {
 public:
  std::uint64_t& operator[](Axis axis) { return rows_.at(static_cast<std::size_t>(axis)); }
  std::uint64_t operator[](Axis axis) const { return rows_.at(static_cast<std::size_t>(axis)); }
  Extents& operator+=(const Extents& other);

 private:
  std::array<std::uint64_t, kAxisNames.size()> rows_ = {};
};

/// When a dataset is read.
enum class Use : std::uint8_t {
  index,   ///< with the list of frames
  rows,    ///< with one of the frames
  derived  ///< never; for the convenience of other readers
};

/// A dataset: path, meaning of its rows and numbers, shape of a row (none: one number). The numbers
/// of a row are contiguous.
struct Column {
  const char* path;
  Axis axis;
  Use use;
  Meaning meaning;
  std::vector<std::size_t> row = {};
  bool may_be_missing = false;  ///< earlier versions did not write it

  /// Numbers per row.
  std::size_t width() const;
};

/// Rows of one frame within its part.
struct RowSpan {
  std::size_t first = 0;
  std::size_t end = 0;
};

/// Rows of each frame: first row, counted over all parts, and number of rows.
struct RowRanges {
  std::vector<std::uint64_t> first;
  std::vector<std::uint32_t> count;

  /// Ends a frame: the part has this many rows now, and the parts before it have `before`.
  void end_frame(std::uint64_t before, std::size_t rows);
  RowSpan rows_of(std::size_t frame) const;
};

/// One entry per frame.
struct PartFrames {
  std::vector<std::uint64_t> step;
  std::vector<std::uint32_t> stage;
  std::vector<std::uint32_t> entered;  ///< particles so far, whether still present or not
  RowRanges particles;
  RowRanges origins;
  RowRanges pushes;
  RowRanges contacts;

  /// As the counts have it.
  Extents extents() const;
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
  std::vector<std::uint8_t> move;
  std::vector<std::uint32_t> pushed;
  std::vector<std::int32_t> pusher;
  std::vector<std::uint32_t> push_source;
  std::vector<std::uint8_t> push_direction;
  std::vector<std::uint8_t> wall_present;  ///< frames x walls
  std::vector<std::int32_t> wall_offset;   ///< frames x walls, sites along the motion
  std::vector<double> velocity;            ///< x, y
  std::vector<double> spin;
  // Of contacts: see contact::Force.
  std::vector<std::uint32_t> upper;
  std::vector<std::int32_t> other;
  std::vector<double> point;   ///< x, y
  std::vector<double> normal;  ///< x, y
  std::vector<double> branch;  ///< x, y
  std::vector<double> force;   ///< along the normal, along the shear
};

struct PartDerived {
  std::vector<std::uint16_t> species;
  std::vector<double> position;       ///< x, y of the centre of mass
  std::vector<double> wall_position;  ///< frames x (walls x 2): x, y from home
};

struct TrajectoryPart {
  PartFrames frames;
  PartOrigins origins;
  PartRows rows;
  PartDerived derived;

  /// Adds a frame. `before`: extents of the previous parts. Stores origins of the particles with
  /// ids from `first_origin` on.
  void add(const grains::State& state, std::size_t stage, std::size_t first_origin,
           const Extents& before, const ContactFrame& contact);
  std::size_t bytes() const;
};

/// Calls visit(column, vector) for each dataset.
template <class Part, class Visit>
void for_each_column(Part& part, const Layout& layout, Visit visit) {
  const auto columns = [&visit](Axis axis, Use use) {
    return
        [&visit, axis, use](const char* path, const Meaning& meaning, auto& values,
                            const std::vector<std::size_t>& row = {}, bool may_be_missing = false) {
          visit(Column{path, axis, use, meaning, row, may_be_missing}, values);
        };
  };
  auto& frames = part.frames;
  auto& rows = part.rows;
  const auto of_frames = columns(Axis::frames, Use::index);
  of_frames("frames/step", {"steps", "of the whole run"}, frames.step);
  of_frames("frames/stage", {"", "which of `scene/stages`, from 0"}, frames.stage);
  of_frames("frames/entered", {"", "particles that had entered; ids are below this"},
            frames.entered);
  of_frames("frames/first", {"", "the first row of the frame in `particles`"},
            frames.particles.first);
  of_frames("frames/particles", {"", "rows of the frame in `particles`"}, frames.particles.count);
  of_frames("frames/first_origin", {"", "the first row of the frame in `origins`"},
            frames.origins.first);
  of_frames("frames/origins", {"", "rows of the frame in `origins`"}, frames.origins.count);
  of_frames("frames/first_push", {"", "the first row of the frame in `pushes`"},
            frames.pushes.first);
  of_frames("frames/pushes", {"", "rows of the frame in `pushes`"}, frames.pushes.count);
  if (layout.contacts) {
    of_frames("frames/first_contact", {"", "the first row of the frame in `contacts`"},
              frames.contacts.first);
    of_frames("frames/contacts", {"", "rows of the frame in `contacts`"}, frames.contacts.count);
  }

  const auto of_origins = columns(Axis::origins, Use::index);
  of_origins("origins/id",
             {"", "of the particle; all in the first frame of a stage, later the new ones"},
             part.origins.id);
  of_origins("origins/site",
             {"sites", "column and row where it was when the stage began or it entered"},
             part.origins.site, {2});

  const auto of_particles = columns(Axis::particles, Use::rows);
  of_particles("particles/id", {"", "for life; ascending in a frame, without those gone"}, rows.id);
  of_particles("particles/site",
               {"sites",
                "column and row of the reference site; the column, as nothing else, counts on "
                "across a periodic boundary"},
               rows.site, {2});
  of_particles("particles/kind", {"", "which of `scene/kinds`: species and orientation"},
               rows.kind);
  of_particles("particles/move", {"", "the last move: 0 to 5 clockwise from up, 6 none"},
               rows.move);
  if (layout.velocities) {
    of_particles("particles/velocity", {"spacings/step", "x, y; of the contact model"},
                 rows.velocity, {2});
    of_particles("particles/spin",
                 {"spacings/step",
                  "angular velocity, anticlockwise, times the radius of a disc of the same area; "
                  "of the contact model"},
                 rows.spin, {}, true);
  }

  const auto of_pushes = columns(Axis::pushes, Use::rows);
  of_pushes("pushes/pushed", {"", "id of a particle that was pushed"}, rows.pushed);
  of_pushes("pushes/pusher",
            {"", "by whom: a particle, or -2 for the first wall, -3 for the second ..."},
            rows.pusher);
  of_pushes("pushes/source", {"", "the wall where the push began"}, rows.push_source);
  of_pushes("pushes/direction", {"", "0 to 5 clockwise from up"}, rows.push_direction);

  if (layout.walls > 0) {
    const auto of_walls = columns(Axis::frames, Use::rows);
    of_walls("walls/present", {"", "1 where the wall is there"}, rows.wall_present, {layout.walls});
    of_walls("walls/offset", {"sites", "from home along its motion"}, rows.wall_offset,
             {layout.walls});
  }

  if (layout.contacts) {
    const auto of_contacts = columns(Axis::contacts, Use::rows);
    of_contacts("contacts/upper", {"", "id of a particle"}, rows.upper);
    of_contacts(
        "contacts/other",
        {"",
         "what it touches: a particle, -2 for the first wall, -3 for the second ..., or "
         "-2³¹, -2³¹+1, -2³¹+2, -2³¹+3 for `box.floor`, `box.top`, `box.left`, `box.right`"},
        rows.other);
    of_contacts("contacts/place", {"spacings", "x, y of the contact, in the box"}, rows.point, {2});
    of_contacts("contacts/normal", {"", "x, y: unit vector to the upper particle"}, rows.normal,
                {2});
    of_contacts("contacts/branch",
                {"spacings",
                 "x, y from the other centre, or from the point of contact with what is no "
                 "particle, to the upper centre"},
                rows.branch, {2});
    of_contacts("contacts/force",
                {"weights of a grain of mean mass",
                 "on the upper particle: along the normal, and along the normal turned "
                 "anticlockwise"},
                rows.force, {2});
  }

  auto& derived = part.derived;
  const auto more_of_particles = columns(Axis::particles, Use::derived);
  more_of_particles("particles/species", {"", "which of `scene/species`"}, derived.species);
  more_of_particles("particles/position", {"spacings", "x, y of the centre of mass, in the box"},
                    derived.position, {2});
  if (layout.walls > 0) {
    columns(Axis::frames, Use::derived)("walls/position", {"spacings", "x, y from home"},
                                        derived.wall_position, {layout.walls, 2});
  }
}

/// Adds the datasets of this use to a list of those to be read into `part`, which has to stay
/// where it is until then.
void add_datasets(TrajectoryPart& part, const Layout& layout, Use use,
                  std::vector<Hdf5Dataset>& datasets);

}  // namespace clca::store
