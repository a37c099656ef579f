#include "automaton/update_order.hpp"

#include "clca/random/draw.hpp"

namespace clca::automaton {

UpdateOrder::UpdateOrder(const Rules& rules, std::uint64_t seed) : rules_(rules), seed_(seed) {
  // All six: a push may lead where nobody goes by itself.
  Rules all = rules;
  all.candidates = Candidates::all;
  std::uint64_t place = 0;
  for (const lattice::Direction direction : candidate_directions(all)) {
    place_[index_of(direction)] = place++;
  }
}

UpdateKey UpdateOrder::key(std::uint32_t id, grains::Move previous, grains::Move move,
                           std::uint64_t step) const {
  const std::uint64_t rank = class_rank(previous, move);
  const std::uint64_t tie = rules_.ties == Ties::particle
                                ? random::draw(seed_, step, id, random::Purpose::tie)
                                : direction_tie(move, rank, step);
  return {rank, tie, id};
}

std::uint64_t UpdateOrder::class_rank(grains::Move previous, grains::Move move) const {
  for (std::uint64_t rank = 0; rank < rules_.update_priority.size(); ++rank) {
    const UpdateClass wanted = rules_.update_priority[rank];
    if ((wanted == UpdateClass::rest && previous == grains::kRest) ||
        (wanted == UpdateClass::inertia && previous == move) ||
        (wanted == UpdateClass::gravity && move == static_cast<grains::Move>(rules_.gravity))) {
      return rank;
    }
  }
  return rules_.update_priority.size();
}

std::uint64_t UpdateOrder::direction_tie(grains::Move move, std::uint64_t rank,
                                         std::uint64_t step) const {
  const std::uint64_t place = place_[move];
  const bool has_twin = place != 0 && place != lattice::kDirectionCount - 1;
  if (!has_twin) {
    return place;
  }
  const auto coin =
      random::draw(seed_, step, static_cast<std::uint32_t>(rank), random::Purpose::direction_order);
  // Twins stand at places 1, 2 and 3, 4: tails swaps them.
  const bool swapped = (coin & 1U) != 0;
  const std::uint64_t twin = ((place - 1) ^ 1U) + 1;
  return swapped ? twin : place;
}

}  // namespace clca::automaton
