#pragma once
// H5MD (h5md.org, version 1.1): row i of each dataset of particles is the particle with id i.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clca/export/export.hpp"
#include "clca/export/frame.hpp"

namespace clca::exports {

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

}  // namespace clca::exports
