#include "contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <utility>

#include "clca/contact/contact_model.hpp"

namespace clca::bench {

namespace {

using contact::ContactModel;

constexpr std::size_t kMinContactRuns = 2;
constexpr std::uint64_t kMinContactSteps = 100;
constexpr std::array kContactSettings = {ContactSetting::defaults, ContactSetting::preview};

std::string name(ContactSetting setting) {
  return setting == ContactSetting::defaults ? "defaults" : "preview";
}

/// Of this thread. Other work on the machine adds little to it.
double processor_seconds() {
  timespec now = {};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Of the bed packed to 0.8; in a collapse it is as wide as high.
double bed_height(Case a_case, const grains::State& state) {
  double area = 0;
  for (const grains::Particle& particle : state.particles) {
    area += static_cast<double>(state.shape(particle).size()) * lattice::kColumnPitch;
  }
  area /= 0.8;
  return a_case == Case::collapse ? std::sqrt(area)
                                  : area / (state.lattice.columns() * lattice::kColumnPitch);
}

ContactModel model_of(Case a_case, const grains::State& start, ContactSetting setting) {
  contact::Parameters parameters = {.fall_height = bed_height(a_case, start)};
  if (setting == ContactSetting::preview) {
    parameters.resolution = 0.8;
    parameters.restitution = 0;
  }
  contact::State state = {.grains = start};
  state.velocities.resize(start.particles.size());
  state.remainders.resize(start.particles.size());
  return {std::move(state), parameters};
}

/// Adds one run to the measurement.
void run(const grains::State& start, std::uint64_t most_steps, ContactMeasurement& one) {
  ContactModel model = model_of(one.a_case, start, one.setting);
  one.steps = 0;
  one.moved = 0;
  one.at_rest = false;
  if (one.a_case == Case::collapse) {
    model.remove_wall(0);
  }
  const double begin = processor_seconds();
  while (one.steps < most_steps && !one.at_rest) {
    const grains::StepReport report = model.step();
    ++one.steps;
    one.moved += report.moved_count;
    one.at_rest = report.settled;
  }
  one.seconds.push_back((processor_seconds() - begin) / static_cast<double>(one.steps));
}

double nanoseconds(const ContactMeasurement& one, double seconds_a_step) {
  return 1e9 * seconds_a_step / static_cast<double>(one.particles);
}

double median(const ContactMeasurement& one) {
  const std::size_t half = one.seconds.size() / 2;
  return one.seconds.size() % 2 == 1 ? one.seconds[half]
                                     : (one.seconds[half - 1] + one.seconds[half]) / 2;
}

}  // namespace

std::vector<ContactMeasurement> measure_contact(Case a_case, const grains::State& start,
                                                double seconds, std::uint64_t max_updates) {
  const std::uint64_t most_steps = std::max(kMinContactSteps, max_updates / start.particles.size());
  std::vector<ContactMeasurement> all;
  for (const ContactSetting setting : kContactSettings) {
    ContactMeasurement one = {
        .a_case = a_case, .setting = setting, .particles = start.particles.size()};
    const double begin = processor_seconds();
    while (one.seconds.size() < kMinContactRuns || processor_seconds() - begin < seconds) {
      run(start, most_steps, one);
    }
    std::sort(one.seconds.begin(), one.seconds.end());
    all.push_back(std::move(one));
  }
  return all;
}

store::Table contact_table(const std::vector<ContactMeasurement>& measurements) {
  store::Table table({"case", "particles", "setting", "steps", "at_rest", "moved", "runs",
                      "ns_per_grain_step_best", "ns_per_grain_step_median",
                      "ns_per_grain_step_worst"});
  for (const ContactMeasurement& one : measurements) {
    table.add_row({name(one.a_case), std::uint64_t{one.particles}, name(one.setting), one.steps,
                   std::uint64_t{one.at_rest ? 1U : 0U}, one.moved,
                   std::uint64_t{one.seconds.size()}, nanoseconds(one, one.seconds.front()),
                   nanoseconds(one, median(one)), nanoseconds(one, one.seconds.back())});
  }
  return table;
}

std::string markdown(const std::vector<ContactMeasurement>& measurements) {
  std::string text =
      "| contact model | grains | setting | steps | at rest | ns a grain and step (median, worst) "
      "|\n"
      "|---|---|---|---|---|---|\n";
  for (const ContactMeasurement& one : measurements) {
    text += fmt::format("| {} | {} | {} | {} | {} | {:.1f} ({:.1f}, {:.1f}) |\n", name(one.a_case),
                        one.particles, name(one.setting), one.steps, one.at_rest ? "yes" : "no",
                        nanoseconds(one, one.seconds.front()), nanoseconds(one, median(one)),
                        nanoseconds(one, one.seconds.back()));
  }
  return text;
}

}  // namespace clca::bench
