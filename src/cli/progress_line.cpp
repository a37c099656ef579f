#include "cli/progress_line.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "clca/text/message.hpp"
#include "cli/terminal.hpp"

namespace clca::cli {

namespace {

constexpr std::chrono::seconds kPlainInterval(10);

/// "12 s", "3 min 20 s", "5 h 10 min".
std::string duration(double seconds) {
  constexpr double kMaxRate = 1e9;
  const auto whole = static_cast<long long>(std::ceil(std::min(seconds, kMaxRate)));
  if (whole < 60) {
    return fmt::format("{} s", whole);
  }
  if (whole < 3600) {
    return fmt::format("{} min {} s", whole / 60, whole % 60);
  }
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

std::string left_text(const std::optional<double>& seconds) {
  return seconds ? fmt::format(", about {} left", duration(*seconds)) : "";
}

/// The time left is that of the stage: nobody knows how long the later ones take.
template <class Progress>
std::string left_text_of_stage(const Progress& progress) {
  const bool is_last = progress.stage_number == progress.stage_count;
  return left_text(progress.seconds_left) +
         (progress.seconds_left && !is_last ? " of this stage" : "");
}

/// Characters in a line of the terminal; 80 if it does not say.
std::size_t terminal_width() {
  winsize size = {};
  const bool known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : 80;
}

}  // namespace

// The time left stands before what a narrow terminal has no room for.
std::string to_text(const run::Progress& progress) {
  return fmt::format("{} ({}/{}): step {}{}{}, {:.1f} % moving, {:.1f} million updates/s",
                     progress.stage, progress.stage_number, progress.stage_count, progress.step,
                     progress.ends_at_rest ? ", not at rest yet" : left_text_of_stage(progress),
                     progress.time_text.empty() ? "" : ", t = " + progress.time_text,
                     100 * progress.moving_share, progress.particle_updates_per_second / 1e6);
}

std::string to_text(const run::GasProgress& progress) {
  return fmt::format("{} ({}/{}): gas {} of {}{}, time {:.4g} of {}, {:.3g} million collisions/s",
                     progress.stage, progress.stage_number, progress.stage_count,
                     std::min(progress.done_gases + 1, progress.gas_count), progress.gas_count,
                     left_text_of_stage(progress), progress.time, progress.end_time,
                     progress.collisions_per_second / 1e6);
}

std::string to_text(const drawing::RedrawProgress& progress) {
  return fmt::format("{} of {} pictures{}", progress.drawn_pictures, progress.total_pictures,
                     left_text(progress.seconds_left));
}

std::string to_text(const sweep::Progress& progress) {
  std::string text =
      fmt::format("{} of {} runs, {} failed, {:.3g} runs/s{}",
                  progress.done_runs + progress.failed_runs, progress.total_runs,
                  progress.failed_runs, progress.runs_per_second, left_text(progress.seconds_left));
  for (const sweep::RunUnderWay& run : progress.running) {
    text += fmt::format("; {}: {} ({}/{}), step {}, {:.1f} % moving", run.name, run.progress.stage,
                        run.progress.stage_number, run.progress.stage_count, run.progress.step,
                        100 * run.progress.moving_share);
  }
  return text;
}

ProgressLine::ProgressLine()
    : terminal_(::isatty(STDERR_FILENO) != 0),
      next_plain_(std::chrono::steady_clock::now() + kPlainInterval) {}

void ProgressLine::show(const std::string& text) {
  if (terminal_) {
    // The last column stays free: some terminals go on to the next line after it.
    print_error("\r{}\033[K", text::first_characters(text, terminal_width() - 1));
    line_shown_ = true;
  } else if (std::chrono::steady_clock::now() >= next_plain_) {
    next_plain_ = std::chrono::steady_clock::now() + kPlainInterval;
    print_error("{}\n", text);
  }
}

void ProgressLine::print(const std::string& line) {
  clear();
  print_error("{}\n", line);
}

void ProgressLine::clear() {
  if (std::exchange(line_shown_, false)) {
    write_error("\r\033[K");
  }
}

}  // namespace clca::cli
