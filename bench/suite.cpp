// How fast steps are, and how near to what the machine can do: all cases for all sizes, as tables.

#include <fmt/format.h>
#include <omp.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iterator>
#include <string>
#include <vector>

#include "clca/store/file.hpp"
#include "suite/cases.hpp"
#include "suite/contact.hpp"
#include "suite/machine.hpp"
#include "suite/measurement.hpp"
#include "suite/report.hpp"

namespace {

namespace bench = clca::bench;
namespace store = clca::store;

struct Wishes {
  std::vector<std::size_t> sizes = {540, 5'000, 54'000, 100'000, 1'000'000, 10'000'000};
  std::vector<std::string> cases;
  std::vector<std::string> models = {"automaton", "contact"};
  bench::Effort effort = {.threads = omp_get_num_procs(),
                          .seconds = 1,
                          .max_updates = 20'000'000'000,
                          .max_unsleeping = 60'000};
  std::uint64_t max_contact_updates = 500'000'000;
  std::size_t memory = 1024;  ///< MiB
  std::filesystem::path folder = "bench/results";
};

void add_options(CLI::App& app, Wishes& wishes) {
  std::vector<std::string> names;
  for (const bench::Case a_case : bench::kCases) {
    names.push_back(bench::name(a_case));
  }
  wishes.cases = names;
  app.option_defaults()->always_capture_default();
  app.add_option("--sizes", wishes.sizes, "Numbers of particles")
      ->delimiter(',')
      ->check(CLI::Range(std::size_t{100}, std::size_t{100'000'000}));
  app.add_option("--cases", wishes.cases, "Cases")->delimiter(',')->check(CLI::IsMember(names));
  app.add_option("--models", wishes.models, "Models; settling and collapse only of contact")
      ->delimiter(',')
      ->check(CLI::IsMember({"automaton", "contact"}));
  app.add_option("--threads", wishes.effort.threads, "1 to so many threads")
      ->check(CLI::Range(1, 1024));
  app.add_option("--seconds", wishes.effort.seconds,
                 "Seconds for each row, unless two runs take longer")
      ->check(CLI::PositiveNumber);
  app.add_option("--most-updates", wishes.effort.max_updates,
                 "Ends runs after so many particles x steps");
  app.add_option("--most-contact-updates", wishes.max_contact_updates,
                 "The same for the contact model");
  app.add_option("--memory", wishes.memory,
                 "Largest working set for the limits of the machine, MiB")
      ->check(CLI::Range(std::size_t{1}, std::size_t{65536}));
  app.add_option("-o,--output", wishes.folder, "Folder for the tables");
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

struct Measurements {
  std::vector<bench::Measurement> automaton = {};
  std::vector<bench::ContactMeasurement> contact = {};
};

void measure(const Wishes& wishes, bench::Case a_case, std::size_t particles, Measurements& all) {
  fmt::print(stderr, "suite: {}, {} particles\n", bench::name(a_case), particles);
  const auto state = bench::start(a_case, particles);
  if (contains(wishes.models, "automaton")) {
    auto some = bench::measure(a_case, state, wishes.effort);
    std::move(some.begin(), some.end(), std::back_inserter(all.automaton));
  }
  const bool comes_to_rest = a_case == bench::Case::settling || a_case == bench::Case::collapse;
  if (contains(wishes.models, "contact") && comes_to_rest) {
    auto some =
        bench::measure_contact(a_case, state, wishes.effort.seconds, wishes.max_contact_updates);
    std::move(some.begin(), some.end(), std::back_inserter(all.contact));
  }
}

Measurements measure_all(const Wishes& wishes) {
  Measurements all;
  for (const bench::Case a_case : bench::kCases) {
    if (!contains(wishes.cases, bench::name(a_case))) {
      continue;
    }
    for (const std::size_t particles : wishes.sizes) {
      measure(wishes, a_case, particles, all);
    }
  }
  return all;
}

void run(const Wishes& wishes) {
  store::make_folder(wishes.folder);
  fmt::print(stderr, "suite: limits of the machine\n");
  const bench::Machine machine(wishes.memory << 20U, wishes.effort.threads,
                               wishes.effort.seconds / 10);
  const auto [measurements, contact] = measure_all(wishes);
  const auto write = [&](const char* file, const store::Table& table) {
    store::write_whole_file(wishes.folder / file, table.to_csv());
  };
  write("machine.csv", machine.table());
  write("automaton.csv", bench::automaton_table(measurements));
  write("shares.csv", bench::share_table(measurements));
  write("limits.csv", bench::limit_table(measurements, machine));
  write("contact.csv", bench::contact_table(contact));
  fmt::print("{}, {} cores\n\n{}\n{}\n{}", bench::processor_name(), omp_get_num_procs(),
             bench::markdown(machine, wishes.effort.threads), bench::markdown(measurements),
             bench::markdown(contact));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    CLI::App app("Measures how fast steps are", "clca_suite");
    Wishes wishes;
    add_options(app, wishes);
    CLI11_PARSE(app, argc, argv);
    run(wishes);
    return 0;
  } catch (const std::exception& error) {
    std::fputs(("clca_suite: error: " + std::string(error.what()) + "\n").c_str(), stderr);
    return 1;
  }
}
