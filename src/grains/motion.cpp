#include "clca/grains/motion.hpp"

#include <algorithm>
#include <iterator>

namespace clca::grains {

namespace {

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;  // for clang 14

/// The quotient rounded to the nearest whole number, halves away from zero.
std::int32_t rounded_ratio(std::int64_t numerator, std::int64_t denominator) {
  const std::int64_t half = numerator < 0 ? -denominator / 2 : denominator / 2;
  return static_cast<std::int32_t>((numerator + half) / denominator);
}

/// amplitude x sin(pi t / half) for t in [0, half] by Bhaskara's formula.
std::int32_t half_sine(std::int64_t amplitude, std::int64_t t, std::int64_t half) {
  const std::int64_t product = t * (half - t);
  return rounded_ratio(16 * amplitude * product, 5 * half * half - 4 * product);
}

/// Rises from 0 to the amplitude and falls back in `half` units of time.
std::int32_t half_triangle(std::int64_t amplitude, std::int64_t t, std::int64_t half) {
  return rounded_ratio(2 * amplitude * std::min(t, half - t), half);
}

int sign(std::int32_t value) {
  return (value > 0 ? 1 : 0) - (value < 0 ? 1 : 0);
}

bool due(const Drive& drive, const Travel& travel) {
  return travel.offset < drive.distance && (travel.clock + 1) % drive.period == 0;
}

int wish_of(const Shake& shake, const Travel& travel) {
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

Range range_of(const Motion& motion) {
  return std::visit(Overloaded{[](const Drive& drive) {
                                 return Range{0, drive.distance};
                               },
                               [](const Wave& wave) {
                                 return Range{-wave.amplitude, wave.amplitude};
                               },
                               [](const Shake& shake) {
                                 return Range{0, shake.amplitude};
                               },
                               [](const Path& path) {
                                 Range range;
                                 for (const Path::Point& point : path.points) {
                                   range.low = std::min(range.low, point.offset);
                                   range.high = std::max(range.high, point.offset);
                                 }
                                 return range;
                               }},
                    motion.program);
}

bool is_cyclic(const Motion& motion) {
  return std::holds_alternative<Shake>(motion.program) ||
         std::holds_alternative<Wave>(motion.program);
}

std::int32_t target(const Wave& wave, std::uint64_t clock) {
  // In half steps, so that half a period is a whole number.
  const auto half = static_cast<std::int64_t>(wave.period);
  const auto time = static_cast<std::int64_t>(2 * (clock % wave.period));
  const bool second_half = time >= half;
  const std::int64_t t = second_half ? time - half : time;
  const std::int32_t height = wave.form == Waveform::sine ? half_sine(wave.amplitude, t, half)
                                                          : half_triangle(wave.amplitude, t, half);
  return second_half ? -height : height;
}

std::int32_t target(const Path& path, std::uint64_t clock) {
  const auto next = std::upper_bound(
      path.points.begin(), path.points.end(), clock,
      [](std::uint64_t step, const Path::Point& point) { return step < point.step; });
  const Path::Point before = next == path.points.begin() ? Path::Point{} : *std::prev(next);
  if (next == path.points.end()) {
    return before.offset;
  }
  const auto rise = static_cast<std::int64_t>(next->offset) - before.offset;
  const auto done = static_cast<std::int64_t>(clock - before.step);
  return before.offset +
         rounded_ratio(rise * done, static_cast<std::int64_t>(next->step - before.step));
}

int wish(const Motion& motion, const Travel& travel) {
  return std::visit(
      Overloaded{
          [&](const Drive& drive) { return due(drive, travel) ? 1 : 0; },
          [&](const Wave& wave) { return sign(target(wave, travel.clock + 1) - travel.offset); },
          [&](const Shake& shake) { return wish_of(shake, travel); },
          [&](const Path& path) { return sign(target(path, travel.clock + 1) - travel.offset); }},
      motion.program);
}

bool is_over(const Motion& motion, const Travel& travel) {
  if (const auto* drive = std::get_if<Drive>(&motion.program)) {
    return travel.offset >= drive->distance;
  }
  if (const auto* path = std::get_if<Path>(&motion.program)) {
    return path->points.empty() || (travel.clock >= path->points.back().step &&
                                    travel.offset == path->points.back().offset);
  }
  return false;
}

int lasting_wish(const Motion& motion, const Travel& travel) {
  if (const auto* drive = std::get_if<Drive>(&motion.program)) {
    return travel.offset < drive->distance ? 1 : 0;
  }
  if (const auto* shake = std::get_if<Shake>(&motion.program)) {
    return wish_of(*shake, travel);
  }
  const auto* path = std::get_if<Path>(&motion.program);
  const bool at_last =
      path != nullptr && !path->points.empty() && travel.clock >= path->points.back().step;
  return at_last ? sign(path->points.back().offset - travel.offset) : 0;
}

void take_step(const Motion& motion, Travel& travel, int wished, bool done, std::uint64_t step) {
  ++travel.clock;
  if (wished != 0 && done) {
    travel.offset += wished;
    travel.stalled_since.reset();
  } else if (wished != 0) {
    ++travel.stalls;
    travel.stalled_since = travel.stalled_since.value_or(step);
  }
  if (const auto* shake = std::get_if<Shake>(&motion.program)) {
    turn(*shake, travel);
  }
  if (const auto* wave = std::get_if<Wave>(&motion.program)) {
    travel.cycles = travel.clock / wave->period;
  }
}

void end_step(const Motion& motion, Travel& travel, bool particles_moved) {
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
