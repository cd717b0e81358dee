#include "memory.h"

#include <malloc.h>
#include <sys/resource.h>

#include <fstream>
#include <string>

namespace isolux {

double peak_memory() {
  constexpr double kKibibyte = 1024;
  // What getrusage() tells may be of the process that this one was forked from.
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double peak = 0;
    if (word == "VmHWM:" && status >> peak) return kKibibyte * peak;
  }
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return kKibibyte * static_cast<double>(usage.ru_maxrss);
}

double allocated_memory() {
  const auto info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

}  // namespace isolux
