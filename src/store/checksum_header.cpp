#include "store/checksum_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <stdexcept>
#include <string>

#include "clca/random/word_hash.hpp"

namespace clca::store {

namespace {

constexpr std::string_view kMark = "clca ";

/// Hash of the bytes in words of eight, and of their number.
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

std::string header_text(const FileKind& kind, std::span<const std::uint8_t> content) {
  const std::string title = fmt::format("{}{} version {}\n", kMark, kind.name, kind.version);
  return fmt::format("{}bytes {}\nchecksum {:016x}\n", title, content.size(),
                     checksum(title, content));
}

template <class T>
bool read_number(std::string_view header, std::string_view key, T& number) {
  const std::size_t at = header.find(key);
  const std::string_view rest = at == std::string_view::npos ? "" : header.substr(at + key.size());
  return std::from_chars(rest.data(), rest.data() + rest.size(), number).ec == std::errc();
}

}  // namespace

std::vector<std::uint8_t> with_header(const FileKind& kind, std::span<const std::uint8_t> content) {
  const std::string text = header_text(kind, content);
  std::vector<std::uint8_t> file(kHeaderBytes + content.size(), 0);
  std::ranges::copy(text, file.begin());
  std::ranges::copy(content, file.begin() + kHeaderBytes);
  return file;
}

std::span<const std::uint8_t> content_of(const FileKind& kind, std::span<const std::uint8_t> file) {
  const std::string_view header(reinterpret_cast<const char*>(file.data()),
                                std::min(file.size(), kHeaderBytes));
  std::uint32_t version = 0;
  std::uint64_t bytes = 0;
  if (!header.starts_with(fmt::format("{}{} ", kMark, kind.name)) ||
      !read_number(header, " version ", version) || !read_number(header, "\nbytes ", bytes)) {
    throw std::runtime_error(fmt::format("it is no {} of clca", kind.name));
  }
  if (version != kind.version) {
    throw std::runtime_error(fmt::format("its format is version {}, this program reads version {}",
                                         version, kind.version));
  }
  if (file.size() < kHeaderBytes || bytes > file.size() - kHeaderBytes) {
    throw std::runtime_error("it is cut off");
  }
  const auto content = file.subspan(kHeaderBytes);
  std::string right = header_text(kind, content);
  right.resize(kHeaderBytes, '\0');
  if (bytes < content.size() || header != right) {
    throw std::runtime_error("its checksum is wrong: it has been changed or damaged");
  }
  return content;
}

}  // namespace clca::store
