#pragma once
// A gas of an ensemble that another rank advances.

#include "clca/scene/boltzmann.hpp"
#include "clca/tasks/ranks.hpp"
#include "run/gas_member.hpp"

namespace clca::run {

struct GasRequest {
  double restitution = 1;
  std::uint64_t seed = 0;  ///< of the member
  int threads = 1;
  GasMember member;

  static constexpr auto fields() {
    using reflection::field;
    return std::make_tuple(field("restitution", &GasRequest::restitution),
                           field("seed", &GasRequest::seed), field("threads", &GasRequest::threads),
                           field("member", &GasRequest::member));
  }
};

tasks::Bytes to_bytes(const GasRequest& request, const scene::BoltzmannScene& scene);

/// The same in all processes of one version of clca.
std::uint64_t gas_fingerprint();

/// From the answer of a rank.
GasMember gas_member(const tasks::Bytes& answer);

}  // namespace clca::run
