// Fills that end where nothing more fits, or at a level.

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "clca/automaton/automaton.hpp"
#include "clca/lattice/region.hpp"

namespace clca::grains::mixture_test {
namespace {

using automaton::Automaton;

State box(int columns, int rows) {
  State state{.lattice = lattice::Lattice(columns, rows, false), .seed = 7};
  state.kinds = {{lattice::Shape::hexagon(1), 0}, {lattice::Shape::hexagon(2), 1}};
  return state;
}

/// Mean height of the highest taken site of the columns.
double surface(const Automaton& automaton) {
  const lattice::Lattice& lattice = automaton.state().lattice;
  const Occupancy occupancy(automaton.state());
  double sum = 0;
  for (int column = 0; column < lattice.columns(); ++column) {
    int row = lattice.rows() - 1;
    while (row >= 0 && !occupancy.is_taken(lattice.index({column, row}))) {
      --row;
    }
    sum += lattice::position(lattice::Site{column, row}).y();
  }
  return sum / lattice.columns();
}

const lattice::Rectangle kAll = {0, 0, 200, 100};

TEST(Mixture, FillsUntilTheNextParticleHasNoRoomInItsProportions) {
  for (const bool deposited : {false, true}) {
    Automaton automaton(box(150, 100));
    const FillResult result =
        automaton.fill(kAll, Mixture{.part_weights = {{3, 1}}, .deposited = deposited});
    EXPECT_TRUE(result.complete);
    const auto small = static_cast<double>(result.placed_by_species[0]);
    const auto large = static_cast<double>(result.placed_by_species[1]);
    const double share = small / (small + large);
    EXPECT_NEAR(share, 0.75, 4 * std::sqrt(0.75 * 0.25 / (small + large)));
    const double filling = (7 * small + 19 * large) / (150.0 * 100);
    EXPECT_GT(filling, deposited ? 0.7 : 0.45);
    EXPECT_EQ(Occupancy(automaton.state()), automaton.occupancy());
  }
}

TEST(Mixture, EndsAtItsLevel) {
  Automaton automaton(box(150, 100));
  automaton.fill(kAll, Mixture{.part_weights = {{1, 1}}, .deposited = true, .surface_level = 40});
  EXPECT_NEAR(surface(automaton), 40, 0.2);  // a particle raises the mean by less
  EXPECT_GE(surface(automaton), 40);
}

TEST(Mixture, LiesInThePartsOfItsPicture) {
  for (const bool deposited : {false, true}) {
    Automaton automaton(box(150, 100));
    automaton.fill(kAll, Mixture{.part_weights = {{1, 0}, {0, 1}},
                                 .picture_rows = {"....", "ABA.", "BABA"},
                                 .deposited = deposited});
    const State& state = automaton.state();
    EXPECT_GT(state.particles.size(), 100U);
    const lattice::Picture picture = {.box = kAll, .rows = {"....", "ABA.", "BABA"}};
    for (const Particle& particle : state.particles) {
      EXPECT_EQ(lattice::pixel_at(picture, lattice::position(particle.site())),
                particle.kind == 0 ? 'A' : 'B');
    }
    EXPECT_EQ(Occupancy(state), automaton.occupancy());
    if (deposited) {
      EXPECT_TRUE(automaton.step().settled);
    }
  }
}

TEST(Mixture, NeedsWeightsForEachSpeciesAndAPictureForSeveralParts) {
  for (const Mixture& wrong :
       {Mixture{}, Mixture{.part_weights = {{1}}}, Mixture{.part_weights = {{0, 0}}},
        Mixture{.part_weights = {{1, 0}, {0, 1}}},
        Mixture{.part_weights = {{1, 1}}, .picture_rows = {"A", ""}}}) {
    Automaton fresh(box(20, 20));
    EXPECT_THROW(fresh.fill(kAll, wrong), std::invalid_argument);
    EXPECT_NO_THROW(fresh.fill(kAll, Mixture{.part_weights = {{1, 1}}}))
        << "after what was refused";
  }
}

}  // namespace
}  // namespace clca::grains::mixture_test
