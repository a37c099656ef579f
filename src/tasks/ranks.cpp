#include "clca/tasks/ranks.hpp"

#include <fmt/format.h>

#include <chrono>
#include <thread>
#include <utility>

namespace clca::tasks {

void Ranks::begin(const std::string& command, const std::string& failure) {
  has_begun_ = true;
  std::string verdict = failure;
  if (rank() == 0) {
    for (int other = 1; other < size(); ++other) {
      const Message message = wait();
      const std::string text(message.bytes.begin(), message.bytes.end());
      const bool has_failed = message.number != 0;
      if (verdict.empty() && (has_failed || text != command)) {
        verdict = fmt::format(
            "rank {}: {}", message.from,
            has_failed ? text
                       : "error: it was started with another scene, folder or version of clca");
      }
    }
    send_to_others(0, verdict);
  } else {
    const std::string& text = failure.empty() ? command : failure;
    send(0, failure.empty() ? 0 : 1, {text.begin(), text.end()});
    const Message message = wait();
    verdict.assign(message.bytes.begin(), message.bytes.end());
  }
  is_at_work_ = verdict.empty();
  if (!is_at_work_ && failure.empty()) {
    throw StartError(verdict);
  }
}

void Ranks::hand_out_work(const std::function<Bytes(int rank)>& work) {
  reset_counter();
  for (int other = 1; other < size() && !is_dismissed_; ++other) {
    send(other, 0, work(other));
  }
}

void Ranks::dismiss() {
  if (!std::exchange(is_dismissed_, true)) {
    send_to_others(kEndOfWork, "");
  }
}

bool Ranks::is_stop_message(const Message& message) {
  if (message.number != kStopped) {
    return false;
  }
  stop_signal_ = message.bytes.at(0);
  return true;
}

void Ranks::tell_stop(const std::atomic<int>* signal) {
  if (signal != nullptr && *signal != 0 && !std::exchange(has_told_stop_, true)) {
    send(0, kStopped, {static_cast<std::uint8_t>(*signal)});
  }
}

std::optional<Bytes> Ranks::wait_for_work(const std::atomic<int>* stop) {
  if (is_dismissed_) {
    return std::nullopt;
  }
  Message message = wait(stop);
  is_dismissed_ = message.number == kEndOfWork;
  return is_dismissed_ ? std::nullopt : std::optional(std::move(message.bytes));
}

bool Ranks::is_dismissed() {
  if (rank() > 0 && !is_dismissed_) {
    is_dismissed_ = receive().has_value();  // rank 0 sends nothing else meanwhile
  }
  return is_dismissed_;
}

Message Ranks::wait(const std::atomic<int>* stop) {
  constexpr std::chrono::milliseconds kPause(2);
  while (true) {
    if (auto message = receive()) {
      return *std::move(message);
    }
    tell_stop(stop);
    std::this_thread::sleep_for(kPause);
  }
}

void Ranks::send_to_others(std::uint64_t number, const std::string& text) {
  for (int other = 1; other < size(); ++other) {
    send(other, number, {text.begin(), text.end()});
  }
}

}  // namespace clca::tasks
