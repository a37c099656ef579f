#include "clca/store/file.hpp"

#include <fmt/format.h>

#include <cstring>
#include <string>
#include <system_error>

#include "clca/store/atomic_file.hpp"
#include "clca/text/read.hpp"
#include "store/descriptor.hpp"

namespace clca::store {

namespace {

[[noreturn]] void fail(std::string_view what, const std::filesystem::path& path, int error) {
  throw StoreError(fmt::format("cannot {} {}: {}", what, path.string(), std::strerror(error)));
}

}  // namespace

void write_whole(const std::filesystem::path& path, std::span<const std::uint8_t> bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.finish();
}

void write_whole(const std::filesystem::path& path, std::string_view text) {
  write_whole(path, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    fail("make the folder", folder, error.value());
  }
}

void look_anew(const std::filesystem::path& folder) {
  for (const std::filesystem::path& directory : {folder.parent_path(), folder}) {
    // To open a folder asks the server.
    const Descriptor opened(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  }
}

std::vector<std::uint8_t> read_whole(const std::filesystem::path& path, double max_bytes) {
  try {
    return text::read_file(path, max_bytes);
  } catch (const text::ReadError& error) {
    throw StoreError(fmt::format("cannot read {}: {}", path.string(), error.what()));
  }
}

}  // namespace clca::store
