// Ranks of MPI.

#include <mpi.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <list>
#include <thread>
#include <utility>

#include "cli/ranks.hpp"

namespace clca::cli {

namespace {

// A message is a list of words: the number of its bytes, then these. So its length in words fits
// into an int up to 16 GiB.
using Word = std::uint64_t;
constexpr int kTag = 1;

std::vector<Word> words_of(const tasks::Bytes& bytes) {
  std::vector<Word> words(1 + (bytes.size() + sizeof(Word) - 1) / sizeof(Word));
  words[0] = bytes.size();
  std::memcpy(words.data() + 1, bytes.data(), bytes.size());
  return words;
}

tasks::Bytes bytes_of(const std::vector<Word>& words) {
  tasks::Bytes bytes(words.at(0));
  std::memcpy(bytes.data(), words.data() + 1, bytes.size());
  return bytes;
}

/// A message that is being sent or received.
struct Transfer {
  int other = 0;
  std::vector<Word> words;
  MPI_Request request = MPI_REQUEST_NULL;

  bool is_done() {
    int done = 0;
    return MPI_Test(&request, &done, MPI_STATUS_IGNORE) == MPI_SUCCESS && done != 0;
  }
};

class MpiRanks : public tasks::Ranks {
 public:
  MpiRanks() {
    // A rank that ends while MPI starts would leave the others waiting for ever.
    constexpr unsigned kLongest = 600;  // seconds
    ::alarm(kLongest);
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);  // a rank may have ended
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
    MPI_Comm machine = MPI_COMM_NULL;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
    MPI_Comm_size(machine, &on_this_machine_);
    MPI_Comm_free(&machine);
    ::alarm(0);
  }
  ~MpiRanks() override {
    const int tries = has_lost_ranks_ ? 50 : 500;
    constexpr std::chrono::milliseconds kPause(10);
    for (int i = 0; i < tries && !all_sent(); ++i) {
      while (receive()) {  // what others are still sending
      }
      std::this_thread::sleep_for(kPause);
    }
    if (!has_lost_ranks_) {  // for which MPI_Finalize may wait
      MPI_Finalize();
    }
  }
  MpiRanks(const MpiRanks&) = delete;
  MpiRanks& operator=(const MpiRanks&) = delete;

  int rank() const override { return rank_; }
  int size() const override { return size_; }
  int on_this_machine() const override { return on_this_machine_; }

  void send(int to, tasks::Bytes bytes) override {
    all_sent();
    Transfer& one = sent_.emplace_back(Transfer{to, words_of(bytes)});
    MPI_Isend(one.words.data(), static_cast<int>(one.words.size()), MPI_UINT64_T, to, kTag,
              MPI_COMM_WORLD, &one.request);
  }

  void note_lost_rank() override { has_lost_ranks_ = true; }

  std::optional<tasks::Message> receive() override {
    all_sent();
    begin_to_receive();
    // What comes from one rank stays in order, a long message before a short one.
    std::vector<bool> is_waiting(static_cast<std::size_t>(size_), false);
    for (auto one = received_.begin(); one != received_.end(); ++one) {
      const auto from = static_cast<std::size_t>(one->other);
      if (!is_waiting[from] && one->is_done()) {
        tasks::Message message = {one->other, bytes_of(one->words)};
        received_.erase(one);
        return message;
      }
      is_waiting[from] = true;
    }
    return std::nullopt;
  }

 private:
  /// Releases what has been sent.
  bool all_sent() {
    sent_.remove_if([](Transfer& one) { return one.is_done(); });
    return sent_.empty();
  }

  void begin_to_receive() {
    int found = 1;
    while (found != 0) {
      MPI_Message message = MPI_MESSAGE_NULL;
      MPI_Status status;
      int words = 0;
      found = 0;
      if (MPI_Improbe(MPI_ANY_SOURCE, kTag, MPI_COMM_WORLD, &found, &message, &status) !=
              MPI_SUCCESS ||
          found == 0) {
        return;
      }
      MPI_Get_count(&status, MPI_UINT64_T, &words);
      Transfer& one = received_.emplace_back(
          Transfer{status.MPI_SOURCE, std::vector<Word>(static_cast<std::size_t>(words))});
      MPI_Imrecv(one.words.data(), words, MPI_UINT64_T, &message, &one.request);
    }
  }

  int rank_ = 0;
  int size_ = 1;
  int on_this_machine_ = 1;
  bool has_lost_ranks_ = false;
  std::list<Transfer> sent_;      // lists: the words stay where they are
  std::list<Transfer> received_;  // likewise
};

}  // namespace

std::unique_ptr<tasks::Ranks> started_ranks(char** /*arguments*/) {
  return std::make_unique<MpiRanks>();
}

}  // namespace clca::cli
