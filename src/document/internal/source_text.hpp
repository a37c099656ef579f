#pragma once
// The text of a scene before YAML parsing: allowed characters and line numbers.

#include <memory>
#include <string_view>
#include <vector>

#include "document/internal/value.hpp"

namespace clca::document {

/// Maximum nesting of lists and maps.
inline constexpr std::size_t kMaxDepth = 32;
inline constexpr std::size_t kMaxValues = 260'000;

class SourceText {
 public:
  /// Throws Error unless the text is UTF-8 without control characters, tabs (comments may
  /// hold some), byte order mark and YAML directives, not larger than kMaxBytes, not with
  /// more than kMaxDepth brackets inside each other and not with more than kMaxValues values.
  SourceText(std::string_view text, std::shared_ptr<const Origin> origin);

  std::string_view text() const { return text_; }
  /// The location of the byte at `position`.
  TextLocation location(std::size_t position) const;
  /// Where the quote that opens at `begin` closes; the size of the text if it does not.
  std::size_t end_of_quote(std::size_t begin) const;

 private:
  std::size_t characters_before(std::size_t position) const;
  void check_characters() const;
  void check_directives() const;
  void check_brackets() const;
  void check_character(std::size_t position, std::size_t length) const;

  std::string_view text_;
  std::shared_ptr<const Origin> origin_;
  std::vector<std::size_t> line_starts_ = {0};
  std::vector<std::size_t> characters_;  // before each block of bytes, for long lines
};

}  // namespace clca::document
