#include "memory.h"

#include <sys/resource.h>

namespace isolux {

double peak_memory() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);  // Linux counts in KiB
}

}  // namespace isolux
