#pragma once
// What comes from outside: whole files, numbers in text, names of files; the error for wrong input.

#include <charconv>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <vector>

namespace clca::text {

/// A file, folder or name that the user gave is wrong. what() is one line.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Why a file cannot be read, without its name: `No such file or directory`.
class ReadError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The bytes of a regular file. Does not block on devices, pipes or sockets.
/// Throws ReadError for other files, and for more than `max_bytes`, even if read while it grows.
std::vector<std::uint8_t> read_file(const std::filesystem::path& file, double max_bytes);

/// The whole text as a number, if it is one. `format`: further arguments of std::from_chars.
template <class T>
std::optional<T> number(std::string_view text, auto... format) {
  T result = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, result, format...);
  return stop == end && error == std::errc() ? std::optional(result) : std::nullopt;
}

/// Whether `text` is safe as a file name, or its beginning: a single path component, no leading
/// dot, no control characters, at most 200 bytes.
bool is_file_name(std::string_view text);

}  // namespace clca::text
