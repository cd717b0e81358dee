#pragma once

namespace isolux {

/// While it lives, the first SIGINT (Ctrl-C) or SIGTERM only raises a flag; the second ends the
/// program as usual. One at a time.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  bool requested() const;

  /// From here on both signals do nothing: what is being written gets written.
  void ignore();
};

}  // namespace isolux
