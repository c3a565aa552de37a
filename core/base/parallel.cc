#include "core/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace dhcal {

int NumProcessors() { return static_cast<int>(std::max(1U, std::thread::hardware_concurrency())); }

void ParallelFor(int count, const std::function<void(int)>& work, int threads) {
  std::atomic<int> next{0};
  const auto take = [&] {
    for (int k = next++; k < count; k = next++) work(k);
  };
  std::vector<std::thread> others;
  for (int k = 1; k < std::min(count, threads); ++k) others.emplace_back(take);
  take();
  for (std::thread& other : others) other.join();
}

}  // namespace dhcal
