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

int columns_of(const lattice::Shape& shape) {
  const auto [first, last] =
      std::minmax_element(shape.sites().begin(), shape.sites().end(),
                          [](lattice::Axial one, lattice::Axial other) { return one.x < other.x; });
  return last->x - first->x + 1;
}

bool is_wall_or_side(grains::Owner owner) {
  return owner <= grains::kFirstWall;
}

}  // namespace

ContactFinder::ContactFinder(const grains::Box& box, const Rule& rule,
                             const parallel::Threads& threads)
    : state_(box.state),
      box_(box),
      rule_(rule),
      threads_(threads),
      has_moving_walls_(
          std::any_of(state_.walls.begin(), state_.walls.end(),
                      [](const grains::Wall& wall) { return wall.motion.has_value(); })),
      normals_(static_cast<std::size_t>(threads.count), NormalTable(state_.kinds)),
      touches_(threads),
      changed_(threads),
      at_walls_(threads),
      partners_(threads),
      sorted_(state_.walls.size(), max_groups(state_.lattice, threads)) {
  for (const grains::Kind& kind : state_.kinds) {
    widest_ = std::max(widest_, columns_of(kind.shape));
    for (const bool odd : {false, true}) {
      std::vector<lattice::Offset>& offsets = rings_.emplace_back();
      for (const lattice::Axial site : ring(kind.shape)) {
        offsets.push_back(state_.lattice.offset(site, odd));
      }
    }
  }
}

std::size_t ContactFinder::max_groups(const lattice::Lattice& lattice,
                                      const parallel::Threads& threads) {
  // One for each strip, and one for contacts that appear later.
  return threads.count == 1
             ? 1
             : static_cast<std::size_t>(strip_of(lattice, lattice.columns() - 1)) + 2;
}

void ContactFinder::load(const std::vector<Contact>& contacts, ContactSlots& slots) {
  slots.clear(state_.particles.size());
  for (const Contact& contact : contacts) {
    slots.add(content(contact),
              grains::is_particle(contact.other)
                  ? apart(contact.upper, static_cast<std::uint32_t>(contact.other))
                  : lattice::Axial());
  }
}

std::size_t ContactFinder::update(std::span<const std::uint32_t> moved, WallVelocities walls,
                                  ContactSlots& slots) {
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
  touches_.clear();
  changed_.clear();
  at_walls_.clear();
  parallel::split(threads_, ids_.size(),
                  [&](std::size_t part, std::size_t first, std::size_t last) {
                    for (const std::uint32_t id : std::span(ids_).subspan(first, last - first)) {
                      check_contacts(id, slots, part);
                      if (state_.particles[id].present) {
                        look_around(id, slots, part);
                      }
                    }
                  });
  for (const std::uint32_t id : ids_) {
    moved_[id] = 0;
  }
  found_.clear();
  touches_.for_each([&](const Touch& touch) { add_found(touch); });
  changed_.for_each([&](std::int32_t at) { change_contact(at, slots); });
  at_walls_.for_each([&](std::uint32_t id) { check_walls(id, slots); });
  std::sort(found_.begin(), found_.end(),
            [](const auto& one, const auto& other) { return one.first < other.first; });
  const std::size_t first = slots.all().size();
  for (const auto& [key, touch] : found_) {
    slots.add(content(touch.contact), touch.apart);
  }
  return first;
}

void ContactFinder::add_found(const Touch& touch) {
  found_.emplace_back(touch.key(state_, down_), touch);
}

