#include "run/frame_choice.hpp"

namespace clca::run {

std::vector<std::size_t> frame_choice(const std::vector<store::Trajectory::Frame>& frames,
                                      std::uint64_t every) {
  std::vector<std::size_t> chosen;
  std::uint64_t beat = 0;  // step of the last frame that `every` counts from
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const store::Trajectory::Frame& frame = frames[i];
    const bool begins = i == 0 || frames[i - 1].stage != frame.stage;
    const bool ends = i + 1 == frames.size() || frames[i + 1].stage != frame.stage;
    const bool due = begins || frame.step - beat >= every;
    if (due) {
      beat = frame.step;
    }
    const bool drawn_before = i > 0 && frames[i - 1].step == frame.step;
    if ((due || ends) && !drawn_before) {
      chosen.push_back(i);
    }
  }
  return chosen;
}

bool is_among(std::size_t number, std::size_t count, std::size_t most) {
  if (count <= most) {
    return true;
  }
  // The k-th selected item is the one nearest to k * (count - 1) / (most - 1).
  const std::size_t gaps = most - 1;
  const std::size_t k = (number * gaps + (count - 1) / 2) / (count - 1);
  return (k * (count - 1) + gaps / 2) / gaps == number;
}

}  // namespace clca::run
