#pragma once
// The gases of an ensemble that a rank advances.

#include <algorithm>
#include <cstdint>
#include <map>
#include <vector>

#include "clca/scene/boltzmann.hpp"
#include "clca/tasks/ranks.hpp"
#include "model/internal/gas_member.hpp"

namespace clca::run {

struct GasShare {
  double restitution = 1;
  /// Of all members that have not begun, by number: each rank takes the next one when it is free.
  std::vector<std::size_t> shared;
  /// Members that have begun in an earlier process, by number: for this rank alone.
  std::map<std::size_t, model::GasMember> begun;

  CLCA_FIELDS(restitution, shared, begun);
};

tasks::Bytes to_bytes(const GasShare& share, const scene::BoltzmannScene& scene);

/// From the answer of a rank.
model::GasMember gas_member(const tasks::Bytes& answer);

/// Gases at a time in a process, and threads of each.
struct GasThreads {
  GasThreads(int threads, std::uint64_t ensemble, int ranks)
      : gases(std::min<std::uint64_t>(static_cast<std::uint64_t>(threads),
                                      1 + (ensemble - 1) / static_cast<std::uint64_t>(ranks))),
        of_gas(std::max(1, threads / static_cast<int>(gases))) {}

  std::size_t gases;
  int of_gas;
};

}  // namespace clca::run
