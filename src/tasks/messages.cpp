#include "tasks/messages.hpp"

#include <cstring>

namespace clca::tasks {

Bytes bytes_of(Kind kind, std::uint64_t number, const Bytes& rest) {
  Bytes bytes;
  bytes.reserve(1 + sizeof number + rest.size());
  bytes.resize(1 + sizeof number);
  bytes[0] = static_cast<std::uint8_t>(kind);
  std::memcpy(&bytes[1], &number, sizeof number);
  bytes.insert(bytes.end(), rest.begin(), rest.end());
  return bytes;
}

Bytes bytes_of(Kind kind, std::uint64_t number, std::string_view rest) {
  return bytes_of(kind, number, Bytes(rest.begin(), rest.end()));
}

Content content_of(const Bytes& bytes) {
  Content content;
  content.kind = static_cast<Kind>(bytes.at(0));
  std::memcpy(&content.number, &bytes.at(1), sizeof content.number);
  content.rest.assign(bytes.begin() + 1 + sizeof content.number, bytes.end());
  return content;
}

}  // namespace clca::tasks
