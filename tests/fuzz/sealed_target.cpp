// Sealed files: whatever is written is read again, within the limit of memory and as nothing else;
// what was changed is refused, and so are bytes that never were one.

#include <array>
#include <optional>
#include <utility>
#include <variant>

#include "choices.hpp"
#include "clca/store/file.hpp"
#include "memory_meter.hpp"
#include "scratch_file.hpp"
#include "store/sealed_file.hpp"

namespace {

using namespace clca;
using Bytes = std::vector<std::uint8_t>;
using Texts = std::vector<std::string>;

constexpr store::FileKind kKind = {"thing", 3};
constexpr std::array kPaths = {"a", "b", "g/a", "g/h/a", "g/h/b"};
constexpr std::uint32_t kMostRows = 1U << 16U;
constexpr std::uint32_t kMostColumns = 8;
constexpr std::uint32_t kMostLimit = 1U << 23U;
// What HDF5 keeps beside the numbers: buffers for chunks, free lists.
constexpr double kBeside = 3e6;

template <class T>
struct Numbers {
  std::size_t columns = 1;
  std::vector<T> values;
};
using Content = std::variant<Numbers<std::uint8_t>, Numbers<std::uint16_t>, Numbers<std::uint32_t>,
                             Numbers<std::uint64_t>, Numbers<std::int32_t>, Numbers<float>,
                             Numbers<double>, Texts>;

struct Item {
  std::string path;
  Content content;
};

/// Numbers that look random, which compression does not make fewer.
template <class T>
T scattered(std::size_t place) {
  std::uint64_t bits = (place + 1) * 0x9E3779B97F4A7C15U;
  bits = (bits ^ (bits >> 29U)) * 0xBF58476D1CE4E5B9U;
  T value = {};
  std::memcpy(&value, &bits, sizeof(T));
  return value;
}

/// A few numbers again and again, or all different: many need little input.
template <class T>
Numbers<T> numbers(fuzz::Choices& choices) {
  Numbers<T> result = {.columns = 1 + choices.up_to(kMostColumns - 1), .values = {}};
  const std::size_t count = result.columns * choices.up_to(choices.yes() ? kMostRows : 16);
  std::vector<T> few(1 + choices.up_to(7));
  for (T& number : few) {
    number = choices.any<T>();
  }
  const bool different = choices.yes();
  for (std::size_t i = 0; i < count; ++i) {
    result.values.push_back(different ? scattered<T>(i) : few[i % few.size()]);
  }
  return result;
}

/// Zeros at the end of a text are not kept.
Texts texts(fuzz::Choices& choices) {
  Texts result(choices.up_to(5));
  for (std::string& text : result) {
    text = choices.text(40);
    text.resize(text.find_last_not_of('\0') + 1);
  }
  return result;
}

template <std::size_t kIndex = 0>
Content content(std::size_t which, fuzz::Choices& choices) {
  if constexpr (kIndex + 1 < std::variant_size_v<Content>) {
    using Some = std::variant_alternative_t<kIndex, Content>;
    using T = typename decltype(Some::values)::value_type;
    return which == kIndex ? Content(numbers<T>(choices)) : content<kIndex + 1>(which, choices);
  } else {
    return texts(choices);
  }
}

std::vector<Item> items(fuzz::Choices& choices) {
  std::vector<Item> result;
  for (const char* path : kPaths) {
    if (choices.yes()) {
      const std::size_t which = choices.up_to(std::variant_size_v<Content> - 1);
      result.push_back({path, content(which, choices)});
    }
  }
  return result;
}

Bytes sealed(const std::vector<Item>& items) {
  store::SealedWriter writer(kKind);
  const auto add = [&](const std::string& path, const auto& content) {
    if constexpr (std::same_as<std::decay_t<decltype(content)>, Texts>) {
      writer.add_texts(path, content);
    } else {
      writer.add(path, std::span(std::as_const(content.values)), content.columns);
    }
  };
  for (const Item& item : items) {
    std::visit([&](const auto& content) { add(item.path, content); }, item.content);
  }
  return writer.seal();
}

/// Bit for bit: NaN is itself.
template <class T>
bool same(const Numbers<T>& one, const Numbers<T>& other) {
  const auto size = one.values.size();
  return size == other.values.size() &&
         (size == 0 || std::memcmp(one.values.data(), other.values.data(), size * sizeof(T)) == 0);
}
bool same(const Texts& one, const Texts& other) {
  return one == other;
}

template <class T>
Numbers<T> read(const store::SealedReader& reader, const std::string& path,
                const Numbers<T>& numbers) {
  return {.columns = numbers.columns, .values = reader.read<T>(path, numbers.columns)};
}
Texts read(const store::SealedReader& reader, const std::string& path, const Texts& /*texts*/) {
  return reader.read_texts(path);
}

template <class T>
double bytes_of(const Numbers<T>& numbers) {
  return static_cast<double>(numbers.values.size() * sizeof(T));
}
/// None of them is long.
double bytes_of(const Texts& texts) {
  return 1000.0 * static_cast<double>(texts.size());
}

template <class Read>
void require_refusal(Read read, const char* otherwise) {
  try {
    read();
  } catch (const store::StoreError&) {
    return;
  }
  fuzz::found(otherwise);
}

template <class T>
void require_nothing_else(const store::SealedReader& reader, const std::string& path,
                          const Numbers<T>& numbers) {
  using Other = std::conditional_t<std::same_as<T, float>, std::uint32_t, float>;
  require_refusal([&] { reader.read<Other>(path, numbers.columns); }, "read as other numbers");
  require_refusal([&] { reader.read<T>(path, numbers.columns + 1); }, "read with more columns");
  require_refusal([&] { reader.read_texts(path); }, "numbers read as text");
}
void require_nothing_else(const store::SealedReader& reader, const std::string& path,
                          const Texts& /*texts*/) {
  require_refusal([&] { reader.read<std::uint8_t>(path); }, "text read as numbers");
}

void require_all(const std::vector<Item>& items, const fuzz::ScratchFile& file) {
  const store::SealedReader reader(file.path(), kKind, 1e9);
  for (const Item& item : items) {
    std::visit(
        [&](const auto& content) {
          fuzz::require(same(read(reader, item.path, content), content), "read as something else");
          require_nothing_else(reader, item.path, content);
        },
        item.content);
  }
  for (const char* path : kPaths) {
    const bool there = std::any_of(items.begin(), items.end(),
                                   [&](const Item& item) { return item.path == path; });
    fuzz::require(reader.has(path) == there, "not there, or there");
  }
}

/// What may be there at once when all is read and kept.
double need(const std::vector<Item>& items, std::size_t file_bytes) {
  double sum = 2 * static_cast<double>(file_bytes);
  for (const Item& item : items) {
    sum += std::visit([](const auto& content) { return bytes_of(content); }, item.content);
  }
  return sum;
}

void require_limit(const std::vector<Item>& items, const fuzz::ScratchFile& file, double limit,
                   double need) {
  const fuzz::MemoryMeter meter;
  std::vector<Content> kept;
  kept.reserve(items.size());
  try {
    const store::SealedReader reader(file.path(), kKind, limit);
    for (const Item& item : items) {
      std::visit([&](const auto& content) { kept.emplace_back(read(reader, item.path, content)); },
                 item.content);
    }
  } catch (const store::StoreError& error) {
    fuzz::require(limit < need, std::string("refused within the limit: ") + error.what());
  }
  fuzz::require(
      meter.most_bytes() <= limit + kBeside,
      "took " + std::to_string(meter.most_bytes()) + " bytes, not " + std::to_string(limit));
}

void require_refused(Bytes bytes, fuzz::Choices& choices, const fuzz::ScratchFile& file) {
  const std::size_t place = choices.up_to(static_cast<std::uint32_t>(bytes.size() - 1));
  if (const std::size_t change = choices.up_to(0xFF); change == 0) {
    bytes.resize(place);
  } else {
    bytes[place] = static_cast<std::uint8_t>(bytes[place] ^ change);
  }
  file.hold(bytes);
  require_refusal([&] { const store::SealedReader reader(file.path(), kKind, 1e9); },
                  "a changed file is read");
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::ScratchFile file;
  fuzz::Choices choices({data, size});
  const std::vector<Item> all = items(choices);
  const Bytes bytes = sealed(all);
  file.hold(bytes);
  require_all(all, file);
  require_limit(all, file, static_cast<double>(choices.up_to(kMostLimit)), need(all, bytes.size()));
  require_refused(bytes, choices, file);
  file.hold({data, size});
  require_refusal([&] { const store::SealedReader reader(file.path(), kKind, 1e9); },
                  "any bytes are read");
  return 0;
}
