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

/// What the child does before it is another program, prepared: between fork and exec there may be
/// no allocation.
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

/// Calls only functions that are safe in a signal handler, since other threads may have held locks.
[[noreturn]] void become(const Plan& plan) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != plan.parent) {
    ::_exit(127);  // too late for that signal
  }
  ::setpgid(0, 0);  // signals from the terminal are for the parent
  ::signal(SIGPIPE, SIG_DFL);
  // Out of the way first: one of them may have the number of another's place.
  const int report = ::fcntl(plan.report, F_DUPFD_CLOEXEC, 3);
  std::array<int, 3> streams = plan.streams;
  for (int& stream : streams) {
    stream = ::fcntl(stream, F_DUPFD_CLOEXEC, 3);
  }
  for (int place = 0; place < 3; ++place) {
    if (const int stream = streams[static_cast<std::size_t>(place)]; stream >= 0) {
      ::dup2(stream, place);
    }
  }
  ::close_range(3, ~0U, CLOSE_RANGE_CLOEXEC);
  if (::chdir(plan.folder) != 0) {
    give_up(report, true);
  }
  ::execv(plan.arguments[0], plan.arguments);
  give_up(report, false);
}

/// What the child reports; nothing once it is another program.
Failure read_report(int report) {
  Failure failure;
  ssize_t count = 0;
  do {
    count = ::read(report, &failure, sizeof failure);
  } while (count < 0 && errno == EINTR);
  return count == sizeof failure ? failure : Failure();
}

}  // namespace

pid_t start_child(const std::vector<std::string>& arguments, const Setting& setting, int input) {
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
      .folder = setting.folder.c_str(),
      .streams = {input, setting.out != nullptr ? setting.out->number() : STDOUT_FILENO,
                  setting.err != nullptr ? setting.err->number() : STDERR_FILENO},
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
    fail(failure.in_folder ? fmt::format("enter the folder {}", setting.folder.string()) : run,
         failure.error);
  }
  return child;
}

}  // namespace clca::process
