#include "support/difference.hpp"

#include <algorithm>
#include <sstream>

namespace clca::testing {

using grains::Particle;
using grains::Push;
using grains::State;
using grains::Wall;

namespace {

std::ostream& operator<<(std::ostream& out, const Particle& particle) {
  return out << "kind " << particle.kind << " at [" << particle.column << ", " << particle.row
             << "] did " << int{particle.previous} << (particle.present ? "" : ", gone");
}

std::ostream& operator<<(std::ostream& out, const Wall& wall) {
  return out << "offset " << wall.travel.offset << " clock " << wall.travel.clock << " stalls "
             << wall.travel.stalls << " waited " << wall.travel.waited;
}

std::ostream& operator<<(std::ostream& out, const Push& push) {
  return out << push.pusher << " on " << push.pushed << " from wall " << push.source << " along "
             << static_cast<int>(push.direction);
}

template <class Item>
void compare(std::ostream& out, const char* name, const std::vector<Item>& found,
             const std::vector<Item>& expected) {
  for (std::size_t i = 0; i < std::min(found.size(), expected.size()); ++i) {
    if (!(found[i] == expected[i])) {
      out << name << ' ' << i << ": " << found[i] << "; expected " << expected[i] << '\n';
    }
  }
  if (found.size() != expected.size()) {
    out << found.size() << ' ' << name << "s; expected " << expected.size() << '\n';
  }
}

}  // namespace

std::string difference(const State& found, const State& expected) {
  std::ostringstream out;
  compare(out, "wall", found.walls, expected.walls);
  compare(out, "particle", found.particles, expected.particles);
  compare(out, "push", found.pushes, expected.pushes);
  if (out.str().empty() && !(found == expected)) {
    out << "something else differs";
  }
  return out.str();
}

}  // namespace clca::testing
