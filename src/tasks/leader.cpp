#include "clca/tasks/leader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <new>
#include <sstream>
#include <system_error>
#include <utility>

#include "tasks/messages.hpp"

namespace clca::tasks {

namespace {

void send_to_all(Ranks& ranks, const Bytes& bytes) {
  for (int number = 1; number < ranks.size(); ++number) {
    ranks.send(number, bytes);
  }
}

}  // namespace

void dismiss(Ranks& ranks, bool has_lost_ranks) {
  try {
    send_to_all(ranks, bytes_of(Kind::end, has_lost_ranks ? 1 : 0));
  } catch (const std::bad_alloc&) {  // they see that this rank has ended
  }
}

std::chrono::microseconds PollInterval::now() const {
  constexpr std::chrono::microseconds kShortest(200);
  constexpr std::chrono::microseconds kLongest(20'000);
  constexpr int kPart = 20;
  const auto without = std::chrono::duration_cast<std::chrono::microseconds>(Clock::now() - last_);
  return std::clamp(without / kPart, kShortest, kLongest);
}

Leader::Leader(Ranks& ranks, const std::filesystem::path& lock_file, std::uint64_t fingerprint,
               std::size_t most, std::function<void(const std::string&)> warning)
    : ranks_(ranks),
      lock_file_(std::filesystem::absolute(lock_file)),
      presence_(lock_file_, 0),
      fingerprint_(fingerprint),
      most_(most),
      warning_(std::move(warning)),
      others_(static_cast<std::size_t>(ranks.size())) {
  send_to_all(ranks_, bytes_of(Kind::begin, 0, lock_file_.string()));
}

Leader::~Leader() {
  for (int number = 1; number < ranks_.size(); ++number) {
    if (sees_locks_ && others_[static_cast<std::size_t>(number)].is_useful &&
        !presence_.has(number)) {  // it ended when there was no more for it to do
      has_lost_ranks_ = true;
      ranks_.note_lost_rank();
    }
  }
  dismiss(ranks_, has_lost_ranks_);
  std::error_code unknown;
  if (std::filesystem::file_size(lock_file_, unknown) == 0) {
    std::filesystem::remove(lock_file_, unknown);
  }
}

std::size_t Leader::idle() const {
  std::size_t sum = 0;
  for (const Rank& one : others_) {
    sum += one.idle;
  }
  return sum;
}

std::size_t Leader::busy() const {
  std::size_t sum = 0;
  for (const Rank& one : others_) {
    sum += one.tasks.size();
  }
  return sum;
}

void Leader::start(std::size_t task, const Bytes& request) {
  const auto one = std::max_element(others_.begin(), others_.end(),
                                    [](const Rank& a, const Rank& b) { return a.idle < b.idle; });
  --one->idle;
  one->tasks.push_back(task);
  ranks_.send(static_cast<int>(one - others_.begin()), bytes_of(Kind::request, task, request));
}

void Leader::stop() {
  try {
    send_to_all(ranks_, bytes_of(Kind::stop));
  } catch (const std::bad_alloc&) {  // they end with their tasks
  }
}

std::vector<Leader::Answer> Leader::take_answers() {
  std::vector<Answer> answers;
  while (const auto message = ranks_.receive()) {
    interval_.note_message();
    handle(*message, answers);
  }
  constexpr std::chrono::seconds kPause(1);
  const auto now = std::chrono::steady_clock::now();
  if (sees_locks_ && now - looked_ >= kPause) {
    looked_ = now;
    look_for_lost_ranks();
  }
  return answers;
}

std::vector<std::size_t> Leader::carried_out() const {
  std::vector<std::size_t> tasks;
  std::transform(others_.begin() + 1, others_.end(), std::back_inserter(tasks),
                 [](const Rank& one) { return one.carried_out; });
  return tasks;
}

std::vector<std::size_t> Leader::take_lost() {
  return std::exchange(lost_, {});
}

void Leader::handle(const Message& message, std::vector<Answer>& answers) {
  Content content = content_of(message.bytes);
  Rank& one = others_[static_cast<std::size_t>(message.from)];
  if (content.kind == Kind::greeting) {
    greet(message.from, content.number, content.text());
  } else if (content.kind == Kind::refusal) {
    give_up(message.from, content.text());
  } else if (content.kind == Kind::answer && one.is_useful) {
    const auto task = std::find(one.tasks.begin(), one.tasks.end(), content.number);
    if (task != one.tasks.end()) {
      one.tasks.erase(task);
      ++one.idle;
      ++one.carried_out;
      answers.push_back({content.number, std::move(content.rest)});
    }
  }
}

void Leader::greet(int number, std::uint64_t fingerprint, const std::string& greeting) {
  if (fingerprint != fingerprint_) {
    give_up(number, "it was started with another scene, folder or version of clca");
    return;
  }
  std::size_t threads = 0;
  bool sees_this_rank = false;
  std::istringstream(greeting) >> threads >> sees_this_rank;
  if (sees_locks_ && !sees_this_rank) {
    sees_locks_ = false;
    warning_(
        fmt::format("rank {} does not see the lock of rank 0: the file system of the folder does "
                    "not lock between them, so ranks that end are not noticed",
                    number));
  }
  Rank& one = others_[static_cast<std::size_t>(number)];
  one.is_useful = true;
  one.idle = std::min(threads, most_);
}

void Leader::look_for_lost_ranks() {
  for (int number = 1; number < ranks_.size(); ++number) {
    Rank& one = others_[static_cast<std::size_t>(number)];
    if (one.is_useful && one.watch.has_ended(presence_.has(number))) {
      give_up(number, "it has ended");
      has_lost_ranks_ = true;
      ranks_.note_lost_rank();
    }
  }
}

void Leader::give_up(int number, const std::string& why) {
  Rank& one = others_[static_cast<std::size_t>(number)];
  if (!why.empty()) {
    warning_(fmt::format("rank {} takes no more tasks: {}", number, why));
  }
  lost_.insert(lost_.end(), one.tasks.begin(), one.tasks.end());
  const std::size_t carried_out = one.carried_out;
  one = {};
  one.carried_out = carried_out;
}

}  // namespace clca::tasks
