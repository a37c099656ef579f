#pragma once
// The request of a sweep (a scene, varied values, seeds) and the plan made from it: the parsed
// scenes, the runs, their order and names.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
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
  std::vector<std::vector<std::string>> value_rows;  ///< each with a value per key
};

struct Request {
  std::filesystem::path scene_file;
  std::vector<scene::Override> overrides;  ///< for all runs
  std::vector<Variation> variations;
  std::vector<std::uint64_t> seeds;            ///< ascending
  std::optional<std::string> scene_text = {};  ///< replaces the text of the file
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

/// One combination of the varied values.
struct Variant {
  std::vector<std::string> values;  ///< one per key of Plan::varied_keys()
  scene::Scene scene;               ///< with the first seed
};

/// All combinations, the last variation changing fastest; within each all seeds.
struct Plan {
  Request request;
  std::vector<Variant> variants;

  /// All varied keys, in the order of the variations.
  std::vector<std::string> varied_keys() const;
  std::string title() const;  ///< title of the scenes; empty where it varies
  std::size_t run_count() const { return variants.size() * request.seeds.size(); }
  const Variant& variant(std::size_t run) const { return variants[run / request.seeds.size()]; }
  std::uint64_t seed(std::size_t run) const { return request.seeds[run % request.seeds.size()]; }
  scene::Scene scene(std::size_t run) const;
  /// Folder name of a run, `rules.inertia=0,seed=3`: the same in every sweep for the same values
  /// and seed. Values that cannot be in a file name are replaced by a hash.
  std::string run_name(std::size_t run) const;
};

/// A hash of all scenes of a plan, the version of clca and `more`: the same in every process.
std::uint64_t hash_of(const Plan& plan, std::string_view more);

/// Parses every combination. `max_bytes`: for the state of another run that they begin with. Throws
/// scene::SceneError for the first that is wrong. `interrupt` is called for each and may throw.
Plan plan(
    Request request, double max_bytes = std::numeric_limits<double>::infinity(),
    const std::function<void()>& interrupt = [] {});

/// How many of `jobs` runs fit into `max_bytes` of memory at a time. Throws scene::SceneError if
/// not even one does, or one cannot begin. `interrupt` as of plan().
int fitting_jobs(
    const Plan& plan, int jobs, double max_bytes, const std::function<void()>& interrupt = [] {});

}  // namespace clca::sweep
