#include "report.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string_view>
#include <utility>

namespace clca::bench {

namespace {

using store::Cell;

constexpr double kNano = 1e-9;

std::string_view name(automaton::TieBreaking ties) {
  return ties == automaton::TieBreaking::particle ? "particle" : "direction";
}

std::vector<std::string> with_key(const std::vector<std::string>& further) {
  std::vector<std::string> columns = {"case", "particles", "threads", "ties", "sleeping"};
  columns.insert(columns.end(), further.begin(), further.end());
  return columns;
}

std::vector<Cell> with_key(const Measurement& one, const std::vector<Cell>& further) {
  std::vector<Cell> cells = {name(one.a_case), std::uint64_t{one.particles},
                             static_cast<std::uint64_t>(one.variant.threads),
                             std::string(name(one.variant.ties)),
                             std::uint64_t{one.variant.sleeping ? 1U : 0U}};
  cells.insert(cells.end(), further.begin(), further.end());
  return cells;
}

/// What follows from a piece of work on so many particles.
struct Rates {
  Rates(const Work& work, std::size_t particles)
      : effective(static_cast<double>(particles) * static_cast<double>(work.steps) / work.seconds),
        moving_share(static_cast<double>(work.moved) /
                     (static_cast<double>(particles) * static_cast<double>(work.steps))),
        seconds_per_move(work.moved > 0 ? work.seconds / static_cast<double>(work.moved) : NAN) {}

  double effective;  // particle-updates per second
  double moving_share;
  double seconds_per_move;
};

/// What the moves of a run have to touch, and how long the machine needs for that.
struct Limits {
  double lines = 0;
  double copy_seconds = 0;  ///< to read and write each line once
  double wait_seconds = 0;  ///< when each line is waited for on its own, threads side by side
};

/// From the samples.
Limits limits(const Measurement& one, const Machine& machine) {
  Limits result;
  double moved = 0;
  for (const Sample& sample : one.samples) {
    const auto lines = static_cast<double>(sample.lines);
    const double bytes = lines * static_cast<double>(kLine);
    moved += static_cast<double>(sample.moved);
    result.lines += lines;
    result.copy_seconds += 2 * bytes / machine.copy_rate(bytes, one.variant.threads);
    result.wait_seconds += lines * machine.latency(bytes) / one.variant.threads;
  }
  const double scale = static_cast<double>(one.work().moved) / moved;
  return {.lines = result.lines * scale,
          .copy_seconds = result.copy_seconds * scale,
          .wait_seconds = result.wait_seconds * scale};
}

}  // namespace

store::Table automaton_table(const std::vector<Measurement>& measurements) {
  store::Table table(
      with_key({"steps", "at_rest", "runs", "step_s_best", "step_s_median", "step_s_worst", "moved",
                "moving_share", "effective_per_s", "ns_per_move", "speedup"}));
  for (const Measurement& one : measurements) {
    const Work& work = one.work();
    const Rates rates(work, one.particles);
    const Run& run = one.runs.front();
    table.add_row(with_key(
        one, {work.steps, std::uint64_t{run.at_rest ? 1U : 0U}, std::uint64_t{one.runs.size()},
              one.best(), one.median(), one.worst(), work.moved, rates.moving_share,
              rates.effective, rates.seconds_per_move / kNano, one.speedup}));
  }
  return table;
}

store::Table share_table(const std::vector<Measurement>& measurements) {
  store::Table table(
      with_key({"moving_share", "steps", "moved", "step_s", "effective_per_s", "ns_per_move"}));
  for (const Measurement& one : measurements) {
    for (std::size_t bin = 0; bin < kShareBins; ++bin) {
      Work work = one.runs.front().by_share[bin];
      if (work.steps == 0) {
        continue;
      }
      for (const Run& run : one.runs) {
        work.seconds = std::min(work.seconds, run.by_share[bin].seconds);
      }
      const Rates rates(work, one.particles);
      table.add_row(with_key(one, {rates.moving_share, work.steps, work.moved,
                                   work.seconds / static_cast<double>(work.steps), rates.effective,
                                   rates.seconds_per_move / kNano}));
    }
  }
  return table;
}

store::Table limit_table(const std::vector<Measurement>& measurements, const Machine& machine) {
  store::Table table(with_key(
      {"steps", "moved", "run_s", "run_bytes", "copy_s", "wait_s", "near_copy", "near_wait"}));
  for (const Measurement& one : measurements) {
    if (one.samples.empty()) {
      continue;
    }
    const Work& work = one.work();
    const Limits least = limits(one, machine);
    table.add_row(with_key(
        one, {work.steps, work.moved, work.seconds, 2 * least.lines * static_cast<double>(kLine),
              least.copy_seconds, least.wait_seconds, least.copy_seconds / work.seconds,
              least.wait_seconds / work.seconds}));
  }
  return table;
}

std::string markdown(const std::vector<Measurement>& measurements) {
  std::string text =
      "| case | particles | threads | ties | sleeping | steps | at rest | moving | ms a step "
      "(median, worst) | updates/s | ns a move | against 1 thread |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const Measurement& one : measurements) {
    const Work& work = one.work();
    const Rates rates(work, one.particles);
    const std::string cost =
        work.moved > 0 ? fmt::format("{:.1f}", rates.seconds_per_move / kNano) : "";
    text += fmt::format(
        "| {} | {} | {} | {} | {} | {} | {} | {:.2g} | {:.4g} ({:.3g}, {:.3g}) | {:.3g} | "
        "{} | {:.2f} |\n",
        name(one.a_case), one.particles, one.variant.threads, name(one.variant.ties),
        one.variant.sleeping ? "on" : "off", work.steps, one.runs.front().at_rest ? "yes" : "no",
        rates.moving_share, 1e3 * one.best(), 1e3 * one.median(), 1e3 * one.worst(),
        rates.effective, cost, one.speedup);
  }
  return text;
}

std::string markdown(const Machine& machine, int threads) {
  std::string text = "| working set | dependent load, ns |";
  std::string rule = "|---|---|";
  for (int team = 1; team <= threads; ++team) {
    text += fmt::format(" copy, GB/s, {} thread{} |", team, team == 1 ? "" : "s");
    rule += "---|";
  }
  text += "\n" + rule + "\n";
  for (const std::size_t bytes : machine.working_sets()) {
    const auto set = static_cast<double>(bytes);
    text += fmt::format("| {} KiB | {:.1f} |", bytes >> 10U, machine.latency(set) / kNano);
    for (int team = 1; team <= threads; ++team) {
      text += fmt::format(" {:.1f} |", machine.copy_rate(set, team) * kNano);
    }
    text += "\n";
  }
  return text;
}

}  // namespace clca::bench
