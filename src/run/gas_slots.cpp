#include "run/gas_slots.hpp"

#include <algorithm>
#include <utility>

namespace clca::run {

model::GasMember GasSlots::begin(std::size_t number) {
  const std::lock_guard lock(mutex_);
  running_[number] = collecting_;
  return std::exchange(members_[number], {});
}

void GasSlots::after_step(std::size_t number, const model::GasMember& member) {
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock) {
    return;  // a step later will do
  }
  if (!collecting_) {
    if (!checkpoint_writer_.due(member.gas->step)) {
      return;
    }
    collect();
  }
  if (bool& awaited = running_[number]) {
    model::GasMember copy = member;  // whole, or memory has run out and nothing is changed
    members_[number] = std::move(copy);
    awaited = false;
    save_when_complete();
  }
}

std::uint64_t GasSlots::participations(std::size_t number) {
  const std::lock_guard lock(mutex_);
  return members_[number].participations;
}

void GasSlots::save_if_time() {
  const std::lock_guard lock(mutex_);
  if (!collecting_ && checkpoint_writer_.due_by_clock()) {
    collect();
    save_when_complete();
  }
}

void GasSlots::collect() {
  collecting_ = true;
  for (auto& [_, awaited] : running_) {
    awaited = true;
  }
}

void GasSlots::end(std::size_t number, model::GasMember member) {
  const std::lock_guard lock(mutex_);
  members_[number] = std::move(member);
  running_.erase(number);
  save_when_complete();
}

void GasSlots::save_when_complete() {
  const bool complete = collecting_ && std::none_of(running_.begin(), running_.end(),
                                                    [](const auto& gas) { return gas.second; });
  if (!complete) {
    return;
  }
  collecting_ = false;
  save_();
  for (const auto& [number, _] : running_) {
    members_[number] = {};  // its thread has the gas itself
  }
}

}  // namespace clca::run
