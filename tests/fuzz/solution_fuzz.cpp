#include "fuzz/fuzz.h"
#include "isolux/solution/solution.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace isolux;
  const auto file = write_fuzz_file("a.glb", {reinterpret_cast<const char*>(data), size});
  expect_no_harm([&] { load_solution(file); });
  return 0;
}
