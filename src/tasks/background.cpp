#include "clca/tasks/background.hpp"

#include <system_error>
#include <utility>

namespace clca::tasks {

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
