#pragma once
// Shows how a run or a sweep is going: one line that is written over on a terminal, plain lines
// elsewhere.

#include <chrono>
#include <string>

#include "clca/run/redraw.hpp"
#include "clca/run/run.hpp"
#include "clca/sweep/sweep.hpp"

namespace clca::cli {

class ProgressLine {
 public:
  ProgressLine();
  /// Leaves a clean line to whatever comes next, an error for one.
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(const run::Progress& progress);
  void show(const run::GasProgress& progress);
  void show(const run::RedrawProgress& progress);
  void show(const sweep::Progress& progress);
  /// A line that stays, on standard error.
  void print(const std::string& line);

 private:
  void show(const std::string& text);
  void clear();

  bool terminal_;
  bool stands_ = false;  // a line, on the terminal
  std::chrono::steady_clock::time_point next_plain_;
};

/// "12 s", "3 min 20 s", "5 h 10 min".
std::string duration(double seconds);

}  // namespace clca::cli
