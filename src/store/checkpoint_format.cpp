// The bytes of a checkpoint.
//
// Behind the checksum header stand entries, one after the other to the end of the file: four texts,
// and a column of numbers for each field of the run. An entry is
//
//     u8      type: 0 text, 1 u8, 2 u16, 3 u32, 4 u64, 5 i32, 6 f64, 7 i64
//     u16     length of the name
//     u64     count of bytes (of a text) or numbers
//     u64     length of the data
//     name
//     data    compressed by zlib: blocks of up to 65,536 numbers, of each block the lowest bytes of
//             all its numbers first, then the second bytes, and so on
//
// All numbers are little-endian, f64 as IEEE 754 has it.

#include <fmt/format.h>

#include <array>
#include <bit>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "clca/store/checkpoint.hpp"
#include "store/checksum_header.hpp"
#include "store/column_compression.hpp"

namespace clca::store {

namespace {

constexpr FileKind kCheckpointKind = {"checkpoint", 2};

/// Type of text entries; other types are their index in reflection::Column plus one.
constexpr std::uint8_t kText = 0;
constexpr std::size_t kEntryBytes = 1 + 2 + 8 + 8;  // without name and data
constexpr double kBytesBeside = 160;                // in memory: name, node of the map, vector

constexpr std::array<std::string_view, 4> kTexts = {"kind", "scene_name", "scene", "summary"};

template <class AnyCheckpoint>
auto& text_of(AnyCheckpoint& checkpoint, std::string_view name) {
  return name == kTexts[0]   ? checkpoint.kind
         : name == kTexts[1] ? checkpoint.scene_name
         : name == kTexts[2] ? checkpoint.scene
                             : checkpoint.summary;
}

template <class Unsigned>
void put(std::vector<std::uint8_t>& bytes, Unsigned number) {
  for (std::size_t i = 0; i < sizeof number; ++i) {
    bytes.push_back(static_cast<std::uint8_t>(number >> (8 * i)));
  }
}

template <class T>
void put_entry(std::vector<std::uint8_t>& file, Compressor& compressor, std::uint8_t type,
               std::string_view name, std::span<const T> values) {
  put(file, type);
  put(file, static_cast<std::uint16_t>(name.size()));
  put(file, static_cast<std::uint64_t>(values.size()));
  const std::size_t length_at = file.size();
  put(file, std::uint64_t{0});
  file.insert(file.end(), name.begin(), name.end());
  const std::size_t data_at = file.size();
  compressor.add(values, file);
  std::vector<std::uint8_t> length;
  put(length, static_cast<std::uint64_t>(file.size() - data_at));
  std::copy(length.begin(), length.end(), file.begin() + static_cast<std::ptrdiff_t>(length_at));
}

/// An entry whose sizes have been checked.
struct Entry {
  std::uint8_t type = 0;
  std::string_view name;
  std::uint64_t count = 0;
  std::span<const std::uint8_t> data;
};

void require(bool holds, const char* reason) {
  if (!holds) {
    throw std::runtime_error(reason);
  }
}

/// Reads entries from the start of a file.
class Entries {
 public:
  explicit Entries(std::span<const std::uint8_t> rest) : rest_(rest) {}
  bool at_end() const { return rest_.empty(); }

  Entry next() {
    require(rest_.size() >= kEntryBytes, kCut);
    Entry entry;
    entry.type = number<std::uint8_t>();
    const auto name_length = number<std::uint16_t>();
    entry.count = number<std::uint64_t>();
    const auto data_length = number<std::uint64_t>();
    const auto name = bytes(name_length);
    entry.name = {reinterpret_cast<const char*>(name.data()), name.size()};
    entry.data = bytes(data_length);
    return entry;
  }

 private:
  static constexpr const char* kCut = "an entry goes beyond its end";

