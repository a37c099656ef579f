#pragma once

#include <cstdint>
#include <vector>

#include "contact/engine/contact_slots.hpp"
#include "contact/rule/impacts.hpp"

namespace clca::contact {

/// The contacts that an impact reaches, in their order, as isolated_impacts() finds them; none if
/// there are too many grains. `at`: the slot that bounces.
std::vector<ImpactContact> isolated_impact(ContactSlots& slots, std::int32_t at);

}  // namespace clca::contact
