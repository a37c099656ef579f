#pragma once
// A part of a trajectory in memory: the datasets of docs/trajectory.md.

#include <cstdint>
#include <vector>

#include "clca/grains/state.hpp"
#include "clca/scene/scene.hpp"
#include "clca/store/trajectory.hpp"
#include "store/hdf5_file.hpp"

namespace clca::store {

inline constexpr FileKind kTrajectoryKind{.name = "trajectory", .version = 1};

/// Optional datasets of a trajectory.
struct Layout {
  std::size_t walls = 0;
  bool velocities = false;
  bool contacts = false;
};

Layout layout_of(const scene::Scene& scene);

/// What the rows of a dataset are.
enum class Axis : std::uint8_t { frames, particles, origins, pushes, contacts };

struct Extents {
  std::uint64_t frames = 0;
  std::uint64_t particles = 0;
  std::uint64_t origins = 0;
  std::uint64_t pushes = 0;
  std::uint64_t contacts = 0;

  std::uint64_t along(Axis axis) const;
  Extents& operator+=(const Extents& other);
  bool operator==(const Extents&) const = default;
};

/// A dataset: path, meaning of its rows and numbers, shape of a row (none: one number). The numbers
/// of a row are contiguous.
struct Column {
  const char* path;
  Axis axis;
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