  template <class Unsigned>
  Unsigned number() {
    Unsigned value = 0;
    std::size_t shift = 0;
    for (const std::uint8_t byte : bytes(sizeof(Unsigned))) {
      value = static_cast<Unsigned>(value | (static_cast<Unsigned>(byte) << shift));
      shift += 8;
    }
    return value;
  }
  std::span<const std::uint8_t> bytes(std::uint64_t count) {
    require(count <= rest_.size(), kCut);
    return std::exchange(rest_, rest_.subspan(count)).first(count);
  }

  std::span<const std::uint8_t> rest_;
};

/// Size of a number of this type; 0 for an unknown type.
double item_bytes(std::uint8_t type) {
  constexpr std::array<double, 8> kBytes = {1, 1, 2, 4, 8, 4, 8, 8};
  return type < kBytes.size() ? kBytes.at(type) : 0;
}

/// Reads all entries and checks that they fit into memory.
std::vector<Entry> entries_of(std::span<const std::uint8_t> content, double max_bytes) {
  std::vector<Entry> entries;
  std::set<std::pair<bool, std::string_view>> names;
  double sum = 0;
  for (Entries rest(content); !rest.at_end();) {
    const Entry entry = rest.next();
    const double bytes = static_cast<double>(entry.count) * item_bytes(entry.type);
    require(item_bytes(entry.type) > 0, "an entry of an unknown type");
    require(bytes <= kMaxExpansion * static_cast<double>(entry.data.size()),
            "an entry that is longer than its data can be");
    sum += bytes + kBytesBeside + 2 * static_cast<double>(entry.name.size() + sizeof(Entry));
    require(sum <= max_bytes, "it needs more memory than the limit");
    require(names.emplace(entry.type == kText, entry.name).second, "an entry that is there twice");
    entries.push_back(entry);
  }
  return entries;
}

template <class T>
std::vector<T> expanded(const Entry& entry, Decompressor& expander) {
  std::vector<T> values(entry.count);
  expander.expand(entry.data, std::span(values));
  return values;
}

template <std::size_t... kIndex>
reflection::Column column_of(const Entry& entry, Decompressor& expander,
                             std::index_sequence<kIndex...> /*types*/) {
  reflection::Column column;
  static_cast<void>(
      ((entry.type == kIndex + 1 &&
        (column =
             expanded<typename std::variant_alternative_t<kIndex, reflection::Column>::value_type>(
                 entry, expander),
         true)) ||
       ...));
  return column;
}

}  // namespace

std::vector<std::uint8_t> checkpoint_bytes(const Checkpoint& checkpoint) {
  Compressor compressor;
  std::vector<std::uint8_t> content;
  for (const std::string_view name : kTexts) {
    put_entry<char>(content, compressor, kText, name, text_of(checkpoint, name));
  }
  for (const auto& [name, column] : checkpoint.fields) {
    std::visit(
        [&, type = static_cast<std::uint8_t>(column.index() + 1),
         path = std::string_view(name)]<class T>(const std::vector<T>& values) {
          put_entry<T>(content, compressor, type, path, values);
        },
        column);
  }
  return with_header(kCheckpointKind, content);
}

Checkpoint parse_checkpoint(std::span<const std::uint8_t> file, double max_bytes) {
  const auto content = content_of(kCheckpointKind, file);
  const std::vector<Entry> entries =
      entries_of(content, max_bytes - static_cast<double>(file.size()));
  Checkpoint checkpoint;
  Decompressor expander;
  std::size_t texts = 0;
  for (const Entry& entry : entries) {
    if (entry.type != kText) {
      constexpr auto kTypes = std::make_index_sequence<std::variant_size_v<reflection::Column>>();
      checkpoint.fields[std::string(entry.name)] = column_of(entry, expander, kTypes);
      continue;
    }
    require(std::find(kTexts.begin(), kTexts.end(), entry.name) != kTexts.end(),
            "a text of an unknown name");
    std::string& text = text_of(checkpoint, entry.name);
    text.resize(entry.count);
    expander.expand(entry.data, std::span(text));
    ++texts;
  }
  require(texts == kTexts.size(), "a text is missing");
  return checkpoint;
}

}  // namespace clca::store
