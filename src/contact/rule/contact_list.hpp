#pragma once
// The list of contacts and the order in which they are swept.

#include <vector>

#include "clca/contact/state.hpp"
#include "contact/rule/touching.hpp"

namespace clca::contact {

/// The contacts of `before` that still touch, in order, followed by new ones.
/// With `sorted` all are sorted anew. A pair keeps its impulses if upper and lower body swap.
std::vector<Touch> next_contacts(const grains::State& state, const std::vector<Contact>& before,
                                 const std::vector<Touch>& now, lattice::Direction down,
                                 bool sorted);

}  // namespace clca::contact
