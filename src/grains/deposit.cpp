#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "clca/random/draw.hpp"
#include "grains/internal/filling.hpp"

namespace clca::grains {

namespace {

using lattice::Direction;

/// Integers from `low` to `high`, inclusive.
struct IntegerRange {
  int low = 0;
  int high = -1;

  bool contains(int value) const { return value >= low && value <= high; }
  int count() const { return high - low + 1; }
};

/// The lowest and the highest site of a kind in one of the columns it covers.
struct ColumnEnds {
  lattice::Axial bottom;
  lattice::Axial top;
};

/// Where the reference site of a kind may stand so that all its sites lie in the region.
struct Room {
  IntegerRange columns;
  std::array<IntegerRange, 2> rows;  ///< in even and odd columns
  std::vector<ColumnEnds> ends_by_column;

  bool contains(lattice::Site site) const {
    return columns.contains(site.column) &&
           rows[lattice::is_odd(site.column) ? 1 : 0].contains(site.row);
  }
};

std::vector<ColumnEnds> ends_by_column_of(const lattice::Shape& shape) {
  std::vector<ColumnEnds> ends_by_column;
  for (const lattice::Axial offset : shape.sites()) {  // sorted by x, then q
    if (ends_by_column.empty() || ends_by_column.back().bottom.x != offset.x) {
      ends_by_column.push_back({offset, offset});
    }
    ends_by_column.back().top = offset;
  }
  return ends_by_column;
}

/// The integers from 0 to below `end` for which `inside` holds; they are consecutive.
template <class Inside>
IntegerRange range_where(int end, Inside inside) {
  int low = 0;
  while (low < end && !inside(low)) {
    ++low;
  }
  int after = low;
  while (after < end && inside(after)) {
    ++after;
  }
  return {low, after - 1};
}

/// Whether a particle may come to rest at a site.
using Accept = std::function<bool(lattice::Site)>;

class Deposit {
 public:
  Deposit(Box& box, const lattice::Rectangle& region)
      : box_(box), state_(box.state), region_(region) {
    const State& state = box.state;
    rooms_.reserve(state.kinds.size());
    for (const Kind& kind : state.kinds) {
      rooms_.push_back(room_of(kind.shape));
    }
    surface_.resize(static_cast<std::size_t>(state.lattice.columns()));
    for (int column = 0; column < state.lattice.columns(); ++column) {
      const int top = highest_taken(column);
      surface_[static_cast<std::size_t>(column)] = top + 1;
      if (in_region(column)) {
        height_sum_ += lattice::position(lattice::Site{column, top}).y();
        ++column_count_;
      }
    }
  }

  /// Mean over the columns of the region of the highest taken site, in lattice spacings.
  double level() const { return height_sum_ / column_count_; }

  /// Returns false and changes nothing if there is no column where it fits and comes to rest at a
  /// site that is accepted.
  bool place(std::uint16_t kind, const Accept& accept) {
    const Room& room = rooms_[kind];
    const std::uint32_t id = next_id(state_);
    if (room.columns.count() <= 0) {
      return false;
    }
    const auto columns = static_cast<std::uint64_t>(room.columns.count());
    const std::uint64_t drawn = random::uniform_below(
        random::draw(state_.seed, 0, id, random::Purpose::deposit_column), columns);
    for (std::uint64_t tried = 0; tried < columns; ++tried) {
      box_.check_interruption();
      const int column = room.columns.low + static_cast<int>((drawn + tried) % columns);
      if (const auto start = landing(room, column)) {
        Particle particle = {.column = column, .row = *start, .kind = kind};
        roll_down(particle, id);
        if (!accept({state_.lattice.wrapped(particle.column), particle.row})) {
          continue;
        }
        insert(box_, particle);
        raise_surface(particle);
        return true;
      }
    }
    return false;
  }

 private:
  bool in_region(int column) const {
    const double x = lattice::position(lattice::Site{column, 0}).x();
    return x >= region_.left && x < region_.right;
  }

  Room room_of(const lattice::Shape& shape) const {
    Room room;
    room.ends_by_column = ends_by_column_of(shape);
    const lattice::Lattice& lattice = state_.lattice;
    const auto fits_across = [&](int column) {
      return std::ranges::all_of(room.ends_by_column, [&](const ColumnEnds& ends) {
        const int at = lattice.wrapped(column + ends.bottom.x);
        return at >= 0 && at < lattice.columns() && in_region(at);
      });
    };
    room.columns = range_where(lattice.columns(), fits_across);
    for (const int parity : {0, 1}) {
      const auto fits_up = [&](int row) {
        return std::ranges::all_of(shape.sites(), [&](lattice::Axial offset) {
          const lattice::Site site = lattice::Site{parity, row} + offset;
          const double y = lattice::position(site).y();
          return site.row >= 0 && site.row < lattice.rows() && y >= region_.bottom &&
                 y < region_.top;
        });
      };
      room.rows[static_cast<std::size_t>(parity)] = range_where(lattice.rows(), fits_up);
    }
    return room;
  }

  /// Highest taken row below the top of the region; -1 if there is none.
  int highest_taken(int column) const {
    int row = state_.lattice.rows() - 1;
    while (row >= 0 && (lattice::position(lattice::Site{column, row}).y() >= region_.top ||
                        !box_.occupancy.is_taken(state_.lattice.index({column, row})))) {
      --row;
    }
    return row;
  }

