#include "contact/engine/contact_finder.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "grains/internal/separation.hpp"

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

ContactFinder::ContactFinder(const grains::Box& box, const Rule& rule)
    : state_(box.state),
      box_(box),
      has_moving_walls_(
          std::any_of(state_.walls.begin(), state_.walls.end(),
                      [](const grains::Wall& wall) { return wall.motion.has_value(); })),
      normals_(state_.kinds),
      sorted_(state_, rule) {
  for (const grains::Kind& kind : state_.kinds) {
    for (const bool odd : {false, true}) {
      std::vector<lattice::Offset>& offsets = rings_.emplace_back();
      for (const lattice::Axial site : ring(kind.shape)) {
        offsets.push_back(state_.lattice.offset(site, odd));
      }
    }
  }
}

void ContactFinder::load(const std::vector<Contact>& contacts, ContactSlots& slots) {
  slots.clear(state_.particles.size());
  for (const Contact& contact : contacts) {
    slots.add(contact, grains::is_particle(contact.other)
                           ? apart(contact.upper, static_cast<std::uint32_t>(contact.other))
                           : lattice::Axial());
  }
}

void ContactFinder::update(std::span<const std::uint32_t> moved, WallVelocities walls,
                           ContactSlots& slots, SmallGroups& groups) {
  walls_ = std::move(walls);
  moved_.resize(state_.particles.size());
  ids_.clear();
  const auto look_at = [&](std::uint32_t id) {
    if (std::exchange(moved_[id], 1) == 0) {
      ids_.push_back(id);
    }
  };
  std::for_each(moved.begin(), moved.end(), look_at);
  std::for_each(at_several_bodies_.begin(), at_several_bodies_.end(), look_at);
  at_several_bodies_.clear();
  found_.clear();
  changed_.clear();
  at_walls_.clear();
  for (const std::uint32_t id : ids_) {
    check_contacts(id, slots);
    if (state_.particles[id].present) {
      look_around(id, slots);
    }
  }
  for (const std::uint32_t id : ids_) {
    moved_[id] = 0;
  }
  for (const std::int32_t at : changed_) {
    change_contact(at, slots, groups);
  }
  for (const std::uint32_t id : at_walls_) {
    check_walls(id, slots);
  }
  std::sort(found_.begin(), found_.end(),
            [](const auto& one, const auto& other) { return one.first < other.first; });
  for (const auto& [key, touch] : found_) {
    slots.add(touch.contact, touch.apart);
  }
}

void ContactFinder::add_found(const Touch& touch) {
  found_.emplace_back(touch.key(state_, down_), touch);
}

/// Changes nothing but normals. Contacts that end, and those whose upper grain changes, are
/// collected: the partners of other grains that have moved may still be looked up.
void ContactFinder::check_contacts(std::uint32_t id, ContactSlots& slots) {
  const ContactSlots& all = slots;
  all.for_each(id, [&](std::int32_t at) {
    const Slot& slot = all.at(at);
    const bool with_grain = grains::is_particle(slot.other);
    const auto other = grains::particle_id(slot.other);
    const std::uint32_t partner = slot.upper == id ? other : slot.upper;
    if (with_grain && checked_with(partner, id)) {
      return;
    }
    if (!state_.particles[id].present || (with_grain && !state_.particles[partner].present)) {
      changed_.push_back(at);
    } else if (with_grain) {  // else see check_walls
      const Touch now = touch(slot.upper, other);
      if (now.contact.normal == UnitVector() || now.contact.upper != slot.upper) {
        changed_.push_back(at);
      } else {
        slots.set_apart(at, now.apart, now.contact.normal);
      }
    }
  });
}

void ContactFinder::look_around(std::uint32_t id, const ContactSlots& slots) {
  const grains::Particle& grain = state_.particles[id];
  const lattice::Lattice& lattice = state_.lattice;
  const std::size_t index = lattice.index(grain.site());
  const int column = lattice.wrapped(grain.column);
  partners_.clear();
  slots.for_each(id, [&](std::int32_t at) {
    const Slot& slot = slots.at(at);
    partners_.push_back(slot.upper == id ? slot.other : grains::as_owner(slot.upper));
  });
  bool at_wall = std::any_of(partners_.begin(), partners_.end(), is_wall_or_side);
  grains::Owner before = grains::kFree;
  for (const lattice::Offset offset :
       rings_[2U * grain.kind + (lattice::is_odd(grain.column) ? 1U : 0U)]) {
    const grains::Owner owner = box_.occupancy.owner(lattice.at(index, column, offset));
    if (owner == before) {
      continue;
    }
    before = owner;
    at_wall = at_wall || is_wall_or_side(owner);
    const auto other = grains::particle_id(owner);
    if (grains::is_particle(owner) && !checked_with(other, id) &&
        std::find(partners_.begin(), partners_.end(), owner) == partners_.end()) {
      partners_.push_back(owner);
      const Touch found = touch(id, other);
      if (found.contact.normal != UnitVector()) {
        add_found(found);
      }
    }
  }
  if (at_wall) {
    at_walls_.push_back(id);
  }
}

