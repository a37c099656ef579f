#include "run/saver.hpp"

#include <utility>

namespace clca::run {

Saver::Saver(const std::optional<scene::Checkpoints>& when) : when_(when) {
  if (when && when->seconds) {
    ticker_.emplace(std::chrono::duration_cast<std::chrono::milliseconds>(
        std::chrono::duration<double>(*when->seconds)));
  }
}

bool Saver::due(std::uint64_t step) {
  const bool by_steps = when_ && when_->every && step % *when_->every == 0;
  return by_steps || (ticker_ && ticker_->due());
}

void Saver::save(const store::OutputFolder& run_folder, store::Checkpoint checkpoint,
                 std::function<void()> before) {
  finish();
  writing_ = std::async(std::launch::async, [run_folder, checkpoint = std::move(checkpoint),
                                             before = std::move(before)] {
    before();
    store::write_checkpoint(run_folder, checkpoint);
  });
}

void Saver::finish() {
  if (writing_.valid()) {
    writing_.get();
  }
}

}  // namespace clca::run
