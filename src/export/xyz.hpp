#pragma once
// Extended XYZ: frame after frame as text (github.com/libAtoms/extxyz).

#include <optional>
#include <string>
#include <vector>

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
  std::optional<scene::Conversion> units_;  // of the contact model
  std::vector<std::string> species_;        // by kind
};

}  // namespace clca::exports
