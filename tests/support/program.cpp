#include "support/program.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <sstream>
#include <thread>

#include "support/runs.hpp"

namespace clca::testing {

namespace {

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

void redirect(int descriptor, const std::filesystem::path& file) {
  const int opened = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  ::dup2(opened, descriptor);
  ::close(opened);
}

/// Until the file has the text or the child has ended; false if neither happens within kLimit.
bool wait_for_text(const std::filesystem::path& file, const std::string& text, pid_t child) {
  constexpr std::chrono::minutes kLimit(2);
  const auto start = std::chrono::steady_clock::now();
  siginfo_t ended = {};
  while (text_of(file).find(text) == std::string::npos &&
         ::waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         ended.si_pid == 0) {
    if (std::chrono::steady_clock::now() - start > kLimit) {
      return false;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

}  // namespace

ProgramResult run_program(const std::vector<std::string>& arguments,
                          const ProgramSetting& setting) {
  const ScratchFolder scratch;
  const std::filesystem::path out = scratch.path() / "out";
  const std::filesystem::path err = scratch.path() / "err";
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGHUP, SIG_DFL);  // also where the tests run under nohup
    redirect(STDOUT_FILENO, out);
    redirect(STDERR_FILENO, err);
    for (const auto& [name, value] : setting.environment) {
      ::setenv(name.c_str(), value.c_str(), 1);
    }
    if (setting.file_size_limit > 0) {
      const rlimit limit = {setting.file_size_limit, setting.file_size_limit};
      ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    if (setting.memory_limit > 0) {
      const rlimit limit = {setting.memory_limit, setting.memory_limit};
      ::setrlimit(RLIMIT_AS, &limit);
    }
    std::vector<char*> argv = {const_cast<char*>("clca")};
    for (const std::string& argument : arguments) {
      argv.push_back(const_cast<char*>(argument.c_str()));
    }
    argv.push_back(nullptr);
    if (::chdir(setting.folder.c_str()) == 0) {
      ::execv(setting.program.empty() ? CLCA_PROGRAM : setting.program.c_str(), argv.data());
    }
    ::_exit(127);
  }
  if (setting.signal_after > 0) {
    std::this_thread::sleep_for(std::chrono::duration<double>(setting.signal_after));
    ::kill(child, setting.signal);
  } else if (!setting.once.empty()) {
    const bool there = wait_for_text(std::filesystem::path(setting.folder) / setting.once,
                                     setting.once_has, child);
    EXPECT_TRUE(there) << setting.once << " has not come to have " << setting.once_has;
    ::kill(child, there ? setting.signal : SIGKILL);
  }
  int status = 0;
  rusage usage = {};
  ::wait4(child, &status, 0, &usage);
  return {.code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status),
          .out = text_of(out),
          .err = text_of(err),
          .max_bytes = 1024.0 * static_cast<double>(usage.ru_maxrss)};
}

}  // namespace clca::testing
