// One step of the Baxter model, as docs/baxter.md has it.

#include "clca/baxter/baxter_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <tuple>
#include <utility>

#include "clca/random/draw.hpp"
#include "grains/internal/one_site_steps.hpp"
#include "lattice/internal/require.hpp"

namespace clca::baxter {

namespace {

/// Energies are whole numbers: 1 is 10^-power / kUnit of the energies in docs/baxter.md.
using Energy = std::int64_t;
constexpr Energy kUnit = Energy{1} << 20U;

/// Number of velocities: those of grains::Move.
constexpr std::size_t kVelocities = lattice::kDirectionCount + 1;

/// The velocity and axis that a grain chooses, with their energy.
struct Choice {
  std::uint32_t id = 0;
  grains::Move velocity = grains::kRest;
  std::uint16_t axis = 0;
  Energy energy = 0;
};

using lattice::Direction;

constexpr std::array<Direction, 3> kDownward = {Direction::down, Direction::down_left,
                                                Direction::down_right};

bool is_downward(std::size_t velocity) {
  return std::ranges::any_of(
      kDownward, [velocity](Direction direction) { return index_of(direction) == velocity; });
}

/// The angle between two velocities in units of 60 degrees; from rest to any direction 1.
std::size_t velocity_distance(std::size_t one, std::size_t other) {
  if (one == grains::kRest || other == grains::kRest) {
    return one == other ? 0 : 1;
  }
  return static_cast<std::size_t>(
      lattice::sixths_between(static_cast<Direction>(one), static_cast<Direction>(other)));
}

Energy power_of(Energy base, int power) {
  Energy result = 1;
  for (; power > 0; --power) {
    result *= base;
  }
  return result;
}

/// Pure: a choice depends on the state when the step begins and the draws of its grain.
class Rule {
 public:
  Rule(const grains::Box& box, const Rules& rules) : box_(box) {
    require(rules.exponent >= 0 && rules.exponent <= kMaxPower && rules.gravity >= 0 &&
                rules.gravity <= kMaxGravity && rules.like_axes_factor >= 0 &&
                rules.like_axes_factor <= 1,
            "a rule of the Baxter model is out of range");
    const std::vector<grains::Kind>& kinds = box.state.kinds;
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
      require(kinds.size() % kAxisCount == 0 && kinds[kind].species == kind / kAxisCount,
              "a species of the Baxter model has a kind for each axis");
    }
    // 0.1 + 0.1 distance, to the power, in 10^-power.
    for (std::size_t i = 0; i < unlike_velocities_.size(); ++i) {
      unlike_velocities_[i] = power_of(static_cast<Energy>(i) + 1, rules.exponent);
    }
    // One product each is rounded as IEEE 754 says: the same whole number on every machine.
    gravity_ =
        std::llround(rules.gravity * static_cast<double>(power_of(10, rules.exponent) * kUnit));
    like_axes_ = std::llround(rules.like_axes_factor * static_cast<double>(kUnit));
  }

  /// Velocity and axis of least energy. Of equal ones: rest, then the axis it has, then a draw.
  Choice choice(std::uint32_t id) const {
    const grains::Particle& grain = box_.state.particles[id];
    const std::array<bool, kVelocities> is_open = open_velocities(grain.site());
    const Energies energies = neighbour_energies(grain.site());
    const bool can_fall = is_open[index_of(Direction::down)];
    const bool can_descend = std::ranges::any_of(
        kDownward, [&](Direction direction) { return is_open[index_of(direction)]; });
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
                        (can_fall && velocity != index_of(Direction::down));
      for (std::uint16_t axis = 0; axis < kAxisCount; ++axis) {
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
    return least[random::uniform_below(bits, least.size())];
  }

  /// Those of the choices that move: of several that want one site, the one of least energy, and of
  /// equal ones a draw decides.
  std::vector<Choice> winners(const std::vector<Choice>& choices) const {
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
    std::ranges::sort(claims, {}, key);
    std::vector<Choice> result;
    for (std::size_t i = 0; i < claims.size(); ++i) {
      if (i == 0 || claims[i].site != claims[i - 1].site) {
        result.push_back(*claims[i].choice);
      }
    }
    return result;
  }

 private:
  using Energies = std::array<std::array<Energy, kAxisCount>, kVelocities>;

  /// The velocities that a grain may choose.
  std::array<bool, kVelocities> open_velocities(lattice::Site site) const {
    std::array<bool, kVelocities> result = {};
    for (const Direction direction : lattice::kDirections) {
      result[index_of(direction)] =
          direction != Direction::up &&
          !box_.occupancy.is_taken(box_.state.lattice.index(site + unit(direction)));
    }
    result[grains::kRest] = true;
    return result;
  }

  /// Energies by velocity and axis that the neighbours alone give.
  Energies neighbour_energies(lattice::Site site) const {
    Energies energies = {};
    for (const Direction direction : lattice::kDirections) {
      const grains::Owner owner =
          box_.occupancy.owner(box_.state.lattice.index(site + unit(direction)));
      if (!grains::is_particle(owner)) {
        continue;
      }
      const grains::Particle& neighbour = box_.state.particles[grains::particle_id(owner)];
      for (std::size_t velocity = 0; velocity < kVelocities; ++velocity) {
        const Energy energy = unlike_velocities_[velocity_distance(velocity, neighbour.previous)];
        for (std::uint16_t axis = 0; axis < kAxisCount; ++axis) {
          energies[velocity][axis] += energy * (axis == axis_of(neighbour) ? like_axes_ : kUnit);
        }
      }
    }
    return energies;
  }

  const grains::Box& box_;
  std::array<Energy, 4> unlike_velocities_ = {};  // energies by velocity_distance()
  Energy gravity_ = 0;
  Energy like_axes_ = 0;  // in units of kUnit
};

class BaxterMechanics final : public grains::OneSiteMechanics {
 public:
  BaxterMechanics(grains::State initial, const Rules& rules, const Options& options)
      : OneSiteMechanics(std::move(initial), options), rule_(box(), rules) {}

  bool advance(grains::StepReport& report) override {
    std::vector<grains::Particle>& particles = state().particles;
    std::vector<Choice> choices;
    bool changed = false;
    for (std::uint32_t id = 0; id < particles.size(); ++id) {
      if (particles[id].present) {
        choices.push_back(rule_.choice(id));
        changed = changed || particles[id].previous != grains::kRest;
      }
    }
    const std::vector<Choice> winners = rule_.winners(choices);

    const auto set_axis = [&](const Choice& choice) {
      grains::Particle& grain = particles[choice.id];
      changed = changed || choice.axis != axis_of(grain);
      grain.kind = static_cast<std::uint16_t>(grain.kind - axis_of(grain) + choice.axis);
    };
    for (const Choice& choice : choices) {
      if (choice.velocity == grains::kRest) {
        set_axis(choice);
      }
    }
    std::vector<std::pair<std::uint32_t, grains::Move>> moves;
    for (const Choice& choice : winners) {
      set_axis(choice);
      moves.emplace_back(choice.id, choice.velocity);
    }
    this->move(moves, report);
    return moves.empty() && !changed;
  }

 private:
  Rule rule_;
};

}  // namespace

std::vector<grains::Kind> kinds_along_axes(std::uint16_t species) {
  return std::vector<grains::Kind>(kAxisCount, {lattice::Shape::hexagon(0), species});
}

BaxterModel::BaxterModel(grains::State state, const Rules& rules, const Options& options)
    : Model(std::make_unique<BaxterMechanics>(std::move(state), rules, options)) {}

}  // namespace clca::baxter
