#pragma once

#include <chrono>

#include "isolux/radiosity/solve.h"

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

 private:
  bool enabled_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace isolux
