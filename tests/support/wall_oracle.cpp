#include "support/wall_oracle.hpp"

#include <algorithm>
#include <cmath>

#include "support/overlaps.hpp"

namespace clca::testing {

using grains::is_particle;
using grains::Owner;
using grains::Push;
using grains::State;
using grains::Travel;
using grains::Wall;
using lattice::Direction;

namespace {

int rounded(double value) {
  return static_cast<int>(std::lround(value));
}

int wave_target(const grains::Wave& wave, std::uint64_t clock) {
  const double half = static_cast<double>(wave.period) / 2;
  const auto time = static_cast<double>(clock % wave.period);
  const int side = time < half ? 1 : -1;
  const double t = time < half ? time : time - half;
  if (wave.form == grains::Waveform::triangle) {
    return side * rounded(2 * wave.amplitude * std::min(t, half - t) / half);
  }
  const double product = t * (half - t);  // Bhaskara
  return side * rounded(16 * wave.amplitude * product / (5 * half * half - 4 * product));
}

int path_target(const grains::Path& path, std::uint64_t clock) {
  grains::Path::Point before;
  for (const auto& point : path.points) {
    if (clock < point.step) {
      const double rise = point.offset - before.offset;
      const auto done = static_cast<double>(clock - before.step);
      return before.offset + rounded(rise * done / static_cast<double>(point.step - before.step));
    }
    before = point;
  }
  return before.offset;
}

int wanted_offset(const Wall& wall) {
  const auto& program = wall.motion->program;
  const Travel& travel = wall.travel;
  const std::uint64_t now = travel.clock + 1;
  if (const auto* drive = std::get_if<grains::Drive>(&program)) {
    return now % drive->period == 0 ? std::max(drive->distance, travel.offset) : travel.offset;
  }
  if (const auto* wave = std::get_if<grains::Wave>(&program)) {
    return wave_target(*wave, now);
  }
  if (const auto* path = std::get_if<grains::Path>(&program)) {
    return path_target(*path, now);
  }
  const auto& shake = std::get<grains::Shake>(program);
  switch (travel.phase) {
    case Travel::Phase::rising:
      return shake.amplitude;
    case Travel::Phase::falling:
      return 0;
    case Travel::Phase::waiting:
      break;
  }
  return travel.offset;
}

/// One wall, one step.
class Turn {
 public:
  Turn(State& state, std::size_t number, int sense)
      : state_(state),
        wall_(state.walls[number]),
        number_(number),
        sense_(sense),
        direction_(sense > 0 ? wall_.motion->direction : opposite(wall_.motion->direction)),
        owners_(occupants(state)),
        before_(wall_body(state, number, wall_.travel.offset)),
        after_(wall_body(state, number, wall_.travel.offset + sense)) {}

  bool taken() { return wall_.passive == grains::Passive::rigid ? pushes() : enters(); }

 private:
  bool pushes() {
    std::set<Owner> train;
    for (const lattice::Site site : after_) {
      train.insert(owners_[site].begin(), owners_[site].end());
    }
    for (std::size_t size = 0; size != train.size();) {
      size = train.size();
      for (const Owner owner : std::set(train)) {
        if (is_particle(owner) && !couples(owner, train)) {
          return false;
        }
      }
    }
    train.erase(grains::wall_code(number_));
    if (std::any_of(train.begin(), train.end(), grains::is_wall)) {
      return false;
    }
    for (const Owner owner : train) {
      grains::Particle& particle = state_.particles[static_cast<std::size_t>(owner)];
      const lattice::Site target = particle.site() + unit(direction_);
      particle.column = target.column;
      particle.row = target.row;
    }
    return true;
  }

  /// Adds whoever stands where the particle stands or would stand. False at the border.
  bool couples(Owner owner, std::set<Owner>& train) {
    const auto& particle = state_.particles[static_cast<std::size_t>(owner)];
    for (const Sites& sites : {body(state_, particle), body_after(state_, particle, direction_)}) {
      if (!inside(state_, sites)) {
        return false;
      }
      for (const lattice::Site site : sites) {
        train.insert(owners_[site].begin(), owners_[site].end());
      }
    }
    return true;
  }

