#include "fuzz/fuzz.h"
#include "isolux/measure/csv.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace isolux;
  const std::string text(reinterpret_cast<const char*>(data), size);
  expect_no_harm([&] { read_points(text, "a.csv"); });
  return 0;
}
