#pragma once
// The unit of impulses.

#include <vector>

#include "clca/grains/state.hpp"

namespace clca::contact {

/// Unit of mass in sites: 1 if no grain has more than 16 sites, else a power of two, so that
/// impulses of large grains stay in range.
double mass_unit(const std::vector<grains::Kind>& kinds);

}  // namespace clca::contact
