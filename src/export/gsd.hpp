#pragma once
// GSD with the schema of HOOMD (gsd.readthedocs.io, "HOOMD schema").

#include <optional>

#include "clca/export/export.hpp"
#include "clca/export/frame.hpp"
#include "export/gsd_file.hpp"

namespace clca::exports {

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

}  // namespace clca::exports
