#pragma once
// The folder of a sweep.

#include <filesystem>
#include <string>

#include "clca/store/output_folder.hpp"
#include "clca/sweep/plan.hpp"

namespace clca::sweep {

class Folder {
 public:
  /// Makes the folder if needed and writes the request. Existing files stay, except an old
  /// overview. Throws store::StoreError, also for the folder of a run.
  Folder(const std::filesystem::path& path, const Plan& plan);

  std::filesystem::path run(const std::string& name) const { return files_.path() / "runs" / name; }
  void write_tables(const std::string& runs, const std::string& measures) const;
  void write_overview(const std::vector<std::uint8_t>& png) const;

 private:
  store::OutputFolder files_;
};

}  // namespace clca::sweep
