#pragma once
// Constant data of a trajectory: group `scene` of each part.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "clca/grains/state.hpp"
#include "clca/scene/scene.hpp"
#include "store/hdf5_file.hpp"

namespace clca::store {

/// Concatenated sets of sites.
struct SiteSets {
  std::vector<std::uint64_t> first;
  std::vector<std::uint32_t> size;
  std::vector<std::int32_t> sites;  ///< two numbers each

  void begin();
  void add(int one, int other);
  bool operator==(const SiteSets&) const = default;
};

struct SceneTables {
  std::string name;
  std::string units;  ///< of all that is in the trajectory, in words
  std::vector<std::uint64_t> seed;
  std::vector<std::uint32_t> lattice;  ///< columns, rows, 1 if periodic
  std::vector<std::string> species;
  std::vector<std::string> stages;
  std::vector<std::uint16_t> kind_species;
  std::vector<double> kind_centre;  ///< x, y from the reference site
  SiteSets kind_sites;              ///< axial x, q from the reference site
  std::vector<std::string> walls;
  SiteSets wall_sites;  ///< column, row at home

  SceneTables() = default;
  SceneTables(const scene::Scene& scene, const grains::State& state);

  void write(const Hdf5Writer& file) const;
  /// All datasets except name and units. This object must outlive the list.
  std::vector<Hdf5Dataset> datasets();
  /// Throws StoreError with the difference unless those read from `path` are of the same scene.
  void require_same(const SceneTables& read, const std::filesystem::path& path) const;
};

}  // namespace clca::store
