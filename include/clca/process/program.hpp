#pragma once
// Other programs: found on the PATH, run without a shell.

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

/// What a program writes: a file without a name, gone with this object.
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

struct Setting {
  std::filesystem::path folder = ".";  ///< to run in
  const Transcript* out = nullptr;     ///< none: where this program writes to
  const Transcript* err = nullptr;
  /// Gives it what feed() is called with as its standard input, else nothing at all. Such a program
  /// is out of the terminal's reach: Ctrl-C stops who feeds it, and that one tells it the end.
  bool fed = false;
};

/// A program that runs beside this one.
class Program {
 public:
  /// Starts the file `arguments[0]`. Throws ProcessError.
  Program(const std::vector<std::string>& arguments, const Setting& setting);
  /// Ends it if it still runs.
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// Waits until the program has taken the bytes; false when it no longer does.
  bool feed(std::span<const std::uint8_t> bytes);
  /// Ends its standard input and waits for its end: exit code, or 128 and the number of a signal.
  int wait();

 private:
  void close_input();

  int child_ = -1;  // process id; -1 when it has ended
  int code_ = 0;    // when it has ended
  int input_ = -1;  // file descriptor; -1 when there is none
};

}  // namespace clca::process
