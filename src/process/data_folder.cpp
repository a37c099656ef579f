#include "clca/process/data_folder.hpp"

#include <dlfcn.h>

#include <cstdlib>
#include <system_error>

#include "clca/process/program.hpp"

namespace clca::process {

namespace fs = std::filesystem;

namespace {

/// This program, or the shared library that this code is in.
fs::path own_file() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  static constexpr char kInThisFile = 0;
  Dl_info info = {};
  const bool found = ::dladdr(&kInThisFile, &info) != 0;
  const fs::path library = found ? fs::canonical(info.dli_fname, error) : fs::path();
  return library.extension() == ".so" ? library : program;
}

/// Others could put modules there, which Python would run.
bool is_writable_by_others(const fs::path& folder) {
  std::error_code error;
  return (fs::status(folder, error).permissions() & fs::perms::others_write) != fs::perms::none;
}

}  // namespace

fs::path data_folder(const fs::path& what) {
  const fs::path data = fs::path("share") / "clca" / what;
  std::error_code error;
  fs::path folder = own_file();
  while (folder.has_relative_path()) {
    folder = folder.parent_path();
    if (!is_writable_by_others(folder) && fs::exists(folder / data, error)) {
      return folder / data;
    }
  }
  return fs::path(CLCA_DATA) / what;
}

fs::path python_program() {
  constexpr const char* kSystemPython = "/usr/bin/python3";
  std::error_code error;
  const char* chosen = std::getenv("CLCA_PYTHON");  // NOLINT(concurrency-mt-unsafe)
  if (chosen != nullptr && *chosen != '\0') {
    return chosen;
  }
  if (fs::exists(kSystemPython, error)) {
    return kSystemPython;
  }
  if (const auto found = find_program("python3")) {
    return *found;
  }
  throw ProcessError("python3 not found; install it, or say where it is by CLCA_PYTHON");
}

std::map<std::string, fs::path> data_files(const fs::path& what, const std::string& extension) {
  std::map<std::string, fs::path> files;
  std::error_code error;
  for (fs::directory_iterator it(data_folder(what), error), end; !error && it != end;
       it.increment(error)) {
    if (it->path().extension() == extension) {
      files[it->path().stem().string()] = it->path();
    }
  }
  return files;
}

}  // namespace clca::process
