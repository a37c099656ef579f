#include "clca/text/name.hpp"

#include <algorithm>

namespace clca::text {

bool is_file_name(std::string_view name) {
  constexpr std::size_t kMostBytes = 200;
  return !name.empty() && name != "." && name != ".." && name.size() <= kMostBytes &&
         std::none_of(name.begin(), name.end(), [](char letter) {
           const auto byte = static_cast<unsigned char>(letter);
           return letter == '/' || byte < ' ' || byte == 0x7F;
         });
}

}  // namespace clca::text
