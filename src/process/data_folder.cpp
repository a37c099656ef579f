#include "clca/process/data_folder.hpp"

#include <system_error>

namespace clca::process {

namespace fs = std::filesystem;

std::array<fs::path, 2> data_folders(const fs::path& what) {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return {(program.parent_path() / CLCA_DATA_FROM_PROGRAM / what).lexically_normal(),
          fs::path(CLCA_DATA_IN_SOURCE) / what};
}

}  // namespace clca::process
