#include "isolux/core/file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <string>
#include <vector>

#include "isolux/core/error.h"

namespace isolux {
namespace {
namespace fs = std::filesystem;

class FileTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              ("isolux_file_" + std::to_string(::getpid()) + "_" +
               testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::vector<std::string> listing() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      names.push_back(entry.path().filename().string());
    }
    return names;
  }

  fs::path folder_;
};

template <class Action>
std::string error_of(Action action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST_F(FileTest, ReadsBackEveryByte) {
  std::string bytes(3 << 20, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * 31 >> 3);
  write_file(folder_ / "a", bytes);
  EXPECT_EQ(read_file(folder_ / "a"), bytes);
  write_file(folder_ / "a", std::string("short"));
  EXPECT_EQ(read_file(folder_ / "a"), "short");
  write_file(folder_ / "a", std::string());
  EXPECT_EQ(read_file(folder_ / "a"), "");
  EXPECT_THAT(listing(), testing::ElementsAre("a")) << "no temporary file stays";
}

TEST_F(FileTest, RefusesWhatIsTooLarge) {
  write_file(folder_ / "a", std::string(100, 'x'));
  EXPECT_EQ(read_file(folder_ / "a", 100).size(), 100u);
  EXPECT_THAT(error_of([&] { read_file(folder_ / "a", 99); }),
              testing::HasSubstr("larger than 99 bytes"));
  EXPECT_THAT(error_of([] { read_file("/dev/zero", 1 << 20); }), testing::HasSubstr("larger"))
      << "a file without end";
}

TEST_F(FileTest, ErrorsNameTheFileAndTheReason) {
  EXPECT_THAT(error_of([&] { read_file(folder_ / "none"); }),
              testing::AllOf(testing::HasSubstr("none: "), testing::HasSubstr("No such file")));
  EXPECT_THAT(error_of([&] { read_file(folder_); }), testing::HasSubstr("is a folder"));
  EXPECT_THAT(error_of([&] { write_file(folder_, std::string("x")); }),
              testing::HasSubstr("is a folder"));
  EXPECT_THAT(error_of([&] { write_file(folder_ / "none" / "a", std::string("x")); }),
              testing::HasSubstr("No such file"));
}

TEST_F(FileTest, FailedWriteLeavesTheOldFile) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const fs::path path = folder_ / "a";
  write_file(path, std::string("old"));
  // What would be the temporary file is a link to a device that is always full.
  fs::path temporary = path;
  temporary += ".part-" + std::to_string(::getpid());
  fs::create_symlink("/dev/full", temporary);
  EXPECT_THAT(error_of([&] { write_file(path, std::string(1 << 20, 'x')); }),
              testing::HasSubstr("No space left"));
  EXPECT_EQ(read_file(path), "old");
  EXPECT_THAT(listing(), testing::ElementsAre("a"));
}

}  // namespace
}  // namespace isolux
