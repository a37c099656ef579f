#pragma once
// Messages between rank 0 and the others: a byte for the kind, a number of eight bytes, the rest.

#include <cstdint>
#include <string>
#include <string_view>

#include "clca/tasks/ranks.hpp"

namespace clca::tasks {

enum class Kind : std::uint8_t {
  // from rank 0
  begin,    ///< number: none; rest: path of the lock file
  request,  ///< number: of the task; rest: of the request
  stop,     ///< break off all tasks
  end,      ///< there are no more; number: 1 if a rank has been lost
  // to rank 0
  greeting,  ///< number: fingerprint; rest: number of threads, 1 if the lock of rank 0 is seen
  answer,    ///< number: of the task; rest: the result
  refusal,   ///< rest: why this rank serves no longer; empty: it was asked to end
};

struct Content {
  Kind kind = Kind::end;
  std::uint64_t number = 0;
  Bytes rest;

  std::string text() const { return {rest.begin(), rest.end()}; }
};

Bytes bytes_of(Kind kind, std::uint64_t number = 0, const Bytes& rest = {});
Bytes bytes_of(Kind kind, std::uint64_t number, std::string_view rest);
Content content_of(const Bytes& bytes);

}  // namespace clca::tasks
