#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "run/saved.hpp"

namespace clca::run {

namespace {

void require_of_run(bool holds, const char* reason) {
  if (!holds) {
    throw reflection::ColumnMismatch(reason);
  }
}

/// Throws reflection::ColumnMismatch unless a run of the scene can have saved it.
void check(const SavedGasRun& course, const scene::BoltzmannScene& scene) {
  const std::vector<model::ObservationTime> times = model::observation_times(scene);
  const std::size_t lasting = model::lasting_time_count(scene);
  const std::size_t bins = model::energy_bins(scene).count();
  const auto check_gas = [&](const boltzmann::Gas& gas, double from, double to) {
    require_of_run(static_cast<std::uint64_t>(gas.particle_count()) == scene.particles,
                   "a gas has another number of particles");
    require_of_run(gas.time >= from && gas.time <= to, "a gas is at another time");
    // Powers up to the fourth, summed up, must not overflow.
    constexpr double kMaxSpeed = 1e70;
    require_of_run(gas.thermal_speed >= 0 && gas.thermal_speed <= kMaxSpeed &&
                       (gas.motions.abs() <= kMaxSpeed).all(),
                   "a speed of a gas is not finite or too large");
  };
  const auto check_member = [&](const model::GasMember& member) {
    const std::size_t seen = member.observations.size();
    require_of_run(seen <= times.size(), "it has more observations than the scene has times");
    for (std::size_t i = 0; i < seen; ++i) {
      const auto& [translational, rotational] = member.observations[i].shares;
      const std::size_t count = times[i].in_histograms ? bins : 0;
      require_of_run(translational.size() == count && rotational.size() == count,
                     "its bins are others");
    }
    require_of_run(!member.gas || seen < times.size(), "a gas is beyond the end");
    require_of_run(member.gas || seen == 0 || seen == times.size(), "a gas is missing");
    if (member.gas) {
      check_gas(*member.gas, seen == 0 ? 0 : times[seen - 1].time, times[seen].time);
    }
    if (member.lasting) {
      require_of_run(lasting > 0 && seen >= lasting,
                     "a gas is kept for an end that it has not reached");
      check_gas(*member.lasting, times[lasting - 1].time, times[lasting - 1].time);
    }
  };
  require_of_run(course.wall_seconds >= 0 && std::isfinite(course.wall_seconds),
                 "its time is not a number of 0 or more");
  require_of_run(
      course.cases.size() <= scene.restitutions.size() && course.cases_ended <= course.cases.size(),
      "its restitutions are others");
  for (std::size_t i = 0; i < course.cases.size(); ++i) {
    require_of_run(course.cases[i].restitution == scene.restitutions[i],
                   "its restitutions are others");
    require_of_run(course.cases[i].members.size() == scene.ensemble_size,
                   "its ensemble is another");
    std::ranges::for_each(course.cases[i].members, check_member);
  }
}

void move_back_to_new_end(SavedGasRun& course, const scene::BoltzmannScene& old_scene,
                          const SavedRun& saved) {
  const auto& scene = std::get<scene::BoltzmannScene>(saved.scene);
  const auto refuse = [&](const std::string& reason) {
    throw store::StoreError(fmt::format("cannot resume the run in {} until {}: {}",
                                        saved.folder.path().string(), scene.end_time, reason));
  };
  const std::size_t lasting = model::lasting_time_count(old_scene);
  const std::size_t shared = model::shared_time_count(model::observation_times(old_scene),
                                                      model::observation_times(scene));
  for (record::GasCase& gas_case : course.cases) {
    for (model::GasMember& member : gas_case.members) {
      if (member.gas ? member.observations.size() < shared : member.observations.empty()) {
        continue;  // all of it comes before the earlier end
      }
      if (lasting > shared) {
        refuse(fmt::format("its gases are beyond {}, or in a step that leads beyond it",
                           scene.end_time));
      }
      if (!member.lasting) {
        refuse(
            "it has not kept its gases as they were before the end (output.checkpoint: none, or "
            "more than 1 GiB of them)");
      }
      member.observations.resize(lasting);
      member.gas = std::exchange(member.lasting, std::nullopt);
    }
  }
  course.cases_ended = 0;
}

}  // namespace

SavedGasRun saved_gas_run(const SavedRun& saved) {
  const store::Checkpoint& checkpoint = saved.checkpoint;
  const auto old_scene = std::get<scene::BoltzmannScene>(
      scene::parse_any(checkpoint.scene_text, (saved.folder.path() / store::kSceneFile).string()));
  SavedGasRun course;
  try {
    reflection::decode(kGasesPath, checkpoint.fields, saved.max_bytes, course);
    check(course, old_scene);
  } catch (const reflection::ColumnMismatch& error) {
    throw mismatched_checkpoint(saved.folder.path(), error.what());
  }
  if (old_scene.end_time != std::get<scene::BoltzmannScene>(saved.scene).end_time) {
    move_back_to_new_end(course, old_scene, saved);
  }
  for (record::GasCase& gas_case : course.cases) {
    for (model::GasMember& member : gas_case.members) {
      if (member.gas) {
        member.record_counts();
      }
    }
  }
  return course;
}

}  // namespace clca::run
