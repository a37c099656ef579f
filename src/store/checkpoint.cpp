// Checkpoints and their bytes.
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
//             all its numbers first, then the second bytes, and so on: similar numbers share high
//             bytes
//
// All numbers are little-endian, f64 as IEEE 754 has it.

#include "clca/store/checkpoint.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <new>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "store/checksum_header.hpp"

namespace clca::store {

namespace {

namespace fs = std::filesystem;
using Bytes = std::span<const std::uint8_t>;

static_assert(std::endian::native == std::endian::little, "numbers are copied as they are");

constexpr FileKind kCheckpointKind = {"checkpoint", 4};
using Text = std::pair<std::string_view, std::string Checkpoint::*>;
constexpr std::array<Text, 4> kTexts = {{{"kind", &Checkpoint::kind},
                                         {"scene_name", &Checkpoint::scene_name},
                                         {"scene", &Checkpoint::scene_text},
                                         {"summary", &Checkpoint::summary_json}}};

void require(bool holds, const char* reason) {
  if (!holds) {
    throw std::runtime_error(reason);
  }
}

/// The bytes of a vector or text, and of a number of it.
template <class Values>
auto value_bytes(Values& values) {
  using Byte = std::conditional_t<std::is_const_v<Values>, const std::uint8_t, std::uint8_t>;
  constexpr std::size_t kSize = sizeof(typename Values::value_type);
  return std::pair(std::span(reinterpret_cast<Byte*>(values.data()), values.size() * kSize), kSize);
}

/// Brings the bytes of numbers from their order in memory to that in a file, or back.
template <bool kToFile>
void reorder(std::span<std::uint8_t> bytes, std::size_t number_bytes) {
  const std::size_t most = number_bytes << 16U;  // in a block
  std::vector<std::uint8_t> before;
  for (std::size_t at = 0; at < bytes.size(); at += most) {
    const auto block = bytes.subspan(at, std::min(most, bytes.size() - at));
    before.assign(block.begin(), block.end());
    const std::size_t numbers = block.size() / number_bytes;
    for (std::size_t byte = 0; byte < number_bytes; ++byte) {
      for (std::size_t number = 0; number < numbers; ++number) {
        const std::size_t in_file = byte * numbers + number;
        const std::size_t in_memory = number * number_bytes + byte;
        block[kToFile ? in_file : in_memory] = before[kToFile ? in_memory : in_file];
      }
    }
  }
}

/// Nothing for no bytes.
std::vector<std::uint8_t> compressed(Bytes bytes, std::size_t number_bytes) {
  constexpr int kLevel = 1;  // more costs time and gains little on sorted bytes
  std::vector<std::uint8_t> sorted(bytes.begin(), bytes.end());
  reorder<true>(sorted, number_bytes);
  uLongf length = bytes.empty() ? 0 : ::compressBound(sorted.size());
  std::vector<std::uint8_t> data(length);
  if (length > 0 &&
      ::compress2(data.data(), &length, sorted.data(), sorted.size(), kLevel) != Z_OK) {
    throw std::bad_alloc();
  }
  data.resize(length);
  return data;
}

template <class Values>
void add_entry(std::vector<std::uint8_t>& content, std::size_t type, std::string_view name,
               const Values& values) {
  const auto put = [&content](auto number) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(&number);
    content.insert(content.end(), bytes, bytes + sizeof number);
  };
  const auto [bytes, number_bytes] = value_bytes(values);
  const std::vector<std::uint8_t> data = compressed(bytes, number_bytes);
  put(static_cast<std::uint8_t>(type));
  put(static_cast<std::uint16_t>(name.size()));
  put(static_cast<std::uint64_t>(values.size()));
  put(static_cast<std::uint64_t>(data.size()));
  content.insert(content.end(), name.begin(), name.end());
  content.insert(content.end(), data.begin(), data.end());
}

/// An entry whose sizes have been checked.
struct Entry {
  std::uint8_t type = 0;
  std::string_view name;
  std::uint64_t count = 0;
  Bytes data;

