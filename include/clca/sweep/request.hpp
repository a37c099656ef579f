#pragma once
// The input of a sweep: a scene, varied values, seeds.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clca/scene/parse.hpp"

namespace clca::sweep {

inline constexpr std::size_t kMaxRuns = 100'000;

/// Keys of the scene, as for scene::Override, that vary together, and their values (YAML).
struct Variation {
  std::vector<std::string> keys;
  std::vector<std::vector<std::string>> rows;  ///< each with a value per key
};

struct Request {
  std::filesystem::path scene;
  std::vector<scene::Override> overrides;  ///< for all runs
  std::vector<Variation> variations;
  std::vector<std::uint64_t> seeds;      ///< ascending
  std::optional<std::string> text = {};  ///< in place of that of the file
};

/// Seeds from `1..16`, `3` or `1,4,9..12`, ascending. Throws scene::SceneError that names
/// `--seeds TEXT`.
std::vector<std::uint64_t> parse_seeds(std::string_view text);

/// A variation from `KEY=V1,V2,...`, or for keys that vary together `K1,K2=V1,V2; W1,W2; ...`. Of
/// one key a value `FIRST:LAST:STEP` stands for all numbers of the range. Commas and semicolons
/// inside brackets, braces and quotes belong to the value. Throws scene::SceneError that names
/// `--vary TEXT`.
Variation parse_variation(std::string_view text);

/// Shortest text that parse_seeds() reads as these seeds.
std::string to_text(const std::vector<std::uint64_t>& seeds);

}  // namespace clca::sweep
