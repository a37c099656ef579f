#pragma once
// HDF5 files behind a checksum header, which any program for HDF5 opens. The library works in child
// processes only: what it does with a damaged file, or short of memory, stays there.

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "store/checksum_header.hpp"

namespace clca::store {

/// Numbers that a dataset may hold.
template <class T>
concept Number = std::same_as<T, std::uint8_t> || std::same_as<T, std::uint16_t> ||
    std::same_as<T, std::uint32_t> || std::same_as<T, std::uint64_t> ||
    std::same_as<T, std::int32_t> || std::same_as<T, double>;

/// Adds datasets to a file, in the child process that makes it. Every path is relative to the root;
/// groups are made on the way. Throws what hdf5::check throws.
class Hdf5Writer {
 public:
  /// `file`: of the HDF5 library.
  explicit Hdf5Writer(std::int64_t file) : file_(file) {}

  /// A dataset of `values` in rows of `columns` numbers (1: a plain list), chunked and compressed.
  template <Number T>
  void add(const std::string& path, std::span<const T> values, std::size_t columns = 1) const;
  /// A string, as UTF-8.
  void add_text(const std::string& path, std::string_view text) const;
  /// A list of strings.
  void add_texts(const std::string& path, const std::vector<std::string>& texts) const;

 private:
  std::int64_t file_;
};

/// The bytes of a file that is to be written to `path`. `add` is called in a child process. Throws
/// StoreError.
std::vector<std::uint8_t> hdf5_file(const std::filesystem::path& path, const FileKind& kind,
                                    const std::function<void(const Hdf5Writer& file)>& add);

/// A dataset that is wanted: rows of `columns` numbers, or texts; and where it goes.
struct Hdf5Dataset {
  using Values =
      std::variant<std::vector<std::uint8_t>*, std::vector<std::uint16_t>*,
                   std::vector<std::uint32_t>*, std::vector<std::uint64_t>*,
                   std::vector<std::int32_t>*, std::vector<double>*, std::vector<std::string>*>;
  std::string path;
  Values values;
  std::size_t columns = 1;
};

/// Reads these datasets of a file and no others. `most_bytes`: that the file, all that is read of
/// it and once more the largest dataset may take. Throws StoreError, with the path of the file, for
/// whatever is not as it should be: cut off, changed, of another kind or version, a dataset that is
/// missing, of other numbers, laid out as none of ours or larger than what memory may hold.
void read_hdf5(const std::filesystem::path& path, const FileKind& kind,
               const std::vector<Hdf5Dataset>& datasets, double most_bytes);

}  // namespace clca::store
