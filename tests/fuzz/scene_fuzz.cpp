#include "fuzz/fuzz.h"
#include "isolux/formats/scene_file.h"

// Compiled once for each format. FUZZ_FILE is the name of the scene's file, FUZZ_SIDE_FILE that of
// one beside it, which has what follows kSeparator where that occurs.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace isolux;
  constexpr std::string_view kSeparator = "\n=====\n";
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const std::size_t end = bytes.find(kSeparator);
  const auto file = write_fuzz_file(FUZZ_FILE, bytes.substr(0, end));
  std::filesystem::remove(fuzz_folder() / FUZZ_SIDE_FILE);
  if (end != bytes.npos) write_fuzz_file(FUZZ_SIDE_FILE, bytes.substr(end + kSeparator.size()));
  expect_no_harm([&] { load_scene_file(file); });
  return 0;
}
