#include "clca/process/program.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/close_range.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <system_error>
#include <utility>

namespace clca::process {

namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kPause(5);
constexpr int kUnknown = -1;  // exit code

void wait_briefly() {
  ::poll(nullptr, 0, static_cast<int>(kPause.count()));
}

[[noreturn]] void fail(const std::string& what, int error = errno) {
  throw ProcessError(fmt::format("cannot {}: {}", what, std::strerror(error)));
}

/// Two file descriptors; those that are left are closed.
class FileDescriptors {
 public:
  FileDescriptors() = default;
  ~FileDescriptors() {
    for (const int end : numbers) {
      if (end >= 0) {
        ::close(end);
      }
    }
  }
  FileDescriptors(const FileDescriptors&) = delete;
  FileDescriptors& operator=(const FileDescriptors&) = delete;

  std::array<int, 2> numbers = {-1, -1};
};

/// A file that is gone once it is closed.
int nameless_file(const fs::path& folder) {
  std::string path = folder / ".clca-XXXXXX";
  const int file = ::mkostemp(path.data(), O_CLOEXEC);
  if (file >= 0) {
    ::unlink(path.c_str());
  }
  return file;
}

/// What the child needs between fork and exec, prepared before: no allocation is allowed there.
struct ChildSetup {
  char* const* arguments;
  int folder;                  ///< file descriptor
  std::array<int, 3> streams;  ///< file descriptors for 0, 1 and 2
  pid_t parent;
  int report;  ///< pipe for the error number
};

/// Calls only async-signal-safe functions, since other threads may have held locks.
[[noreturn]] void exec_program(const ChildSetup& setup) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != setup.parent) {
    ::_exit(127);  // too late for that signal
  }
  ::setpgid(0, 0);  // signals from the terminal are for the parent
  ::signal(SIGPIPE, SIG_DFL);
  // Moves them out of the way first: one may have the number that another needs.
  const int report = ::fcntl(setup.report, F_DUPFD_CLOEXEC, 3);
  std::array<int, 3> streams = setup.streams;
  for (int& stream : streams) {
    stream = ::fcntl(stream, F_DUPFD_CLOEXEC, 3);
  }
  if (::fchdir(setup.folder) == 0) {
    for (int number = 0; number < 3; ++number) {
      ::dup2(streams[static_cast<std::size_t>(number)], number);
    }
    ::close_range(3, ~0U, CLOSE_RANGE_CLOEXEC);
    ::execv(setup.arguments[0], setup.arguments);
  }
  const int error = errno;
  [[maybe_unused]] const ssize_t written = ::write(report, &error, sizeof error);
  ::_exit(127);
}

/// Starts the file `arguments[0]` with standard input `input`.
/// It inherits no other files than its standard streams, and ends when the calling thread ends.
pid_t start(const std::vector<std::string>& arguments, const ProgramOptions& options, int input) {
  std::vector<char*> argv;
  for (const std::string& argument : arguments) {
    argv.push_back(const_cast<char*>(argument.c_str()));
  }
  argv.push_back(nullptr);
  FileDescriptors report;
  FileDescriptors folder;
  folder.numbers[0] = ::open(options.working_folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
  if (folder.numbers[0] < 0) {
    fail(fmt::format("enter the folder {}", options.working_folder.string()));
  }
  if (::pipe2(report.numbers.data(), O_CLOEXEC) != 0) {
    fail("run " + arguments[0]);
  }
  const ChildSetup setup = {
      .arguments = argv.data(),
      .folder = folder.numbers[0],
      .streams = {input, options.output != nullptr ? options.output->descriptor() : STDOUT_FILENO,
                  options.error_output != nullptr ? options.error_output->descriptor()
                                                  : STDERR_FILENO},
      .parent = ::getpid(),
      .report = report.numbers[1]};
  const pid_t child = ::fork();
  if (child == 0) {
    exec_program(setup);
  }
  if (child < 0) {
    fail("run " + arguments[0]);
  }
  ::close(std::exchange(report.numbers[1], -1));
  int error = 0;
  ssize_t count = 0;
  do {  // until exec has closed the pipe
    count = ::read(report.numbers[0], &error, sizeof error);
  } while (count < 0 && errno == EINTR);
  if (count == sizeof error) {
    ::waitpid(child, nullptr, 0);
    fail("run " + arguments[0], error);
  }
  return child;
}

}  // namespace

