#include "plot/gnuplot.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <sstream>

#include "clca/plot/plot.hpp"

namespace clca::plot {

namespace {

namespace fs = std::filesystem;

/// The first file of that name on the PATH that may be run. Folders without a leading slash are
/// left out: what lies where one happens to work is not to be run.
fs::path find_gnuplot() {
  const char* path = std::getenv("PATH");  // NOLINT(concurrency-mt-unsafe): nobody sets it
  std::stringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    fs::path file = fs::path(folder) / "gnuplot";
    if (file.is_absolute() && !fs::is_directory(file) && ::access(file.c_str(), X_OK) == 0) {
      return file;
    }
  }
  throw PlotError("gnuplot not found; install gnuplot-nox (Debian) or put gnuplot on the PATH");
}

/// A file without a name, gone when it is closed.
class Aside {
 public:
  Aside() : file_(std::tmpfile(), &std::fclose) {
    if (!file_) {
      throw PlotError(fmt::format("cannot make a temporary file: {}", std::strerror(errno)));
    }
  }
  int number() const { return ::fileno(file_.get()); }
  std::vector<std::uint8_t> bytes() const {
    std::rewind(file_.get());
    std::vector<std::uint8_t> all;
    std::vector<std::uint8_t> block(1U << 16U);
    while (const std::size_t count = std::fread(block.data(), 1, block.size(), file_.get())) {
      all.insert(all.end(), block.begin(), block.begin() + static_cast<std::ptrdiff_t>(count));
    }
    return all;
  }

 private:
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

/// What a child process starts with other than what it inherits.
class Actions {
 public:
  Actions(const fs::path& folder, const Aside& out, const Aside& err) {
    ::posix_spawn_file_actions_init(&actions_);
    ::posix_spawn_file_actions_adddup2(&actions_, out.number(), STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions_, err.number(), STDERR_FILENO);
    // Last: where this program has no standard input, `out` is 0 itself.
    ::posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str());
  }
  ~Actions() { ::posix_spawn_file_actions_destroy(&actions_); }
  Actions(const Actions&) = delete;
  Actions& operator=(const Actions&) = delete;
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

/// Exit code, or 128 and the number of a signal.
int run(const std::vector<std::string>& arguments, const Actions& actions) {
  std::vector<char*> argv;
  for (const std::string& argument : arguments) {
    argv.push_back(const_cast<char*>(argument.c_str()));
  }
  argv.push_back(nullptr);
  pid_t child = 0;
  const int error = ::posix_spawn(&child, argv[0], actions.get(), nullptr, argv.data(), environ);
  if (error != 0) {
    throw PlotError(fmt::format("cannot run {}: {}", arguments[0], std::strerror(error)));
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  constexpr int kSignalBase = 128;
  return WIFEXITED(status) ? WEXITSTATUS(status) : kSignalBase + WTERMSIG(status);
}

/// gnuplot shows the command, a mark below it, and then `"FILE" line N: what is wrong`.
std::string first_complaint(const std::vector<std::uint8_t>& bytes) {
  std::stringstream text(std::string(bytes.begin(), bytes.end()));
  std::string first;
  for (std::string line; std::getline(text, line);) {
    if (line.find("line ") != std::string::npos && line.find(": ") != std::string::npos &&
        line.find("warning:") == std::string::npos) {
      return line;
    }
    if (first.empty()) {
      first = line;
    }
  }
  return first;
}

}  // namespace

std::string literal(std::string_view text) {
  std::string result = "'";
  for (const char letter : text) {
    const bool is_control = static_cast<unsigned char>(letter) < ' ';
    result += letter == '\'' ? "''" : std::string(1, is_control ? ' ' : letter);
  }
  return result + '\'';
}

std::vector<std::uint8_t> gnuplot(const fs::path& folder, const std::string& commands,
                                  const std::vector<fs::path>& scripts) {
  // -d: no settings of the user, so that the same tables give the same picture.
  std::vector<std::string> arguments = {find_gnuplot().string(), "-d", "-e", commands};
  for (const fs::path& script : scripts) {
    arguments.push_back(fs::absolute(script).string());
  }
  const Aside out;
  const Aside err;
  const int code = run(arguments, Actions(folder, out, err));
  if (code != 0) {
    throw PlotError(
        fmt::format("gnuplot fails with exit code {}: {}", code, first_complaint(err.bytes())));
  }
  return out.bytes();
}

}  // namespace clca::plot
