#pragma once

#include <string>
#include <vector>

namespace isolux {

/// A scene in another format.
struct WrittenScene {
  std::string text;
  std::vector<std::string> notes;  ///< what it doesn't hold, or holds changed: one line each
};

}  // namespace isolux
