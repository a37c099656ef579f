#include "clca/process/program.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/mman.h>
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

#include "process/start_child.hpp"

namespace clca::process {

namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kPause(5);
constexpr int kUnknown = -1;  // exit code

void pause() {
  ::poll(nullptr, 0, static_cast<int>(kPause.count()));
}

/// Unlike a pipe, a socket raises no signal when the reader is gone. The first end is ours.
std::array<int, 2> socket_pair() {
  std::array<int, 2> ends = {-1, -1};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw ProcessError(fmt::format("cannot make a pipe: {}", std::strerror(errno)));
  }
  return ends;
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
    throw ProcessError(fmt::format("cannot make a temporary file: {}", std::strerror(errno)));
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
      grace_(options.grace) {
  std::array<int, 2> ends = {-1, -1};  // ours and its
  if (options.fed) {
    ends = socket_pair();
  } else if (ends[1] = ::open("/dev/null", O_RDONLY | O_CLOEXEC); ends[1] < 0) {
    throw ProcessError(fmt::format("cannot open /dev/null: {}", std::strerror(errno)));
  }
  input_ = ends[0];
  try {
    child_ = start_child(arguments, options, ends[1]);
  } catch (...) {
    ::close(ends[1]);
    close_input();
    throw;
  }
  ::close(ends[1]);
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
    pause();
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
