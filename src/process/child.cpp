#include "clca/process/child.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <new>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define CLCA_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define CLCA_SANITIZED 1
#endif
#endif

#include "process/internal/write_all.hpp"

namespace clca::process {

namespace {

constexpr int kThrew = 1;  // exit code

/// The first end is for reading.
std::array<int, 2> make_pipe() {
  std::array<int, 2> ends = {-1, -1};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw ProcessError(fmt::format("cannot make a pipe: {}", std::strerror(errno)));
  }
  return ends;
}

void close_both(const std::array<int, 2>& ends) {
  ::close(ends[0]);
  ::close(ends[1]);
}

/// Closes all file descriptors from 3 on but two, so that the child holds no locks or files of the
/// parent.
void close_others(int one, int other) {
  int first = STDERR_FILENO + 1;
  for (const int kept : {std::min(one, other), std::max(one, other)}) {
    if (first < kept) {
      ::close_range(static_cast<unsigned>(first), static_cast<unsigned>(kept - 1), 0);
    }
    first = std::max(first, kept + 1);
  }
  ::close_range(static_cast<unsigned>(first), ~0U, 0);
}

/// The child ignores terminal signals: the parent decides when to stop. A crash ends the child at
/// once, whatever handlers the parent has.
void set_signals() {
  for (const int ignored : {SIGINT, SIGTERM, SIGHUP}) {
    ::signal(ignored, SIG_IGN);
  }
  for (const int fatal :
       {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU, SIGPIPE, SIGALRM, SIGSYS, SIGTRAP}) {
    ::signal(fatal, SIG_DFL);
  }
}

void set_limit(decltype(RLIMIT_AS) what, rlim_t most) {
  rlimit limit{};
  if (::getrlimit(what, &limit) == 0) {
    limit.rlim_cur = std::min(limit.rlim_cur, most);
    ::setrlimit(what, &limit);
  }
}

#ifndef CLCA_SANITIZED
/// Address space of this process in bytes; 0 if the system does not report it.
double address_space() {
  const int file = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  std::array<char, 64> text = {};
  const bool known = file >= 0 && ::read(file, text.data(), text.size() - 1) > 0;
  ::close(file);
  return known ? static_cast<double>(std::strtoull(text.data(), nullptr, 10)) *
                     static_cast<double>(::sysconf(_SC_PAGESIZE))
               : 0;
}
#endif

void set_limits(const ChildLimits& limits) {
  set_limit(RLIMIT_CORE, 0);
  set_limit(RLIMIT_CPU, limits.cpu_seconds);
#ifndef CLCA_SANITIZED
  constexpr double kUnlimited = 0x1p46;
  const double most = address_space() + limits.memory_bytes;
  if (most > limits.memory_bytes && most < kUnlimited) {
    set_limit(RLIMIT_AS, static_cast<rlim_t>(most));
  }
#endif
}

/// Sanitizer allocators (GCC 12) do not support fork: a lock held by another thread stays locked in
/// the child.
bool can_fork() {
#ifdef CLCA_SANITIZED
  using Entries = std::filesystem::directory_iterator;
  return std::distance(Entries("/proc/self/task"), Entries()) == 1;
#else
  return true;
#endif
}

/// What the child does; returns its exit code.
int run_child(const std::function<void(const Child::Send&)>& work, int output, int error) {
  const auto report = [error](const char* text) {
    write_all(error, {reinterpret_cast<const std::uint8_t*>(text), std::strlen(text)});
    return kThrew;
  };
  try {
    work([output](std::span<const std::uint8_t> bytes) {
      if (!write_all(output, bytes)) {
        throw std::runtime_error(std::strerror(errno));
      }
    });
    return 0;
  } catch (const std::bad_alloc&) {
    return report("out of memory");
  } catch (const std::exception& exception) {
    return report(exception.what());
  } catch (...) {
    return kThrew;
  }
}

}  // namespace

Child::Child(const std::function<void(const Send&)>& work, const ChildLimits& limits)
    : limits_(limits) {
  const std::array<int, 2> output = make_pipe();
  std::array<int, 2> error = {-1, -1};
  try {
    error = make_pipe();
  } catch (...) {
    close_both(output);
    throw;
  }
  output_ = output[0];
  error_ = error[0];
  if (!can_fork()) {
    thread_ = std::thread([this, work, output, error] {
      static std::mutex one_at_a_time;
      const std::lock_guard lock(one_at_a_time);
      thread_status_ = W_EXITCODE(run_child(work, output[1], error[1]), 0);
      ::close(output[1]);
      ::close(error[1]);
    });
    return;
  }
  const pid_t parent = ::getpid();
  child_ = ::fork();
  if (child_ == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) {
      ::_exit(kThrew);
    }
    close_others(output[1], error[1]);
    set_signals();
    set_limits(limits);
    ::_exit(run_child(work, output[1], error[1]));
  }
  if (child_ < 0) {
    const int reason = errno;
    close_both(output);
    close_both(error);
    throw ProcessError(fmt::format("cannot start a child process: {}", std::strerror(reason)));
  }
  ::close(output[1]);
  ::close(error[1]);
}

Child::~Child() {
  if (thread_.joinable()) {
    for (std::array<std::uint8_t, 4096> rest = {}; ::read(output_, rest.data(), rest.size()) > 0;) {
    }
    thread_.join();
  } else if (child_ > 0) {
    ::kill(child_, SIGKILL);
    wait();
  }
  ::close(output_);
  ::close(error_);
}

std::size_t Child::read_some(std::span<std::uint8_t> bytes) const {
  while (true) {
    const ssize_t count = ::read(output_, bytes.data(), bytes.size());
    if (count >= 0) {
      return static_cast<std::size_t>(count);
    }
    if (errno != EINTR) {
      throw ProcessError(fmt::format("cannot read from a pipe: {}", std::strerror(errno)));
    }
  }
}

void Child::receive(std::span<std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const std::size_t count = read_some(bytes);
    if (count == 0) {
      fail(wait());
    }
    bytes = bytes.subspan(count);
  }
}

void Child::finish() {
  std::uint8_t more = 0;
  if (read_some({&more, 1}) != 0) {
    throw ChildError("sent more than expected", false);
  }
  if (const int status = wait(); status != 0) {
    fail(status);
  }
}

int Child::wait() {
  if (thread_.joinable()) {
    thread_.join();
    return thread_status_;
  }
  int status = 0;
  while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
  }
  child_ = -1;
  return status;
}

void Child::fail(int status) const {
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    throw ChildError(signal == SIGXCPU ? fmt::format("took more than {} s", limits_.cpu_seconds)
                                       : fmt::format("crashed (signal {})", signal),
                     true);
  }
  std::array<char, 4096> text = {};
  const ssize_t length = ::read(error_, text.data(), text.size());
  throw ChildError(length > 0 ? std::string(text.data(), static_cast<std::size_t>(length))
                              : fmt::format("ended early (code {})", WEXITSTATUS(status)),
                   length <= 0);
}

bool write_all(int descriptor, std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) {
      return false;
    }
    bytes = bytes.subspan(static_cast<std::size_t>(std::max<ssize_t>(written, 0)));
  }
  return true;
}

}  // namespace clca::process
