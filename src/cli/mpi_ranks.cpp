// Ranks of MPI.

#include <mpi.h>

#include <cstring>

#include "cli/ranks.hpp"

namespace clca::cli {

namespace {

// A message is a list of words: its number, the number of its bytes, then these. So its length in
// words fits into an int up to 16 GiB.
using Word = std::uint64_t;
constexpr int kTag = 1;
constexpr std::size_t kHeader = 2;  // words

/// The counter of next_number() is memory of rank 0 that all others reach. Errors of MPI end all
/// ranks.
class MpiRanks : public tasks::Ranks {
 public:
  MpiRanks() {
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
    MPI_Comm machine = MPI_COMM_NULL;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
    MPI_Comm_size(machine, &on_this_machine_);
    MPI_Comm_free(&machine);
    Word* memory = nullptr;
    const MPI_Aint bytes = rank_ == 0 ? sizeof(Word) : 0;
    MPI_Win_allocate(bytes, sizeof(Word), MPI_INFO_NULL, MPI_COMM_WORLD, &memory, &counter_);
    MPI_Win_lock_all(0, counter_);
  }
  ~MpiRanks() override {
    MPI_Win_unlock_all(counter_);
    MPI_Win_free(&counter_);
    MPI_Finalize();
  }
  MpiRanks(const MpiRanks&) = delete;
  MpiRanks& operator=(const MpiRanks&) = delete;

  int rank() const override { return rank_; }
  int size() const override { return size_; }
  int size_on_this_machine() const override { return on_this_machine_; }

  std::uint64_t next_number() override { return change_counter(1, MPI_SUM); }
  void reset_counter() override { change_counter(0, MPI_REPLACE); }

  void send(int to, std::uint64_t number, const tasks::Bytes& bytes) override {
    std::vector<Word> words(kHeader + (bytes.size() + sizeof(Word) - 1) / sizeof(Word));
    words[0] = number;
    words[1] = bytes.size();
    std::memcpy(words.data() + kHeader, bytes.data(), bytes.size());
    MPI_Send(words.data(), static_cast<int>(words.size()), MPI_UINT64_T, to, kTag, MPI_COMM_WORLD);
  }

  std::optional<tasks::Message> receive() override {
    int found = 0;
    MPI_Message message = MPI_MESSAGE_NULL;
    MPI_Status status;
    MPI_Improbe(MPI_ANY_SOURCE, kTag, MPI_COMM_WORLD, &found, &message, &status);
    if (found == 0) {
      return std::nullopt;
    }
    int count = 0;
    MPI_Get_count(&status, MPI_UINT64_T, &count);
    std::vector<Word> words(static_cast<std::size_t>(count));
    MPI_Mrecv(words.data(), count, MPI_UINT64_T, &message, MPI_STATUS_IGNORE);
    tasks::Bytes bytes(words.at(1));
    std::memcpy(bytes.data(), words.data() + kHeader, bytes.size());
    return tasks::Message{status.MPI_SOURCE, words.at(0), std::move(bytes)};
  }

 private:
  /// Returns the value before.
  Word change_counter(Word operand, MPI_Op operation) {
    Word before = 0;
    MPI_Fetch_and_op(&operand, &before, MPI_UINT64_T, 0, 0, operation, counter_);
    MPI_Win_flush(0, counter_);
    return before;
  }

  int rank_ = 0;
  int size_ = 1;
  int on_this_machine_ = 1;
  MPI_Win counter_ = MPI_WIN_NULL;
};

}  // namespace

std::unique_ptr<tasks::Ranks> start_ranks(char** /*arguments*/) {
  return std::make_unique<MpiRanks>();
}

void end_all_ranks(int code) {
  MPI_Abort(MPI_COMM_WORLD, code);
}

}  // namespace clca::cli
