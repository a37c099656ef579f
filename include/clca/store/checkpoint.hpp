#pragma once
// Checkpoints: everything that a run needs to resume.

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "clca/reflection/columns.hpp"
#include "clca/store/file.hpp"
#include "clca/store/output_folder.hpp"

namespace clca::store {

/// A checkpoint, or a file that it refers to, has changed since the run wrote it.
class UnusableCheckpointError : public store::StoreError {
 public:
  using StoreError::StoreError;
};

struct Checkpoint {
  std::string kind;          ///< as RunSummary::kind
  std::string scene_name;    ///< as RunSummary::scene
  std::string scene_text;    ///< resolved, as in scene.yaml
  std::string summary_json;  ///< run.json as it was then
  /// All that the run has changed; before its first step only options beside its scene, if any:
  /// columns `wanted/...`.
  reflection::Columns fields;

  static constexpr const char* kRequestPrefix = "wanted";
  bool is_before_first_step() const {
    return std::ranges::all_of(fields, [](const auto& column) {
      return column.first.starts_with(std::string(kRequestPrefix) + "/");
    });
  }
};

/// The content of a file; also sent between processes.
std::vector<std::uint8_t> checkpoint_bytes(const Checkpoint& checkpoint);

/// Throws std::runtime_error with the reason for data that checkpoint_bytes() does not produce, or
/// that needs more than `max_bytes` including the file; checked before allocation.
Checkpoint parse_checkpoint(std::span<const std::uint8_t> file, double max_bytes);

inline constexpr const char* kCheckpointFile = "checkpoint.clca";
inline constexpr const char* kPreviousCheckpointFile = "checkpoint-previous.clca";

/// What becomes of the newest checkpoint before another one is written.
enum class PreviousCheckpoint : std::uint8_t { kept, replaced };

/// Writes a checkpoint, after all that was written before it is on the disk; one that is kept is
/// renamed to kPreviousCheckpointFile. One complete checkpoint exists at any moment. Throws
/// StoreError.
void write_checkpoint(const OutputFolder& folder, const Checkpoint& checkpoint,
                      PreviousCheckpoint previous = PreviousCheckpoint::kept);
/// Removes both, the older first. Throws StoreError.
void remove_checkpoints(const OutputFolder& folder);

struct FoundCheckpoint {
  Checkpoint checkpoint;
  std::string warning;  ///< one line if the newest cannot be used and this is the previous one
};

/// The newest valid checkpoint, if any. Throws StoreError if none of those present can be read
/// within `max_bytes` of memory, or if the only one is from an older version of clca.
std::optional<FoundCheckpoint> read_checkpoint(const std::filesystem::path& run_folder,
                                               double max_bytes);

}  // namespace clca::store
