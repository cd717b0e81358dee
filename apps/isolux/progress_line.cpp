#include "progress_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <string>

namespace isolux {
namespace {

constexpr const char* kEraseLine = "\r\x1b[K";

std::string duration(double seconds) {
  if (!(seconds >= 0 && seconds < 1e8)) return "?";
  const auto s = static_cast<long>(std::lround(seconds));
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {:02} s", s / 60, s % 60);
  return fmt::format("{} h {:02} min", s / 3600, s / 60 % 60);
}

std::string rate(double per_second) {
  if (per_second >= 1e6) return fmt::format("{:.1f} M", per_second / 1e6);
  return fmt::format("{:.0f} k", per_second / 1e3);
}

}  // namespace

ProgressLine::ProgressLine(bool quiet) : enabled_(!quiet && ::isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() {
  if (shown_) std::fputs(kEraseLine, stderr);
}

bool ProgressLine::begin() {
  const Clock::time_point now = Clock::now();
  if (!enabled_ || (shown_ && now - last_ < std::chrono::milliseconds(100))) return false;
  shown_ = true;
  last_ = now;
  std::fputs(kEraseLine, stderr);
  return true;
}

void ProgressLine::show(const ReadingProgress& progress) {
  if (Clock::now() - start_ < std::chrono::seconds(1) || !begin()) return;
  fmt::print(stderr, "{}", progress.step);
  if (progress.done > 0) fmt::print(stderr, " {:.0f} %", 100 * progress.done);
  std::fflush(stderr);
}

void ProgressLine::show(const Progress& progress) {
  if (!begin()) return;
  if (progress.iterations == 0) {
    fmt::print(stderr, "{}{:.1f} % unshot, {} triangles, {} rays/s",
               progress.error > 0 ? fmt::format("± {:.2g} %, ", 100 * progress.error) : "",
               100 * progress.unshot_fraction, progress.triangles, rate(progress.rays_per_second));
    std::fflush(stderr);
    return;
  }
  fmt::print(stderr, "{}/{} iterations, {:.1f} % unshot, {} triangles, {} rays/s, {} left",
             progress.iteration, progress.iterations, 100 * progress.unshot_fraction,
             progress.triangles, rate(progress.rays_per_second), duration(progress.seconds_left));
  std::fflush(stderr);
}

}  // namespace isolux
