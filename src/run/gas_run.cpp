// Runs a scene of the Boltzmann equation: an ensemble of gases for each restitution.

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <mutex>
#include <numeric>
#include <optional>
#include <thread>
#include <utility>

#include "clca/parallel/team.hpp"
#include "clca/random/word_hash.hpp"
#include "clca/run/run.hpp"
#include "clca/scene/parse.hpp"
#include "clca/tasks/pool.hpp"
#include "record/internal/meter.hpp"
#include "run/run_base.hpp"
#include "run/saved.hpp"

namespace clca::run {

namespace {

constexpr double kMinSeconds = 1e-9;
constexpr double kAnySize = std::numeric_limits<double>::infinity();

struct GasShare {
  double restitution = 1;
  /// Numbers of the members that have not begun: each rank takes the next one when it is free.
  std::vector<std::size_t> shared = {};
  /// Members that have begun in an earlier process, by number: for this rank alone.
  std::map<std::size_t, model::GasMember> begun = {};

  CLCA_FIELDS(restitution, shared, begun);
};

template <class T>
tasks::Bytes message_bytes(const T& value, const std::string& scene) {
  return store::checkpoint_bytes({.kind = "gas",
                                  .scene_name = "",
                                  .scene_text = scene,
                                  .summary_json = "",
                                  .fields = reflection::encode(value)});
}

/// Gases at a time in a process, and threads of each.
struct GasThreads {
  GasThreads(int threads, std::uint64_t ensemble, int ranks)
      : gases(std::min<std::uint64_t>(static_cast<std::uint64_t>(threads),
                                      1 + (ensemble - 1) / static_cast<std::uint64_t>(ranks))),
        per_gas(std::max(1, threads / static_cast<int>(gases))) {}

  std::size_t gases;
  int per_gas;
};

std::string case_name(double restitution) {
  return fmt::format("restitution-{}", restitution);
}

struct MemberProgress {
  std::atomic<double> time = 0;                   ///< while this process advances it, else 0
  std::atomic<std::uint64_t> participations = 0;  ///< so far, of any process
};

class GasRun : public RunBase {
 public:
  GasRun(const scene::BoltzmannScene& scene, const RunOptions& options, const RunEvents& events,
         std::optional<store::RunFolder> folder = {}, SavedGasRun course = {})
      : RunBase({.kind = "boltzmann",
                 .scene = scene.name,
                 .title = scene.title,
                 .seed = scene.seed,
                 .scene_text = scene::to_yaml(scene),
                 .checkpoint_intervals = scene.checkpoint},
                with_threads(options, parallel::startable_threads(options.threads), events),
                events),
        scene_(scene),
        ranks_(options.ranks != nullptr ? *options.ranks : alone_),
        threads_(RunBase::options().threads, scene.ensemble_size, ranks_.size()),
        integrator_(scene),
        course_(std::move(course)),
        cases_logged_(std::exchange(course_.cases_ended, 0)) {
    if (course_.cases.empty()) {
      begin(std::move(folder), checkpoint_without_fields());
    } else {
      go_on(*std::move(folder), course_.log_bytes, course_.wall_seconds);
    }
  }

 private:
  void carry_out() override;
  void complete_summary(store::RunSummary& summary) const override;
  void run_cases();
  void run_case(record::GasCase& gas_case);
  std::vector<GasShare> shares_of(const record::GasCase& gas_case) const;
  tasks::Pool<bool>::Work work(record::GasCase& gas_case);
  /// Asks all gases of this process to stop for a checkpoint if that is due.
  void check_if_save_is_due();
  void show_progress(double restitution);
  void finish_case(const record::GasCase& gas_case);
  void save_course();  ///< writes a checkpoint; no gas may change meanwhile
  void warn_of_long_step();
  bool is_done(const model::GasMember& member) const {
    return member.observations.size() == integrator_.times().size();
  }
  bool has_all_observations(const record::GasCase& gas_case) const {
    return gas_case.members_with(integrator_.times().size() - 1).size() == gas_case.members.size();
  }
  /// How often a particle has collided so far, summed over all gases.
  std::uint64_t participations() const {
    return std::transform_reduce(
        progress_.begin(), progress_.end(), participations_before_, std::plus(),
        [](const MemberProgress& gas) { return gas.participations.load(); });
  }
  /// Collisions so far: one of the literal scheme changes one particle, others change both.
  double collisions() const {
    const double changed = std::holds_alternative<boltzmann::Majorant>(scene_.scheme) ? 2 : 1;
    return static_cast<double>(participations()) / changed;
  }