void ContactFinder::change_contact(std::int32_t at, ContactSlots& slots, SmallGroups& groups) {
  const Slot& slot = slots.at(at);
  const bool with_grain = grains::is_particle(slot.other);
  const auto other = grains::particle_id(slot.other);
  const bool present =
      state_.particles[slot.upper].present && (!with_grain || state_.particles[other].present);
  Touch now = present ? touch(slot.upper, other) : Touch();
  if (now.contact.normal == UnitVector()) {
    groups.lost_contact(slot.upper);
    if (with_grain) {
      groups.lost_contact(other);
    }
    slots.remove(at);
    return;
  }
  now.contact.impulse = turned_over(slots.contact(at).impulse);
  slots.set(at, now.contact, now.apart);
}

void ContactFinder::check_walls(std::uint32_t id, ContactSlots& slots) {
  const auto [now, several_bodies] = wall_touches(box_, id, walls_);
  if (several_bodies && has_moving_walls_) {
    at_several_bodies_.push_back(id);
  }
  std::vector<std::pair<Contact, std::int32_t>> before;
  slots.for_each(id, [&](std::int32_t at) {
    if (is_wall_or_side(slots.at(at).other)) {
      before.emplace_back(slots.contact(at), at);
    }
  });
  std::sort(before.begin(), before.end(),
            [](const auto& one, const auto& other) { return one.first.other < other.first.other; });
  std::vector<Contact> contacts;
  std::transform(before.begin(), before.end(), std::back_inserter(contacts),
                 [](const auto& slot) { return slot.first; });
  const std::vector<std::size_t> next = followed_by(contacts, now);
  std::vector<bool> is_new(now.size(), true);
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (next[i] == kNoTouch) {
      slots.remove(before[i].second);
      continue;
    }
    Contact contact = now[next[i]].contact;
    contact.impulse = contacts[i].impulse;
    slots.set(before[i].second, contact, {});
    is_new[next[i]] = false;
  }
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (is_new[i]) {
      add_found(now[i]);
    }
  }
}

void ContactFinder::sort(ContactSlots& slots) {
  // From the order of the last time, which is nearly right.
  listed_.resize(state_.particles.size());
  std::erase_if(order_, [&](const auto& entry) {
    listed_[entry.second] = slots.touches_anything(entry.second) ? 1 : 0;
    return listed_[entry.second] == 0;
  });
  for (std::uint32_t id = 0; id < listed_.size(); ++id) {
    if (listed_[id] == 0 && slots.touches_anything(id)) {
      listed_[id] = 1;
      order_.emplace_back(0, id);
    }
  }
  for (auto& [key, id] : order_) {
    key = order_key(state_, down_, id);
  }
  std::sort(order_.begin(), order_.end());
  sorted_.clear(state_.particles.size());
  const auto key = [&](std::int32_t at) {
    return std::tie(slots.at(at).apart, slots.at(at).other);
  };
  for (const auto& [rank, id] : order_) {
    of_one_.clear();
    slots.for_each(id, [&, upper = id](std::int32_t at) {
      if (slots.at(at).upper == upper) {
        of_one_.push_back(at);
      }
    });
    std::sort(of_one_.begin(), of_one_.end(),
              [&](std::int32_t one, std::int32_t other) { return key(one) < key(other); });
    for (const std::int32_t at : of_one_) {
      sorted_.add(slots.contact(at), slots.at(at).apart);
    }
  }
  std::swap(slots, sorted_);
}

Touch ContactFinder::touch(std::uint32_t first, std::uint32_t second) {
  const bool in_order = is_above(state_, down_, first, second);
  const std::uint32_t upper = in_order ? first : second;
  const std::uint32_t lower = in_order ? second : first;
  const lattice::Axial apart = this->apart(upper, lower);
  return {.contact = {.upper = upper,
                      .other = grains::as_owner(lower),
                      .normal = normals_.normal(state_.particles[upper].kind,
                                                state_.particles[lower].kind, apart)},
          .apart = apart};
}

lattice::Axial ContactFinder::apart(std::uint32_t upper, std::uint32_t other) const {
  return grains::nearest_vector(state_.lattice, state_.particles[upper].site(),
                                state_.particles[other].site());
}

}  // namespace clca::contact
