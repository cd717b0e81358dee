#pragma once

namespace isolux {

/// The most memory that the process has held so far, bytes.
double peak_memory();

/// What is allocated now, bytes.
double allocated_memory();

}  // namespace isolux
