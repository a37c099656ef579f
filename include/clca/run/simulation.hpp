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

/// Stages follow each other as in a run, with the same bits. After step() or begin_next_stage() has
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
  std::size_t stage_index() const;  ///< number of the stage, from 0
  /// How the stage has ended, as in run.json; empty while it goes on.
  std::string stage_end_text() const;
  bool is_over() const;

  /// Takes a step, and before that begins the next stage where one has ended. Throws
  /// std::logic_error if is_over(), else as run().
  grains::StepReport step();
  /// Begins the next stage now. Throws std::logic_error in the last one, else as run().
  void begin_next_stage();

  const grains::State& state() const;
  /// state(), which keeps its memory while held: the next stage then works on a copy.
  /// While a source is open, it is a copy.
  std::shared_ptr<const grains::State> shared_state() const;
  /// Velocities, spins and forces of the contact model in the last step.
  store::ContactFrame contact_frame() const;
  std::uint64_t state_hash() const;  ///< as RunSummary::state_hash

  /// The measures of the stage in run.json, as of now; `wanted`: only this one of Scene::measures.
  std::vector<store::NamedMeasure> measures(std::optional<scene::Measure> wanted = {}) const;
  /// Throws scene::SceneError if the driver cannot draw it.
  image::Image picture(const scene::PictureOutput& frames);

 private:
  struct Impl;
  Impl& checked_impl() const;  ///< throws the exception of an earlier failure

  std::unique_ptr<Impl> impl_;
};

}  // namespace clca::run
