#include "store/seal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <stdexcept>

#include "clca/random/word_hash.hpp"

namespace clca::store {

namespace {

constexpr std::string_view kMark = "clca ";

/// Of the bytes, in words of eight, and their number.
std::uint64_t checksum(std::string_view title, std::span<const std::uint8_t> content) {
  random::WordHash hash;
  const auto add = [&](const void* bytes, std::size_t size) {
    for (std::size_t at = 0; at < size; at += sizeof(std::uint64_t)) {
      std::uint64_t word = 0;
      std::memcpy(&word, static_cast<const char*>(bytes) + at, std::min(sizeof word, size - at));
      hash.add(word);
    }
    hash.add(size);
  };
  add(title.data(), title.size());
  add(content.data(), content.size());
  return hash.value();
}

std::string title_of(std::string_view kind, std::uint32_t version) {
  return fmt::format("{}{} version {}\n", kMark, kind, version);
}

std::string text_of(const std::string& title, std::span<const std::uint8_t> content) {
  return fmt::format("{}bytes {}\nchecksum {:016x}\n", title, content.size(),
                     checksum(title, content));
}

/// The number after `key` in the seal; none where it is not there.
template <class T>
bool read_number(std::string_view seal, std::string_view key, T& number) {
  const std::size_t at = seal.find(key);
  const std::string_view rest = at == std::string_view::npos ? "" : seal.substr(at + key.size());
  return std::from_chars(rest.data(), rest.data() + rest.size(), number).ec == std::errc();
}

}  // namespace

std::vector<std::uint8_t> seal_of(const FileKind& kind, std::span<const std::uint8_t> content) {
  const std::string text = text_of(title_of(kind.name, kind.version), content);
  std::vector<std::uint8_t> seal(kSealBytes, 0);
  std::copy(text.begin(), text.end(), seal.begin());
  return seal;
}

std::uint32_t check_seal(const FileKind& kind, std::span<const std::uint8_t> file) {
  const std::string_view seal(reinterpret_cast<const char*>(file.data()),
                              std::min(file.size(), kSealBytes));
  std::uint32_t version = 0;
  std::uint64_t bytes = 0;
  if (!seal.starts_with(fmt::format("{}{} ", kMark, kind.name)) ||
      !read_number(seal, " version ", version) || !read_number(seal, "\nbytes ", bytes)) {
    throw std::runtime_error(fmt::format("it is no {} of clca", kind.name));
  }
  if (version > kind.version) {
    throw std::runtime_error(
        fmt::format("its format is version {}, newer than this program, which knows up to {}",
                    version, kind.version));
  }
  if (file.size() < kSealBytes || bytes > file.size() - kSealBytes) {
    throw std::runtime_error("it is cut off");
  }
  const auto content = file.subspan(kSealBytes);
  const auto right = seal_of({kind.name, version}, content);
  if (bytes < content.size() || !std::equal(right.begin(), right.end(), file.begin())) {
    throw std::runtime_error("its checksum is wrong: it has been changed or damaged");
  }
  return version;
}

}  // namespace clca::store
