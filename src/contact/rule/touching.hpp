#pragma once
// Touching bodies, their normals and their order; how contacts persist between steps.

#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "clca/contact/state.hpp"
#include "grains/internal/box.hpp"

namespace clca::contact {

/// Sort key of a grain: from the top down, at equal height from the left.
std::int64_t order_key(const grains::State& state, lattice::Direction down, std::uint32_t id);

/// Whether the grain `one` is the upper one of two.
inline bool is_above(const grains::State& state, lattice::Direction down, std::uint32_t one,
                     std::uint32_t other) {
  return order_key(state, down, one) < order_key(state, down, other);
}

/// Contact normal of two grains, towards the first; none if they do not touch. `to_second`: from
/// the reference site of the first to that of the second.
/// Two hexagons or discs: the line of centres. Otherwise opposite to the sum of the directions in
/// which the second blocks the first.
std::optional<UnitVector> normal_between(const lattice::Shape& first, const lattice::Shape& second,
                                         lattice::Axial to_second);

/// Contact normals of all pairs of kinds and relative positions, each computed once.
class NormalTable {
 public:
  explicit NormalTable(const std::vector<grains::Kind>& kinds)
      : kinds_(kinds), tables_(kinds.size() * kinds.size()) {}

  /// normal_between() of the kinds; zero if they do not touch.
  UnitVector normal(std::uint16_t first, std::uint16_t second, lattice::Axial to_second) {
    PairTable& table = tables_[first * kinds_.size() + second];
    if (table.normals.empty()) {
      table = PairTable(kinds_[first].shape, kinds_[second].shape);
    }
    const lattice::Axial at = to_second - table.low;
    if (at.x < 0 || at.q < 0 || at.x >= table.size.x || at.q >= table.size.q) {
      return {};
    }
    UnitVector& normal =
        table.normals[static_cast<std::size_t>(at.x) * static_cast<std::size_t>(table.size.q) +
                      static_cast<std::size_t>(at.q)];
    if (normal == kUnknown) {
      normal = normal_between(kinds_[first].shape, kinds_[second].shape, to_second)
                   .value_or(UnitVector());
    }
    return normal;
  }

 private:
  static constexpr UnitVector kUnknown = {1, 1};  // not computed yet; no unit vector

  /// Normals of two kinds, for each vector between their reference sites at which they overlap or
  /// touch, and for some around these.
  struct PairTable {
    PairTable() = default;  ///< empty
    PairTable(const lattice::Shape& first, const lattice::Shape& second);

    lattice::Axial low;   ///< the first vector
    lattice::Axial size;  ///< how many x and how many q
    std::vector<UnitVector> normals;
  };

  const std::vector<grains::Kind>& kinds_;
  std::vector<PairTable> tables_;  // by first kind, then by second
};

/// A contact in a step.
struct StepContact {
  Contact contact = {};              ///< with its present normal, and the impulses of the last step
  lattice::Axial to_other = {};      ///< from the upper grain to the other; 0 for a wall or side
  std::int32_t bounce_velocity = 0;  ///< the velocity with which its bodies are to separate

  /// Order of contacts: by the upper grain, then by the vector to the other one.
  using Key = std::tuple<std::int64_t, lattice::Axial, grains::Owner>;
  Key key(const grains::State& state, lattice::Direction down) const {
    return {order_key(state, down, contact.upper), to_other, contact.other};
  }
};

/// The bodies of a contact, the lower id of two grains first, whichever is the upper one.
inline std::pair<grains::Owner, grains::Owner> sorted_bodies(std::uint32_t upper,
                                                             grains::Owner other) {
  const auto id = grains::as_owner(upper);
  return grains::is_particle(other) && other < id ? std::pair(other, id) : std::pair(id, other);
}

/// Velocities of walls, by number.
using WallVelocities = std::vector<Velocity<>>;

/// All contacts of the grains where they are, without impulses.
std::vector<StepContact> all_contacts(const grains::Box& box, lattice::Direction down,
                                      NormalTable& normals, const WallVelocities& walls);

/// Adds the contacts of a grain with walls and sides to `touches`, sorted by `other`: one with each
/// surface that they form around it; where bodies of a surface differ in velocity, one for each.
/// Returns how many walls and sides the grain touches.
std::size_t add_wall_contacts(const grains::Box& box, std::uint32_t id, const WallVelocities& walls,
                              std::vector<StepContact>& touches);

/// For each earlier contact with a wall or side, the contact that continues it (null: it ends): of
/// the same grain, with the most similar normal, at most 45 degrees apart. Wall to wall and side to
/// side are matched first. Equal normals prefer the same body.
std::vector<const StepContact*> successors(std::span<const Contact> before,
                                           std::span<const StepContact> now);

/// The impulses of a contact whose grains have swapped: the rolling one changes its sign.
inline Impulse<> with_bodies_swapped(Impulse<> impulse) {
  impulse.rolling *= -1;
  return impulse;
}

/// The contacts of `before` that still touch, in order, followed by new ones.
/// `sorted`: sorts all anew. A pair keeps its impulses if upper and lower body swap.
std::vector<StepContact> next_contacts(const grains::State& state,
                                       const std::vector<Contact>& before,
                                       const std::vector<StepContact>& now, lattice::Direction down,
                                       bool sorted);

/// Whether a step sorts the contacts anew.
inline bool is_sorting_step(const State& state) {
  constexpr std::uint64_t kEvery = 8;
  return state.changed || state.grains.step % kEvery == 0;
}

}  // namespace clca::contact
