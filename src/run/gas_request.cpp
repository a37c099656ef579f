#include "run/gas_request.hpp"

#include <limits>
#include <variant>

#include "clca/parallel/team.hpp"
#include "clca/random/word_hash.hpp"
#include "clca/run/run.hpp"
#include "clca/scene/parse.hpp"
#include "clca/scene/resolve.hpp"
#include "clca/store/checkpoint.hpp"
#include "clca/tasks/leader.hpp"

namespace clca::run {

namespace {

constexpr double kAnySize = std::numeric_limits<double>::infinity();

template <class T>
tasks::Bytes packed(const T& value, const std::string& scene) {
  return store::checkpoint_bytes({.kind = "gas",
                                  .scene_name = "",
                                  .scene = scene,
                                  .summary = "",
                                  .fields = reflection::encode(value)});
}

tasks::Bytes answer_to(std::size_t /*task*/, const tasks::Bytes& bytes,
                       const std::atomic<int>& stop) {
  const store::Checkpoint content = store::parse_checkpoint(bytes, kAnySize);
  GasRequest request;
  reflection::decode(content.fields, kAnySize, request);
  const auto scene =
      std::get<scene::BoltzmannScene>(scene::parse_any(content.scene, "the scene of rank 0"));
  GasIntegrator(scene).integrate(request.member, request.restitution, request.seed,
                                 parallel::start_team(request.threads),
                                 [&](const GasMember& /*now*/) { return stop == 0; });
  return packed(request.member, "");
}

}  // namespace

tasks::Bytes to_bytes(const GasRequest& request, const scene::BoltzmannScene& scene) {
  return packed(request, scene::to_yaml(scene));
}

GasMember gas_member(const tasks::Bytes& answer) {
  GasMember member;
  reflection::decode(store::parse_checkpoint(answer, kAnySize).fields, kAnySize, member);
  if (member.gas) {
    member.count();
  }
  return member;
}

std::uint64_t gas_fingerprint() {
  random::WordHash hash;
  for (const char letter : version()) {
    hash.add(static_cast<unsigned char>(letter));
  }
  return hash.value();
}

void serve(const RunOptions& options) {
  tasks::serve(*options.ranks, static_cast<std::size_t>(options.threads), gas_fingerprint(),
               answer_to, options.stop);
}

}  // namespace clca::run
