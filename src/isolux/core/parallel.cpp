#include "isolux/core/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#ifdef ISOLUX_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace isolux {
namespace {

/// What orders a loop: all before it comes before each of its ranges, and all ranges come before
/// what follows it. TBB sees to that; the thread sanitizer, which can't look into TBB, is told
/// here. Between ranges it is told nothing, so it finds their races. Otherwise this does nothing.
class LoopOrder {
 public:
  LoopOrder() { release(start_); }
  ~LoopOrder() { acquire(end_); }
  LoopOrder(const LoopOrder&) = delete;
  LoopOrder& operator=(const LoopOrder&) = delete;

  /// Lives while one range runs.
  class Range {
   public:
    explicit Range(LoopOrder& loop) : loop_(loop) { acquire(loop_.start_); }
    ~Range() { release(loop_.end_); }
    Range(const Range&) = delete;
    Range& operator=(const Range&) = delete;

   private:
    LoopOrder& loop_;
  };

 private:
#ifdef ISOLUX_THREAD_SANITIZER
  static void acquire(int& event) { __tsan_acquire(&event); }
  static void release(int& event) { __tsan_release(&event); }
#else
  static void acquire(int&) {}
  static void release(int&) {}
#endif

  int start_ = 0, end_ = 0;  // only their addresses count
};

}  // namespace

ThreadLimit::ThreadLimit(int threads)
    : control_(threads > 0 ? new tbb::global_control(tbb::global_control::max_allowed_parallelism,
                                                     static_cast<std::size_t>(threads))
                           : nullptr) {}

ThreadLimit::~ThreadLimit() { delete static_cast<tbb::global_control*>(control_); }

void parallel_for(std::size_t n, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body) {
  const std::size_t step = std::max<std::size_t>(1, grain);
  const std::size_t ranges = (n + step - 1) / step;
  if (ranges <= 1) {
    if (n > 0) body(0, n);
    return;
  }
  LoopOrder order;
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, ranges, 1),
      [&](const tbb::blocked_range<std::size_t>& range) {
        const LoopOrder::Range ordered(order);
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
          body(i * step, std::min(n, (i + 1) * step));
        }
      },
      tbb::simple_partitioner());
}

}  // namespace isolux