  std::size_t surface_column(int column) const {
    return static_cast<std::size_t>(state_.lattice.wrapped(column));
  }

  /// The lowest row of the column in which the particle is above everything that lies there; none
  /// above the region.
  std::optional<int> landing(const Room& room, int column) const {
    const IntegerRange& rows = room.rows[lattice::is_odd(column) ? 1 : 0];
    int lowest = rows.low;
    for (const ColumnEnds& ends : room.ends_by_column) {
      const int bottom = (lattice::Site{column, 0} + ends.bottom).row;
      lowest = std::max(lowest, surface_[surface_column(column + ends.bottom.x)] - bottom);
    }
    return lowest <= rows.high ? std::optional(lowest) : std::nullopt;
  }

  bool is_free(const Particle& particle, Direction direction) const {
    lattice::Site target = particle.site() + unit(direction);
    target.column = state_.lattice.wrapped(target.column);
    return rooms_[particle.kind].contains(target) && box_.is_free(particle, direction);
  }

  void roll_down(Particle& particle, std::uint32_t id) const {
    std::uint64_t flips = 0;
    while (const auto direction = way_down(particle, id, flips)) {
      particle = after_step(particle, *direction);
    }
  }

  /// Down if free, else a free side, each with equal probability. None at rest. `flips`: random
  /// bits that the particle has used.
  std::optional<Direction> way_down(const Particle& particle, std::uint32_t id,
                                    std::uint64_t& flips) const {
    if (is_free(particle, Direction::down)) {
      return Direction::down;
    }
    const bool right = is_free(particle, Direction::down_right);
    const bool left = is_free(particle, Direction::down_left);
    if (!right && !left) {
      return std::nullopt;
    }
    bool to_right = right;
    if (right && left) {
      constexpr std::uint64_t kBits = 64;  // of a draw
      const std::uint64_t bits =
          random::draw(state_.seed, flips / kBits, id, random::Purpose::deposit_coin);
      to_right = ((bits >> (flips % kBits)) & 1U) != 0;
      ++flips;
    }
    return to_right ? Direction::down_right : Direction::down_left;
  }

  void raise_surface(const Particle& particle) {
    for (const ColumnEnds& ends : rooms_[particle.kind].ends_by_column) {
      int& surface = surface_[surface_column(particle.column + ends.top.x)];
      const int raised = std::max(surface, (particle.site() + ends.top).row + 1);
      height_sum_ += raised - surface;  // a particle covers columns of the region only
      surface = raised;
    }
  }

  Box& box_;
  const State& state_;
  lattice::Rectangle region_;
  std::vector<Room> rooms_;   // of each kind
  std::vector<int> surface_;  // of each column: above the highest taken row
  // Of the region: the sum over its columns of the highest taken sites, and their number.
  double height_sum_ = 0;
  double column_count_ = 0;
};

/// In a random orientation, or the next one that fits.
bool place_one(Deposit& deposit, const State& state, const std::vector<std::uint16_t>& kinds,
               const Accept& accept) {
  const std::uint64_t drawn = random::uniform_below(
      random::draw(state.seed, 0, next_id(state), random::Purpose::deposit_kind), kinds.size());
  for (std::size_t tried = 0; tried < kinds.size(); ++tried) {
    if (deposit.place(kinds[(drawn + tried) % kinds.size()], accept)) {
      return true;
    }
  }
  return false;
}

}  // namespace

FillResult deposit_region(Box& box, const lattice::Rectangle& region,
                          std::span<const std::size_t> counts) {
  State& state = box.state;
  const std::size_t first = state.particles.size();
  std::vector<std::size_t> left(counts.begin(), counts.end());
  std::uint64_t all_left = std::accumulate(left.begin(), left.end(), std::uint64_t{0});
  state.particles.reserve(first + all_left);
  state.origins.reserve(first + all_left);
  FillResult result{.placed_by_species = std::vector<std::size_t>(counts.size(), 0),
                    .complete = true};
  Deposit deposit(box, region);
  while (all_left > 0) {
    const std::size_t species = draw_species(state, left);
    if (place_one(deposit, state, kinds_of(state, species), [](lattice::Site) { return true; })) {
      ++result.placed_by_species[species];
      --left[species];
      --all_left;
    } else {  // nor will it fit later: the packing only grows
      all_left -= std::exchange(left[species], 0);
      result.complete = false;
    }
  }
  renumber(box, first);
  return result;
}

FillResult deposit_mixture(Box& box, const lattice::Rectangle& region, const MixtureParts& parts,
                           std::optional<double> level) {
  const State& state = box.state;
  FillResult result{.placed_by_species = std::vector<std::size_t>(parts.weights.front().size(), 0)};
  Deposit deposit(box, region);
  // A part that has no room may get some where another one grows beneath it.
  std::size_t full = 0;
  for (std::size_t part = 0; full < parts.weights.size() && !(level && deposit.level() >= *level);
       part = (part + 1) % parts.weights.size()) {
    const std::size_t species = draw_species(state, parts.weights[part]);
    if (place_one(deposit, state, kinds_of(state, species),
                  [&](lattice::Site site) { return parts.part_at(site) == part; })) {
      ++result.placed_by_species[species];
      full = 0;
    } else {
      ++full;
    }
  }
  return result;
}

}  // namespace clca::grains
