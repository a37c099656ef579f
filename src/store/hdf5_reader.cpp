#include <fmt/format.h>

#include <cstring>

#include "clca/process/child.hpp"
#include "clca/store/file.hpp"
#include "store/hdf5_content.hpp"
#include "store/hdf5_file.hpp"
#include "store/internal/hdf5.hpp"

namespace clca::store {

namespace {

/// One second more per MiB: over a hundred times what reading takes.
unsigned seconds_for(double bytes) {
  constexpr double kMinSeconds = 10;
  return static_cast<unsigned>(std::min(kMinSeconds + bytes / (1U << 20U), 1e6));
}

/// Memory of the child besides the numbers: library, chunks, decompression.
constexpr double kLibraryBytes = 1U << 26U;

/// The output of the child is checked: the child may be damaged.
class Receiver {
 public:
  Receiver(process::Child& child, double max_bytes) : child_(child), bytes_left_(max_bytes) {}

  template <Number T>
  void receive(std::vector<T>& values, std::size_t columns) {
    const hdf5::DatasetHeader header = receive_header(static_cast<double>(columns) * sizeof(T));
    values.resize(header.rows * columns);
    child_.receive({reinterpret_cast<std::uint8_t*>(values.data()), values.size() * sizeof(T)});
  }

  void receive(std::vector<std::string>& texts, std::size_t /*columns*/) {
    const hdf5::DatasetHeader header = receive_header(sizeof(std::string));
    take(header.rows, static_cast<double>(header.item_bytes));
    texts.assign(header.rows, std::string(header.item_bytes, '\0'));
    for (std::string& text : texts) {
      child_.receive({reinterpret_cast<std::uint8_t*>(text.data()), text.size()});
      text.resize(text.find_last_not_of('\0') + 1);
    }
  }

 private:
  hdf5::DatasetHeader receive_header(double row_bytes) {
    std::array<std::uint8_t, sizeof(hdf5::DatasetHeader)> bytes = {};
    child_.receive(bytes);
    hdf5::DatasetHeader header;
    std::memcpy(&header, bytes.data(), sizeof header);
    take(header.rows, row_bytes);
    return header;
  }
  /// All data read count, as the caller keeps them.
  void take(std::uint64_t rows, double row_bytes) {
    bytes_left_ -= static_cast<double>(rows) * row_bytes;
    if (bytes_left_ < 0) {
      throw process::ChildError("it needs more memory than the limit", false);
    }
  }

  process::Child& child_;
  double bytes_left_;
};

void receive_all(std::span<const std::uint8_t> content, const std::vector<Hdf5Dataset>& datasets,
                 double max_bytes) {
  { const hdf5::Session first; }  // no fork before it amid a call of another thread
  process::Child child(
      [&](const process::Child::Send& send) {
        hdf5::send_datasets(content, datasets, max_bytes, send);
      },
      {.memory_bytes = max_bytes + kLibraryBytes,
       .cpu_seconds = seconds_for(static_cast<double>(content.size()))});
  Receiver receiver(child, max_bytes);
  for (const Hdf5Dataset& dataset : datasets) {
    std::visit([&](auto* values) { receiver.receive(*values, dataset.columns); }, dataset.values);
  }
  child.finish();
}

}  // namespace

void read_hdf5(const std::filesystem::path& path, const FileKind& kind,
               const std::vector<Hdf5Dataset>& datasets, double max_bytes) {
  const auto refuse = [&path](const std::string& reason) {
    throw StoreError(fmt::format("cannot read {}: {}", path.string(), reason));
  };
  const std::vector<std::uint8_t> file = read_whole(path, max_bytes);
  try {
    receive_all(content_of(kind, file), datasets, max_bytes - static_cast<double>(file.size()));
  } catch (const process::ChildError& error) {
    refuse(error.crashed() ? fmt::format("it is damaged: the HDF5 library {}", error.what())
                           : error.what());
  } catch (const std::runtime_error& error) {
    refuse(error.what());
  }
}

}  // namespace clca::store