  bool enters() {
    const Owner code = grains::wall_code(number_);
    std::set<std::uint32_t> touched;
    for (const lattice::Site site : after_) {
      if (before_.contains(site) || owners_[site].empty()) {
        continue;
      }
      const Owner owner = *owners_[site].begin();
      if (owners_[site].size() > 1 || !is_particle(owner)) {
        return false;
      }
      touched.insert(static_cast<std::uint32_t>(owner));
    }
    if (std::any_of(touched.begin(), touched.end(), [&](auto id) { return !can_flee(id); })) {
      return false;
    }
    std::erase_if(state_.pushes, [&](const Push& push) {
      const bool ended = shared(body(state_, state_.particles[push.pushed]), after_) == 0;
      return push.pusher == code && (ended || touched.contains(push.pushed));
    });
    for (const std::uint32_t id : touched) {
      state_.pushes.push_back({.pushed = id,
                               .pusher = code,
                               .source = static_cast<std::uint32_t>(number_),
                               .direction = direction_});
    }
    std::sort(state_.pushes.begin(), state_.pushes.end(), [](const Push& a, const Push& b) {
      return std::pair(a.pushed, a.pusher) < std::pair(b.pushed, b.pusher);
    });
    return true;
  }

  bool can_flee(std::uint32_t id) const {
    const auto& particle = state_.particles[id];
    const std::vector ways = {direction_, rotated(direction_, 1), rotated(direction_, -1)};
    return std::any_of(ways.begin(), ways.end(), [&](Direction way) {
      return shared(body_after(state_, particle, way), after_) == 0;
    });
  }

  State& state_;
  const Wall& wall_;
  std::size_t number_;
  int sense_;
  Direction direction_;
  std::map<lattice::Site, std::set<Owner>> owners_;
  Sites before_;
  Sites after_;
};

void turn_round(const Wall& wall, Travel& travel) {
  if (const auto* shake = std::get_if<grains::Shake>(&wall.motion->program)) {
    if (travel.phase == Travel::Phase::rising && travel.offset == shake->amplitude) {
      travel.phase = Travel::Phase::falling;
    } else if (travel.phase == Travel::Phase::falling && travel.offset == 0) {
      travel.phase = Travel::Phase::waiting;
      travel.waited = 0;
    }
  }
  if (const auto* wave = std::get_if<grains::Wave>(&wall.motion->program)) {
    travel.cycles = travel.clock / wave->period;
  }
}

}  // namespace

WallTurns oracle_walls(State& state) {
  WallTurns turns;
  for (std::size_t number = 0; number < state.walls.size(); ++number) {
    Wall& wall = state.walls[number];
    Travel& travel = wall.travel;
    if (!wall.motion || !wall.present || !travel.active) {
      continue;
    }
    const int way = wanted_offset(wall) - travel.offset;
    ++travel.clock;
    if (way != 0) {
      const int sense = way > 0 ? 1 : -1;
      if (Turn(state, number, sense).taken()) {
        travel.offset += sense;
        travel.stalled_since.reset();
        ++turns.moved;
      } else {
        ++travel.stalls;
        travel.stalled_since = travel.stalled_since.value_or(state.step);
        ++turns.stalled;
      }
    }
    turn_round(wall, travel);
  }
  return turns;
}

void oracle_wait(State& state, bool particles_moved) {
  for (Wall& wall : state.walls) {
    const auto* shake = wall.motion ? std::get_if<grains::Shake>(&wall.motion->program) : nullptr;
    Travel& travel = wall.travel;
    if (shake == nullptr || !wall.present || !travel.active ||
        travel.phase != Travel::Phase::waiting) {
      continue;
    }
    if (shake->wait ? travel.waited >= *shake->wait : !particles_moved) {
      ++travel.cycles;
      travel.phase = Travel::Phase::rising;
    }
    ++travel.waited;
  }
}

}  // namespace clca::testing
