#pragma once
// Contacts from step to step, and the order in which they are swept.

#include <vector>

#include "clca/contact/state.hpp"
#include "contact/rule/touching.hpp"

namespace clca::contact {

/// A contact in a step: what it remembers and where it is now.
struct ActiveContact {
  Contact contact;
  bool is_new = false;
};

/// The contacts of `before` that still touch, in their order, and behind them those that are new.
/// With `sorted` all are put in order anew. A pair that has turned over keeps what it remembers.
std::vector<ActiveContact> next_contacts(const grains::State& state,
                                         const std::vector<Contact>& before,
                                         const std::vector<Touch>& now, lattice::Direction down,
                                         bool sorted);

}  // namespace clca::contact
