#include "run/gas_saved.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clca/reflection/columns.hpp"
#include "run/saved.hpp"

namespace clca::run {

namespace {

void require_of_run(bool holds, const char* reason) {
  if (!holds) {
    throw reflection::Mismatch(reason);
  }
}

/// Whether a checkpoint can be from a run of a scene.
class GasCheck {
 public:
  explicit GasCheck(const scene::BoltzmannScene& scene)
      : scene_(scene),
        times_(model::gas_times(scene)),
        lasting_times_(model::lasting_times(scene)),
        bins_(model::bins_of(scene).count()) {}

  void operator()(const GasCourse& course) const {
    require_of_run(course.wall_seconds >= 0 && std::isfinite(course.wall_seconds),
                   "its time is not a number of 0 or more");
    require_of_run(course.cases.size() <= scene_.restitutions.size() &&
                       course.cases_ended <= course.cases.size(),
                   "its restitutions are others");
    for (std::size_t i = 0; i < course.cases.size(); ++i) {
      require_of_run(course.cases[i].restitution == scene_.restitutions[i],
                     "its restitutions are others");
      require_of_run(course.cases[i].members.size() == scene_.ensemble, "its ensemble is another");
      for (const model::GasMember& member : course.cases[i].members) {
        check(member);
      }
    }
  }

 private:
  void check(const model::GasMember& member) const {
    const std::size_t seen = member.observations.size();
    require_of_run(seen <= times_.size(), "it has more observations than the scene has times");
    for (std::size_t i = 0; i < seen; ++i) {
      check(member.observations[i], times_[i]);
    }
    if (member.gas) {
      require_of_run(seen < times_.size(), "a gas is beyond the end");
      check(*member.gas, seen == 0 ? 0 : times_[seen - 1].time, times_[seen].time);
    } else {
      require_of_run(seen == 0 || seen == times_.size(), "a gas is missing");
    }
    if (member.lasting) {
      require_of_run(lasting_times_ > 0 && seen >= lasting_times_,
                     "a gas is kept for an end that it has not reached");
      const double time = times_[lasting_times_ - 1].time;
      check(*member.lasting, time, time);
    }
  }

  void check(const model::GasObservation& observation, const model::GasTime& time) const {
    const std::size_t bins = time.in_histograms ? bins_ : 0;
    require_of_run(observation.shares.translational.size() == bins &&
                       observation.shares.rotational.size() == bins,
                   "its bins are others");
  }

  void check(const boltzmann::Gas& gas, double from, double to) const {
    require_of_run(static_cast<std::uint64_t>(gas.particles()) == scene_.particles,
                   "a gas has another number of particles");
    require_of_run(gas.time >= from && gas.time <= to, "a gas is at another time");
    // Powers up to the fourth, summed up, must not overflow.
    constexpr double kMaxSpeed = 1e70;
    require_of_run(gas.thermal_speed >= 0 && gas.thermal_speed <= kMaxSpeed &&
                       (gas.motions.abs() <= kMaxSpeed).all(),
                   "a speed of a gas is not finite or too large");
  }

  const scene::BoltzmannScene& scene_;
  std::vector<model::GasTime> times_;
  std::size_t lasting_times_;
  std::size_t bins_;
};

/// Moves gases back if the end of the run changes.
class EndChange {
 public:
  EndChange(const scene::BoltzmannScene& old_scene, const scene::BoltzmannScene& scene)
      : lasting_times_(model::lasting_times(old_scene)),
        shared_times_(model::shared_times(model::gas_times(old_scene), model::gas_times(scene))),
        until_(scene.until) {}

  void operator()(model::GasMember& member) const {
    const bool same_way =
        member.gas ? member.observations.size() < shared_times_ : member.observations.empty();
    if (same_way) {
      return;
    }
    if (lasting_times_ > shared_times_) {
      throw reflection::Mismatch(
          fmt::format("its gases are beyond {}, or in a step that leads beyond it", until_));
    }
    if (!member.lasting) {
      throw reflection::Mismatch(
          "it has not kept its gases as they were before the end (output.checkpoint: none, or more "
          "than 1 GiB of them)");
    }
    member.observations.resize(lasting_times_);
    member.gas = std::move(member.lasting);
    member.lasting.reset();
  }

 private:
  std::size_t lasting_times_;
  std::size_t shared_times_;
  double until_;
};

void move_end(GasCourse& course, const scene::BoltzmannScene& old_scene, const SavedRun& saved) {
  const auto& scene = std::get<scene::BoltzmannScene>(saved.scene);
  const EndChange move(old_scene, scene);
  try {
    for (record::GasCase& gas_case : course.cases) {
      std::for_each(gas_case.members.begin(), gas_case.members.end(), move);
    }
  } catch (const reflection::Mismatch& error) {
    throw store::StoreError(fmt::format("cannot resume the run in {} until {}: {}",
                                        saved.folder.path().string(), scene.until, error.what()));
  }
  course.cases_ended = 0;
}

}  // namespace

GasCourse saved_course(const SavedRun& saved) {
  const store::Checkpoint& checkpoint = saved.checkpoint;
  const auto old_scene = std::get<scene::BoltzmannScene>(
      scene::parse_any(checkpoint.scene, (saved.folder.path() / store::kSceneFile).string()));
  GasCourse course;
  try {
    reflection::decode(kSavedGases, checkpoint.fields, saved.max_bytes, course);
    GasCheck{old_scene}(course);
  } catch (const reflection::Mismatch& error) {
    throw mismatched_checkpoint(saved.folder.path(), error.what());
  }
  if (old_scene.until != std::get<scene::BoltzmannScene>(saved.scene).until) {
    move_end(course, old_scene, saved);
  }
  for (record::GasCase& gas_case : course.cases) {
    for (model::GasMember& member : gas_case.members) {
      if (member.gas) {
        member.count();
      }
    }
  }
  return course;
}

}  // namespace clca::run
