#pragma once

#include <chrono>

#include "isolux/radiosity/solve.h"
#include "isolux/scene/reading_progress.h"

namespace isolux {

/// One line on the terminal, overwritten in place about ten times a second, gone at the end.
class ProgressLine {
 public:
  /// Shows nothing where `quiet`, or where stderr is not a terminal.
  explicit ProgressLine(bool quiet);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(const Progress& progress);
  /// Shows nothing in the first second.
  void show(const ReadingProgress& progress);

 private:
  /// Whether it is time to show something; the cursor then stands at the start of an empty line.
  bool begin();

  using Clock = std::chrono::steady_clock;
  bool enabled_;
  bool shown_ = false;
  const Clock::time_point start_ = Clock::now();
  Clock::time_point last_;
};

}  // namespace isolux