/// Several threads call this, so it changes nothing but normals. Contacts that end, and those whose
/// upper grain changes, are collected.
void ContactFinder::check_contacts(std::uint32_t id, ContactSlots& slots, std::size_t part) {
  const ContactSlots& all = slots;
  all.for_each(id, [&](std::int32_t at) {
    const Slot& slot = all.at(at);
    const bool with_grain = grains::is_particle(slot.other);
    const auto other = static_cast<std::uint32_t>(slot.other);
    const std::uint32_t partner = slot.upper == id ? other : slot.upper;
    if (with_grain && checked_with(partner, id)) {
      return;
    }
    if (!state_.particles[id].present || (with_grain && !state_.particles[partner].present)) {
      changed_.of(part).push_back(at);
    } else if (with_grain) {  // else see check_walls
      const Touch now = touch(slot.upper, other, part);
      if (now.contact.normal == UnitVector() || now.contact.upper != slot.upper) {
        changed_.of(part).push_back(at);
      } else {
        slots.set_apart(at, now.apart, now.contact.normal);
      }
    }
  });
}

void ContactFinder::look_around(std::uint32_t id, const ContactSlots& slots, std::size_t part) {
  const grains::Particle& grain = state_.particles[id];
  const lattice::Lattice& lattice = state_.lattice;
  const std::size_t place = lattice.index(grain.site());
  const int column = lattice.wrapped(grain.column);
  std::vector<grains::Owner>& partners = partners_.of(part);
  partners.clear();
  slots.for_each(id, [&](std::int32_t at) {
    const Slot& slot = slots.at(at);
    partners.push_back(slot.upper == id ? slot.other : static_cast<grains::Owner>(slot.upper));
  });
  bool at_wall = std::any_of(partners.begin(), partners.end(), is_wall_or_side);
  grains::Owner before = grains::kFree;
  for (const lattice::Offset offset :
       rings_[2U * grain.kind + (lattice::is_odd(grain.column) ? 1U : 0U)]) {
    const grains::Owner owner = box_.occupancy.owner(lattice.at(place, column, offset));
    if (owner == before) {
      continue;
    }
    before = owner;
    at_wall = at_wall || is_wall_or_side(owner);
    const auto other = static_cast<std::uint32_t>(owner);
    if (grains::is_particle(owner) && !checked_with(other, id) &&
        std::find(partners.begin(), partners.end(), owner) == partners.end()) {
      partners.push_back(owner);
      const Touch found = touch(id, other, part);
      if (found.contact.normal != UnitVector()) {
        touches_.of(part).push_back(found);
      }
    }
  }
  if (at_wall) {
    at_walls_.of(part).push_back(id);
  }
}

void ContactFinder::change_contact(std::int32_t at, ContactSlots& slots) {
  const Slot& slot = slots.at(at);
  const bool with_grain = grains::is_particle(slot.other);
  const auto other = static_cast<std::uint32_t>(slot.other);
  const bool present =
      state_.particles[slot.upper].present && (!with_grain || state_.particles[other].present);
  Touch now = present ? touch(slot.upper, other, 0) : Touch();
  if (now.contact.normal == UnitVector()) {
    slots.remove(at);
    return;
  }
  now.contact.impulse = turned_over(slots.content(at).contact.impulse);
  slots.set(at, content(now.contact), now.apart);
}

void ContactFinder::check_walls(std::uint32_t id, ContactSlots& slots) {
  const auto [now, several_bodies] = wall_touches(box_, id, walls_);
  if (several_bodies && has_moving_walls_) {
    at_several_bodies_.push_back(id);
  }
  std::vector<std::pair<Contact, std::int32_t>> before;
  slots.for_each(id, [&](std::int32_t at) {
    if (is_wall_or_side(slots.at(at).other)) {
      before.emplace_back(slots.content(at).contact, at);
    }
  });
  std::sort(before.begin(), before.end(),
            [](const auto& one, const auto& other) { return one.first.other < other.first.other; });
  std::vector<Contact> contacts;
  std::transform(before.begin(), before.end(), std::back_inserter(contacts),
                 [](const auto& one) { return one.first; });
  const std::vector<std::size_t> next = followed_by(contacts, now);
  std::vector<bool> is_new(now.size(), true);
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (next[i] == kNoTouch) {
      slots.remove(before[i].second);
      continue;
    }
    Contact contact = now[next[i]].contact;
    contact.impulse = contacts[i].impulse;
    slots.set(before[i].second, content(contact), {});
    is_new[next[i]] = false;
  }
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (is_new[i]) {
      add_found(now[i]);
    }
  }
}

