#pragma once
// Other programs: found on the PATH, run without a shell.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace clca::process {

/// A program that cannot be started. what() is one line.
class ProcessError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The first file of that name on the PATH that may be run; nothing where there is none. Folders
/// without a leading slash are left out: what lies where one happens to work is not to be run.
std::optional<std::filesystem::path> find_program(const std::string& name);

/// What a program writes, kept in memory.
class Transcript {
 public:
  /// Throws ProcessError.
  Transcript();
  /// File descriptor, to write to.
  int number() const;
  /// All that is there.
  std::vector<std::uint8_t> bytes() const;

 private:
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

/// It was ended because a flag said so.
class Stopped : public ProcessError {
 public:
  using ProcessError::ProcessError;
};

struct Setting {
  std::filesystem::path folder = ".";  ///< to run in
  const Transcript* out = nullptr;     ///< none: where this program writes to
  const Transcript* err = nullptr;
  /// Gives it what feed() is called with as its standard input, else nothing at all.
  bool fed = false;
  /// Once this is not zero it has `grace` left to come to its end, then it is killed.
  const std::atomic<int>* stop = nullptr;
  std::chrono::milliseconds grace{0};
};

/// A program that runs beside this one, out of the reach of the terminal. It ends with the thread
/// that started it, however that ends.
class Program {
 public:
  /// Starts the file `arguments[0]`. Throws ProcessError.
  Program(const std::vector<std::string>& arguments, const Setting& setting);
  /// Ends it if it still runs.
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// Waits until the program has taken the bytes; false when it no longer does. Throws Stopped.
  bool feed(std::span<const std::uint8_t> bytes);
  /// Ends its standard input and waits for its end: exit code, or 128 and the number of a signal.
  /// Throws Stopped.
  int wait();

 private:
  void end_when_stopped();
  void kill();
  /// `options`: of waitpid(2).
  bool has_ended(int options);
  void close_input();

  std::string name_;
  const std::atomic<int>* stop_;
  std::chrono::milliseconds grace_;
  std::optional<std::chrono::steady_clock::time_point> deadline_;  // once it is to stop
  int child_ = -1;  // process id; -1 when it has ended
  int code_ = 0;    // when it has ended
  int input_ = -1;  // file descriptor; -1 when there is none
};

}  // namespace clca::process
