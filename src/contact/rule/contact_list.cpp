#include "contact/rule/contact_list.hpp"

#include <algorithm>
#include <iterator>
#include <tuple>

namespace clca::contact {

namespace {

/// Finds the touch of the two bodies of a contact, in either order.
const Touch* find(const std::vector<Touch>& touches, std::uint32_t upper, grains::Owner other) {
  const auto touch =
      std::lower_bound(touches.begin(), touches.end(), std::pair(upper, other),
                       [](const Touch& listed, const auto& key) {
                         return std::pair(listed.contact.upper, listed.contact.other) < key;
                       });
  return touch != touches.end() && touch->contact.upper == upper && touch->contact.other == other
             ? &*touch
             : nullptr;
}

/// The touch that each contact with a wall or a side goes on as; null for the others.
std::vector<const Touch*> at_walls(const std::vector<Contact>& before,
                                   const std::vector<Touch>& now) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (!grains::is_particle(before[i].other)) {
      order.push_back(i);
    }
  }
  std::sort(order.begin(), order.end(), [&](std::size_t one, std::size_t other) {
    return std::tie(before[one].upper, before[one].other) <
           std::tie(before[other].upper, before[other].other);
  });
  std::vector<const Touch*> result(before.size(), nullptr);
  for (auto first = order.begin(); first != order.end();) {
    const std::uint32_t grain = before[*first].upper;
    const auto last =
        std::find_if(first, order.end(), [&](std::size_t i) { return before[i].upper != grain; });
    std::vector<Contact> of_grain;
    std::transform(first, last, std::back_inserter(of_grain),
                   [&](std::size_t i) { return before[i]; });
    const auto begin = std::lower_bound(
        now.begin(), now.end(), grain,
        [](const Touch& touch, std::uint32_t id) { return touch.contact.upper < id; });
    const auto end = std::find_if(begin, now.end(), [&](const Touch& touch) {
      return touch.contact.upper != grain || grains::is_particle(touch.contact.other);
    });
    const std::vector<std::size_t> next = followed_by(of_grain, {begin, end});
    for (const std::size_t touch : next) {
      result[*first++] =
          touch == kNoTouch ? nullptr : &*(begin + static_cast<std::ptrdiff_t>(touch));
    }
  }
  return result;
}

}  // namespace

std::vector<Touch> next_contacts(const grains::State& state, const std::vector<Contact>& before,
                                 const std::vector<Touch>& now, lattice::Direction down,
                                 bool sorted) {
  std::vector<Touch> all;
  all.reserve(now.size());
  std::vector<bool> known(now.size(), false);
  const std::vector<const Touch*> next_at_walls = at_walls(before, now);
  for (std::size_t i = 0; i < before.size(); ++i) {
    const Contact& contact = before[i];
    const bool with_grain = grains::is_particle(contact.other);
    const Touch* touch = with_grain ? find(now, contact.upper, contact.other) : next_at_walls[i];
    const bool turned = touch == nullptr && with_grain;
    if (turned) {
      touch = find(now, static_cast<std::uint32_t>(contact.other), grains::as_owner(contact.upper));
    }
    if (touch == nullptr) {
      continue;
    }
    known[static_cast<std::size_t>(touch - now.data())] = true;
    Touch& kept = all.emplace_back(*touch);
    kept.contact.impulse = turned ? turned_over(contact.impulse) : contact.impulse;
  }
  const auto first_new = static_cast<std::ptrdiff_t>(all.size());
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (!known[i]) {
      all.push_back(now[i]);
    }
  }
  std::sort(all.begin() + (sorted ? 0 : first_new), all.end(),
            [&](const Touch& one, const Touch& other) {
              return one.key(state, down) < other.key(state, down);
            });
  return all;
}

}  // namespace clca::contact