  template <class Values>
  void read_into(Values& values) const {
    values.resize(count);
    const auto [bytes, number_bytes] = value_bytes(values);
    auto length = static_cast<uLongf>(bytes.size());
    auto used = static_cast<uLong>(data.size());
    const bool whole = bytes.empty()
                           ? data.empty()
                           : ::uncompress2(bytes.data(), &length, data.data(), &used) == Z_OK &&
                                 length == bytes.size() && used == data.size();
    require(whole, "its compressed data is damaged");
    reorder<false>(bytes, number_bytes);
  }
};

Bytes take(Bytes& rest, std::uint64_t count) {
  require(count <= rest.size(), "an entry goes beyond its end");
  return std::exchange(rest, rest.subspan(count)).first(count);
}

template <class Number>
Number take_number(Bytes& rest) {
  Number number = 0;
  std::memcpy(&number, take(rest, sizeof number).data(), sizeof number);
  return number;
}

Entry take_entry(Bytes& rest) {
  Entry entry;
  entry.type = take_number<std::uint8_t>(rest);
  const auto name_length = take_number<std::uint16_t>(rest);
  entry.count = take_number<std::uint64_t>(rest);
  const auto data_length = take_number<std::uint64_t>(rest);
  const Bytes name = take(rest, name_length);
  entry.name = {reinterpret_cast<const char*>(name.data()), name.size()};
  entry.data = take(rest, data_length);
  return entry;
}

/// Reads all entries and checks that they fit into memory.
std::vector<Entry> entries_of(Bytes rest, double max_bytes) {
  constexpr std::array<double, 8> kNumberBytes = {1, 1, 2, 4, 8, 4, 8, 8};  // by type
  constexpr double kBytesBeside = 160;    // in memory: name, node of the map, vector
  constexpr double kMaxExpansion = 1032;  // bytes that one compressed byte can expand to
  std::vector<Entry> entries;
  std::set<std::pair<bool, std::string_view>> names;
  double sum = 0;
  while (!rest.empty()) {
    const Entry entry = take_entry(rest);
    require(entry.type < kNumberBytes.size(), "an entry of an unknown type");
    const double bytes = static_cast<double>(entry.count) * kNumberBytes.at(entry.type);
    require(bytes <= kMaxExpansion * static_cast<double>(entry.data.size()),
            "an entry that is longer than its data can be");
    sum += bytes + kBytesBeside + 2 * static_cast<double>(entry.name.size() + sizeof(Entry));
    require(sum <= max_bytes, "it needs more memory than the limit");
    require(names.emplace(entry.type == 0, entry.name).second, "an entry that is there twice");
    entries.push_back(entry);
  }
  return entries;
}

/// An empty column of the type of an entry.
template <std::size_t... kIndex>
reflection::Column column_of(std::size_t type, std::index_sequence<kIndex...> /*types*/) {
  const std::array<reflection::Column, sizeof...(kIndex)> columns = {
      std::variant_alternative_t<kIndex, reflection::Column>()...};
  return columns.at(type - 1);
}

Checkpoint read(const fs::path& file, double max_bytes) {
  const std::vector<std::uint8_t> bytes = read_whole_file(file, max_bytes);
  try {
    return parse_checkpoint(bytes, max_bytes);
  } catch (const std::runtime_error& error) {
    throw StoreError(fmt::format("cannot read {}: {}", file.string(), error.what()));
  }
}

}  // namespace

std::vector<std::uint8_t> checkpoint_bytes(const Checkpoint& checkpoint) {
  std::vector<std::uint8_t> content;
  for (const auto& [name, text] : kTexts) {
    add_entry(content, 0, name, checkpoint.*text);
  }
  for (const auto& [name, column] : checkpoint.fields) {
    std::visit([&, type = column.index() + 1, path = std::string_view(name)](
                   const auto& values) { add_entry(content, type, path, values); },
               column);
  }
  return with_header(kCheckpointKind, content);
}

Checkpoint parse_checkpoint(Bytes file, double max_bytes) {
  constexpr auto kTypes = std::make_index_sequence<std::variant_size_v<reflection::Column>>();
  Checkpoint checkpoint;
  std::size_t texts = 0;
  for (const Entry& entry : entries_of(content_of(kCheckpointKind, file),
                                       max_bytes - static_cast<double>(file.size()))) {
    if (entry.type == 0) {
      const auto* text = std::ranges::find(kTexts, entry.name, &Text::first);
      require(text != kTexts.end(), "a text of an unknown name");
      entry.read_into(checkpoint.*text->second);
      ++texts;
    } else {
      reflection::Column& column = checkpoint.fields[std::string(entry.name)];
      column = column_of(entry.type, kTypes);
      std::visit([&entry](auto& values) { entry.read_into(values); }, column);
    }
  }
  require(texts == kTexts.size(), "a text is missing");
  return checkpoint;
}

void write_checkpoint(const OutputFolder& folder, const Checkpoint& checkpoint,
                      PreviousCheckpoint previous) {
  AtomicFile file = folder.create(kCheckpointFile);
  file.write(checkpoint_bytes(checkpoint));
  file.flush();
  if (previous == PreviousCheckpoint::kept) {
    folder.rename(kCheckpointFile, kPreviousCheckpointFile);
  }
  folder.flush();
  file.finish();
}

void remove_checkpoints(const OutputFolder& folder) {
  folder.remove(kPreviousCheckpointFile);
  folder.remove(kCheckpointFile);
}

std::optional<FoundCheckpoint> read_checkpoint(const fs::path& run_folder, double max_bytes) {
  const fs::path newest = run_folder / kCheckpointFile;
  const fs::path one_before = run_folder / kPreviousCheckpointFile;
  if (!fs::exists(newest) && !fs::exists(one_before)) {
    return std::nullopt;
  }
  try {
    return FoundCheckpoint{read(newest, max_bytes), ""};
  } catch (const StoreError& first) {
    try {
      return FoundCheckpoint{
          read(one_before, max_bytes),
          fmt::format("{}; going on from {}", first.what(), one_before.string())};
    } catch (const StoreError&) {
      throw first;
    }
  }
}

}  // namespace clca::store
