#include "run/checkpoint_writer.hpp"

#include <memory>
#include <system_error>
#include <utility>

namespace clca::run {

CheckpointWriter::CheckpointWriter(const std::optional<scene::Checkpoints>& when) : when_(when) {
  if (when && when->seconds) {
    timer_.emplace(std::chrono::duration_cast<std::chrono::milliseconds>(
        std::chrono::duration<double>(*when->seconds)));
  }
}

bool CheckpointWriter::due(std::uint64_t step) {
  const bool by_steps = when_ && when_->every && step % *when_->every == 0;
  return by_steps || due_by_clock();
}

void CheckpointWriter::save(const store::OutputFolder& run_folder, store::Checkpoint checkpoint) {
  finish();
  const auto shared = std::make_shared<const store::Checkpoint>(std::move(checkpoint));
  const auto write = [run_folder, shared] { store::write_checkpoint(run_folder, *shared); };
  try {
    writing_ = std::async(std::launch::async, write);
  } catch (const std::system_error&) {  // no more threads can be had
    write();
  }
}

void CheckpointWriter::finish() {
  if (writing_.valid()) {
    writing_.get();
  }
}

}  // namespace clca::run
