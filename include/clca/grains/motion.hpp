#pragma once
// Motions of walls: at most one lattice site per step, prescribed by the scene.
// The automaton uses whole sites (desired_step), the contact model fractions (next_displacement).

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "clca/lattice/direction.hpp"
#include "clca/reflection/reflection.hpp"

namespace clca::grains {

/// Smallest and largest offset that a motion can reach, in sites.
struct OffsetRange {
  std::int32_t low = 0;
  std::int32_t high = 0;
};

/// One site every `period` steps, `distance` sites in all. The automaton makes up for no stall.
struct Drive {
  std::uint64_t period = 1;
  std::int32_t distance = 0;

  OffsetRange offset_range() const { return {0, distance}; }
  bool operator==(const Drive&) const = default;
};

enum class Waveform : std::uint8_t { sine, triangle };

/// Oscillation about the initial position, `amplitude` sites each way, first along the direction.
struct Wave {
  Waveform form = Waveform::sine;
  std::int32_t amplitude = 1;
  std::uint64_t period = 8;  ///< steps, at least least_period()

  OffsetRange offset_range() const { return {-amplitude, amplitude}; }
  bool operator==(const Wave&) const = default;
};

/// Shortest period for each site of amplitude, in steps: the wave moves one site a step at most.
inline constexpr std::uint64_t kSineStepsPerSite = 7;
inline constexpr std::uint64_t kTriangleStepsPerSite = 4;
inline std::uint64_t least_period(const Wave& wave) {
  return (wave.form == Waveform::sine ? kSineStepsPerSite : kTriangleStepsPerSite) *
         static_cast<std::uint64_t>(wave.amplitude);
}

/// Lifted by `amplitude` sites, dropped back, then a pause; repeated.
struct Shake {
  std::int32_t amplitude = 1;
  std::optional<std::uint64_t> wait;  ///< steps after the drop; none: until no particle moves
  /// Contact model only: steps per site, at most kMotionUnitsPerSpacing. The automaton takes
  /// one.
  std::optional<std::uint64_t> period = {};
  std::uint64_t contact_period() const { return period.value_or(10); }

  OffsetRange offset_range() const { return {0, amplitude}; }
  bool operator==(const Shake&) const = default;
};

/// Linear interpolation between points; stays at the last.
/// Steps count from the start of the motion and increase; the slope is at most one site per step.
struct Path {
  struct Point {
    std::uint64_t step = 0;
    std::int32_t offset = 0;  ///< sites along the direction

    bool operator==(const Point&) const = default;
  };
  std::vector<Point> points;

  OffsetRange offset_range() const;
  bool operator==(const Path&) const = default;
};

/// Whether the way from a point to a later one is longer in sites than in steps.
inline bool is_too_steep(const Path::Point& from, const Path::Point& to) {
  const std::int64_t rise = std::int64_t{to.offset} - from.offset;
  return static_cast<std::uint64_t>(rise < 0 ? -rise : rise) > to.step - from.step;
}

/// A lattice spacing in the unit of positions that are finer than sites.
inline constexpr std::int64_t kMotionUnitsPerSpacing = 1 << 20;

/// The motion of a wall along a direction, by a program.
struct WallMotion {
  lattice::Direction direction = lattice::Direction::up;
  std::variant<Drive, Wave, Shake, Path> program;

  bool operator==(const WallMotion&) const = default;
};

/// How a moving wall treats particles in its way. `rigid` pushes them and all particles they
/// touch by one site, or stalls.
/// `overlap` moves onto them; the passive rule then removes the overlap.
enum class PassiveRule : std::uint8_t { rigid, overlap };

/// Progress of a moving wall.
struct Travel {
  enum class Phase : std::uint8_t { rising, falling, waiting };  // of a Shake

  bool active = false;      ///< in this stage
  std::int32_t offset = 0;  ///< sites from the initial position along the direction of the motion
  std::uint64_t clock = 0;  ///< steps in motion
  Phase phase = Phase::rising;
  std::uint64_t waited = 0;  ///< steps, in the phase of that name
  std::uint64_t cycles = 0;  ///< completed cycles of a Shake or a Wave
  std::uint64_t stalls = 0;  ///< moves that failed
  /// Step of the first failed move since the wall last moved.
  std::optional<std::uint64_t> stalled_since = {};

  bool operator==(const Travel&) const = default;
  CLCA_FIELDS(active, offset, clock, phase, waited, cycles, stalls, stalled_since);
};

OffsetRange offset_range(const WallMotion& motion);

/// True for periodic motions: Shake and Wave.
bool is_cyclic(const WallMotion& motion);

/// Offset of a Wave or a Path after `clock` steps, in sites. Integers only: the sine is Bhaskara's
/// rational approximation, within 0.2 % of the amplitude.
std::int32_t target_offset(const Wave& wave, std::uint64_t clock);
std::int32_t target_offset(const Path& path, std::uint64_t clock);

/// Displacement of the motion in its next step, in 2^-20 lattice spacings along the direction.
/// `ahead`, in the same unit: how far the motion is ahead of the wall.
std::int32_t next_displacement(const WallMotion& motion, const Travel& travel, std::int64_t ahead);

/// Whether a run can reach a state in which the motion is `ahead` of the wall by this much.
bool can_be_ahead(const WallMotion& motion, const Travel& travel, std::int64_t ahead);

/// The step that the motion prescribes now: +1 along the direction, -1 against it, 0 none.
int desired_step(const WallMotion& motion, const Travel& travel);

/// True if the wall will never move again.
bool is_over(const WallMotion& motion, const Travel& travel);

/// The prescribed step that is still to be done, now or when it is next due. 0 if there is none or
/// it depends on the step at which the wall gets there.
int pending_step(const WallMotion& motion, const Travel& travel);

/// Updates the progress after a step: `desired` as desired_step(), `done` if the wall moved, `step`
/// the number of the step.
/// A Shake changes direction only at its turning point with nothing `ahead`.
void record_step(const WallMotion& motion, Travel& travel, int desired, bool done,
                 std::uint64_t step, std::int64_t ahead = 0);

/// Ends the step. A Shake that waits for rest goes on if no particle moved.
void end_step(const WallMotion& motion, Travel& travel, bool particles_moved);

}  // namespace clca::grains
