#include "automaton/push_book.hpp"

#include <algorithm>
#include <utility>

namespace clca::automaton {

namespace {

std::pair<std::uint32_t, Owner> place_of(const Push& push) {
  return {push.pushed, push.pusher};
}

auto lower_bound(const std::vector<Push>& pushes, std::uint32_t pushed, Owner pusher) {
  return std::lower_bound(
      pushes.begin(), pushes.end(), std::pair(pushed, pusher),
      [](const Push& push, const auto& place) { return place_of(push) < place; });
}

}  // namespace

PushBook::PushBook(const State& state) : parts_(state.particles.size(), 0) {
  for (const Push& push : state.pushes) {
    count(push, 1);
  }
}

std::vector<std::uint32_t> PushBook::engaged_particles(const State& state) {
  std::vector<std::uint32_t> ids;
  for (const Push& push : state.pushes) {
    ids.push_back(push.pushed);
    if (is_particle(push.pusher)) {
      ids.push_back(static_cast<std::uint32_t>(push.pusher));
    }
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

std::span<const Push> PushBook::onto(const State& state, std::uint32_t id) {
  constexpr Owner kLowest = std::numeric_limits<Owner>::min();
  const auto first = lower_bound(state.pushes, id, kLowest);
  const auto last =
      std::find_if(first, state.pushes.end(), [id](const Push& push) { return push.pushed != id; });
  return {first, last};
}

const Push* PushBook::find(const State& state, std::uint32_t id, Owner pusher) {
  const auto found = lower_bound(state.pushes, id, pusher);
  const bool there = found != state.pushes.end() && place_of(*found) == std::pair(id, pusher);
  return there ? &*found : nullptr;
}

void PushBook::record(State& state, const Push& push) {
  const auto place = state.pushes.begin() +
                     (lower_bound(state.pushes, push.pushed, push.pusher) - state.pushes.cbegin());
  if (place != state.pushes.end() && place_of(*place) == place_of(push)) {
    *place = push;
    return;
  }
  state.pushes.insert(place, push);
  count(push, 1);
}

void PushBook::forget(State& state, std::uint32_t id, Owner other) {
  if (!erase(state, id, other) && is_particle(other)) {
    erase(state, static_cast<std::uint32_t>(other), static_cast<Owner>(id));
  }
}

bool PushBook::erase(State& state, std::uint32_t pushed, Owner pusher) {
  const Push* push = find(state, pushed, pusher);
  if (push == nullptr) {
    return false;
  }
  count(*push, -1);
  state.pushes.erase(state.pushes.begin() + (push - state.pushes.data()));
  return true;
}

void PushBook::count(const Push& push, int change) {
  parts_[push.pushed] += static_cast<std::uint32_t>(change);
  if (is_particle(push.pusher)) {
    parts_[static_cast<std::size_t>(push.pusher)] += static_cast<std::uint32_t>(change);
  }
}

}  // namespace clca::automaton
