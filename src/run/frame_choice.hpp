#pragma once
// Which frames of a trajectory are drawn.

#include <cstdint>
#include <vector>

#include "clca/store/trajectory.hpp"

namespace clca::run {

/// Places in `frames`, ascending. As in a run, each stage begins and ends with a picture, those
/// between are at least `every` steps apart, and a step is drawn once: as the stage that ends there
/// leaves it.
std::vector<std::size_t> frame_choice(const std::vector<store::Trajectory::Frame>& frames,
                                      std::uint64_t every);

/// Whether item `number` of `count` is one of at most `most`, two or more, that lie evenly among
/// them, the first and the last included.
bool is_among(std::size_t number, std::size_t count, std::size_t most);

}  // namespace clca::run