  const scene::BoltzmannScene& scene_;
  tasks::OneRank alone_;  // for ranks_, where none are given
  tasks::Ranks& ranks_;
  GasThreads threads_;
  model::GasIntegrator integrator_;
  SavedGasRun course_;
  std::uint64_t cases_logged_;               // by the lines of log.txt that were there
  std::uint64_t participations_before_ = 0;  // of the cases before
  std::uint64_t done_gases_ = 0;
  std::vector<MemberProgress> progress_;    // one for each member of a case
  std::mutex checkpoint_mutex_;             // of checkpoint_due_by_clock()
  std::atomic<bool> is_save_due_ = false;   // a checkpoint is written once no gas is advanced here
  std::atomic<int> startable_threads_ = 1;  // of each gas
  std::thread::id thread_ = std::this_thread::get_id();  // that made this object
  record::TimeEstimate forecast_;
  std::uint64_t steps_ = 0;
  random::WordHash hash_;  // of the state hashes of all gases
};

void GasRun::carry_out() {
  if (log_bytes() == 0) {
    warn_of_long_step();
  }
  if (ranks_.size() > 1) {
    ranks_.begin(store::version());
  }
  const bool is_inline = threads_.gases == 1 && ranks_.size() == 1;  // gases advance in this thread
  startable_threads_ = is_inline ? parallel::start_team(threads_.per_gas) : threads_.per_gas;
  run_cases();
}

void GasRun::warn_of_long_step() {
  const auto* literal = std::get_if<boltzmann::OgawaKato>(&scene_.scheme);
  if (literal == nullptr || literal->time_step <= boltzmann::OgawaKato().time_step) {
    return;
  }
  constexpr double kPercent = 100;
  const double heat = kPercent * boltzmann::expected_heating(*literal, scene_.end_time);
  const std::string bias = std::isfinite(heat) ? fmt::format("by {:.0f} %", heat) : "without bound";
  warning(
      fmt::format("{}: a time step of {} is too long for the scheme ogawa-kato, whose bias "
                  "grows with it: elastic spheres heat {} until time {}; 0.025 or less is "
                  "what it was made for",
                  scene_.location, literal->time_step, bias, scene_.end_time));
}

void GasRun::run_cases() {
  course_.cases.reserve(scene_.restitutions.size());
  for (std::size_t i = 0; i < scene_.restitutions.size() && is_complete(); ++i) {
    if (i == course_.cases.size()) {
      course_.cases.push_back({.restitution = scene_.restitutions[i],
                               .members = std::vector<model::GasMember>(scene_.ensemble_size)});
    }
    record::GasCase& gas_case = course_.cases[i];
    run_case(gas_case);
    if (!has_all_observations(gas_case)) {
      mark_interrupted();
    }
    const bool last = i + 1 == scene_.restitutions.size();
    if (!is_complete() || (last && scene_.checkpoint)) {
      save_course();
    }
    finish_case(gas_case);
    record::write_gas_tables(scene_, course_.cases, folder().output_folder());
  }
}

void GasRun::run_case(record::GasCase& gas_case) {
  done_gases_ = 0;
  tell(fmt::format("restitution {}: {} gases of {} particles", gas_case.restitution,
                   gas_case.members.size(), scene_.particles));
  participations_before_ = participations();
  progress_ = std::vector<MemberProgress>(gas_case.members.size());
  for (std::size_t number = 0; number < gas_case.members.size(); ++number) {
    done_gases_ += is_done(gas_case.members[number]) ? 1 : 0;
    progress_[number].participations = gas_case.members[number].participations;
  }
  forecast_ = record::TimeEstimate();
  const std::vector<GasShare> shares = shares_of(gas_case);
  ranks_.hand_out_work([&](int rank) {
    return message_bytes(shares[static_cast<std::size_t>(rank)], scene::to_yaml(scene_));
  });
  tasks::Pool<bool> pool(threads_.gases, ranks_, shares[0].shared, work(gas_case),
                         options().stop_signal, true);
  for (const auto& [number, _] : shares[0].begun) {
    pool.add(number);
  }
  constexpr std::chrono::milliseconds kPause(100);
  if (stop_is_requested()) {
    pool.stop();
  }
  while (!pool.finished()) {
    for (const auto& [number, is_done] : pool.take_finished(kPause)) {
      done_gases_ += is_done ? 1 : 0;
      if (!is_done) {
        pool.add(number);
      }
    }
    if (stop_is_requested()) {
      pool.stop();
    }
    check_if_save_is_due();
    if (is_save_due_ && pool.is_idle()) {
      save_course();
      is_save_due_ = false;
    }
    pool.allow_starts(!is_save_due_);
    if (progress_due()) {
      show_progress(gas_case.restitution);
    }
  }
}

/// By rank; that of rank 0 has no copies of members, which it has itself.
std::vector<GasShare> GasRun::shares_of(const record::GasCase& gas_case) const {
  std::vector<GasShare> shares(static_cast<std::size_t>(ranks_.size()),
                               {.restitution = gas_case.restitution});
  std::size_t begun = 0;
  for (std::size_t number = 0; number < gas_case.members.size(); ++number) {
    const model::GasMember& member = gas_case.members[number];
    if (member.gas) {
      const std::size_t rank = begun++ % shares.size();
      shares[rank].begun.emplace(number, rank == 0 ? model::GasMember() : member);
    } else if (!is_done(member)) {
      for (GasShare& share : shares) {
        share.shared.push_back(number);
      }
    }
  }
  return shares;
}

tasks::Pool<bool>::Work GasRun::work(record::GasCase& gas_case) {
  const auto end = [this, &gas_case](std::size_t number, model::GasMember member) {
    progress_[number].participations = member.participations;
    gas_case.members[number] = std::move(member);
    return is_done(gas_case.members[number]);
  };
  const auto advance = [this, &gas_case, end](std::size_t number, const std::atomic<int>& stop) {
    model::GasMember member = std::exchange(gas_case.members[number], {});
    MemberProgress& progress = progress_[number];
    std::uint64_t step = member.gas ? member.gas->step : 0;
    const auto keep_going = [&](const model::GasMember& now) {
      if (now.gas->step != std::exchange(step, now.gas->step)) {
        check_if_save_is_due();  // so there is a step between two of them
      }
      progress.time = now.gas->time;
      progress.participations = now.gas->participations;
      if (std::this_thread::get_id() == thread_ &&
          progress_due()) {  // in the thread that called run()
        show_progress(gas_case.restitution);
      }
      return stop == 0 && !stop_is_requested() && !is_save_due_;
    };
    integrator_.integrate(member, gas_case.restitution, boltzmann::member_seed(scene_.seed, number),
                          startable_threads_, keep_going);
    if (is_done(member)) {
      progress.time = 0;
    }
    return end(number, std::move(member));
  };
  return {.carry_out = advance,
          .result =
              [end](std::size_t number, const tasks::Bytes& answer) {
                model::GasMember member;
                reflection::decode(store::parse_checkpoint(answer, kAnySize).fields, kAnySize,
                                   member);
                return end(number, std::move(member));
              },
          .begin = [this] {  // while there is memory for it
            const int had = parallel::start_team(threads_.per_gas);
            int least = startable_threads_;
            while (had < least && !startable_threads_.compare_exchange_weak(least, had)) {
            }
          }};
}

void GasRun::check_if_save_is_due() {
  const std::unique_lock lock(checkpoint_mutex_, std::try_to_lock);
  if (lock && !is_save_due_) {  // else a step later will do
    is_save_due_ = checkpoint_due_by_clock();
  }
}

void GasRun::show_progress(double restitution) {
  if (!events().gas_progress) {
    return;
  }
  double sum = 0;
  double latest = 0;
  for (const MemberProgress& gas : progress_) {
    const double time = gas.time;
    sum += time;
    latest = std::max(latest, time);
  }
  const auto gases = static_cast<double>(scene_.ensemble_size);
  forecast_.update((static_cast<double>(done_gases_) + sum / scene_.end_time) / gases);
  events().gas_progress({.stage = case_name(restitution),
                         .stage_number = course_.cases_ended + 1,
                         .stage_count = scene_.restitutions.size(),
                         .time = latest,
                         .end_time = scene_.end_time,
                         .done_gases = done_gases_,
                         .gas_count = scene_.ensemble_size,
                         .collisions_per_second = collisions() / wall_seconds(),
                         .seconds_left = forecast_.seconds_left()});
}

void GasRun::finish_case(const record::GasCase& gas_case) {
  std::uint64_t steps = 0;
  for (const model::GasMember& member : gas_case.members) {
    steps += member.steps;
    hash_.add(member.hash);
  }
  steps_ += steps;
  const std::string ended = is_complete() ? "time" : "interrupted";
  stage_summaries().push_back({.name = case_name(gas_case.restitution),
                               .steps = steps,
                               .end_reason = ended,
                               .measures = record::gas_measures(scene_, gas_case)});
  if (++course_.cases_ended > cases_logged_) {
    info(fmt::format("restitution {}: {} gases of {} particles, {} steps, ended: {}",
                     gas_case.restitution, gas_case.members.size(), scene_.particles, steps,
                     ended));
  }
}

void GasRun::save_course() {
  course_.wall_seconds = wall_seconds();
  course_.log_bytes = log_bytes();
  store::Checkpoint saved = checkpoint_without_fields();
  reflection::encode(kGasesPath, course_, saved.fields);
  save(std::move(saved));
}

void GasRun::complete_summary(store::RunSummary& summary) const {
  summary.ranks = ranks_.size();
  summary.particles = scene_.particles * scene_.ensemble_size;
  summary.steps = steps_;
  summary.table_descriptions = record::gas_table_summaries(scene_);
  summary.step_seconds = summary.wall_seconds;
  summary.rate_per_second = collisions() / std::max(summary.wall_seconds, kMinSeconds);
  summary.state_hash = hash_.value();
}

/// On a rank that is not rank 0.
void advance(GasShare share, const scene::BoltzmannScene& scene, const RunOptions& options) {
  const model::GasIntegrator integrator(scene);
  const GasThreads threads(options.threads, scene.ensemble_size, options.ranks->size());
  const auto advance_one = [&](std::size_t number, const std::atomic<int>& stop) {
    const auto begun = share.begun.find(number);
    model::GasMember member =
        begun == share.begun.end() ? model::GasMember() : std::move(begun->second);
    integrator.integrate(member, share.restitution, boltzmann::member_seed(scene.seed, number),
                         parallel::start_team(threads.per_gas),
                         [&](const model::GasMember& /*now*/) { return stop == 0; });
    return message_bytes(member, "");
  };
  tasks::Pool<tasks::Bytes> pool(threads.gases, *options.ranks, share.shared,
                                 {.carry_out = advance_one}, options.stop_signal);
  for (const auto& [number, _] : share.begun) {
    pool.add(number);
  }
  tasks::send_results(pool, *options.ranks);
}

}  // namespace

store::RunSummary run(const scene::BoltzmannScene& scene, const RunOptions& options,
                      const RunEvents& events) {
  return GasRun(scene, options, events).execute();
}

store::RunSummary resume_gas(SavedRun& saved, const RunOptions& options, const RunEvents& events) {
  const auto& scene = std::get<scene::BoltzmannScene>(saved.scene);
  SavedGasRun course;
  if (saved.checkpoint.is_before_first_step()) {
    saved.folder.start_over(saved.checkpoint);
  } else {
    course = saved_gas_run(saved);
    saved.checkpoint.fields.clear();  // as large as the gases
  }
  return GasRun(scene, options, events, std::move(saved.folder), std::move(course)).execute();
}

void work_for_rank_0(const RunOptions& options) {
  options.ranks->begin(store::version());
  while (const auto work = options.ranks->wait_for_work(options.stop_signal)) {
    const store::Checkpoint content = store::parse_checkpoint(*work, kAnySize);
    GasShare share;
    reflection::decode(content.fields, kAnySize, share);
    advance(std::move(share),
            std::get<scene::BoltzmannScene>(
                scene::parse_any(content.scene_text, "the scene of rank 0")),
            options);
  }
}

}  // namespace clca::run
