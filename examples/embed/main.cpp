// Lets 200 hexagons, small and large, fall into a box until nothing moves any more.

#include <array>
#include <clca/automaton/automaton.hpp>
#include <cstdio>
#include <cstdlib>
#include <exception>

namespace automaton = clca::automaton;
namespace grains = clca::grains;
namespace lattice = clca::lattice;

namespace {

constexpr double kWidth = 60;    // lattice spacings
constexpr double kHeight = 120;  // lattice spacings
constexpr std::array<std::size_t, 2> kCounts = {100, 100};

grains::State empty_box() {
  grains::State state{.lattice = lattice::Lattice::covering(kWidth, kHeight, false)};
  state.seed = 2001;
  state.kinds = {{.shape = lattice::Shape::hexagon(1), .species = 0},
                 {.shape = lattice::Shape::hexagon(2), .species = 1}};
  return state;
}

}  // namespace

int main() try {
  automaton::Automaton box(empty_box());
  const lattice::Rectangle everywhere = {.right = kWidth, .top = kHeight};
  if (!box.fill(everywhere, kCounts).complete) {
    std::fputs("the particles do not fit into the box\n", stderr);
    return EXIT_FAILURE;
  }
  while (!box.step().settled) {
  }

  const grains::State& state = box.state();
  std::printf("%zu particles settled after %llu steps, state hash %016llx\n",
              grains::present_count(state), static_cast<unsigned long long>(state.step),
              static_cast<unsigned long long>(grains::hash(state)));
  return EXIT_SUCCESS;
} catch (const std::exception& error) {
  std::fprintf(stderr, "error: %s\n", error.what());
  return EXIT_FAILURE;
}
