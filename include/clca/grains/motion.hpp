#pragma once
// How walls move: by themselves, one lattice site a step at most, whatever stands in their way.
// A motion says in sites where the automaton wants a wall (wish), and finer where the contact model
// wants it (velocity).

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "clca/fields/fields.hpp"
#include "clca/lattice/direction.hpp"

namespace clca::grains {

/// One site every `period` steps, `distance` sites in all. What a stall costs is not made up for by
/// the automaton.
struct Drive {
  std::uint64_t period = 1;
  std::int32_t distance = 0;

  bool operator==(const Drive&) const = default;
};

enum class Waveform : std::uint8_t { sine, triangle };

/// To and fro about home, `amplitude` sites to either side, first along the direction.
struct Wave {
  Waveform form = Waveform::sine;
  std::int32_t amplitude = 1;
  std::uint64_t period = 8;  ///< steps; long enough for one site a step

  bool operator==(const Wave&) const = default;
};

/// Lifted by `amplitude` sites, dropped back home, then a wait; again and again.
struct Shake {
  std::int32_t amplitude = 1;
  std::optional<std::uint64_t> wait;  ///< steps after the last drop; none: until no particle moves
  /// Steps for each site, at most kSpacing; none: ten. Of the contact model: that of the automaton
  /// takes one.
  std::optional<std::uint64_t> period = {};

  bool operator==(const Shake&) const = default;
};

/// Straight from one point to the next, at the last for good. The steps count from the start of
/// the motion, at home, and increase; nowhere is it steeper than one site a step.
struct Path {
  struct Point {
    std::uint64_t step = 0;
    std::int32_t offset = 0;  ///< sites along the direction

    bool operator==(const Point&) const = default;
  };
  std::vector<Point> points;

  bool operator==(const Path&) const = default;
};

/// Finer than sites: a lattice spacing.
inline constexpr std::int64_t kSpacing = 1 << 20;

struct Motion {
  lattice::Direction direction = lattice::Direction::up;
  std::variant<Drive, Wave, Shake, Path> program;

  bool operator==(const Motion&) const = default;
};

/// What happens to particles in the way of a moving wall: `rigid` pushes them, and all that these
/// stand against, by one site, or the wall stalls; `overlap` enters them and leaves it to the
/// passive rule to remove the overlap.
enum class Passive : std::uint8_t { rigid, overlap };

/// How far a moving wall has come.
struct Travel {
  enum class Phase : std::uint8_t { rising, falling, waiting };  // of a Shake

  bool active = false;      ///< in this stage
  std::int32_t offset = 0;  ///< sites from home along the direction of the motion
  std::uint64_t clock = 0;  ///< steps in motion
  Phase phase = Phase::rising;
  std::uint64_t waited = 0;  ///< steps, in the phase of that name
  std::uint64_t cycles = 0;  ///< of a Shake or a Wave that are complete
  std::uint64_t stalls = 0;  ///< moves that failed
  /// Step of the first of the moves that have failed since the wall last moved.
  std::optional<std::uint64_t> stalled_since = {};

  bool operator==(const Travel&) const = default;
  static constexpr auto fields() {
    using fields::field;
    return std::make_tuple(field("active", &Travel::active), field("offset", &Travel::offset),
                           field("clock", &Travel::clock), field("phase", &Travel::phase),
                           field("waited", &Travel::waited), field("cycles", &Travel::cycles),
                           field("stalls", &Travel::stalls),
                           field("stalled_since", &Travel::stalled_since));
  }
};

/// Least and greatest offset that the motion can reach, in sites.
struct Range {
  std::int32_t low = 0;
  std::int32_t high = 0;
};
Range range_of(const Motion& motion);

/// True for motions that go round: a Shake or a Wave.
bool is_cyclic(const Motion& motion);

/// Where a Wave or a Path wants to be after `clock` steps, in sites. All in integers: a sine is
/// Bhaskara's rational one, within 0.2 % of the amplitude.
std::int32_t target(const Wave& wave, std::uint64_t clock);
std::int32_t target(const Path& path, std::uint64_t clock);

/// How far the motion goes in its next step, in 2^-20 lattice spacings along the direction.
/// `ahead`, in the same unit: how far it is beyond where the wall is.
std::int32_t velocity(const Motion& motion, const Travel& travel, std::int64_t ahead);

/// Whether a motion that is so far ahead of the wall can be where it is: by its clock, or for a
/// Shake between its ends.
bool can_be_ahead(const Motion& motion, const Travel& travel, std::int64_t ahead);

/// The step that the wall wants to take now: +1 along the direction, -1 against it, 0 none.
int wish(const Motion& motion, const Travel& travel);

/// True when the wall will never again want to move.
bool is_over(const Motion& motion, const Travel& travel);

/// The step that the wall wants now or the next time it is due, until it is done: as wish. 0 where
/// that depends on when it comes to it, or where it wants none.
int lasting_wish(const Motion& motion, const Travel& travel);

/// Accounts for the move of this step: what the wall wished and whether it was done. `step` is the
/// number of the step. A Shake turns once the wall is where it turns and nothing is `ahead`.
void take_step(const Motion& motion, Travel& travel, int wished, bool done, std::uint64_t step,
               std::int64_t ahead = 0);

/// Ends the step, in which particles moved or did not: what waits for them may go on.
void end_step(const Motion& motion, Travel& travel, bool particles_moved);

}  // namespace clca::grains
