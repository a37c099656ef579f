#pragma once
// How libpng reports: errors are kept and long-jump, warnings are dropped.

#include <png.h>

#include <array>
#include <csetjmp>
#include <string>

namespace clca::image {

struct PngError {
  std::array<char, 200> reason = {};

  std::string message(const std::string& what) const {
    return reason.front() == '\0' ? what : what + ": " + reason.data();
  }
};

[[noreturn]] inline void fail(png_structp png, png_const_charp reason) {
  auto* error = static_cast<PngError*>(png_get_error_ptr(png));
  std::size_t length = 0;
  while (reason[length] != '\0' && length + 1 < error->reason.size()) {
    error->reason[length] = reason[length];
    ++length;
  }
  error->reason[length] = '\0';
  png_longjmp(png, 1);
}

inline void ignore(png_structp, png_const_charp) {}

}  // namespace clca::image
