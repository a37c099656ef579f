#include "clca/grains/motion.hpp"

#include <algorithm>
#include <iterator>

namespace clca::grains {

namespace {

/// A rational number of sites.
struct Ratio {
  std::int64_t numerator = 0;
  std::int64_t denominator = 1;  // positive
};

/// Nearest integer; halves round away from zero.
std::int32_t rounded(const Ratio& ratio) {
  const std::int64_t half = ratio.numerator < 0 ? -ratio.denominator / 2 : ratio.denominator / 2;
  return static_cast<std::int32_t>((ratio.numerator + half) / ratio.denominator);
}

/// `ratio` in 2^-20 lattice spacings, rounded towards zero.
std::int64_t in_motion_units(const Ratio& ratio) {
  __extension__ using Int128 = __int128;
  return static_cast<std::int64_t>(Int128{ratio.numerator} * kMotionUnitsPerSpacing /
                                   ratio.denominator);
}

/// amplitude x sin(pi t / half) for t in [0, half] by Bhaskara's formula.
Ratio half_sine(std::int64_t amplitude, std::int64_t t, std::int64_t half) {
  const std::int64_t product = t * (half - t);
  return {16 * amplitude * product, 5 * half * half - 4 * product};
}

/// Rises from 0 to the amplitude and falls back in `half` units of time.
Ratio half_triangle(std::int64_t amplitude, std::int64_t t, std::int64_t half) {
  return {2 * amplitude * std::min(t, half - t), half};
}

/// Offset of a Wave.
Ratio offset_at(const Wave& wave, std::uint64_t clock) {
  // In half steps, so that half a period is a whole number.
  const auto half = static_cast<std::int64_t>(wave.period);
  const auto time = static_cast<std::int64_t>(2 * (clock % wave.period));
  const bool second_half = time >= half;
  const std::int64_t t = second_half ? time - half : time;
  Ratio height = wave.form == Waveform::sine ? half_sine(wave.amplitude, t, half)
                                             : half_triangle(wave.amplitude, t, half);
  height.numerator *= second_half ? -1 : 1;
  return height;
}

/// The last point of a Path and the rise since then.
struct PathSegment {
  std::int32_t from = 0;
  Ratio rise;
};

PathSegment segment_at(const Path& path, std::uint64_t clock) {
  const auto next = std::ranges::upper_bound(path.points, clock, {}, &Path::Point::step);
  const Path::Point before = next == path.points.begin() ? Path::Point{} : *std::prev(next);
  if (next == path.points.end()) {
    return {.from = before.offset, .rise = {}};
  }
  const auto rise = static_cast<std::int64_t>(next->offset) - before.offset;
  return {.from = before.offset,
          .rise = {rise * static_cast<std::int64_t>(clock - before.step),
                   static_cast<std::int64_t>(next->step - before.step)}};
}

// Offset of a motion after `clock` steps, in 2^-20 lattice spacings.
std::int64_t position(const Drive& drive, std::uint64_t clock) {
  const auto distance = static_cast<std::uint64_t>(drive.distance);
  return clock / drive.period >= distance
             ? drive.distance * kMotionUnitsPerSpacing
             : in_motion_units(
                   {static_cast<std::int64_t>(clock), static_cast<std::int64_t>(drive.period)});
}
std::int64_t position(const Wave& wave, std::uint64_t clock) {
  return in_motion_units(offset_at(wave, clock));
}
std::int64_t position(const Path& path, std::uint64_t clock) {
  const PathSegment segment = segment_at(path, clock);
  return segment.from * kMotionUnitsPerSpacing + in_motion_units(segment.rise);
}

template <class Program>
std::int64_t velocity_of(const Program& program, const Travel& travel, std::int64_t /*now*/) {
  return position(program, travel.clock + 1) - position(program, travel.clock);
}
std::int64_t velocity_of(const Shake& shake, const Travel& travel, std::int64_t now) {
  const std::int64_t highest = shake.amplitude * kMotionUnitsPerSpacing;
  const auto period = static_cast<std::int64_t>(shake.contact_period());
  // Of a way at constant velocity: how far it goes in the next step.
  const auto next = [&](std::int64_t way) {
    const std::int64_t steps = (way * period + kMotionUnitsPerSpacing - 1) / kMotionUnitsPerSpacing;
    return std::min((steps + 1) * kMotionUnitsPerSpacing / period, highest) - way;
  };
  switch (travel.phase) {
    case Travel::Phase::rising:
      return next(now);
    case Travel::Phase::falling:
      return -next(highest - now);
    case Travel::Phase::waiting:
      break;
  }
  return 0;
}

template <class Program>
bool can_be_at(const Program& program, std::uint64_t clock, std::int64_t now) {
  return now == position(program, clock);
}
bool can_be_at(const Shake& shake, std::uint64_t /*clock*/, std::int64_t now) {
  return now >= 0 && now <= shake.amplitude * kMotionUnitsPerSpacing;
}

int sign(std::int32_t value) {
  return (value > 0 ? 1 : 0) - (value < 0 ? 1 : 0);
}

template <class Program>
int desired_step_of(const Program& program, const Travel& travel) {
  return sign(target_offset(program, travel.clock + 1) - travel.offset);
}
int desired_step_of(const Drive& drive, const Travel& travel) {
  return travel.offset < drive.distance && (travel.clock + 1) % drive.period == 0 ? 1 : 0;
}
int desired_step_of(const Shake& shake, const Travel& travel) {
  switch (travel.phase) {
    case Travel::Phase::rising:
      return travel.offset < shake.amplitude ? 1 : 0;
    case Travel::Phase::falling:
      return travel.offset > 0 ? -1 : 0;
    case Travel::Phase::waiting:
      break;
  }
  return 0;
}

void turn(const Shake& shake, Travel& travel) {
  if (travel.phase == Travel::Phase::rising && travel.offset == shake.amplitude) {
    travel.phase = Travel::Phase::falling;
  } else if (travel.phase == Travel::Phase::falling && travel.offset == 0) {
    travel.phase = Travel::Phase::waiting;
    travel.waited = 0;
  }
}

}  // namespace

OffsetRange Path::offset_range() const {
  OffsetRange range;
  for (const Point& point : points) {
    range.low = std::min(range.low, point.offset);
    range.high = std::max(range.high, point.offset);
  }
  return range;
}

OffsetRange offset_range(const WallMotion& motion) {
  return std::visit([](const auto& program) { return program.offset_range(); }, motion.program);
}

bool is_cyclic(const WallMotion& motion) {
  return std::holds_alternative<Shake>(motion.program) ||
         std::holds_alternative<Wave>(motion.program);
}

std::int32_t target_offset(const Wave& wave, std::uint64_t clock) {
  return rounded(offset_at(wave, clock));
}

std::int32_t target_offset(const Path& path, std::uint64_t clock) {
  const PathSegment segment = segment_at(path, clock);
  return segment.from + rounded(segment.rise);
}

std::int32_t next_displacement(const WallMotion& motion, const Travel& travel, std::int64_t ahead) {
  const std::int64_t now = travel.offset * kMotionUnitsPerSpacing + ahead;
  return static_cast<std::int32_t>(std::visit(
      [&](const auto& program) { return velocity_of(program, travel, now); }, motion.program));
}

bool can_be_ahead(const WallMotion& motion, const Travel& travel, std::int64_t ahead) {
  constexpr std::int64_t kFar = std::int64_t{1} << 50;
  return ahead > -kFar && ahead < kFar &&
         std::visit(
             [&](const auto& program) {
               return can_be_at(program, travel.clock,
                                travel.offset * kMotionUnitsPerSpacing + ahead);
             },
             motion.program);
}

int desired_step(const WallMotion& motion, const Travel& travel) {
  return std::visit([&](const auto& program) { return desired_step_of(program, travel); },
                    motion.program);
}

bool is_over(const WallMotion& motion, const Travel& travel) {
  if (const auto* drive = std::get_if<Drive>(&motion.program)) {
    return travel.offset >= drive->distance;
  }
  if (const auto* path = std::get_if<Path>(&motion.program)) {
    return path->points.empty() || (travel.clock >= path->points.back().step &&
                                    travel.offset == path->points.back().offset);
  }
  return false;
}

int pending_step(const WallMotion& motion, const Travel& travel) {
  if (const auto* drive = std::get_if<Drive>(&motion.program)) {
    return travel.offset < drive->distance ? 1 : 0;
  }
  if (const auto* shake = std::get_if<Shake>(&motion.program)) {
    return desired_step_of(*shake, travel);
  }
  const auto* path = std::get_if<Path>(&motion.program);
  const bool at_last =
      path != nullptr && !path->points.empty() && travel.clock >= path->points.back().step;
  return at_last ? sign(path->points.back().offset - travel.offset) : 0;
}

void record_step(const WallMotion& motion, Travel& travel, int desired, bool done,
                 std::uint64_t step, std::int64_t ahead) {
  ++travel.clock;
  if (desired != 0 && done) {
    travel.offset += desired;
    travel.stalled_since.reset();
  } else if (desired != 0) {
    ++travel.stalls;
    travel.stalled_since = travel.stalled_since.value_or(step);
  }
  if (const auto* shake = std::get_if<Shake>(&motion.program); shake != nullptr && ahead == 0) {
    turn(*shake, travel);
  }
  if (const auto* wave = std::get_if<Wave>(&motion.program)) {
    travel.cycles = travel.clock / wave->period;
  }
}

void end_step(const WallMotion& motion, Travel& travel, bool particles_moved) {
  const auto* shake = std::get_if<Shake>(&motion.program);
  if (shake == nullptr || travel.phase != Travel::Phase::waiting) {
    return;
  }
  // The step of the last drop does not count.
  if (shake->wait ? travel.waited >= *shake->wait : !particles_moved) {
    ++travel.cycles;
    travel.phase = Travel::Phase::rising;
  }
  ++travel.waited;
}

}  // namespace clca::grains
