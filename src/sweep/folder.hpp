#pragma once
// The folder of a sweep.

#include <filesystem>
#include <string>

#include "clca/store/output_folder.hpp"
#include "clca/sweep/plan.hpp"
#include "sweep/tables.hpp"

namespace clca::sweep {

inline constexpr const char* kRunsFolder = "runs";

/// The folder of a run in the folder of a sweep.
inline std::filesystem::path run_folder(const std::filesystem::path& folder,
                                        const std::string& name) {
  return folder / kRunsFolder / name;
}

class SweepFolder {
 public:
  /// Writes nothing. Throws store::StoreError for the folder of a run or of something else.
  explicit SweepFolder(const std::filesystem::path& path);

  /// Makes the folder if needed.
  void make() const { files_.make_own(kRunsFolder); }
  /// Writes the request. Existing files stay, except an old overview. Throws store::StoreError.
  void begin(const Plan& plan) const;

  std::filesystem::path run(const std::string& name) const {
    return run_folder(files_.path(), name);
  }
  /// Also removes those that `means` does not have.
  void write_means(const std::vector<NamedTable>& means) const;
  void write_tables(const std::vector<NamedTable>& tables) const;
  /// The request, with what the columns of the tables are, and the measures that no run has.
  void write_request(const Plan& plan, const std::vector<store::TableSummary>& tables,
                     const std::vector<store::ColumnSummary>& measures) const;
  void write_overview(const std::vector<std::uint8_t>& png) const;

 private:
  store::OutputFolder files_;
};

}  // namespace clca::sweep
