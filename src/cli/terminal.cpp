#include "cli/terminal.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "cli/command.hpp"

namespace clca::cli {

namespace {

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): so is standard output
int output_error = 0;  // errno of the first failure
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): likewise
bool is_silent = false;

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): all a handler can reach
std::atomic<int> caught = 0;
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may only do so much");

extern "C" void remember(int signal) {
  caught = signal;
}

/// 0, or errno.
int write_all(int stream, std::string_view text) noexcept {
  while (!text.empty()) {
    const ssize_t count = ::write(stream, text.data(), text.size());
    if (count >= 0) {
      text.remove_prefix(static_cast<std::size_t>(count));
    } else if (errno == EAGAIN) {  // another process made the terminal non-blocking
      pollfd writable = {.fd = stream, .events = POLLOUT, .revents = 0};
      ::poll(&writable, 1, -1);
    } else if (errno != EINTR) {
      return errno;
    }
  }
  return 0;
}

}  // namespace

void occupy_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) < 0) {
      ::open("/", O_PATH);  // takes the lowest free number; reading and writing fail
    }
  }
}

void silence_output() noexcept {
  is_silent = true;
}

void write_out(std::string_view text) noexcept {
  if (output_error == 0 && !is_silent) {
    output_error = write_all(STDOUT_FILENO, text);
  }
}

void write_error(std::string_view text) noexcept {
  if (!is_silent) {
    write_all(STDERR_FILENO, text);
  }
}

void write_always(std::string_view text) noexcept {
  write_all(STDERR_FILENO, text);
}

int finish_output(int code) noexcept {
  if (::close(STDOUT_FILENO) != 0 && output_error == 0) {  // a file on a network may fail only now
    output_error = errno;
  }
  if (output_error == 0) {
    return code;
  }
  if (output_error == EPIPE) {
    return code == 0 ? kSignalBase + SIGPIPE : code;
  }
  write_error("clca: error: cannot write to standard output: ");
  // NOLINTNEXTLINE(concurrency-mt-unsafe): the other threads have ended
  write_error(std::strerror(output_error));
  write_error("\n");
  return code == 0 ? kFailed : code;
}

const std::atomic<int>& catch_stop_signals() {
  struct sigaction action {};
  action.sa_handler = remember;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction present {};
  sigaction(SIGHUP, nullptr, &present);
  if (present.sa_handler != SIG_IGN) {
    sigaction(SIGHUP, &action, nullptr);
  }
  return caught;
}

int stop_signal() {
  return caught;
}

void set_up_signals() {
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGCHLD, SIG_DFL);
}

}  // namespace clca::cli
