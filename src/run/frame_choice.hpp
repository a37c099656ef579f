#pragma once
// Selection of trajectory frames for drawing.

#include <cstdint>
#include <vector>

#include "clca/store/trajectory.hpp"

namespace clca::run {

/// Selected indices into `frames`, ascending. Each stage begins and ends with a picture, the others
/// are at least `every` steps apart. A step shared by two stages is drawn once, as the end of the
/// first.
std::vector<std::size_t> frame_choice(const std::vector<store::Trajectory::Frame>& frames,
                                      std::uint64_t every);

/// Whether item `number` of `count` is among at most `most` (two or more) evenly spaced ones,
/// including first and last.
bool is_among(std::size_t number, std::size_t count, std::size_t most);

}  // namespace clca::run