  void add(std::uint64_t first_row, std::size_t rows);
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

/// Derived data, for the convenience of other readers.
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
  Extents extents() const;
  std::size_t bytes() const;
};

/// Calls visit(column, vector) for each dataset.
template <class Frames, class Visit>
void for_each_frames_column(Frames& frames, const Layout& layout, Visit visit) {
  constexpr Axis kAxis = Axis::frames;
  visit(Column{"frames/step", kAxis, {"steps", "of the whole run"}}, frames.step);
  visit(Column{"frames/stage", kAxis, {"", "which of `scene/stages`, from 0"}}, frames.stage);
  visit(Column{"frames/entered", kAxis, {"", "particles that had entered; ids are below this"}},
        frames.entered);
  visit(Column{"frames/first", kAxis, {"", "the first row of the frame in `particles`"}},
        frames.particles.first);
  visit(Column{"frames/particles", kAxis, {"", "rows of the frame in `particles`"}},
        frames.particles.count);
  visit(Column{"frames/first_origin", kAxis, {"", "the first row of the frame in `origins`"}},
        frames.origins.first);
  visit(Column{"frames/origins", kAxis, {"", "rows of the frame in `origins`"}},
        frames.origins.count);
  visit(Column{"frames/first_push", kAxis, {"", "the first row of the frame in `pushes`"}},
        frames.pushes.first);
  visit(Column{"frames/pushes", kAxis, {"", "rows of the frame in `pushes`"}}, frames.pushes.count);
  if (layout.contacts) {
    visit(Column{"frames/first_contact", kAxis, {"", "the first row of the frame in `contacts`"}},
          frames.contacts.first);
    visit(Column{"frames/contacts", kAxis, {"", "rows of the frame in `contacts`"}},
          frames.contacts.count);
  }
}

template <class Origins, class Visit>
void for_each_origins_column(Origins& origins, Visit visit) {
  constexpr Axis kAxis = Axis::origins;
  visit(Column{"origins/id",
               kAxis,
               {"", "of the particle; all in the first frame of a stage, later the new ones"}},
        origins.id);
  visit(Column{"origins/site",
               kAxis,
               {"sites", "column and row where it was when the stage began or it entered"},
               {2}},
        origins.site);
}

template <class Rows, class Visit>
void for_each_particles_column(Rows& rows, const Layout& layout, Visit visit) {
  constexpr Axis kAxis = Axis::particles;
  visit(Column{"particles/id", kAxis, {"", "for life; ascending in a frame, without those gone"}},
        rows.id);
  visit(Column{"particles/site",
               kAxis,
               {"sites",
                "column and row of the reference site; the column, as nothing else, counts on "
                "across a periodic boundary"},
               {2}},
        rows.site);
  visit(Column{"particles/kind", kAxis, {"", "which of `scene/kinds`: species and orientation"}},
        rows.kind);
  visit(Column{"particles/move", kAxis, {"", "the last move: 0 to 5 clockwise from up, 6 none"}},
        rows.move);
  if (layout.velocities) {
    visit(Column{"particles/velocity", kAxis, {"spacings/step", "x, y; of the contact model"}, {2}},
          rows.velocity);
    visit(Column{"particles/spin",
                 kAxis,
                 {"spacings/step",
                  "angular velocity, anticlockwise, times the radius of a disc of the same area; "
                  "of the contact model"},
                 {},
                 true},
          rows.spin);
  }
}

template <class Rows, class Visit>
void for_each_contacts_column(Rows& rows, Visit visit) {
  constexpr Axis kAxis = Axis::contacts;
  visit(Column{"contacts/upper", kAxis, {"", "id of a particle"}}, rows.upper);
  visit(
      Column{"contacts/other",
             kAxis,
             {"",
              "what it touches: a particle, -2 for the first wall, -3 for the second ..., or "
              "-2³¹, -2³¹+1, -2³¹+2, -2³¹+3 for `box.floor`, `box.top`, `box.left`, `box.right`"}},
      rows.other);
  visit(Column{"contacts/place", kAxis, {"spacings", "x, y of the contact, in the box"}, {2}},
        rows.point);
  visit(Column{"contacts/normal", kAxis, {"", "x, y: unit vector to the upper particle"}, {2}},
        rows.normal);
  visit(Column{"contacts/branch",
               kAxis,
               {"spacings",
                "x, y from the other centre, or from the point of contact with what is no "
                "particle, to the upper centre"},
               {2}},
        rows.branch);
  visit(Column{"contacts/force",
               kAxis,
               {"weights of a grain of mean mass",
                "on the upper particle: along the normal, and along the normal turned "
                "anticlockwise"},
               {2}},
        rows.force);
}

template <class Rows, class Visit>
void for_each_rows_column(Rows& rows, const Layout& layout, Visit visit) {
  for_each_particles_column(rows, layout, visit);
  constexpr Axis kPushes = Axis::pushes;
  visit(Column{"pushes/pushed", kPushes, {"", "id of a particle that was pushed"}}, rows.pushed);
  visit(Column{"pushes/pusher",
               kPushes,
               {"", "by whom: a particle, or -2 for the first wall, -3 for the second ..."}},
        rows.pusher);
  visit(Column{"pushes/source", kPushes, {"", "the wall where the push began"}}, rows.push_source);
  visit(Column{"pushes/direction", kPushes, {"", "0 to 5 clockwise from up"}}, rows.push_direction);
  if (layout.walls > 0) {
    visit(Column{"walls/present", Axis::frames, {"", "1 where the wall is there"}, {layout.walls}},
          rows.wall_present);
    visit(
        Column{
            "walls/offset", Axis::frames, {"sites", "from home along its motion"}, {layout.walls}},
        rows.wall_offset);
  }
  if (layout.contacts) {
    for_each_contacts_column(rows, visit);
  }
}

template <class Derived, class Visit>
void for_each_derived_column(Derived& derived, std::size_t walls, Visit visit) {
  visit(Column{"particles/species", Axis::particles, {"", "which of `scene/species`"}},
        derived.species);
  visit(Column{"particles/position",
               Axis::particles,
               {"spacings", "x, y of the centre of mass, in the box"},
               {2}},
        derived.position);
  if (walls > 0) {
    visit(Column{"walls/position", Axis::frames, {"spacings", "x, y from home"}, {walls, 2}},
          derived.wall_position);
  }
}

template <class Part, class Visit>
void for_each_column(Part& part, const Layout& layout, Visit visit) {
  for_each_frames_column(part.frames, layout, visit);
  for_each_origins_column(part.origins, visit);
  for_each_rows_column(part.rows, layout, visit);
  for_each_derived_column(part.derived, layout.walls, visit);
}

/// Records the destination of each column to be read.
inline auto add_to(std::vector<Hdf5Dataset>& datasets) {
  return [&datasets](const Column& column, auto& values) {
    datasets.push_back({.path = column.path,
                        .values = &values,
                        .columns = column.width(),
                        .may_be_missing = column.may_be_missing});
  };
}

}  // namespace clca::store
