#include "contact/engine/contact_finder.hpp"

#include <algorithm>
#include <utility>

#include "clca/grains/separation.hpp"

namespace clca::contact {

namespace {

/// The sites beside a shape.
std::vector<lattice::Axial> ring(const lattice::Shape& shape) {
  std::vector<lattice::Axial> sites;
  for (const lattice::Direction direction : lattice::kDirections) {
    const std::vector<lattice::Axial> lead = shape.lead(direction);
    sites.insert(sites.end(), lead.begin(), lead.end());
  }
  std::sort(sites.begin(), sites.end());
  sites.erase(std::unique(sites.begin(), sites.end()), sites.end());
  return sites;
}

bool is_wall_or_side(grains::Owner owner) {
  return owner <= grains::kFirstWall;
}

}  // namespace

ContactFinder::ContactFinder(const grains::State& state, const grains::Occupancy& occupancy,
                             const grains::FootprintTable& footprints, const Rule& rule)
    : state_(state),
      occupancy_(occupancy),
      footprints_(footprints),
      rule_(rule),
      normals_(state.kinds) {
  for (const grains::Kind& kind : state.kinds) {
    for (const bool odd : {false, true}) {
      std::vector<lattice::Offset>& offsets = rings_.emplace_back();
      for (const lattice::Axial site : ring(kind.shape)) {
        offsets.push_back(state.lattice.offset(site, odd));
      }
    }
  }
}

void ContactFinder::load(const std::vector<Contact>& contacts, ContactSlots& slots) {
  slots.clear(state_.particles.size());
  for (const Contact& contact : contacts) {
    LaneContent loaded =
        content({.upper = contact.upper, .other = contact.other, .normal = contact.normal});
    loaded.impulse = contact.impulse;
    slots.add(loaded);
  }
}

std::size_t ContactFinder::update(std::span<const std::uint32_t> moved, ContactSlots& slots) {
  for (const std::uint32_t id : moved) {
    check_grains(id, slots);
  }
  found_.clear();
  for (const std::uint32_t id : moved) {
    if (state_.particles[id].present) {
      look_around(id, slots);
    }
  }
  // Two grains that have both moved have found each other.
  std::sort(found_.begin(), found_.end(), [this](const Touch& one, const Touch& other) {
    return one.key(state_, down_) < other.key(state_, down_);
  });
  const std::size_t first = slots.all().size();
  for (std::size_t i = 0; i < found_.size(); ++i) {
    if (i == 0 || found_[i].key(state_, down_) != found_[i - 1].key(state_, down_)) {
      slots.add(content(found_[i]));
    }
  }
  return first;
}

void ContactFinder::check_grains(std::uint32_t id, ContactSlots& slots) {
  const bool present = state_.particles[id].present;
  slots.for_each(id, [&](std::int32_t at) {
    const Slot& slot = slots.at(at);
    if (!present) {
      slots.remove(at);
    } else if (grains::is_particle(slot.other)) {  // else see check_walls
      const Touch now = touch(slot.upper, static_cast<std::uint32_t>(slot.other));
      if (now.normal == UnitVector()) {
        slots.remove(at);
        return;
      }
      LaneContent changed = content(now);
      changed.impulse = slots.batches().impulse(slot.lane);
      if (now.upper != slot.upper) {
        changed.impulse.rolling *= -1;
      }
      slots.set(at, changed);
    }
  });
}

void ContactFinder::look_around(std::uint32_t id, ContactSlots& slots) {
  const grains::Particle& grain = state_.particles[id];
  const lattice::Lattice& lattice = state_.lattice;
  const std::size_t place = lattice.index(grain.site());
  const int column = lattice.wrapped(grain.column);
  bool at_wall = false;
  grains::Owner before = grains::kFree;
  for (const lattice::Offset offset :
       rings_[2U * grain.kind + (lattice::is_odd(grain.column) ? 1U : 0U)]) {
    const grains::Owner owner = occupancy_.owner(lattice.at(place, column, offset));
    if (owner == before) {
      continue;
    }
    before = owner;
    at_wall = at_wall || is_wall_or_side(owner);
    if (grains::is_particle(owner) && !slots.touch(id, static_cast<std::uint32_t>(owner))) {
      const Touch found = touch(id, static_cast<std::uint32_t>(owner));
      if (found.normal != UnitVector()) {
        found_.push_back(found);
      }
    }
  }
  slots.for_each(
      id, [&](std::int32_t at) { at_wall = at_wall || is_wall_or_side(slots.at(at).other); });
  if (at_wall) {
    check_walls(id, slots);
  }
}

void ContactFinder::check_walls(std::uint32_t id, ContactSlots& slots) {
  std::vector<Touch> walls = wall_touches(state_, occupancy_, footprints_, id);
  slots.for_each(id, [&](std::int32_t at) {
    const Slot& slot = slots.at(at);
    if (!is_wall_or_side(slot.other)) {
      return;
    }
    const auto touch = std::find_if(walls.begin(), walls.end(),
                                    [&](const Touch& one) { return one.other == slot.other; });
    if (touch == walls.end()) {
      slots.remove(at);
    } else {
      LaneContent changed = content(*touch);
      changed.impulse = slots.batches().impulse(slot.lane);
      slots.set(at, changed);
      walls.erase(touch);
    }
  });
  found_.insert(found_.end(), walls.begin(), walls.end());
}

void ContactFinder::sort(ContactSlots& slots, std::vector<std::int32_t>& lanes) {
  std::sort(lanes.begin(), lanes.end());
  std::vector<std::size_t> marked;  // of the sorted
  // The grains first, then the contacts of each.
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
  for (std::uint32_t id = 0; id < state_.particles.size(); ++id) {
    if (state_.particles[id].present) {
      order.emplace_back(order_key(state_, down_, id), id);
    }
  }
  std::sort(order.begin(), order.end());
  sorted_.clear();
  std::vector<std::pair<Touch, std::int32_t>> own;  // with their lanes
  for (const auto& [key, id] : order) {
    own.clear();
    slots.for_each(id, [&, id = id](std::int32_t at) {
      const Slot& slot = slots.at(at);
      if (slot.upper == id) {
        Touch touch = {.upper = id,
                       .other = slot.other,
                       .apart = grains::is_particle(slot.other)
                                    ? apart(id, static_cast<std::uint32_t>(slot.other))
                                    : lattice::Axial(),
                       .normal = slots.batches().normal(slot.lane)};
        own.emplace_back(touch, slot.lane);
      }
    });
    std::sort(own.begin(), own.end(), [](const auto& one, const auto& other) {
      return std::tie(one.first.apart, one.first.other) <
             std::tie(other.first.apart, other.first.other);
    });
    for (const auto& [touch, lane] : own) {
      if (std::binary_search(lanes.begin(), lanes.end(), lane)) {
        marked.push_back(sorted_.size());
      }
      sorted_.push_back(content(touch));
      sorted_.back().impulse = slots.batches().impulse(lane);
    }
  }
  slots.clear(state_.particles.size());
  for (const LaneContent& one : sorted_) {
    slots.add(one);
  }
  lanes.clear();
  for (const std::size_t slot : marked) {
    lanes.push_back(slots.all()[slot].lane);
  }
}

LaneContent ContactFinder::content(const Touch& touch) const {
  const auto kind = [&](std::size_t id) { return state_.particles[id].kind; };
  const bool on_wall = !grains::is_particle(touch.other);
  const auto other = static_cast<std::size_t>(touch.other);
  return {.upper = touch.upper,
          .other = touch.other,
          .normal = touch.normal,
          .impulse = {},
          .friction = rule_.friction_with(touch.other),
          .pair = &rule_.bodies.pair(kind(touch.upper),
                                     on_wall ? std::nullopt : std::optional(kind(other)))};
}

Touch ContactFinder::touch(std::uint32_t first, std::uint32_t second) {
  const bool in_order = is_above(state_, down_, first, second);
  const std::uint32_t upper = in_order ? first : second;
  const std::uint32_t lower = in_order ? second : first;
  const lattice::Axial apart = this->apart(upper, lower);
  return {
      .upper = upper,
      .other = static_cast<grains::Owner>(lower),
      .apart = apart,
      .normal = normals_.normal(state_.particles[upper].kind, state_.particles[lower].kind, apart)};
}

lattice::Axial ContactFinder::apart(std::uint32_t upper, std::uint32_t other) const {
  return grains::nearest_vector(state_.lattice, state_.particles[upper].site(),
                                state_.particles[other].site());
}

}  // namespace clca::contact
