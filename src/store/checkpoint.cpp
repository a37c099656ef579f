#include "clca/store/checkpoint.hpp"

#include <fmt/format.h>

namespace clca::store {

namespace {

namespace fs = std::filesystem;

fs::path newest(const fs::path& run_folder) {
  return run_folder / kCheckpointFile;
}
fs::path one_before(const fs::path& run_folder) {
  return run_folder / kCheckpointBefore;
}

AtomicFile on_the_disk(const OutputFolder& folder, const Checkpoint& checkpoint) {
  AtomicFile file = folder.create(kCheckpointFile);
  file.write(checkpoint_bytes(checkpoint));
  file.flush();
  return file;
}

Checkpoint read(const fs::path& file, double max_bytes) {
  const std::vector<std::uint8_t> bytes = read_whole(file, max_bytes);
  try {
    return parse_checkpoint(bytes, max_bytes);
  } catch (const std::runtime_error& error) {
    throw StoreError(fmt::format("cannot read {}: {}", file.string(), error.what()));
  }
}

}  // namespace

void write_checkpoint(const OutputFolder& folder, const Checkpoint& checkpoint) {
  AtomicFile file = on_the_disk(folder, checkpoint);
  folder.rename(kCheckpointFile, kCheckpointBefore);
  folder.flush();
  file.finish();
}

void replace_checkpoint(const OutputFolder& folder, const Checkpoint& checkpoint) {
  AtomicFile file = on_the_disk(folder, checkpoint);
  folder.flush();
  file.finish();
}

void remove_checkpoints(const OutputFolder& folder) {
  folder.remove(kCheckpointBefore);
  folder.remove(kCheckpointFile);
}

std::optional<FoundCheckpoint> read_checkpoint(const fs::path& run_folder, double max_bytes) {
  if (!fs::exists(newest(run_folder)) && !fs::exists(one_before(run_folder))) {
    return std::nullopt;
  }
  try {
    return FoundCheckpoint{read(newest(run_folder), max_bytes), ""};
  } catch (const StoreError& first) {
    try {
      return FoundCheckpoint{
          read(one_before(run_folder), max_bytes),
          fmt::format("{}; going on from {}", first.what(), one_before(run_folder).string())};
    } catch (const StoreError&) {
      throw first;
    }
  }
}

}  // namespace clca::store
