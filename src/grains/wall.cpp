#include "grains/internal/wall.hpp"

#include <algorithm>

namespace clca::grains {

namespace {

std::vector<std::size_t> places_now(const State& state, const Wall& wall) {
  std::vector<std::size_t> places;
  for (const lattice::Site site : sites_now(state.lattice, wall)) {
    places.push_back(state.lattice.index(site));
  }
  return places;
}

/// Gives the sites of a removed wall to other walls that cover them.
void leave_to_others(const State& state, OccupancyTable& occupancy,
                     std::vector<std::size_t>& vacated) {
  std::sort(vacated.begin(), vacated.end());
  for (std::size_t other = 0; other < state.walls.size(); ++other) {
    if (!state.walls[other].present) {
      continue;
    }
    for (const std::size_t place : places_now(state, state.walls[other])) {
      if (std::binary_search(vacated.begin(), vacated.end(), place)) {
        occupancy.take(place, wall_code(other));
      }
    }
  }
}

}  // namespace

std::vector<std::size_t> remove_wall(State& state, OccupancyTable& occupancy, std::size_t number) {
  Wall& wall = state.walls.at(number);
  const Owner code = wall_code(number);
  wall.present = false;
  std::vector<std::size_t> vacated;
  for (const std::size_t place : places_now(state, wall)) {
    if (occupancy.has(place, code) && occupancy.remove(place, code)) {
      vacated.push_back(place);
    }
  }
  leave_to_others(state, occupancy, vacated);
  std::erase_if(vacated, [&](std::size_t place) { return occupancy.taken(place); });
  return vacated;
}

bool insert_wall(State& state, OccupancyTable& occupancy, std::size_t number) {
  Wall& wall = state.walls.at(number);
  if (wall.present) {
    return true;
  }
  const std::vector<std::size_t> places = places_now(state, wall);
  const auto moves = [&](Owner owner) {
    return is_wall(owner) && state.walls[wall_number(owner)].motion.has_value();
  };
  const bool blocked = std::any_of(places.begin(), places.end(), [&](std::size_t place) {
    const Owner owner = occupancy.owner(place);
    return is_particle(owner) || moves(owner) || (owner != kFree && wall.motion.has_value());
  });
  if (blocked) {
    return false;
  }
  wall.present = true;
  for (const std::size_t place : places) {
    const Owner owner = occupancy.owner(place);
    if (!is_wall(owner) || wall_number(owner) < number) {  // as in an OccupancyTable built anew
      occupancy.take(place, wall_code(number));
    }
  }
  return true;
}

}  // namespace clca::grains
