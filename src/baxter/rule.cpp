#include "baxter/rule.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>

#include "clca/random/draw.hpp"

namespace clca::baxter {

namespace {

using lattice::Direction;

constexpr std::array<Direction, 3> kDownward = {Direction::down, Direction::down_left,
                                                Direction::down_right};

constexpr std::size_t velocity_of(Direction direction) {
  return lattice::index_of(direction);
}

bool is_downward(std::size_t velocity) {
  return std::any_of(kDownward.begin(), kDownward.end(), [velocity](Direction direction) {
    return velocity_of(direction) == velocity;
  });
}

/// The angle in units of 60 degrees; from rest to any direction 1.
std::size_t distance(std::size_t one, std::size_t other) {
  if (one == grains::kRest || other == grains::kRest) {
    return one == other ? 0 : 1;
  }
  return static_cast<std::size_t>(
      lattice::turns_between(static_cast<Direction>(one), static_cast<Direction>(other)));
}

Energy power_of(Energy base, int power) {
  Energy result = 1;
  for (; power > 0; --power) {
    result *= base;
  }
  return result;
}

}  // namespace

Rule::Rule(const grains::Box& box, const Rules& rules) : box_(box) {
  if (!(rules.power >= 0 && rules.power <= kMaxPower && rules.gravity >= 0 &&
        rules.gravity <= kMaxGravity && rules.like_axes >= 0 && rules.like_axes <= 1)) {
    throw std::invalid_argument("a rule of the Baxter model is out of range");
  }
  const std::vector<grains::Kind>& kinds = box.state.kinds;
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    if (kinds.size() % kAxes != 0 || kinds[kind].species != kind / kAxes) {
      throw std::invalid_argument("a species of the Baxter model has a kind for each axis");
    }
  }
  // 0.1 + 0.1 distance, to the power, in 10^-power.
  for (std::size_t i = 0; i < unlike_velocities_.size(); ++i) {
    unlike_velocities_[i] = power_of(static_cast<Energy>(i) + 1, rules.power);
  }
  // One product each is rounded as IEEE 754 says: the same whole number on every machine.
  gravity_ = std::llround(rules.gravity * static_cast<double>(power_of(10, rules.power) * kUnit));
  like_axes_ = std::llround(rules.like_axes * static_cast<double>(kUnit));
}

bool Rule::is_free(lattice::Site site) const {
  return !box_.occupancy.taken(box_.state.lattice.index(site));
}

std::array<bool, kVelocities> Rule::open(lattice::Site site) const {
  std::array<bool, kVelocities> result = {};
  for (const Direction direction : lattice::kDirections) {
    result[velocity_of(direction)] = direction != Direction::up && is_free(site + unit(direction));
  }
  result[grains::kRest] = true;
  return result;
}

Rule::Energies Rule::neighbour_energies(lattice::Site site) const {
  Energies energies = {};
  for (const Direction direction : lattice::kDirections) {
    const grains::Owner owner =
        box_.occupancy.owner(box_.state.lattice.index(site + unit(direction)));
    if (!grains::is_particle(owner)) {
      continue;
    }
    const grains::Particle& neighbour = box_.state.particles[grains::particle_id(owner)];
    for (std::size_t velocity = 0; velocity < kVelocities; ++velocity) {
      const Energy energy = unlike_velocities_[distance(velocity, neighbour.previous)];
      for (std::uint16_t axis = 0; axis < kAxes; ++axis) {
        energies[velocity][axis] += energy * (axis == axis_of(neighbour) ? like_axes_ : kUnit);
      }
    }
  }
  return energies;
}

Choice Rule::choice(std::uint32_t id) const {
  const grains::Particle& grain = box_.state.particles[id];
  const std::array<bool, kVelocities> is_open = open(grain.site());
  const Energies energies = neighbour_energies(grain.site());
  const bool can_fall = is_open[velocity_of(Direction::down)];
  const bool can_descend =
      std::any_of(kDownward.begin(), kDownward.end(),
                  [&](Direction direction) { return is_open[velocity_of(direction)]; });
  // The least is chosen.
  const auto rank = [&grain](const Choice& choice) {
    return std::tuple(choice.energy, choice.velocity != grains::kRest,
                      choice.axis != axis_of(grain));
  };
  std::vector<Choice> least;
  for (std::size_t velocity = 0; velocity < kVelocities; ++velocity) {
    if (!is_open[velocity]) {
      continue;
    }
    const bool pays = (can_descend && !is_downward(velocity)) ||
                      (can_fall && velocity != velocity_of(Direction::down));
    for (std::uint16_t axis = 0; axis < kAxes; ++axis) {
      const Choice choice = {id, static_cast<grains::Move>(velocity), axis,
                             energies[velocity][axis] + (pays ? gravity_ : 0)};
      if (!least.empty() && rank(choice) < rank(least.front())) {
        least.clear();
      }
      if (least.empty() || rank(choice) == rank(least.front())) {
        least.push_back(choice);
      }
    }
  }
  if (least.size() == 1) {
    return least.front();
  }
  const std::uint64_t bits =
      random::draw(box_.state.seed, box_.state.step, id, random::Purpose::equal_energy);
  return least[random::below(bits, least.size())];
}

std::vector<Choice> Rule::winners(const std::vector<Choice>& choices) const {
  struct Claim {
    std::size_t site;
    Energy energy;
    std::uint64_t bits;
    const Choice* choice;
  };
  std::vector<Claim> claims;
  for (const Choice& choice : choices) {
    if (choice.velocity != grains::kRest) {
      const lattice::Site target =
          box_.state.particles[choice.id].site() + unit(static_cast<Direction>(choice.velocity));
      claims.push_back({box_.state.lattice.index(target), choice.energy,
                        random::draw(box_.state.seed, box_.state.step, choice.id,
                                     random::Purpose::contested_site),
                        &choice});
    }
  }
  const auto key = [](const Claim& claim) {
    return std::tuple(claim.site, claim.energy, claim.bits, claim.choice->id);
  };
  std::sort(claims.begin(), claims.end(),
            [&](const Claim& one, const Claim& other) { return key(one) < key(other); });
  std::vector<Choice> result;
  for (std::size_t i = 0; i < claims.size(); ++i) {
    if (i == 0 || claims[i].site != claims[i - 1].site) {
      result.push_back(*claims[i].choice);
    }
  }
  return result;
}

}  // namespace clca::baxter
