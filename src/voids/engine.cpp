#include "voids/engine.hpp"

#include <algorithm>
#include <utility>

namespace clca::voids {

namespace {

/// Fewer grains are not worth a thread.
constexpr std::size_t kPerThread = 1024;

}  // namespace

Engine::Engine(grains::State initial, const Rules& rules, const Options& options)
    : Steps(std::move(initial), rules),
      threads_{.count = options.threads,
               .min_per_thread = options.parallel_from.value_or(kPerThread)},
      found_(threads_) {
  wake_from(0);
}

void Engine::wake_from(std::size_t first) {
  is_awake_.resize(state().particles.size());
  for (std::size_t id = first; id < state().particles.size(); ++id) {
    wake(static_cast<std::uint32_t>(id));
  }
}

void Engine::wake(std::uint32_t id) {
  if (!is_awake_[id]) {
    is_awake_[id] = true;
    awake_.push_back(id);
  }
}

void Engine::vacated(lattice::Site site) {
  for (const lattice::Direction direction : kDownward) {
    const grains::Owner above =
        box().occupancy.owner(state().lattice.index(site + unit(opposite(direction))));
    if (grains::is_particle(above)) {
      wake(grains::particle_id(above));
    }
  }
}

bool Engine::can_move(const grains::Particle& grain) const {
  return grain.present &&
         std::any_of(kDownward.begin(), kDownward.end(), [&](lattice::Direction direction) {
           return !box().occupancy.taken(state().lattice.index(grain.site() + unit(direction)));
         });
}

grains::Move Engine::granted_move(std::uint32_t id) const {
  const lattice::Site site = state().particles[id].site();
  std::array<bool, kDownward.size()> claims{};
  for (std::size_t i = 0; i < kDownward.size(); ++i) {
    const lattice::Site below = site + unit(kDownward[i]);
    claims[i] = !box().occupancy.taken(state().lattice.index(below)) &&
                rule().claimed(below) == grains::as_owner(id);
  }
  return rule().granted(id, claims);
}

std::vector<GrainMove> Engine::granted_moves() {
  awake_.erase(std::remove_if(awake_.begin(), awake_.end(),
                              [this](std::uint32_t id) {
                                is_awake_[id] = can_move(state().particles[id]);
                                return !is_awake_[id];
                              }),
               awake_.end());
  found_.clear();
  parallel::split(threads_, awake_.size(),
                  [this](std::size_t part, std::size_t first, std::size_t last) {
                    std::vector<GrainMove>& found = found_.of(part);
                    for (std::size_t i = first; i < last; ++i) {
                      const grains::Move move = granted_move(awake_[i]);
                      if (move != grains::kRest) {
                        found.push_back({awake_[i], move});
                      }
                    }
                  });
  std::vector<GrainMove> moves;
  found_.for_each([&](const GrainMove& move) { moves.push_back(move); });
  return moves;
}

}  // namespace clca::voids
