#pragma once
// Finds the scene that the user names, checks it, and limits its memory.

#include <filesystem>
#include <string>

#include "clca/scene/parse.hpp"
#include "clca/scene/scene.hpp"

namespace clca::run {

/// Unit of memory in messages, in bytes.
inline constexpr double kMebibyte = 1 << 20;

/// The file of an installed scene if `name` is NAME or scenes/NAME.yaml and no file, else `name`.
/// Throws scene::SceneError if `name` looks like the name of a scene that is not there.
std::string scene_file(const std::string& name);

int machine_thread_count();

/// 80 % of the memory that is available without swapping, in bytes.
double default_memory_limit();

/// Upper estimate of the memory of a run, in bytes.
double estimated_run_bytes(const scene::Scene& scene);

/// Throw scene::SceneError when the scene needs more memory than `limit` bytes.
void check_memory(const scene::Scene& scene, double limit);
void check_memory(const scene::AnyScene& scene, double limit, int threads);

/// resolve_begin(), then check_memory(); `limit`: bytes, `threads`: of a Boltzmann run. `file`: of
/// the scene, for messages. Throws scene::SceneError.
void prepare_scene(scene::AnyScene& scene, const std::string& file, double limit, int threads);

/// Throws scene::SceneError if a run in `folder` would replace the scene `file`.
void check_output_folder(const std::string& file, const std::filesystem::path& folder);

/// If the scene begins with the state of another run, enters its hash and number of particles into
/// the scene, unless they are there. Reads it within `max_bytes` of memory. Throws
/// scene::SceneError unless the state is complete and the one that the scene asks for.
void resolve_begin(scene::Scene& scene, double max_bytes);

/// Does everything that a run does before its first step, without a folder, to check the scene.
/// Throws as run(). Takes as much memory and time.
void try_start(const scene::Scene& scene);

}  // namespace clca::run
