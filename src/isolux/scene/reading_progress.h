#pragma once

#include <exception>
#include <functional>

namespace isolux {

/// How far the reading of a scene has come.
struct ReadingProgress {
  const char* step;  ///< what is being done, such as "parsing"
  double done = 0;   ///< of this step, 0 to 1
};

/// Asked now and then; returns false to stop. May be empty.
using ReadingCallback = std::function<bool(const ReadingProgress&)>;

/// Leaves the functions that read where the callback said to stop.
struct ReadingStopped : std::exception {
  const char* what() const noexcept override { return "reading was stopped"; }
};

inline void report_progress(const ReadingCallback& callback, const ReadingProgress& progress) {
  if (callback && !callback(progress)) throw ReadingStopped();
}

}  // namespace isolux
