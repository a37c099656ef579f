#include "contact/rule/contact_list.hpp"

#include <algorithm>
#include <tuple>

namespace clca::contact {

namespace {

auto sorting_key(const grains::State& state, lattice::Direction down, const Touch& touch) {
  return std::tuple(order_key(state, down, touch.contact.upper), touch.apart, touch.contact.other);
}

/// Finds the touch of the two bodies of a contact, in either order.
const Touch* find(const std::vector<Touch>& touches, std::uint32_t upper, grains::Owner other) {
  const auto touch =
      std::lower_bound(touches.begin(), touches.end(), std::pair(upper, other),
                       [](const Touch& one, const auto& key) {
                         return std::pair(one.contact.upper, one.contact.other) < key;
                       });
  return touch != touches.end() && touch->contact.upper == upper && touch->contact.other == other
             ? &*touch
             : nullptr;
}

}  // namespace

std::vector<Touch> next_contacts(const grains::State& state, const std::vector<Contact>& before,
                                 const std::vector<Touch>& now, lattice::Direction down,
                                 bool sorted) {
  std::vector<Touch> all;
  all.reserve(now.size());
  std::vector<bool> known(now.size(), false);
  for (const Contact& contact : before) {
    const Touch* touch = find(now, contact.upper, contact.other);
    const bool turned = touch == nullptr && grains::is_particle(contact.other);
    if (turned) {
      touch = find(now, static_cast<std::uint32_t>(contact.other),
                   static_cast<grains::Owner>(contact.upper));
    }
    if (touch == nullptr) {
      continue;
    }
    known[static_cast<std::size_t>(touch - now.data())] = true;
    Touch& kept = all.emplace_back(*touch);
    kept.is_new = false;
    kept.contact.impulse = turned ? turned_over(contact.impulse) : contact.impulse;
  }
  const auto first_new = static_cast<std::ptrdiff_t>(all.size());
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (!known[i]) {
      all.push_back(now[i]);
    }
  }
  if (sorted) {
    std::sort(all.begin(), all.end(), [&](const Touch& one, const Touch& other) {
      return sorting_key(state, down, one) < sorting_key(state, down, other);
    });
  } else {
    std::sort(all.begin() + first_new, all.end(), [&](const Touch& one, const Touch& other) {
      return one.key(state, down) < other.key(state, down);
    });
  }
  return all;
}

}  // namespace clca::contact
