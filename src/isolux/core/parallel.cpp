#include "isolux/core/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace isolux {

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
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, ranges, 1),
      [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
          body(i * step, std::min(n, (i + 1) * step));
        }
      },
      tbb::simple_partitioner());
}

}  // namespace isolux
