#pragma once
// External programs: found on the PATH, run without a shell.

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

/// The first executable file of that name on the PATH, if any. Relative folders are skipped: the
/// working directory must not decide what runs.
std::optional<std::filesystem::path> find_program(const std::string& name);

/// Keeps the output of a program: in memory, or in a file without a name, for what may be large.
class OutputCapture {
 public:
  /// `folder`: of the file; none: in memory. Throws ProcessError.
  explicit OutputCapture(const std::filesystem::path& folder = {});
  /// File descriptor for writing.
  int descriptor() const;
  /// Everything written so far.
  std::vector<std::uint8_t> bytes() const;
  /// The file, to be read from its beginning.
  std::FILE* rewound_file() const;

 private:
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

/// The program was ended because the stop flag was set.
class StoppedError : public ProcessError {
 public:
  using ProcessError::ProcessError;
};

struct ProgramOptions {
  std::filesystem::path working_folder = ".";  ///< working directory of the program
  const OutputCapture* output = nullptr;       ///< null: standard output of this program
  const OutputCapture* error_output = nullptr;
  /// Standard input: what feed() writes, else empty.
  bool is_fed = false;
  /// Once not zero, the program gets `stop_signal`, unless that is 0, and is killed after
  /// `grace_period`.
  const std::atomic<int>* stop = nullptr;
  int stop_signal = 0;
  std::chrono::milliseconds grace_period{0};
};

/// A running program. It gets no terminal signals and ends when the thread that started it ends.
class Program {
 public:
  /// Starts the file `arguments[0]`. Throws ProcessError.
  Program(const std::vector<std::string>& arguments, const ProgramOptions& options);
  /// Ends the program if it is still running.
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// Writes to its standard input; false if the program no longer reads. Throws StoppedError.
  bool feed(std::span<const std::uint8_t> bytes);
  /// Closes its standard input and waits for its end. Returns the exit code, or 128 plus the
  /// signal.
  /// Throws StoppedError, and ProcessError where the system does not tell how it has ended.
  int wait();

 private:
  void end_when_stopped();
  void kill();
  /// `options`: of waitpid(2).
  bool has_ended(int options);
  void close_input();

  std::string name_;
  const std::atomic<int>* stop_;
  int signal_;
  std::chrono::milliseconds grace_;
  std::optional<std::chrono::steady_clock::time_point> deadline_;  // once it is to stop
  int child_ = -1;  // process id; -1 when it has ended
  int code_ = 0;    // when it has ended
  int input_ = -1;  // file descriptor; -1 when there is none
};

}  // namespace clca::process
