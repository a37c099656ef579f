#include "automaton/rule/push_list.hpp"

#include <algorithm>
#include <utility>

namespace clca::automaton {

namespace {

auto lower_bound(const std::vector<grains::Push>& pushes, std::uint32_t pushed,
                 grains::Owner pusher) {
  return std::lower_bound(
      pushes.begin(), pushes.end(), std::pair(pushed, pusher),
      [](const grains::Push& push, const auto& key) { return push.key() < key; });
}

}  // namespace

PushList::PushList(const grains::State& state) : parts_(state.particles.size(), 0) {
  for (const grains::Push& push : state.pushes) {
    count(push, 1);
  }
}

std::vector<std::uint32_t> PushList::overlapping_particles(const grains::State& state) {
  std::vector<std::uint32_t> ids;
  for (const grains::Push& push : state.pushes) {
    ids.push_back(push.pushed);
    if (grains::is_particle(push.pusher)) {
      ids.push_back(static_cast<std::uint32_t>(push.pusher));
    }
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

std::span<const grains::Push> PushList::onto(const grains::State& state, std::uint32_t id) {
  constexpr grains::Owner kLowest = std::numeric_limits<grains::Owner>::min();
  const auto first = lower_bound(state.pushes, id, kLowest);
  const auto last = std::find_if(first, state.pushes.end(),
                                 [id](const grains::Push& push) { return push.pushed != id; });
  return {first, last};
}

void PushList::record(grains::State& state, const grains::Push& push) {
  const auto position =
      state.pushes.begin() +
      (lower_bound(state.pushes, push.pushed, push.pusher) - state.pushes.cbegin());
  if (position != state.pushes.end() && position->key() == push.key()) {
    *position = push;
    return;
  }
  state.pushes.insert(position, push);
  count(push, 1);
}

void PushList::forget(grains::State& state, std::uint32_t id, grains::Owner other) {
  if (!erase(state, id, other) && grains::is_particle(other)) {
    erase(state, grains::particle_id(other), grains::as_owner(id));
  }
}

bool PushList::erase(grains::State& state, std::uint32_t pushed, grains::Owner pusher) {
  const grains::Push* push = find_push(state, pushed, pusher);
  if (push == nullptr) {
    return false;
  }
  count(*push, -1);
  state.pushes.erase(state.pushes.begin() + (push - state.pushes.data()));
  return true;
}

void PushList::count(const grains::Push& push, int change) {
  parts_[push.pushed] += static_cast<std::uint32_t>(change);
  if (grains::is_particle(push.pusher)) {
    parts_[static_cast<std::size_t>(push.pusher)] += static_cast<std::uint32_t>(change);
  }
}

}  // namespace clca::automaton
