#pragma once
// Where the gases of an ensemble leave what a checkpoint takes of them.

#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <vector>

#include "run/gas_member.hpp"
#include "run/saver.hpp"

namespace clca::run {

/// When it is time for a checkpoint, each gas that is under way leaves a copy of itself after its
/// next step, from its own thread; the last to do so saves. As gases know nothing of each other,
/// the copies may be of different moments.
class GasSlots {
 public:
  /// `save` writes all of `members`; it is called by one thread at a time, while nobody changes
  /// them.
  GasSlots(std::vector<GasMember>& members, Saver& saver, std::function<void()> save)
      : members_(members), saver_(saver), save_(std::move(save)) {}

  /// Takes a member out, to be carried on.
  GasMember begin(std::size_t number);
  void after_step(std::size_t number, const GasMember& member);
  /// Puts it back.
  void end(std::size_t number, GasMember member);

 private:
  void save_when_all_are_there();

  std::vector<GasMember>& members_;
  Saver& saver_;
  std::function<void()> save_;
  std::mutex mutex_;
  bool collecting_ = false;
  std::map<std::size_t, bool> under_way_;  // and whether its copy is still to come
};

}  // namespace clca::run
