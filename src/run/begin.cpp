#include "run/begin.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "clca/store/file.hpp"

namespace clca::run {

namespace {

namespace fs = std::filesystem;

/// "wall-removal, seed 2001, done 2026-11-22 14:05"
std::string description(const store::EarlierRun& earlier) {
  const store::RunSummary& run = earlier.summary;
  return fmt::format("{}, seed {}, {}{}{}", run.scene, run.seed,
                     run.status == "running" ? "not done" : run.status,
                     earlier.when.empty() ? "" : " ", earlier.when);
}

/// Makes the first of FOLDER, FOLDER-2, ... that does not exist.
fs::path made_free(const fs::path& folder) {
  const fs::path wanted = folder.has_filename() ? folder : folder.parent_path();
  if (wanted.has_parent_path()) {
    store::make_folder(wanted.parent_path());
  }
  for (int number = 1;; ++number) {
    fs::path path = number == 1 ? wanted : fs::path(fmt::format("{}-{}", wanted.string(), number));
    if (::mkdir(path.c_str(), 0777) == 0) {
      return path;
    }
    if (errno != EEXIST) {
      throw store::StoreError(
          fmt::format("cannot make the folder {}: {}", path.string(), std::strerror(errno)));
    }
  }
}

/// Throws if the folder `below` cannot be used, or contains user files named like those of a run.
void require_no_foreign(const store::OutputFolder& folder, const std::string& below,
                        const std::string& begin, const std::string& end) {
  const fs::path path = folder.path(below);
  std::error_code error;
  const fs::file_status status = fs::symlink_status(path, error);
  if (!fs::exists(status)) {
    return;
  }
  if (!fs::is_directory(status)) {
    throw store::StoreError(fmt::format(
        "cannot write to {}: it is no folder, or a symbolic link, which is not followed",
        path.string()));
  }
  for (fs::directory_iterator it(path, error), last; !error && it != last; it.increment(error)) {
    const std::string name = it->path().filename().string();
    if (name.starts_with(begin) && name.ends_with(end)) {
      folder.require_free(fmt::format("{}/{}", below, name));
    }
  }
}

}  // namespace

store::RunFolder begin_run(const RunOptions& options, const RunEvents& events,
                           const store::Checkpoint& start, const std::vector<PlannedFile>& files) {
  const fs::path path = options.keep ? made_free(options.folder) : options.folder;
  if (events.folder) {
    events.folder(path);
  }
  store::RunFolder folder = store::RunFolder::for_new_run(path);
  require_no_foreign(folder.files(), store::kFramesFolder, start.scene_name + "-", ".png");
  require_no_foreign(folder.files(), "trajectory", "part-", ".h5");
  std::set<std::string> planned;
  for (const PlannedFile& file : files) {
    folder.files().require_free(file.name);
    if (file.is_certain) {
      planned.insert(file.name);
    }
  }
  if (const auto earlier = folder.earlier_run()) {
    const std::string run = description(*earlier);
    if (earlier->unfinished && !options.overwrite) {
      throw UnfinishedRunError(
          fmt::format("{}: there is an unfinished run ({}): continue it with clca resume, "
                      "replace it with --overwrite, or run in another folder with --keep",
                      path.string(), run));
    }
    if (events.message) {
      events.message(fmt::format("replacing the run in {}: {}", path.string(), run));
    }
  }
  folder.start_over(start, planned);
  return folder;
}

}  // namespace clca::run
