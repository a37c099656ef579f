#include "clca/process/program.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <utility>

namespace clca::process {

namespace {

namespace fs = std::filesystem;

/// What a child process starts with other than what it inherits.
class Actions {
 public:
  /// `input`: file descriptor of its standard input; -1 for nothing to read.
  Actions(const Setting& setting, int input) {
    ::posix_spawn_file_actions_init(&actions_);
    connect(setting.out, STDOUT_FILENO);
    connect(setting.err, STDERR_FILENO);
    // Last: where this program has no standard input, one of the others may be 0 itself.
    if (input >= 0) {
      ::posix_spawn_file_actions_adddup2(&actions_, input, STDIN_FILENO);
    } else {
      ::posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    }
    ::posix_spawn_file_actions_addchdir_np(&actions_, setting.folder.c_str());
  }
  ~Actions() { ::posix_spawn_file_actions_destroy(&actions_); }
  Actions(const Actions&) = delete;
  Actions& operator=(const Actions&) = delete;
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  void connect(const Transcript* transcript, int number) {
    if (transcript != nullptr) {
      ::posix_spawn_file_actions_adddup2(&actions_, transcript->number(), number);
    }
  }

  posix_spawn_file_actions_t actions_{};
};

/// Whether the child is in a group of its own, which signals from the terminal do not reach.
class Attributes {
 public:
  explicit Attributes(bool own_group) {
    ::posix_spawnattr_init(&attributes_);
    if (own_group) {
      ::posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP);
      ::posix_spawnattr_setpgroup(&attributes_, 0);
    }
  }
  ~Attributes() { ::posix_spawnattr_destroy(&attributes_); }
  Attributes(const Attributes&) = delete;
  Attributes& operator=(const Attributes&) = delete;
  const posix_spawnattr_t* get() const { return &attributes_; }

 private:
  posix_spawnattr_t attributes_{};
};

/// A socket, unlike a pipe, can be written to without a signal when nobody reads any more. The
/// first end is ours.
std::array<int, 2> socket_pair() {
  std::array<int, 2> ends = {-1, -1};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw ProcessError(fmt::format("cannot make a pipe: {}", std::strerror(errno)));
  }
  return ends;
}

}  // namespace

std::optional<fs::path> find_program(const std::string& name) {
  const char* path = std::getenv("PATH");  // NOLINT(concurrency-mt-unsafe): nobody sets it
  std::stringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    fs::path file = fs::path(folder) / name;
    if (file.is_absolute() && !fs::is_directory(file) && ::access(file.c_str(), X_OK) == 0) {
      return file;
    }
  }
  return std::nullopt;
}

Transcript::Transcript() : file_(std::tmpfile(), &std::fclose) {
  if (!file_) {
    throw ProcessError(fmt::format("cannot make a temporary file: {}", std::strerror(errno)));
  }
}

int Transcript::number() const {
  return ::fileno(file_.get());
}

std::vector<std::uint8_t> Transcript::bytes() const {
  std::rewind(file_.get());
  std::vector<std::uint8_t> all;
  std::vector<std::uint8_t> block(1U << 16U);
  while (const std::size_t count = std::fread(block.data(), 1, block.size(), file_.get())) {
    all.insert(all.end(), block.begin(), block.begin() + static_cast<std::ptrdiff_t>(count));
  }
  return all;
}

Program::Program(const std::vector<std::string>& arguments, const Setting& setting) {
  std::vector<char*> argv;
  for (const std::string& argument : arguments) {
    argv.push_back(const_cast<char*>(argument.c_str()));
  }
  argv.push_back(nullptr);
  int its_end = -1;
  if (setting.fed) {
    const auto [ours, its] = socket_pair();
    input_ = ours;
    its_end = its;
  }
  const int error = ::posix_spawn(&child_, argv[0], Actions(setting, its_end).get(),
                                  Attributes(setting.fed).get(), argv.data(), environ);
  if (its_end >= 0) {
    ::close(its_end);
  }
  if (error != 0) {
    child_ = -1;
    close_input();
    throw ProcessError(fmt::format("cannot run {}: {}", arguments[0], std::strerror(error)));
  }
}

Program::~Program() {
  if (child_ > 0) {
    ::kill(child_, SIGKILL);
    wait();
  }
}

// Not const: what it is fed changes the program.
// NOLINTNEXTLINE(readability-make-member-function-const)
bool Program::feed(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = ::send(input_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno != EINTR) {
      return false;
    }
    bytes = bytes.subspan(static_cast<std::size_t>(std::max<ssize_t>(sent, 0)));
  }
  return true;
}

int Program::wait() {
  close_input();
  if (child_ < 0) {
    return code_;
  }
  int status = 0;
  while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
  }
  child_ = -1;
  constexpr int kSignalBase = 128;
  code_ = WIFEXITED(status) ? WEXITSTATUS(status) : kSignalBase + WTERMSIG(status);
  return code_;
}

void Program::close_input() {
  if (input_ >= 0) {
    ::close(std::exchange(input_, -1));
  }
}

}  // namespace clca::process
