#pragma once

namespace isolux {

/// What the program returns.
enum ExitCode {
  kDone = 0,
  kUserError = 1,       ///< the input or the usage is wrong
  kInternalError = 2,   ///< a fault of isolux
  kGoalNotReached = 3,  ///< a solution was written, but short of its tolerance or its end
};

}  // namespace isolux
