#pragma once
// Formats of other programs.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clca/export/export.hpp"
#include "clca/export/frame.hpp"
#include "export/gsd_file.hpp"

namespace clca::exports {

/// GSD with the schema of HOOMD (gsd.readthedocs.io, "HOOMD schema").
class GsdWriter : public Writer {
 public:
  GsdWriter(const store::OutputFile& file, const scene::Scene& scene,
            const std::vector<grains::Kind>& kinds);

  void add(const grains::State& state, const store::ContactFrame& contact) override;
  void finish() override { file_.finish(); }

 private:
  /// What no frame after the first one says again.
  void add_fixed(const lattice::Lattice& lattice);
  void add_particles(const lattice::Lattice& lattice, const std::vector<Body>& all);

  GsdFile file_;
  std::optional<scene::Conversion> units_;  // of the contact model
  std::vector<KindAppearance> kinds_;
  bool first_ = true;
};

/// H5MD (h5md.org, version 1.1): row i of each dataset of particles is the particle with id i.
class H5mdWriter : public Writer {
 public:
  H5mdWriter(const store::OutputFile& file, const scene::Scene& scene,
             const std::vector<grains::Kind>& kinds);
  ~H5mdWriter() override;
  H5mdWriter(const H5mdWriter&) = delete;
  H5mdWriter& operator=(const H5mdWriter&) = delete;

  void add(const grains::State& state, const store::ContactFrame& contact) override;
  void finish() override;

 private:
  class Content;
  /// Calls the HDF5 library; its errors become a StoreError with the path.
  template <class Call>
  void by_library(Call call);

  std::string path_;
  store::AtomicFile file_;
  std::optional<scene::Conversion> units_;
  std::unique_ptr<Content> content_;
};

/// VTK files: particles for each frame, walls whenever they have changed, and a collection (.pvd)
/// that assigns them to steps.
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

/// Extended XYZ: frame after frame as text (github.com/libAtoms/extxyz).
class XyzWriter : public Writer {
 public:
  XyzWriter(const store::OutputFile& file, const scene::Scene& scene,
            const std::vector<grains::Kind>& kinds);

  void add(const grains::State& state, const store::ContactFrame& contact) override;
  void finish() override { file_.finish(); }

 private:
  store::AtomicFile file_;
  std::optional<scene::Conversion> units_;  // of the contact model
  std::vector<std::string> species_;        // by kind
};

}  // namespace clca::exports
