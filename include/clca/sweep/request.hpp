#pragma once
// The input of a sweep: a scene, varied values, seeds.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "clca/scene/parse.hpp"

namespace clca::sweep {

inline constexpr std::size_t kMaxRuns = 100'000;

/// A key of the scene, as for scene::Override, and its values (YAML).
struct Variation {
  std::string key;
  std::vector<std::string> values;
};

struct Request {
  std::filesystem::path scene;
  std::vector<scene::Override> overrides;  ///< for all runs
  std::vector<Variation> variations;
  std::vector<std::uint64_t> seeds;  ///< ascending
};

/// Seeds from `1..16`, `3` or `1,4,9..12`, ascending. Throws scene::SceneError that names
/// `--seeds TEXT`.
std::vector<std::uint64_t> parse_seeds(std::string_view text);

/// A variation from `KEY=V1,V2,...`; commas inside brackets, braces and quotes belong to the value.
/// Throws scene::SceneError that names `--vary TEXT`.
Variation parse_variation(std::string_view text);

/// Shortest text that parse_seeds() reads as these seeds.
std::string to_text(const std::vector<std::uint64_t>& seeds);

}  // namespace clca::sweep
