#pragma once
// Which values an option takes. CLI11 alone takes -1 as 2^64 - 1, 010 as 8 and nan as a number.

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace clca::cli {

/// What may stand in place of a word that has been begun.
struct Candidate {
  std::string text;
  std::string about = {};
};

struct OptionValues {
  /// What is wrong with the text, or nothing. May replace it by another that means the same.
  std::function<std::string(std::string& text)> read;
  std::string shown;  ///< in the help, after the type
  /// For completion in a shell; none: file names, where the type is FILE, FOLDER or not said.
  std::function<std::vector<Candidate>(const std::string& begun)> candidates = {};
};

/// Digits without sign or leading zeros.
OptionValues whole_number(std::uint64_t least = 0,
                          std::uint64_t most = std::numeric_limits<std::uint64_t>::max());
/// Pixels or, as `89mm`, a length on paper.
OptionValues length_of_figure();
OptionValues finite_number();
/// `0:5`, of which one may be left out: `:5`.
OptionValues limits_of_axis();

/// `3/64`: the third of 64 parts.
OptionValues part_of_whole(std::uint64_t most);

/// Any text; the key of a scene is completed.
OptionValues key_of_scene();
/// Any text, since the scene checks it; the words of this key are shown and completed.
OptionValues value_of_key(const std::string& key);
/// A key, `=` and what `form` (`KEY=VALUE`) says.
OptionValues assignment(const std::string& form);

/// `90`, `30min` or `2h` into seconds.
OptionValues time_span();
/// `4GiB` into bytes.
OptionValues byte_size();

enum class LetterCase : std::uint8_t { matters, ignored };

/// A word into the same one as it is written in `words`.
OptionValues one_of(const std::vector<std::string>& words,
                    LetterCase letter_case = LetterCase::matters);

}  // namespace clca::cli
