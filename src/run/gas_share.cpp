#include "run/gas_share.hpp"

#include <limits>
#include <variant>

#include "clca/parallel/team.hpp"
#include "clca/record/provenance.hpp"
#include "clca/run/run.hpp"
#include "clca/scene/parse.hpp"
#include "clca/scene/resolve.hpp"
#include "clca/store/checkpoint.hpp"
#include "clca/tasks/pool.hpp"

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

void advance(GasShare share, const scene::BoltzmannScene& scene, const RunOptions& options) {
  const model::GasIntegrator integrator(scene);
  const GasThreads threads(options.threads, scene.ensemble, options.ranks->size());
  const auto advance_one = [&](std::size_t number, const std::atomic<int>& stop) {
    const auto begun = share.begun.find(number);
    model::GasMember member =
        begun == share.begun.end() ? model::GasMember() : std::move(begun->second);
    integrator.integrate(member, share.restitution, boltzmann::member_seed(scene.seed, number),
                         parallel::start_team(threads.of_gas),
                         [&](const model::GasMember& /*now*/) { return stop == 0; });
    return packed(member, "");
  };
  tasks::Pool<tasks::Bytes> pool(threads.gases, *options.ranks, share.shared,
                                 {.carry_out = advance_one}, options.stop);
  for (const auto& [number, _] : share.begun) {
    pool.add(number);
  }
  tasks::serve(pool, *options.ranks);
}

}  // namespace

tasks::Bytes to_bytes(const GasShare& share, const scene::BoltzmannScene& scene) {
  return packed(share, scene::to_yaml(scene));
}

model::GasMember gas_member(const tasks::Bytes& answer) {
  model::GasMember member;
  reflection::decode(store::parse_checkpoint(answer, kAnySize).fields, kAnySize, member);
  return member;
}

void serve(const RunOptions& options) {
  options.ranks->begin(record::version());
  while (const auto work = options.ranks->wait_for_work(options.stop)) {
    const store::Checkpoint content = store::parse_checkpoint(*work, kAnySize);
    GasShare share;
    reflection::decode(content.fields, kAnySize, share);
    advance(std::move(share),
            std::get<scene::BoltzmannScene>(scene::parse_any(content.scene, "the scene of rank 0")),
            options);
  }
}

}  // namespace clca::run
