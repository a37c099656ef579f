// One step of the void model, as docs/voids.md has it.

#include "clca/voids/void_model.hpp"

#include <memory>
#include <utility>

#include "grains/internal/one_site_steps.hpp"
#include "voids/rule.hpp"

namespace clca::voids {

namespace {

class Steps final : public grains::OneSiteSteps {
 public:
  Steps(grains::State initial, const Rules& rules, const Options& options)
      : OneSiteSteps(std::move(initial), options), rule_(box(), rules) {}

  bool advance(grains::StepReport& report) override {
    const auto claims = this->claims();
    std::vector<std::pair<std::uint32_t, grains::Move>> moves;
    for (std::uint32_t id = 0; id < claims.size(); ++id) {
      if (const grains::Move move = rule_.granted(id, claims[id]); move != grains::kRest) {
        moves.emplace_back(id, move);
      }
    }
    this->move(moves, report);
    return moves.empty();
  }

 private:
  /// By id: which of the voids of kDownward claim the grain.
  std::vector<std::array<bool, kDownward.size()>> claims() {
    std::vector<std::array<bool, kDownward.size()>> result(state().particles.size());
    const lattice::Lattice& lattice = state().lattice;
    const grains::OccupancyTable& occupancy = box().occupancy;
    for (int column = 0; column < lattice.columns(); ++column) {
      for (int row = 0; row < lattice.rows(); ++row) {
        const lattice::Site site = {column, row};
        const grains::Owner grain =
            occupancy.taken(lattice.index(site)) ? grains::kFree : rule_.claimed(site);
        for (std::size_t i = 0; grain != grains::kFree && i < kDownward.size(); ++i) {
          if (occupancy.owner(lattice.index(site + unit(opposite(kDownward[i])))) == grain) {
            result[grains::particle_id(grain)][i] = true;
          }
        }
      }
    }
    return result;
  }

  Rule rule_;
};

}  // namespace

VoidModel::VoidModel(grains::State state, const Rules& rules, const Options& options)
    : Model(std::make_unique<Steps>(std::move(state), rules, options)) {}

}  // namespace clca::voids
