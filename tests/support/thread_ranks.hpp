#pragma once
// Ranks that are threads of the test.

#include <deque>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "clca/tasks/ranks.hpp"

namespace clca::testing {

class ThreadRanks {
 public:
  explicit ThreadRanks(int size) : boxes_(static_cast<std::size_t>(size)) {}

  /// Messages that rank 0 has received.
  std::size_t received_by_first() const { return received_; }

  /// As rank `number` sees them.
  std::unique_ptr<tasks::Ranks> seen_from(int number) {
    return std::make_unique<Rank>(*this, number);
  }

 private:
  class Rank : public tasks::Ranks {
   public:
    Rank(ThreadRanks& all, int number) : all_(all), number_(number) {}
    int rank() const override { return number_; }
    int size() const override { return static_cast<int>(all_.boxes_.size()); }
    int size_on_this_machine() const override { return size(); }
    std::uint64_t next_number() override {
      const std::lock_guard lock(all_.mutex_);
      return all_.next_++;
    }
    void reset_counter() override {
      const std::lock_guard lock(all_.mutex_);
      all_.next_ = 0;
    }
    void send(int to, std::uint64_t number, const tasks::Bytes& bytes) override {
      const std::lock_guard lock(all_.mutex_);
      all_.boxes_[static_cast<std::size_t>(to)].push_back({number_, number, bytes});
    }
    std::optional<tasks::Message> receive() override {
      const std::lock_guard lock(all_.mutex_);
      auto& box = all_.boxes_[static_cast<std::size_t>(number_)];
      if (box.empty()) {
        return std::nullopt;
      }
      all_.received_ += number_ == 0 ? 1 : 0;
      tasks::Message first = std::move(box.front());
      box.pop_front();
      return first;
    }

   private:
    ThreadRanks& all_;
    int number_;
  };

  std::size_t received_ = 0;
  std::uint64_t next_ = 1000;  // that of a process that has not set it
  std::mutex mutex_;
  std::vector<std::deque<tasks::Message>> boxes_;  // messages that have not been received
};

}  // namespace clca::testing
