// Lets 60 hexagons fall into a box by the contact model, with all parameters as they are by
// default, until they have come to rest.

#include <array>
#include <clca/contact/contact_model.hpp>
#include <clca/contact/force.hpp>
#include <cstdio>
#include <cstdlib>
#include <exception>

namespace contact = clca::contact;
namespace lattice = clca::lattice;

namespace {

constexpr double kWidth = 30;   // lattice spacings
constexpr double kHeight = 60;  // lattice spacings
constexpr std::array<std::size_t, 1> kCounts = {60};

contact::State empty_box() {
  contact::State state{.grains = {.lattice = lattice::Lattice::covering(kWidth, kHeight, false)}};
  state.grains.seed = 2001;
  state.grains.kinds = {{.shape = lattice::Shape::hexagon(1), .species = 0}};
  return state;
}

}  // namespace

int main() try {
  contact::ContactModel box(empty_box(), contact::Parameters());
  if (!box.fill({.right = kWidth, .top = kHeight}, kCounts).complete) {
    std::fputs("the grains do not fit into the box\n", stderr);
    return EXIT_FAILURE;
  }
  const double before = contact::energy(box.state(), box.gravity()).potential;
  while (!box.step().settled) {
  }

  const contact::State& state = box.state();
  std::printf("%zu grains at rest after %llu steps, %zu contacts, %.0f %% of the energy lost\n",
              state.velocities.size(), static_cast<unsigned long long>(state.grains.step),
              contact::forces(state, box.gravity()).size(),
              100 * (1 - contact::energy(state, box.gravity()).potential / before));
  return EXIT_SUCCESS;
} catch (const std::exception& error) {
  std::fprintf(stderr, "error: %s\n", error.what());
  return EXIT_FAILURE;
}