void ContactFinder::sort(ContactSlots& slots, std::size_t first_new,
                         std::vector<std::int32_t>& new_slots) {
  // From the order of the last time, which is nearly right.
  listed_.resize(state_.particles.size());
  std::erase_if(order_, [&](const auto& one) {
    listed_[one.second] = slots.touches_anything(one.second) ? 1 : 0;
    return listed_[one.second] == 0;
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
  const bool grouped = threads_.count > 1 && order_.size() / threads_.min_per_thread >=
                                                 static_cast<std::size_t>(threads_.count);
  std::vector<int> round;  // its strips
  const auto key = [&](std::int32_t at) {
    return std::tie(slots.at(at).apart, slots.at(at).other);
  };
  for (const auto& [place, id] : order_) {
    if (const int strip = strip_of(state_.lattice, state_.particles[id].column);
        grouped && (round.empty() || round.back() != strip)) {
      begin_strip(strip, round, sorted_.batches());
    }
    of_one_.clear();
    slots.for_each(id, [&, upper = id](std::int32_t at) {
      if (slots.at(at).upper == upper) {
        of_one_.push_back(at);
      }
    });
    std::sort(of_one_.begin(), of_one_.end(),
              [&](std::int32_t one, std::int32_t other) { return key(one) < key(other); });
    for (const std::int32_t at : of_one_) {
      sorted_.add(slots.content(at), slots.at(at).apart);
      if (static_cast<std::size_t>(at) >= first_new) {
        new_slots.push_back(static_cast<std::int32_t>(sorted_.all().size()) - 1);
      }
    }
  }
  if (grouped) {
    sorted_.batches().begin_group(true);  // of contacts that appear later
  }
  std::swap(slots, sorted_);
}

/// Contacts of a strip are a group of their own, in the same round as those before it where they
/// can be.
void ContactFinder::begin_strip(int strip, std::vector<int>& round, Batches& batches) const {
  const bool after = std::any_of(round.begin(), round.end(),
                                 [&](int other) { return may_share_grains(strip, other); });
  if (!round.empty()) {
    batches.begin_group(after);
  }
  if (after) {
    round.clear();
  }
  round.push_back(strip);
}

/// Whether contacts of two strips may have a grain in common.
bool ContactFinder::may_share_grains(int strip, int other) const {
  const lattice::Lattice& lattice = state_.lattice;
  const auto [left, right] = std::minmax(strip, other);
  const auto end = [&](int number) {
    return std::min((number + 1) * kStripColumns, lattice.columns());
  };
  const int between = right * kStripColumns - end(left);
  const int around = left * kStripColumns + lattice.columns() - end(right);
  const int reach = 4 * widest_;  // from upper grain to upper grain
  return between < reach || (lattice.periodic() && around < reach);
}

LaneContent ContactFinder::content(const Contact& contact) const {
  return {.contact = contact,
          .friction = rule_.friction_with(contact.other),
          .pair = rule_.bodies.pair(state_, contact.upper, contact.other)};
}

Touch ContactFinder::touch(std::uint32_t first, std::uint32_t second, std::size_t part) {
  const bool in_order = is_above(state_, down_, first, second);
  const std::uint32_t upper = in_order ? first : second;
  const std::uint32_t lower = in_order ? second : first;
  const lattice::Axial apart = this->apart(upper, lower);
  return {.contact = {.upper = upper,
                      .other = static_cast<grains::Owner>(lower),
                      .normal = normals_[part].normal(state_.particles[upper].kind,
                                                      state_.particles[lower].kind, apart)},
          .apart = apart};
}

lattice::Axial ContactFinder::apart(std::uint32_t upper, std::uint32_t other) const {
  return grains::nearest_vector(state_.lattice, state_.particles[upper].site(),
                                state_.particles[other].site());
}

}  // namespace clca::contact
