#pragma once
// Extended XYZ: frame after frame as text (github.com/libAtoms/extxyz).

#include <string>

#include "clca/export/export.hpp"
#include "clca/export/frame.hpp"

namespace clca::exports {

class XyzWriter : public Writer {
 public:
  XyzWriter(const store::OutputFile& file, const scene::Scene& scene,
            const std::vector<grains::Kind>& kinds);

  void add(const grains::State& state, const store::ContactFrame& contact) override;
  void finish() override { file_.finish(); }

 private:
  store::AtomicFile file_;
  double time_step_;
  double velocity_unit_;
  std::vector<std::string> species_;  // by kind
};

}  // namespace clca::exports
