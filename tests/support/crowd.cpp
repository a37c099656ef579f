#include "support/crowd.hpp"

#include <algorithm>
#include <iterator>

namespace clca::testing {

using grains::is_particle;
using grains::Move;
using grains::Owner;
using grains::Particle;
using grains::Push;
using lattice::Direction;
using lattice::Site;

std::set<Owner> Crowd::owners(Site site) const {
  const auto found = owners_.find(site);
  return found == owners_.end() ? std::set<Owner>() : found->second;
}

std::set<Owner> Crowd::others(Owner id, const Sites& sites) const {
  std::set<Owner> result;
  for (const Site site : sites) {
    result.merge(owners(site));
  }
  result.erase(id);
  return result;
}

std::map<Owner, Change> Crowd::changes(Owner id, Direction direction) const {
  const Sites before = body_of(state_, id);
  const Sites after = body_after(state_, particle(id), direction);
  std::set<Owner> all = others(id, before);
  all.merge(others(id, after));
  std::map<Owner, Change> result;
  for (const Owner other : all) {
    const Sites body = body_of(state_, other);
    Change change{.sites_before = shared(before, body), .sites_after = shared(after, body)};
    if (is_particle(other)) {
      change.depth_before = depth(state_, before, body);
      change.depth_after = depth(state_, after, body);
    }
    result[other] = change;
  }
  return result;
}

Sites Crowd::lead(Owner id, Direction direction) const {
  const Sites here = body_of(state_, id);
  Sites sites = body_after(state_, particle(id), direction);
  std::erase_if(sites, [&](Site site) { return here.contains(site); });
  return sites;
}

bool Crowd::is_free(Owner id, Direction direction) const {
  const Sites ahead = lead(id, direction);
  if (!inside(state_, ahead) || !others(id, ahead).empty()) {
    return false;
  }
  const auto all = changes(id, direction);
  return std::none_of(all.begin(), all.end(), [](const auto& entry) {
    return entry.second.depth_after > entry.second.depth_before;
  });
}

int Crowd::burden(Owner id) const {
  int sum = 0;
  const Sites here = body_of(state_, id);
  for (const Owner other : others(id, here)) {
    sum += is_particle(other) ? shared(here, body_of(state_, other)) : 0;
  }
  return sum;
}

int Crowd::limit(Owner id) const {
  const int sites = static_cast<int>(state_.shape(particle(id)).size());
  return std::max(2, (3 * sites + 5) / 10);
}

std::vector<Push> Crowd::pushes_onto(Owner id) const {
  std::vector<Push> result;
  std::copy_if(state_.pushes.begin(), state_.pushes.end(), std::back_inserter(result),
               [&](const Push& push) { return static_cast<Owner>(push.pushed) == id; });
  return result;
}

void Crowd::move(Owner id, Direction direction) {
  for (const Site site : body_of(state_, id)) {
    owners_[site].erase(id);
  }
  Particle& particle = state_.particles[static_cast<std::size_t>(id)];
  const Site target = particle.site() + unit(direction);
  particle.column = target.column;
  particle.row = target.row;
  particle.previous = static_cast<Move>(direction);
  for (const Site site : body_of(state_, id)) {
    owners_[site].insert(id);
  }
  std::erase_if(state_.pushes, [&](const Push& push) {
    const auto pushed = static_cast<Owner>(push.pushed);
    return (pushed == id || push.pusher == id) &&
           shared(body_of(state_, pushed), body_of(state_, push.pusher)) == 0;
  });
}

void Crowd::record(const Push& push) {
  state_.pushes.push_back(push);
  std::sort(state_.pushes.begin(), state_.pushes.end(), [](const Push& a, const Push& b) {
    return std::pair(a.pushed, a.pusher) < std::pair(b.pushed, b.pusher);
  });
}

}  // namespace clca::testing
