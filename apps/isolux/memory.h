#pragma once

namespace isolux {

/// The most memory that the process has held so far, bytes.
double peak_memory();

}  // namespace isolux
