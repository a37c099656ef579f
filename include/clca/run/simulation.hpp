#pragma once
// A scene of grains step by step, without a folder.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clca/grains/model.hpp"
#include "clca/image/image.hpp"
#include "clca/scene/scene.hpp"
#include "clca/store/summary.hpp"
#include "clca/store/trajectory.hpp"

namespace clca::run {

/// Stages follow each other as in a run, with the same bits. After step() or next_stage() has
/// failed, all but scene() throws the same exception.
class Simulation {
 public:
  /// Begins the first stage. Throws as run(). `interruption`: see
  /// grains::Model::set_interruption.
  explicit Simulation(const scene::Scene& scene, int threads = 1,
                      std::function<void()> interruption = {});
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// The scene, with the hash and the number of particles of the state that it begins with.
  const scene::Scene& scene() const;
  /// Number of the stage, from 0.
  std::size_t stage() const;
  /// How the stage has ended, as in run.json; empty while it goes on.
  std::string ended() const;
  /// The last stage has ended.
  bool is_over() const;

  /// Takes a step, and before that begins the next stage where one has ended. Throws
  /// std::logic_error if is_over(), else as run().
  grains::StepReport step();
  /// Begins the next stage now. Throws std::logic_error in the last one, else as run().
  void next_stage();

  const grains::State& grains() const;
  /// grains(), which stay in their place while held: then the next stage works on a copy.
  /// While a source is open, a copy.
  std::shared_ptr<const grains::State> held_grains() const;
  /// Velocities, spins and forces of the contact model in the last step.
  store::ContactFrame contact_frame() const;
  /// As RunSummary::state_hash.
  std::uint64_t hash() const;

  /// What run.json has of the stage, as of now; `wanted`: one of Scene::measures alone.
  std::vector<store::NamedMeasure> measures(std::optional<scene::Measure> wanted = {}) const;
  /// Throws scene::SceneError if the driver cannot draw it.
  image::Image picture(const scene::Frames& frames);

 private:
  struct Impl;
  /// Throws what has failed before.
  Impl& live() const;

  std::unique_ptr<Impl> impl_;
};

}  // namespace clca::run
