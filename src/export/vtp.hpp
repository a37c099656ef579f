#pragma once
// VTK files: particles for each frame, walls whenever they have changed, and a collection (.pvd)
// that assigns them to steps.

#include <optional>
#include <string>
#include <vector>

#include "clca/export/export.hpp"
#include "clca/export/frame.hpp"

namespace clca::exports {

class VtpWriter : public Writer {
 public:
  VtpWriter(store::OutputFile collection, const scene::Scene& scene,
            const std::vector<grains::Kind>& kinds);

  void add(const grains::State& state, const store::ContactFrame& contact) override;
  void finish() override;

 private:
  /// Position of a wall; none if it is not present.
  using Shift = std::optional<lattice::Axial>;

  /// STEM-000120.vtp beside the collection; STEM-000120-2.vtp for a second frame of that step.
  std::string beside(const std::string& part, std::uint64_t step) const;
  /// Time of this frame, in steps or the unit of time of scene::Conversion; slightly later for a
  /// second frame of a step, as times must differ.
  double time(std::uint64_t step) const;
  void count_frame(std::uint64_t step);
  void write_particles(const std::string& file, const grains::State& state,
                       const store::ContactFrame& contact) const;
  void write_walls(const std::string& file, const grains::State& state) const;
  void collect(std::uint64_t step, int part, const std::string& name, const std::string& file);

  store::OutputFile collection_;
  double time_step_;
  std::optional<scene::Conversion> units_;  // of the contact model
  std::vector<std::string> species_names_;
  std::vector<std::string> wall_names_;
  int step_digits_;
  std::vector<KindAppearance> kinds_;
  std::vector<Shift> seen_;  // the walls that wall_file_ shows
  std::string wall_file_;
  std::optional<std::uint64_t> step_;  // of the last frame
  int earlier_ = 0;                    // frames of the same step before it
  std::string entries_;
};

}  // namespace clca::exports
