#pragma once
// HDF5 files with a checksum header, readable by any HDF5 program.

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

namespace hdf5 {
class Handle;
}

/// Number types of a dataset.
template <class T>
concept Number = std::same_as<T, std::uint8_t> || std::same_as<T, std::uint16_t> ||
    std::same_as<T, std::uint32_t> || std::same_as<T, std::uint64_t> ||
    std::same_as<T, std::int32_t> || std::same_as<T, double>;

/// What a dataset says of itself; as Quantity.
struct Meaning {
  std::string_view unit;  ///< of a pure number, a name or a text empty
  std::string_view text;  ///< empty: it says nothing
};

/// Adds datasets to a file. Paths are relative to the root; groups are made as needed. Throws as
/// hdf5::check.
class Hdf5Writer {
 public:
  /// A text, a list of texts, or numbers.
  using Values = std::variant<std::string_view, std::span<const std::string>,
                              std::span<const std::uint8_t>, std::span<const std::uint16_t>,
                              std::span<const std::uint32_t>, std::span<const std::uint64_t>,
                              std::span<const std::int32_t>, std::span<const double>>;

  explicit Hdf5Writer(const hdf5::Handle& file) : file_(file) {}

  /// Numbers are in rows of `columns` (1: a list), chunked and compressed if there are many.
  void add(const std::string& path, const Values& values, std::size_t columns = 1,
           const Meaning& meaning = {}) const;

 private:
  const hdf5::Handle& file_;
};

/// The bytes of a file for `path`, filled by `add`. Throws StoreError.
std::vector<std::uint8_t> hdf5_file(const std::filesystem::path& path, const FileKind& kind,
                                    const std::function<void(const Hdf5Writer& file)>& add);

/// A dataset to read: rows of `columns` numbers, or texts, and its destination.
struct Hdf5Dataset {
  using Values =
      std::variant<std::vector<std::uint8_t>*, std::vector<std::uint16_t>*,
                   std::vector<std::uint32_t>*, std::vector<std::uint64_t>*,
                   std::vector<std::int32_t>*, std::vector<double>*, std::vector<std::string>*>;
  std::string path;
  Values values;
  std::size_t columns = 1;
  bool may_be_missing = false;  ///< then there are no values
};

inline constexpr double kAnyBytes = 1e18;

/// Reads these datasets of a file whose checksum is right. `max_bytes`: memory limit for three
/// copies of the file, and the data.
/// Throws StoreError with the path for a file that is truncated, damaged, or of another kind or
/// version, and for datasets that are missing, of another type or extent, or too large.
void read_hdf5(const std::filesystem::path& path, const FileKind& kind,
               const std::vector<Hdf5Dataset>& datasets, double max_bytes);

}  // namespace clca::store
