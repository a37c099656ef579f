#pragma once

#include <cstdint>
#include <vector>

#include "contact/engine/contact_slots.hpp"
#include "contact/rule/impacts.hpp"

namespace clca::contact {

/// The slots of the contacts that an impact reaches, in their order, as isolated_impacts() finds
/// them; none if there are too many grains. `at`: the slot that bounces.
std::vector<std::int32_t> isolated_impact(const ContactSlots& slots, std::int32_t at);

}  // namespace clca::contact
