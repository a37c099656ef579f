#include "clca/report/report.hpp"

#include <system_error>

#include "clca/store/output_folder.hpp"
#include "report/page.hpp"
#include "report/sections.hpp"

namespace clca::report {

namespace fs = std::filesystem;

fs::path write_report(const fs::path& folder, const Options& options) {
  Warnings warnings(options.warning);
  std::error_code error;
  const bool is_sweep = fs::exists(folder / "sweep.json", error);
  const Page page =
      is_sweep ? sweep_page(folder, warnings) : run_page(folder, options.max_frames, warnings);
  const store::OutputFile file = options.file.empty()
                                     ? store::OutputFile{store::OutputFolder(folder), "report.html"}
                                     : store::named_file(options.file);
  file.folder.write(file.name, to_html(page, warnings), file.replace);
  return file.path();
}

}  // namespace clca::report
