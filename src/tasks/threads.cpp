#include "clca/tasks/threads.hpp"

#include <exception>
#include <system_error>
#include <utility>

namespace clca::tasks {

Threads::Threads(std::size_t wanted, bool inline_one, const std::function<void()>& begin) {
  if (wanted == 1 && inline_one) {
    return;
  }
  try {
    threads_.reserve(wanted);
    while (threads_.size() < wanted) {
      threads_.emplace_back([this, &begin] { work(begin); });
    }
  } catch (const std::exception&) {  // no more can be had
  }
  if (threads_.empty() && begin) {
    begin();
  }
  std::unique_lock lock(mutex_);
  ended_.wait(lock, [this] { return begun_ == threads_.size(); });
}

Threads::~Threads() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  started_.notify_all();
  for (std::thread& thread : threads_) {
    thread.join();
  }
}

std::size_t Threads::idle() const {
  const std::lock_guard lock(mutex_);
  if (are_inline()) {
    return has_ended_ ? 0 : 1;  // the one before is to be taken first
  }
  return threads_.size() - under_way_;
}

void Threads::start(std::function<void()> call) {
  if (are_inline()) {
    call();
    has_ended_ = true;
    return;
  }
  {
    const std::lock_guard lock(mutex_);
    calls_.push_back(std::move(call));
    ++under_way_;
  }
  started_.notify_one();
}

void Threads::wait(std::chrono::microseconds most) {
  std::unique_lock lock(mutex_);
  ended_.wait_for(lock, most, [this] { return has_ended_; });
  has_ended_ = false;
}

void Threads::work(const std::function<void()>& begin) {
  if (begin) {
    begin();
  }
  std::unique_lock lock(mutex_);
  ++begun_;
  ended_.notify_all();
  while (true) {
    started_.wait(lock, [this] { return over_ || !calls_.empty(); });
    if (calls_.empty()) {
      return;
    }
    const std::function<void()> call = std::move(calls_.back());
    calls_.pop_back();
    lock.unlock();
    call();
    lock.lock();
    --under_way_;
    has_ended_ = true;
    ended_.notify_all();
  }
}

void Background::start(std::function<void()> call) {
  finish();
  call_ = std::move(call);
  try {
    ended_ = std::async(std::launch::async, std::ref(call_));
  } catch (const std::system_error&) {  // no more threads can be had
    call_();
  }
}

void Background::finish() {
  if (ended_.valid()) {
    ended_.get();
  }
  call_ = nullptr;
}

}  // namespace clca::tasks