std::optional<fs::path> find_program(const std::string& name) {
  const char* path = std::getenv("PATH");  // NOLINT(concurrency-mt-unsafe): nobody sets it
  std::stringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    fs::path file = fs::path(folder) / name;
    std::error_code unknown;
    if (file.is_absolute() && !fs::is_directory(file, unknown) &&
        ::access(file.c_str(), X_OK) == 0) {
      return file;
    }
  }
  return std::nullopt;
}

// In memory a full disk cannot truncate it.
OutputCapture::OutputCapture(const fs::path& folder)
    : file_(::fdopen(
                folder.empty() ? ::memfd_create("transcript", MFD_CLOEXEC) : nameless_file(folder),
                "w+"),
            &std::fclose) {
  if (!file_) {
    fail("make a temporary file");
  }
}

int OutputCapture::descriptor() const {
  return ::fileno(file_.get());
}

std::FILE* OutputCapture::rewound_file() const {
  std::rewind(file_.get());
  return file_.get();
}

std::vector<std::uint8_t> OutputCapture::bytes() const {
  rewound_file();
  std::vector<std::uint8_t> all;
  std::vector<std::uint8_t> block(1U << 16U);
  while (const std::size_t count = std::fread(block.data(), 1, block.size(), file_.get())) {
    all.insert(all.end(), block.begin(), block.begin() + static_cast<std::ptrdiff_t>(count));
  }
  return all;
}

Program::Program(const std::vector<std::string>& arguments, const ProgramOptions& options)
    : name_(fs::path(arguments[0]).filename().string()),
      stop_(options.stop),
      signal_(options.stop_signal),
      grace_(options.grace_period) {
  FileDescriptors input;  // ours and its
  if (!options.is_fed) {
    input.numbers[1] = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  } else if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, input.numbers.data()) != 0) {
    fail("make a pipe");  // a socket: unlike a pipe, it raises no signal when the reader is gone
  }
  child_ = start(arguments, options, input.numbers[1]);
  input_ = std::exchange(input.numbers[0], -1);
}

Program::~Program() {
  close_input();
  if (child_ > 0) {
    kill();
  }
}

bool Program::feed(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = ::send(input_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent >= 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(sent));
    } else if (errno == EAGAIN) {
      pollfd writable = {.fd = input_, .events = POLLOUT, .revents = 0};
      ::poll(&writable, 1, static_cast<int>(kPause.count()));
    } else if (errno != EINTR) {
      return false;
    }
    end_when_stopped();
  }
  return true;
}

int Program::wait() {
  close_input();
  while (child_ > 0 && !has_ended(WNOHANG)) {
    end_when_stopped();
    wait_briefly();
  }
  if (code_ == kUnknown) {
    throw ProcessError(fmt::format(
        "cannot tell how {} has ended: SIGCHLD is ignored, or another waitpid has asked", name_));
  }
  return code_;
}

void Program::end_when_stopped() {
  if (stop_ == nullptr || *stop_ == 0) {
    return;
  }
  const auto now = std::chrono::steady_clock::now();
  if (!deadline_) {
    deadline_ = now + grace_;
    if (signal_ != 0) {
      ::kill(child_, signal_);
    }
  }
  if (now >= *deadline_) {
    kill();
    throw StoppedError(fmt::format("{} was stopped before it was done", name_));
  }
}

void Program::kill() {
  ::kill(child_, SIGKILL);
  while (!has_ended(0)) {
  }
}

bool Program::has_ended(int options) {
  int status = 0;
  const pid_t ended = ::waitpid(child_, &status, options);
  if (ended == 0 || (ended < 0 && errno == EINTR)) {
    return false;
  }
  child_ = -1;
  constexpr int kSignalBase = 128;
  code_ = ended < 0           ? kUnknown
          : WIFEXITED(status) ? WEXITSTATUS(status)
                              : kSignalBase + WTERMSIG(status);
  return true;
}

void Program::close_input() {
  if (input_ >= 0) {
    ::close(std::exchange(input_, -1));
  }
}

}  // namespace clca::process
