#include "clca/store/checkpoint.hpp"

#include <fmt/format.h>

#include <system_error>

#include "clca/store/file.hpp"
#include "store/sealed_file.hpp"

namespace clca::store {

namespace {

namespace fs = std::filesystem;

constexpr FileKind kCheckpointKind = {"checkpoint", 1};
constexpr const char* kList = "fields";
constexpr const char* kFields = "run/";

fs::path newest(const fs::path& run_folder) {
  return run_folder / kCheckpointFile;
}
fs::path one_before(const fs::path& run_folder) {
  return run_folder / kCheckpointBefore;
}

template <class... Numbers>
fields::Column read_column(const SealedReader& reader, const std::string& path,
                           std::type_identity<std::variant<std::vector<Numbers>...>> /*kinds*/) {
  fields::Column column;
  const bool known =
      ((reader.holds<Numbers>(path) && (column = reader.read<Numbers>(path), true)) || ...);
  if (!known) {
    reader.refuse(path + " holds other numbers");
  }
  return column;
}

Checkpoint read(const fs::path& file, double most_bytes) {
  const SealedReader reader(file, kCheckpointKind, most_bytes);
  Checkpoint checkpoint = {.kind = reader.read_text("kind"),
                           .scene_name = reader.read_text("scene_name"),
                           .scene = reader.read_text("scene"),
                           .summary = reader.read_text("summary"),
                           .fields = {}};
  for (const std::string& path : reader.read_texts(kList)) {
    checkpoint.fields[path] =
        read_column(reader, kFields + path, std::type_identity<fields::Column>());
  }
  return checkpoint;
}

std::vector<std::uint8_t> encoded(const Checkpoint& checkpoint) {
  SealedWriter writer(kCheckpointKind);
  writer.add_text("kind", checkpoint.kind);
  writer.add_text("scene_name", checkpoint.scene_name);
  writer.add_text("scene", checkpoint.scene);
  writer.add_text("summary", checkpoint.summary);
  std::vector<std::string> paths;
  for (const auto& one : checkpoint.fields) {
    paths.push_back(one.first);
    std::visit(
        [&]<class T>(const std::vector<T>& values) {
          writer.add<T>(kFields + one.first, std::span<const T>(values));
        },
        one.second);
  }
  writer.add_texts(kList, paths);
  return writer.seal();
}

}  // namespace

void write_checkpoint(const OutputFolder& folder, const Checkpoint& checkpoint) {
  AtomicFile file = folder.create(kCheckpointFile);
  file.write(encoded(checkpoint));
  folder.rename(kCheckpointFile, kCheckpointBefore);
  file.finish();
}

void replace_checkpoint(const OutputFolder& folder, const Checkpoint& checkpoint) {
  folder.write(kCheckpointFile, encoded(checkpoint));
}

void remove_checkpoints(const OutputFolder& folder) {
  folder.remove(kCheckpointBefore);
  folder.remove(kCheckpointFile);
}

std::optional<FoundCheckpoint> read_checkpoint(const fs::path& run_folder, double most_bytes) {
  if (!fs::exists(newest(run_folder)) && !fs::exists(one_before(run_folder))) {
    return std::nullopt;
  }
  try {
    return FoundCheckpoint{read(newest(run_folder), most_bytes), ""};
  } catch (const StoreError& first) {
    try {
      return FoundCheckpoint{
          read(one_before(run_folder), most_bytes),
          fmt::format("{}; going on from {}", first.what(), one_before(run_folder).string())};
    } catch (const StoreError&) {
      throw first;
    }
  }
}

}  // namespace clca::store
