#pragma once
// The error for wrong input.

#include <stdexcept>

namespace clca::text {

/// A file, folder or name that the user gave is wrong. what() is one line.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace clca::text
