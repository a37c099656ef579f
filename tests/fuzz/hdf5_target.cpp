// HDF5 files: whatever is written is read again and as nothing else, or refused within the limit of
// memory.

#include <array>
#include <utility>
#include <variant>

#include "choices.hpp"
#include "clca/store/file.hpp"
#include "memory_meter.hpp"
#include "scratch_file.hpp"
#include "store/hdf5.hpp"

namespace {

namespace fuzz = clca::fuzz;
namespace store = clca::store;
using Bytes = std::vector<std::uint8_t>;
using Texts = std::vector<std::string>;

constexpr store::FileKind kKind = {"thing", 3};
constexpr std::array kPaths = {"a", "b", "g/a", "g/h/a", "g/h/b"};
constexpr std::uint32_t kMaxRows = 1U << 16U;
constexpr std::uint32_t kMaxColumns = 8;
constexpr std::uint32_t kMaxLimit = 1U << 23U;
constexpr double kBeside = 4e6;  // names, what reads a file, buffers of the library

template <class T>
struct Numbers {
  std::size_t columns = 1;
  std::vector<T> values;
};
using Content = std::variant<Numbers<std::uint8_t>, Numbers<std::uint16_t>, Numbers<std::uint32_t>,
                             Numbers<std::uint64_t>, Numbers<std::int32_t>, Numbers<double>, Texts>;

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
  Numbers<T> result = {.columns = 1 + choices.up_to(kMaxColumns - 1), .values = {}};
  const std::size_t count = result.columns * choices.up_to(choices.yes() ? kMaxRows : 16);
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

Bytes file_of(const std::vector<Item>& items) {
  const auto add_all = [&](const store::hdf5::Handle& file) {
    for (const Item& item : items) {
      std::visit(
          [&]<class Some>(Some content) {
            if constexpr (std::same_as<Some, Texts>) {
              store::hdf5::add_dataset(file, {item.path, &content});
            } else {
              store::hdf5::add_dataset(file, {item.path, &content.values, content.columns});
            }
          },
          item.content);
    }
  };
  return store::with_header(kKind, store::hdf5::file_bytes("file", add_all));
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

/// Room for what was written, and where it is to be read to.
std::vector<store::Hdf5Dataset> datasets_of(std::vector<Item>& items) {
  std::vector<store::Hdf5Dataset> datasets;
  for (Item& item : items) {
    std::visit(
        [&]<class Some>(Some& content) {
          if constexpr (std::same_as<Some, Texts>) {
            datasets.push_back({.path = item.path, .values = &content});
          } else {
            datasets.push_back(
                {.path = item.path, .values = &content.values, .numbers_per_row = content.columns});
          }
        },
        item.content);
  }
  return datasets;
}

/// Whether all was read, and not refused.
bool read(const fuzz::ScratchFile& file, const std::vector<store::Hdf5Dataset>& datasets,
          double limit) {
  const fuzz::MemoryMeter meter;
  bool was_read = true;
  try {
    store::read_hdf5(file.path(), kKind, datasets, limit);
  } catch (const store::StoreError&) {
    was_read = false;
  }
  fuzz::require(meter.max_bytes() <= limit + kBeside, "took " + std::to_string(meter.max_bytes()) +
                                                          " bytes, not " + std::to_string(limit));
  return was_read;
}

void require_all(const std::vector<Item>& items, const fuzz::ScratchFile& file) {
  std::vector<Item> again = items;
  fuzz::require(read(file, datasets_of(again), 1e9), "what was written is refused");
  for (std::size_t i = 0; i < items.size(); ++i) {
    std::visit(
        [&]<class Some>(const Some& content) {
          fuzz::require(same(std::get<Some>(again[i].content), content), "read as something else");
        },
        items[i].content);
  }
}

/// Nothing is read as other numbers, with other columns or from another place.
void require_nothing_else(const std::vector<Item>& items, fuzz::Choices& choices,
                          const fuzz::ScratchFile& file) {
  if (items.empty()) {
    return;
  }
  std::vector<Item> some = {items[choices.up_to(static_cast<std::uint32_t>(items.size() - 1))]};
  store::Hdf5Dataset wanted = datasets_of(some).front();
  std::vector<double> reals;
  switch (choices.up_to(2)) {
    case 0:
      wanted.path += "/a";
      break;
    case 1:
      ++wanted.numbers_per_row;
      break;
    default:
      if (std::holds_alternative<Numbers<double>>(some.front().content)) {
        wanted.path = "g";
      } else {
        wanted.values = &reals;
      }
  }
  fuzz::require(!read(file, {wanted}, 1e9), "read as what it is not");
}

/// Read, or refused.
void read_within_limit(const std::vector<Item>& items, fuzz::Choices& choices,
                       const fuzz::ScratchFile& file) {
  std::vector<Item> again = items;
  read(file, datasets_of(again), static_cast<double>(choices.up_to(kMaxLimit)));
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::ScratchFile file;
  fuzz::Choices choices({data, size});
  const std::vector<Item> all = items(choices);
  file.hold(file_of(all));
  require_all(all, file);
  require_nothing_else(all, choices, file);
  read_within_limit(all, choices, file);
  return 0;
}
