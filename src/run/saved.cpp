#include "run/saved.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "clca/run/setup.hpp"
#include "clca/store/file.hpp"

namespace clca::run {

namespace {

/// A plain number means steps, the end of a gas its time.
scene::Override until_override(const scene::AnyScene& scene, const std::string& until) {
  const auto* automaton = std::get_if<scene::Scene>(&scene);
  if (automaton == nullptr) {
    return "boltzmann.until=" + until;
  }
  const bool plain = !until.empty() && until.find_first_not_of("0123456789") == std::string::npos;
  return fmt::format("stages.{}.until={}", automaton->stages.size() - 1,
                     plain ? fmt::format("{{steps: {}}}", until) : until);
}

/// A scene by its resolved text, and what to call it.
struct SavedScene {
  std::string text;
  std::string name;
};

scene::AnyScene parse_saved(const SavedScene& saved, const std::filesystem::path& file,
                            const std::optional<std::string>& until) {
  scene::AnyScene scene = scene::parse_any(saved.text, file.string());
  if (until) {
    scene = scene::parse_any(saved.text, file.string(), {until_override(scene, *until)});
  }
  std::visit([&](auto& one) { one.name = saved.name; }, scene);
  return scene;
}

/// What a run has left that was killed before its first checkpoint.
SavedScene scene_in(const store::RunFolder& folder, double most_bytes) {
  if (!std::filesystem::exists(folder.scene()) || !std::filesystem::exists(folder.summary())) {
    throw store::StoreError(
        fmt::format("cannot go on in {}: no run has begun there", folder.path().string()));
  }
  const auto text = store::read_whole(folder.scene(), most_bytes);
  return {std::string(text.begin(), text.end()), store::read_summary(folder.summary()).scene};
}

automaton::State saved_state(const scene::Scene& scene, const SavedRun& saved) {
  const automaton::State beginning = initial_state(scene);
  automaton::State state = beginning;
  fields::decode(kSavedState, saved.checkpoint->fields, saved.most_bytes, state);
  automaton::check_reachable(state, beginning);
  return state;
}

}  // namespace

SavedRun load_run(const std::filesystem::path& folder, double most_bytes,
                  const std::optional<std::string>& until) {
  if (!std::filesystem::is_directory(folder)) {
    throw store::StoreError(
        fmt::format("cannot go on in {}: there is no such folder", folder.string()));
  }
  store::RunFolder run_folder = store::RunFolder::for_resumed_run(folder);
  std::optional<store::FoundCheckpoint> found = store::read_checkpoint(folder, most_bytes);
  const SavedScene saved = found ? SavedScene{found->checkpoint.scene, found->checkpoint.scene_name}
                                 : scene_in(run_folder, most_bytes);
  scene::AnyScene scene = parse_saved(saved, run_folder.scene(), until);
  SavedRun result = {.folder = std::move(run_folder),
                     .scene = std::move(scene),
                     .checkpoint = {},
                     .most_bytes = most_bytes,
                     .warning = found ? found->warning : ""};
  if (found) {
    result.checkpoint = std::move(found->checkpoint);
  }
  return result;
}

store::StoreError not_of_this_run(const std::filesystem::path& folder, const std::string& reason) {
  store::StoreError error(fmt::format("cannot go on in {}: its checkpoint is not of this run: {}",
                                      folder.string(), reason));
  return error;
}

SavedParts saved_parts(const scene::Scene& scene, const SavedRun& saved) {
  SavedParts parts = {
      .state = saved_state(scene, saved), .course = {}, .history = {}, .outputs = {}, .stages = {}};
  const fields::Columns& columns = saved.checkpoint->fields;
  fields::decode(kSavedCourse, columns, saved.most_bytes, parts.course);
  fields::decode(kSavedHistory, columns, saved.most_bytes, parts.history);
  fields::decode(kSavedOutputs, columns, saved.most_bytes, parts.outputs);
  parts.stages = store::parse_summary(saved.checkpoint->summary, "its summary").stages;
  const auto columns_of_lattice = static_cast<std::size_t>(parts.state.lattice.columns());
  if (parts.course.stage >= scene.stages.size() || parts.stages.size() != parts.course.stage ||
      parts.history.profile_at_start.size() != columns_of_lattice) {
    throw fields::Mismatch("its stages are others");
  }
  return parts;
}

}  // namespace clca::run
