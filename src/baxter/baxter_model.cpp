// One step of the Baxter model, as docs/baxter.md has it.

#include "clca/baxter/baxter_model.hpp"

#include <memory>
#include <utility>

#include "baxter/rule.hpp"
#include "grains/internal/one_site_steps.hpp"

namespace clca::baxter {

namespace {

class Steps final : public grains::OneSiteSteps {
 public:
  Steps(grains::State initial, const Rules& rules, const Options& options)
      : OneSiteSteps(std::move(initial), options), rule_(box(), rules) {}

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

    const auto turn = [&](const Choice& choice) {
      grains::Particle& grain = particles[choice.id];
      changed = changed || choice.axis != axis_of(grain);
      grain.kind = static_cast<std::uint16_t>(grain.kind - axis_of(grain) + choice.axis);
    };
    for (const Choice& choice : choices) {
      if (choice.velocity == grains::kRest) {
        turn(choice);
      }
    }
    std::vector<std::pair<std::uint32_t, grains::Move>> moves;
    for (const Choice& choice : winners) {
      turn(choice);
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
  return std::vector<grains::Kind>(kAxes, {lattice::Shape::hexagon(0), species});
}

BaxterModel::BaxterModel(grains::State state, const Rules& rules, const Options& options)
    : Model(std::make_unique<Steps>(std::move(state), rules, options)) {}

}  // namespace clca::baxter
