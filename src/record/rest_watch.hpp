#pragma once
// Finds a bed that does not come to rest, by the few grains that move on.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "clca/reflection/columns.hpp"
#include "clca/scene/scene.hpp"

namespace clca::record {

class RestWatch {
 public:
  static constexpr std::size_t kMostMovers = 3;
  static constexpr std::uint64_t kSteps = 2000;

  /// After a step in which `moved` grains have moved. Once, what there is to warn of: for kSteps
  /// steps the same grains, kMostMovers at most, have been the only ones that moved, none of them
  /// has come lower, and one has gone farther than to a neighbouring site and back; else the bed
  /// settles by itself.
  std::optional<std::string> add(const scene::Scene& scene, const grains::State& state,
                                 std::size_t moved);

  CLCA_FIELDS(movers_, steps_, has_advanced_, has_warned_);
  /// False for what no run that reached the state can have recorded.
  bool precedes(const grains::State& state) const;

 private:
  struct Mover {
    std::uint32_t id = 0;
    std::int32_t column = 0;  // of its anchor, which follows as in contact::State
    std::int32_t row = 0;
    std::int32_t lowest = 0;  // row
    std::uint64_t moves = 0;

    CLCA_FIELDS(id, column, row, lowest, moves);
  };

  void begin_anew();
  void add_move(const grains::State& state, std::uint32_t id);

  std::vector<Mover> movers_;
  std::uint64_t steps_ = 0;  // since they alone move
  bool has_advanced_ = false;
  bool has_warned_ = false;
};

}  // namespace clca::record
