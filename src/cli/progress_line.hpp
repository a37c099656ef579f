#pragma once
// Shows progress: a line that is overwritten on a terminal, plain lines elsewhere.

#include <chrono>
#include <string>

#include "clca/drawing/redraw.hpp"
#include "clca/run/run.hpp"
#include "clca/sweep/sweep.hpp"

namespace clca::cli {

class ProgressLine {
 public:
  ProgressLine();
  /// Clears the line for the next output, such as an error.
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(const std::string& text);
  void print(const std::string& line);

 private:
  void clear();

  bool terminal_;
  bool line_shown_ = false;  // a line, on the terminal
  std::chrono::steady_clock::time_point next_plain_;
};

std::string to_text(const run::Progress& progress);
std::string to_text(const run::GasProgress& progress);
std::string to_text(const drawing::RedrawProgress& progress);
std::string to_text(const sweep::Progress& progress);

}  // namespace clca::cli
