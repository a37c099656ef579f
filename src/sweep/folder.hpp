#pragma once
// The folder that a sweep leaves.

#include <filesystem>
#include <string>

#include "clca/sweep/plan.hpp"

namespace clca::sweep {

class Folder {
 public:
  /// Makes the folder if need be and writes what is asked. What lies there stays, but for the
  /// overview of an earlier sweep, which may show something else. Throws store::StoreError.
  Folder(std::filesystem::path path, const Plan& plan);

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path run(const std::string& name) const { return path_ / "runs" / name; }
  std::filesystem::path runs_table() const { return path_ / "runs.csv"; }
  std::filesystem::path measures_table() const { return path_ / "measures.csv"; }
  std::filesystem::path overview() const { return path_ / "overview.png"; }

 private:
  std::filesystem::path path_;
};

}  // namespace clca::sweep
