#include "contact/engine/contact_finder.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "clca/grains/separation.hpp"
#include "contact/rule/contact_list.hpp"

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

bool is_fixed(grains::Owner owner) {
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
  slots.clear();
  slots.resize(state_.particles.size());
  for (const Contact& contact : contacts) {
    Slot slot = make_slot({.upper = contact.upper, .other = contact.other});
    slot.contact = contact;
    slots.add(slot);
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
    return one.key(state_) < other.key(state_);
  });
  const std::size_t first = slots.all().size();
  for (std::size_t i = 0; i < found_.size(); ++i) {
    if (i == 0 || found_[i].key(state_) != found_[i - 1].key(state_)) {
      slots.add(make_slot(found_[i]));
    }
  }
  return first;
}

void ContactFinder::check_grains(std::uint32_t id, ContactSlots& slots) {
  const bool present = state_.particles[id].present;
  slots.for_each(id, [&](std::int32_t at) {
    Slot& slot = slots.at(at);
    if (!present) {
      slots.remove(at);
      return;
    }
    if (!grains::is_particle(slot.contact.other)) {
      return;  // see check_walls
    }
    if (is_above(state_, static_cast<std::uint32_t>(slot.contact.other), slot.contact.upper)) {
      slots.turn_over(at);
    }
    const std::uint32_t upper = slot.contact.upper;
    const auto other = static_cast<std::uint32_t>(slot.contact.other);
    slot.normal = normal(upper, other, apart(upper, other));
    slot.pair = &rule_.bodies.pair(state_.particles[upper].kind, state_.particles[other].kind);
    if (slot.normal == UnitVector()) {
      slots.remove(at);
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
  for (const lattice::Offset offset : rings_[2U * grain.kind + (grain.column & 1 ? 1U : 0U)]) {
    const grains::Owner owner = occupancy_.owner(lattice.at(place, column, offset));
    if (owner == before) {
      continue;
    }
    before = owner;
    at_wall = at_wall || is_fixed(owner);
    if (!grains::is_particle(owner) || slots.touches(id, owner)) {
      continue;
    }
    Touch touch = {.upper = id, .other = owner};
    if (is_above(state_, static_cast<std::uint32_t>(owner), id)) {
      touch = {.upper = static_cast<std::uint32_t>(owner), .other = static_cast<grains::Owner>(id)};
    }
    const auto other = static_cast<std::uint32_t>(touch.other);
    touch.apart = apart(touch.upper, other);
    touch.normal = normal(touch.upper, other, touch.apart);
    if (touch.normal != UnitVector()) {
      found_.push_back(touch);
    }
  }
  slots.for_each(id, [&](std::int32_t at) {
    at_wall = at_wall || is_fixed(slots.at(at).contact.other);
  });
  if (at_wall) {
    check_walls(id, slots);
  }
}

void ContactFinder::check_walls(std::uint32_t id, ContactSlots& slots) {
  std::vector<Touch> walls = wall_touches(state_, occupancy_, footprints_, id);
  slots.for_each(id, [&](std::int32_t at) {
    Slot& slot = slots.at(at);
    if (!is_fixed(slot.contact.other)) {
      return;
    }
    const auto touch = std::find_if(walls.begin(), walls.end(), [&](const Touch& one) {
      return one.other == slot.contact.other;
    });
    if (touch == walls.end()) {
      slots.remove(at);
    } else {
      slot.normal = touch->normal;
      walls.erase(touch);
    }
  });
  found_.insert(found_.end(), walls.begin(), walls.end());
}

void ContactFinder::sort(ContactSlots& slots) {
  struct Keyed {
    std::uint32_t upper;
    lattice::Axial apart;
    const Slot* slot;
  };
  // The grains first: an order of few numbers, then the contacts of each.
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
  for (std::uint32_t id = 0; id < state_.particles.size(); ++id) {
    if (state_.particles[id].present) {
      order.emplace_back(order_key(state_, id), id);
    }
  }
  std::sort(order.begin(), order.end());
  sorted_.clear();
  std::vector<Keyed> own;
  for (const auto& [key, id] : order) {
    own.clear();
    slots.for_each(id, [&](std::int32_t at) {
      const Slot& slot = slots.at(at);
      const Contact& contact = slot.contact;
      if (contact.upper == id) {
        own.push_back({id,
                       grains::is_particle(contact.other)
                           ? apart(id, static_cast<std::uint32_t>(contact.other))
                           : lattice::Axial(),
                       &slot});
      }
    });
    std::sort(own.begin(), own.end(), [](const Keyed& one, const Keyed& other) {
      return std::pair(one.apart, one.slot->contact.other) <
             std::pair(other.apart, other.slot->contact.other);
    });
    for (const Keyed& one : own) {
      sorted_.push_back(*one.slot);
    }
  }
  slots.clear();
  for (const Slot& slot : sorted_) {
    slots.add(slot);
  }
}

Slot ContactFinder::make_slot(const Touch& touch) const {
  const auto kind = [&](std::size_t id) { return state_.particles[id].kind; };
  return {.contact = {.upper = touch.upper, .other = touch.other},
          .normal = touch.normal,
          .friction = rule_.friction_with(touch.other),
          .pair = &rule_.bodies.pair(kind(touch.upper),
                                     grains::is_particle(touch.other)
                                         ? std::optional(kind(static_cast<std::size_t>(touch.other)))
                                         : std::nullopt)};
}

lattice::Axial ContactFinder::apart(std::uint32_t upper, std::uint32_t other) const {
  return grains::nearest_vector(state_.lattice, state_.particles[upper].site(),
                                state_.particles[other].site());
}

UnitVector ContactFinder::normal(std::uint32_t upper, std::uint32_t other, lattice::Axial apart) {
  return normals_.normal(state_.particles[upper].kind, state_.particles[other].kind, apart);
}

}  // namespace clca::contact
