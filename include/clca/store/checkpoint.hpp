#pragma once
// What a run needs to go on after it was stopped or killed.

#include <filesystem>
#include <optional>
#include <string>

#include "clca/fields/columns.hpp"

namespace clca::store {

struct Checkpoint {
  std::string kind;        ///< as RunSummary::kind
  std::string scene_name;  ///< as RunSummary::scene
  std::string scene;       ///< resolved, as in scene.yaml
  std::string summary;     ///< run.json as it was then
  fields::Columns fields;  ///< all that the run has changed
};

/// Writes `checkpoint.h5`; the one before becomes `checkpoint-previous.h5`. Either is there whole
/// at any moment. Throws StoreError.
void write_checkpoint(const std::filesystem::path& run_folder, const Checkpoint& checkpoint);

struct FoundCheckpoint {
  Checkpoint checkpoint;
  std::string warning;  ///< one line where the newest cannot be used and this is the one before
};

/// The newest that is sound; nothing where there is none at all. Throws StoreError where none that
/// is there may be read with `most_bytes` of memory.
std::optional<FoundCheckpoint> read_checkpoint(const std::filesystem::path& run_folder,
                                               double most_bytes);

}  // namespace clca::store
