#include "clca/text/name.hpp"

#include <algorithm>

namespace clca::text {

bool is_file_name(std::string_view text) {
  constexpr std::size_t kMaxLength = 200;
  return !text.empty() && text.size() <= kMaxLength && text.front() != '.' &&
         std::none_of(text.begin(), text.end(), [](char letter) {
           const auto code = static_cast<unsigned char>(letter);
           return letter == '/' || code < 0x20 || code == 0x7F;
         });
}

}  // namespace clca::text
