#pragma once
// The characters of a scene, before YAML: what may stand there at all, and on which line.

#include <memory>
#include <string_view>
#include <vector>

#include "scene/value.hpp"

namespace clca::scene {

/// Of lists and maps inside each other.
inline constexpr std::size_t kDeepest = 32;

class SourceText {
 public:
  /// Throws SceneError unless the text is UTF-8 without control characters, tabs (comments may
  /// hold some), byte order mark and YAML directives, not larger than kMostSceneBytes and not with
  /// more than kDeepest brackets inside each other.
  SourceText(std::string_view text, std::shared_ptr<const Origin> origin);

  std::string_view text() const { return text_; }
  /// The place of the byte at `position`.
  Place place(std::size_t position) const;

 private:
  std::size_t characters_before(std::size_t position) const;
  void check_characters() const;
  void check_directives() const;
  void check_brackets() const;
  /// Where the quote that opens at `begin` closes.
  std::size_t end_of_quote(std::size_t begin) const;
  void check_character(std::size_t position, std::size_t length) const;

  std::string_view text_;
  std::shared_ptr<const Origin> origin_;
  std::vector<std::size_t> line_starts_ = {0};
  std::vector<std::size_t> characters_;  // before each block of bytes, for long lines
};

}  // namespace clca::scene
