#include "clca/parallel/split.hpp"

#include "clca/parallel/first_failure.hpp"

namespace clca::parallel {

void split(const Threads& threads, std::size_t count,
           const std::function<void(std::size_t, std::size_t, std::size_t)>& work) {
  const auto most = static_cast<std::size_t>(threads.count);
  const std::size_t parts = std::clamp<std::size_t>(count / threads.min_per_thread, 1, most);
  if (parts == 1) {
    work(0, 0, count);
    return;
  }
  FirstFailure failure;
#pragma omp parallel for num_threads(threads.count) schedule(static, 1) default(shared)
  for (std::size_t part = 0; part < parts; ++part) {
    failure.guard([&] { work(part, count * part / parts, count * (part + 1) / parts); });
  }
  failure.rethrow();
}

}  // namespace clca::parallel
