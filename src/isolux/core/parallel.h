#pragma once

#include <cstddef>
#include <functional>

namespace isolux {

/// Limits the parallel loops of the whole process to `threads` threads (0: all processors) while
/// this lives.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  void* control_;
};

/// Runs `body(begin, end)` over disjoint ranges that cover 0 … n − 1, on several threads. The
/// ranges are fixed by `n` and `grain` alone (each `grain` long, the last perhaps shorter), never
/// by the number of threads. An exception of a body is rethrown here.
void parallel_for(std::size_t n, std::size_t grain,
                  const std::function<void(std::size_t begin, std::size_t end)>& body);

}  // namespace isolux
