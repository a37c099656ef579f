#include "process/start_child.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/close_range.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

namespace clca::process {

namespace {

/// What the child needs between fork and exec, prepared before: no allocation is allowed there.
struct Plan {
  char* const* arguments;
  const char* folder;
  std::array<int, 3> streams;  ///< file descriptors for 0, 1 and 2
  pid_t parent;
  int report;  ///< pipe for the Failure
};

struct Failure {
  int error = 0;  ///< errno
  bool in_folder = false;
};

[[noreturn]] void give_up(int report, bool in_folder) {
  const Failure failure = {.error = errno, .in_folder = in_folder};
  [[maybe_unused]] const ssize_t written = ::write(report, &failure, sizeof failure);
  ::_exit(127);
}

/// Calls only async-signal-safe functions, since other threads may have held locks.
[[noreturn]] void become(const Plan& plan) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != plan.parent) {
    ::_exit(127);  // too late for that signal
  }
  ::setpgid(0, 0);  // signals from the terminal are for the parent
  ::signal(SIGPIPE, SIG_DFL);
  // Moves them out of the way first: one may have the number that another needs.
  const int report = ::fcntl(plan.report, F_DUPFD_CLOEXEC, 3);
  std::array<int, 3> streams = plan.streams;
  for (int& stream : streams) {
    stream = ::fcntl(stream, F_DUPFD_CLOEXEC, 3);
  }
  for (int number = 0; number < 3; ++number) {
    if (const int stream = streams[static_cast<std::size_t>(number)]; stream >= 0) {
      ::dup2(stream, number);
    }
  }
  ::close_range(3, ~0U, CLOSE_RANGE_CLOEXEC);
  if (::chdir(plan.folder) != 0) {
    give_up(report, true);
  }
  ::execv(plan.arguments[0], plan.arguments);
  give_up(report, false);
}

/// The child's error report; none once exec has succeeded.
Failure read_report(int report) {
  Failure failure;
  ssize_t count = 0;
  do {
    count = ::read(report, &failure, sizeof failure);
  } while (count < 0 && errno == EINTR);
  return count == sizeof failure ? failure : Failure();
}

}  // namespace

pid_t start_child(const std::vector<std::string>& arguments, const ProgramOptions& options,
                  int input) {
  std::vector<char*> argv;
  for (const std::string& argument : arguments) {
    argv.push_back(const_cast<char*>(argument.c_str()));
  }
  argv.push_back(nullptr);
  const auto fail = [&](const std::string& what, int error) {
    throw ProcessError(fmt::format("cannot {}: {}", what, std::strerror(error)));
  };
  const std::string run = "run " + arguments[0];
  std::array<int, 2> report = {-1, -1};
  if (::pipe2(report.data(), O_CLOEXEC) != 0) {
    fail(run, errno);
  }
  const Plan plan = {
      .arguments = argv.data(),
      .folder = options.folder.c_str(),
      .streams = {input, options.out != nullptr ? options.out->number() : STDOUT_FILENO,
                  options.err != nullptr ? options.err->number() : STDERR_FILENO},
      .parent = ::getpid(),
      .report = report[1]};
  const pid_t child = ::fork();
  const int error = errno;
  if (child == 0) {
    become(plan);
  }
  ::close(report[1]);
  const Failure failure = child > 0 ? read_report(report[0]) : Failure{.error = error};
  ::close(report[0]);
  if (failure.error != 0) {
    if (child > 0) {
      ::waitpid(child, nullptr, 0);
    }
    fail(failure.in_folder ? fmt::format("enter the folder {}", options.folder.string()) : run,
         failure.error);
  }
  return child;
}

}  // namespace clca::process
