#include "contact/rule/contact_list.hpp"

#include <algorithm>
#include <tuple>

namespace clca::contact {

namespace {

/// A contact with its sort key.
struct OrderedContact {
  ActiveContact active;
  Touch touch;
};

auto sorting_key(const grains::State& state, lattice::Direction down, const Touch& touch) {
  return std::tuple(order_key(state, down, touch.upper), touch.apart, touch.other);
}

OrderedContact ordered(const Touch& touch) {
  return {
      .active = {.contact = {.upper = touch.upper, .other = touch.other, .normal = touch.normal},
                 .is_new = true},
      .touch = touch};
}

/// Finds the touch of the two bodies of a contact, in either order.
const Touch* find(const std::vector<Touch>& touches, std::uint32_t upper, grains::Owner other) {
  const auto touch = std::lower_bound(
      touches.begin(), touches.end(), std::pair(upper, other),
      [](const Touch& one, const auto& key) { return std::pair(one.upper, one.other) < key; });
  return touch != touches.end() && touch->upper == upper && touch->other == other ? &*touch
                                                                                  : nullptr;
}

}  // namespace

std::vector<ActiveContact> next_contacts(const grains::State& state,
                                         const std::vector<Contact>& before,
                                         const std::vector<Touch>& now, lattice::Direction down,
                                         bool sorted) {
  std::vector<OrderedContact> all;
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
    OrderedContact kept = ordered(*touch);
    kept.active.is_new = false;
    kept.active.contact.impulse = contact.impulse;
    if (turned) {
      kept.active.contact.impulse.rolling *= -1;
    }
    all.push_back(kept);
  }
  const auto first_new = static_cast<std::ptrdiff_t>(all.size());
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (!known[i]) {
      all.push_back(ordered(now[i]));
    }
  }
  if (sorted) {
    std::sort(all.begin(), all.end(), [&](const OrderedContact& one, const OrderedContact& other) {
      return sorting_key(state, down, one.touch) < sorting_key(state, down, other.touch);
    });
  } else {
    std::sort(all.begin() + first_new, all.end(),
              [&](const OrderedContact& one, const OrderedContact& other) {
                return one.touch.key(state, down) < other.touch.key(state, down);
              });
  }
  std::vector<ActiveContact> result;
  result.reserve(all.size());
  std::transform(all.begin(), all.end(), std::back_inserter(result),
                 [](const OrderedContact& one) { return one.active; });
  return result;
}

}  // namespace clca::contact
