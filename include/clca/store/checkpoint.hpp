#pragma once
// What a run needs to go on after it was stopped or killed.

#include <filesystem>
#include <optional>
#include <string>

#include "clca/fields/columns.hpp"
#include "clca/store/output_folder.hpp"

namespace clca::store {

struct Checkpoint {
  std::string kind;        ///< as RunSummary::kind
  std::string scene_name;  ///< as RunSummary::scene
  std::string scene;       ///< resolved, as in scene.yaml
  std::string summary;     ///< run.json as it was then
  fields::Columns fields;  ///< all that the run has changed; empty before its first step

  /// Whether the run begins anew from here.
  bool is_start() const { return fields.empty(); }
};

inline constexpr const char* kCheckpointFile = "checkpoint.clca";
inline constexpr const char* kCheckpointBefore = "checkpoint-previous.clca";

/// Writes a checkpoint; the one before gets the name kCheckpointBefore. Either is there whole at
/// any moment. Throws StoreError.
void write_checkpoint(const OutputFolder& folder, const Checkpoint& checkpoint);
/// The same in place of the newest one.
void replace_checkpoint(const OutputFolder& folder, const Checkpoint& checkpoint);
/// Removes both, the older one first. Throws StoreError.
void remove_checkpoints(const OutputFolder& folder);

struct FoundCheckpoint {
  Checkpoint checkpoint;
  std::string warning;  ///< one line where the newest cannot be used and this is the one before
};

/// The newest that is sound; nothing where there is none at all. Throws StoreError where none that
/// is there may be read with `most_bytes` of memory, or where only an older version of clca has
/// left one.
std::optional<FoundCheckpoint> read_checkpoint(const std::filesystem::path& run_folder,
                                               double most_bytes);

}  // namespace clca::store
