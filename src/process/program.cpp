#include "clca/process/program.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <glib.h>
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
#include <thread>
#include <utility>

namespace clca::process {

namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kPause(5);
constexpr int kUnknown = -1;  // exit code

[[noreturn]] void fail(const std::string& what) {
  throw ProcessError(fmt::format("cannot {}: {}", what, std::strerror(errno)));
}

/// A file that is gone once it is closed.
int nameless_file(const fs::path& folder) {
  std::string path = folder / ".clca-XXXXXX";
  const int file = ::mkostemp(path.data(), O_CLOEXEC);
  if (file >= 0) {
    ::unlink(path.c_str());
  }
  return file;
}

/// For the child between fork and exec. Calls only async-signal-safe functions, since other threads
/// may have held locks.
void prepare_child(void* parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != *static_cast<pid_t*>(parent)) {
    ::_exit(127);  // too late for that signal
  }
  ::setpgid(0, 0);  // signals from the terminal are for the parent
  ::signal(SIGPIPE, SIG_DFL);
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

int OutputCapture::number() const {
  return ::fileno(file_.get());
}

std::FILE* OutputCapture::rewound() const {
  std::rewind(file_.get());
  return file_.get();
}

std::vector<std::uint8_t> OutputCapture::bytes() const {
  rewound();
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
      signal_(options.signal),
      grace_(options.grace) {
  if (::access((options.folder / "").c_str(), X_OK) != 0) {
    fail(fmt::format("enter the folder {}", options.folder.string()));
  }
  if (::access((options.folder / arguments[0]).c_str(), X_OK) != 0) {
    fail("run " + arguments[0]);
  }
  std::vector<char*> argv;
  for (const std::string& argument : arguments) {
    argv.push_back(const_cast<char*>(argument.c_str()));
  }
  argv.push_back(nullptr);
  const auto number = [](const OutputCapture* output) {
    return output != nullptr ? output->number() : -1;  // that of this program
  };
  std::array<int, 2> input = {-1, -1};  // ours and its; without any it reads nothing
  if (options.fed && ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, input.data()) != 0) {
    fail("make a pipe");  // a socket: unlike a pipe, it raises no signal when the reader is gone
  }
  input_ = input[0];
  pid_t parent = ::getpid();
  GError* error = nullptr;
  // The program inherits no other files than its standard streams.
  ::g_spawn_async_with_fds(options.folder.c_str(), argv.data(), nullptr, G_SPAWN_DO_NOT_REAP_CHILD,
                           prepare_child, &parent, &child_, input[1], number(options.out),
                           number(options.err), &error);
  if (options.fed) {
    ::close(input[1]);
  }
  if (error != nullptr) {
    close_input();
    const std::string text = error->message;
    ::g_error_free(error);
    throw ProcessError(fmt::format("cannot run {}: {}", arguments[0], text));
  }
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
    std::this_thread::sleep_for(kPause);
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
