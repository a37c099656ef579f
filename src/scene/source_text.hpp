#pragma once
// The characters of a scene, before YAML: what may stand there at all, and on which line.

#include <memory>
#include <string_view>
#include <vector>

#include "scene/value.hpp"

namespace clca::scene {

inline constexpr std::size_t kLargestText = std::size_t{16} << 20U;

class SourceText {
 public:
  /// Throws SceneError unless the text is UTF-8 without control characters, tabs (comments may
  /// hold some), byte order mark and YAML directives, and not larger than kLargestText.
  SourceText(std::string_view text, std::shared_ptr<const Origin> origin);

  std::string_view text() const { return text_; }
  /// The place of the byte at `position`.
  Place place(std::size_t position) const;

 private:
  std::size_t characters_before(std::size_t position) const;
  void check_characters() const;
  void check_directives() const;
  void check_character(std::size_t position, std::size_t length) const;

  std::string_view text_;
  std::shared_ptr<const Origin> origin_;
  std::vector<std::size_t> line_starts_ = {0};
  std::vector<std::size_t> characters_;  // before each block of bytes, for long lines
};

}  // namespace clca::scene
