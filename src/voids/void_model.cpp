// One step of the void model, as docs/voids.md has it.

#include "clca/voids/void_model.hpp"

#include <array>
#include <memory>
#include <utility>

#include "clca/random/draw.hpp"
#include "grains/internal/filling.hpp"
#include "grains/internal/one_site_steps.hpp"
#include "lattice/internal/require.hpp"

namespace clca::voids {

namespace {

/// From a grain to the voids that may claim it: straight down first.
constexpr std::array<lattice::Direction, 3> kDownward = {
    lattice::Direction::down, lattice::Direction::down_left, lattice::Direction::down_right};

/// Whether the void there claims a grain, by kDownward.
using Claims = std::array<bool, kDownward.size()>;
/// Weights of a grain for the voids below it, or of the grains above a void, by kDownward.
using Weights = std::array<std::uint64_t, kDownward.size()>;

std::uint64_t weight(double straight, double sieve) {
  require(straight >= 0 && straight <= 1 && sieve >= 0 && sieve <= 1,
          "a weight of the void model lies in [0, 1]");
  constexpr double kOne = 0x1p40;
  return static_cast<std::uint64_t>(straight * sieve * kOne);
}

class VoidMechanics final : public grains::OneSiteMechanics {
 public:
  VoidMechanics(grains::State initial, const Rules& rules, const Options& options)
      : OneSiteMechanics(std::move(initial), options) {
    for (const grains::Kind& kind : state().kinds) {
      require(rules.sieve_factors.empty() || kind.species < rules.sieve_factors.size(),
              "a species has no weight");
      const double sieve = rules.sieve_factors.empty() ? 1 : rules.sieve_factors[kind.species];
      const std::uint64_t beside = weight((1 - rules.straight_weight) / 2, sieve);
      weights_.push_back({weight(rules.straight_weight, sieve), beside, beside});
    }
  }

  bool advance(grains::StepReport& report) override {
    const std::vector<Claims> claims = this->claims();
    std::vector<std::pair<std::uint32_t, grains::Move>> moves;
    for (std::uint32_t id = 0; id < claims.size(); ++id) {
      if (const grains::Move move = granted_move(id, claims[id]); move != grains::kRest) {
        moves.emplace_back(id, move);
      }
    }
    this->move(moves, report);
    return moves.empty();
  }

 private:
  /// The owner of the site from which `downward` leads to this one.
  grains::Owner above(lattice::Site site, lattice::Direction downward) {
    return box().occupancy.owner(state().lattice.index(site + unit(opposite(downward))));
  }

  /// The voids that claim each grain, by id.
  std::vector<Claims> claims() {
    std::vector<Claims> result(state().particles.size());
    const lattice::Lattice& lattice = state().lattice;
    for (int column = 0; column < lattice.columns(); ++column) {
      for (int row = 0; row < lattice.rows(); ++row) {
        const lattice::Site site = {column, row};
        const grains::Owner grain =
            box().occupancy.is_taken(lattice.index(site)) ? grains::kFree : claimed_grain(site);
        for (std::size_t i = 0; grain != grains::kFree && i < kDownward.size(); ++i) {
          if (above(site, kDownward[i]) == grain) {
            result[grains::particle_id(grain)][i] = true;
          }
        }
      }
    }
    return result;
  }

  /// The grain that the void at this site claims: one of the three above it, in proportion to their
  /// weights. kFree if they have none.
  grains::Owner claimed_grain(lattice::Site site) {
    Weights weights{};
    for (std::size_t i = 0; i < kDownward.size(); ++i) {
      if (const grains::Owner grain = above(site, kDownward[i]); grains::is_particle(grain)) {
        weights[i] = weights_[state().particles[grains::particle_id(grain)].kind][i];
      }
    }
    if (weights == Weights{}) {
      return grains::kFree;
    }
    const auto item = static_cast<std::uint32_t>(state().lattice.index(site));
    const std::size_t chosen = grains::weighted_index(
        weights, random::draw(state().seed, state().step, item, random::Purpose::void_choice));
    return above(site, kDownward[chosen]);
  }

  /// Where a grain goes that these voids claim: straight down first; then by a coin.
  grains::Move granted_move(std::uint32_t id, const Claims& claims) {
    std::size_t chosen = claims[0] ? 0 : claims[1] ? 1 : 2;
    if (!claims[chosen]) {
      return grains::kRest;
    }
    if (chosen == 1 && claims[2]) {
      chosen += random::draw(state().seed, state().step, id, random::Purpose::void_coin) & 1U;
    }
    return static_cast<grains::Move>(kDownward[chosen]);
  }

  std::vector<Weights> weights_;  // by kind
};

}  // namespace

VoidModel::VoidModel(grains::State state, const Rules& rules, const Options& options)
    : Model(std::make_unique<VoidMechanics>(std::move(state), rules, options)) {}

}  // namespace clca::voids
