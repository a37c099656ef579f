#pragma once
// A state as a trajectory shows it, in memory: the datasets of docs/trajectory.md.

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "clca/grains/state.hpp"
#include "clca/scene/scene.hpp"
#include "clca/store/trajectory.hpp"

namespace clca::store {

struct Dataset {
  std::string path;
  std::size_t columns = 1;  ///< numbers in a row
  std::variant<std::vector<std::uint8_t>, std::vector<std::uint16_t>, std::vector<std::uint32_t>,
               std::vector<std::uint64_t>, std::vector<std::int32_t>, std::vector<double>,
               std::vector<std::string>>
      values;
};

/// Of a trajectory that has this frame alone, with contacts; but for `scene/name` and
/// `scene/units`.
std::vector<Dataset> datasets(const scene::Scene& scene, const grains::State& state,
                              std::size_t stage, const ContactFrame& contact);

}  // namespace clca::store
