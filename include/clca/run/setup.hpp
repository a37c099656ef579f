#pragma once
// A scene as it is asked for, by file or name, checked, within a limit of memory.

#include <filesystem>
#include <string>

#include "clca/scene/parse.hpp"
#include "clca/scene/scene.hpp"

namespace clca::run {

/// In which memory is told, in bytes.
inline constexpr double kMebibyte = 1 << 20;

/// The file of an installed scene if `name` is NAME or scenes/NAME.yaml and no file, else `name`.
/// Throws scene::SceneError for what may be meant as the name of one.
std::string scene_file(const std::string& name);

/// Number of threads of the machine.
int machine_threads();

/// 80 % of the memory that is available without swapping, in bytes.
double default_memory_limit();

/// Upper estimate of the memory of a run, in bytes.
double memory_of(const scene::Scene& scene);

/// Throw scene::SceneError when the scene needs more memory than `limit` bytes.
void check_memory(const scene::Scene& scene, double limit);
void check_memory(const scene::AnyScene& scene, double limit, int threads);

/// Finds what the scene begins with and checks that it fits into `limit` bytes of memory, that of a
/// Boltzmann run on `threads` threads. `file`: of the scene, for messages. Throws
/// scene::SceneError.
void complete(scene::AnyScene& scene, const std::string& file, double limit, int threads);

/// Throws scene::SceneError if a run in `folder` would replace the scene `file`.
void check_output(const std::string& file, const std::filesystem::path& folder);

/// Notes the hash and the number of particles of the state that the scene begins with, if that is
/// another run's and they are not noted yet. Reads it within `max_bytes` of memory.
/// Throws scene::SceneError unless it is there, whole and the one that the scene asks for.
void find_begin(scene::Scene& scene, double max_bytes);

/// Does everything that a run does before its first step, without a folder, to check the scene.
/// Throws as run(). Takes as much memory and time.
void check_start(const scene::Scene& scene);

}  // namespace clca::run
