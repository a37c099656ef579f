#include "export/gsd_file.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace clca::exports {

namespace {

constexpr std::uint64_t kMagic = 0x65DF65DF65DF65DF;
constexpr std::size_t kNameEntry = 64;  // the list of names is measured in these

constexpr std::uint32_t version(std::uint32_t major, std::uint32_t minor) {
  return major << 16U | minor;
}

struct Header {
  std::uint64_t magic = kMagic;
  std::uint64_t index_location = 0;
  std::uint64_t index_entries = 0;
  std::uint64_t names_location = 0;
  std::uint64_t names_entries = 0;
  std::uint32_t schema_version = version(1, 4);
  std::uint32_t layout_version = version(2, 0);
  std::array<char, 64> application = {};
  std::array<char, 64> schema = {};
  std::array<char, 80> reserved = {};
};
static_assert(sizeof(Header) == 256);

/// Concatenated names, each terminated by a zero.
Bytes name_list(const std::vector<std::string>& names) {
  Bytes bytes;
  for (const std::string& name : names) {
    bytes.insert(bytes.end(), name.begin(), name.end());
    bytes.push_back(0);
  }
  bytes.resize((bytes.size() / kNameEntry + 1) * kNameEntry);
  return bytes;
}

}  // namespace

GsdFile::GsdFile(store::AtomicFile file, std::vector<std::string> names)
    : file_(std::move(file)), names_(std::move(names)) {
  file_.write(bytes_of(Header()));
}

void GsdFile::write(const GsdChunk& chunk, std::span<const std::uint8_t> numbers) {
  index_.push_back({.frame = frame_,
                    .rows = chunk.rows,
                    .location = static_cast<std::int64_t>(file_.size()),
                    .columns = chunk.columns,
                    .name = chunk.name,
                    .type = chunk.type});
  file_.write(numbers);
}

void GsdFile::finish() {
  const Bytes names = name_list(names_);
  Header header;
  header.names_location = file_.size();
  header.names_entries = names.size() / kNameEntry;
  file_.write(names);
  header.index_location = file_.size();
  header.index_entries = index_.size();
  Bytes index;
  for (const Entry& entry : index_) {
    append(index, entry);
  }
  file_.write(index);
  constexpr std::string_view kSchema = "hoomd";
  std::copy(kSchema.begin(), kSchema.end(), header.schema.begin());
  constexpr std::string_view kApplication = "clca";
  std::copy(kApplication.begin(), kApplication.end(), header.application.begin());
  file_.rewrite_begin(bytes_of(header));
  file_.finish();
}

}  // namespace clca::exports
