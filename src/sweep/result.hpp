#pragma once
// The result of a run.

#include <cstdint>
#include <string>
#include <vector>

#include "clca/reflection/reflection.hpp"
#include "clca/store/summary.hpp"

namespace clca::sweep {

enum class Status : std::uint8_t { waiting, done, failed, interrupted };

struct Result {
  Status status = Status::waiting;
  store::RunSummary summary;  ///< of a run that is done
  std::string error;          ///< why it failed

  /// All but the summary, which has a form of its own.
  static constexpr auto fields() {
    using reflection::field;
    return std::make_tuple(field("status", &Result::status), field("error", &Result::error));
  }
};

}  // namespace clca::sweep
