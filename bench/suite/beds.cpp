#include "beds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "clca/automaton/automaton.hpp"
#include "clca/lattice/region.hpp"
#include "clca/random/draw.hpp"

namespace clca::bench {

namespace {

using grains::State;

// The sites of a cell, which holds a particle of either kind with a free row to the next cell.
constexpr int kCellColumns = 6;
constexpr int kCellRows = 8;
constexpr std::size_t kLowRain = 24;  // cells

std::size_t ratio_up(std::size_t count, std::size_t divisor) {
  return (count + divisor - 1) / divisor;
}

State empty_box(const lattice::Lattice& lattice) {
  State state{.lattice = lattice, .seed = 2001};
  state.kinds = {{lattice::Shape::hexagon(1), 0}, {lattice::Shape::hexagon(2), 1}};
  return state;
}

/// One particle in each cell, `high` cells one above the other, from row `bottom` on. Ids follow
/// the columns from the left, upwards, as those of a fill.
void add_rain(State& state, std::size_t particles, std::size_t high, int bottom) {
  state.particles.reserve(particles);
  for (std::size_t cell = 0; cell < particles; ++cell) {
    const std::uint64_t bits = random::draw(state.seed, cell, 0, random::Purpose::fill_position);
    const int column =
        kCellColumns * static_cast<int>(cell / high) + 2 + static_cast<int>(bits & 1U);
    const int row =
        bottom + kCellRows * static_cast<int>(cell % high) + 3 + static_cast<int>(bits >> 1U & 1U);
    state.particles.push_back(
        {.column = column, .row = row, .kind = static_cast<std::uint16_t>(bits >> 2U & 1U)});
  }
  std::sort(state.particles.begin(), state.particles.end(),
            [](const auto& left, const auto& right) { return left.site() < right.site(); });
  std::transform(state.particles.begin(), state.particles.end(), std::back_inserter(state.origins),
                 [](const auto& particle) { return particle.site(); });
}

State rain_of_height(std::size_t particles, std::size_t high, int bottom) {
  const auto columns = kCellColumns * static_cast<int>(ratio_up(particles, high));
  const auto rows = bottom + kCellRows * static_cast<int>(high);
  State state = empty_box({columns, rows, false});
  add_rain(state, particles, high, bottom);
  return state;
}

}  // namespace

State rain(std::size_t particles) {
  const double height_of_one = kCellRows / (kCellColumns * lattice::kColumnPitch);
  const double high = std::sqrt(static_cast<double>(particles) / height_of_one);
  return rain_of_height(particles, static_cast<std::size_t>(std::ceil(high)), kFallingSteps);
}

State low_rain(std::size_t particles) {
  return rain_of_height(particles, std::min(particles, kLowRain), 0);
}

State walled_bed(std::size_t particles) {
  const double scale = std::sqrt(static_cast<double>(particles) / 540);
  const double width = 87 * scale;
  const double height = 140 * scale;  // half as much again as the bed
  State state = empty_box(lattice::Lattice::covering(300 * scale, height, false));
  state.walls = {{.sites = lattice::sites_in(state.lattice, {width, 0, width + 1, height})}};
  automaton::Automaton bed(std::move(state));
  const std::array counts = {particles / 2, particles - particles / 2};
  if (!bed.fill({0, 0, width, height}, counts, true).complete) {
    throw std::logic_error("the bed is higher than its box");
  }
  return bed.state();
}

}  // namespace clca::bench
