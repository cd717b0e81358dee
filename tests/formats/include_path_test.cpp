#include "isolux/formats/include_path.h"

#include <gmock/gmock.h>

#include "formats/temporary_folder.h"
#include "isolux/core/error.h"

namespace isolux {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;

std::string refusal(Includes& includes, std::string_view name) {
  try {
    includes.open(name);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(IncludePath, NamesAreRelativeToTheFileThatHasThem) {
  const TemporaryFolder folder;
  const fs::path main = folder.write("main", "");
  folder.write("a/first", "1");
  folder.write("a/b/second", "2");
  folder.write("third", "3");
  Includes includes(main);
  EXPECT_EQ(includes.open("./a/first").text, "1");
  const SourceText second = includes.open("b/second");
  EXPECT_EQ(second.text, "2");
  EXPECT_EQ(second.file, (folder.path() / "a/b/second").string());
  EXPECT_EQ(includes.open("../../third").text, "3");
  includes.close();
  includes.close();
  includes.close();
  EXPECT_EQ(includes.open("third").text, "3");
}

TEST(IncludePath, NamesMayAllBeRelativeToTheMainFile) {
  const TemporaryFolder folder;
  const fs::path main = folder.write("main", "");
  folder.write("a/first", "1");
  folder.write("second", "2");
  folder.write("a/second", "wrong");
  Includes includes(main, Includes::Base::main_file);
  EXPECT_EQ(includes.open("a/first").text, "1");
  EXPECT_EQ(includes.open("second").text, "2");
  EXPECT_THAT(refusal(includes, "../secret"), HasSubstr("outside the folder"));
}

TEST(IncludePath, NothingOutsideTheFolderIsRead) {
  const TemporaryFolder folder;
  const fs::path main = folder.write("scene/main", "");
  folder.write("secret", "s");
  folder.write("scene-too/secret", "s");
  folder.write("scene/sub/file", "");
  fs::create_symlink(folder.path() / "secret", folder.path() / "scene/link");
  fs::create_directory_symlink(folder.path(), folder.path() / "scene/up");
  Includes includes(main);
  for (const std::string name :
       {"../secret", "sub/../../secret", "../scene-too/secret", "link", "up/secret", ".."}) {
    EXPECT_THAT(refusal(includes, name), HasSubstr("outside the folder")) << name;
  }
  EXPECT_THAT(refusal(includes, (folder.path() / "scene/sub/file").string()),
              HasSubstr("relative"));
  EXPECT_THAT(refusal(includes, ""), HasSubstr("relative"));
  EXPECT_THAT(refusal(includes, "nothing"), HasSubstr("there is no file 'nothing'"));
  EXPECT_THAT(refusal(includes, "sub"), HasSubstr("there is no file 'sub'"));
  EXPECT_EQ(refusal(includes, "up/scene/sub/file"), "");
}

TEST(IncludePath, CirclesDepthAndNumberAreBounded) {
  const TemporaryFolder folder;
  const fs::path main = folder.write("main", "");
  for (int i = 0; i < 40; ++i) folder.write(std::to_string(i), "");
  fs::create_symlink("main", folder.path() / "alias");
  Includes includes(main);
  EXPECT_THAT(refusal(includes, "main"), HasSubstr("'main' includes itself"));
  EXPECT_THAT(refusal(includes, "alias"), HasSubstr("includes itself"));
  includes.open("0");
  EXPECT_THAT(refusal(includes, "main"), HasSubstr("includes itself"));
  for (int i = 1; i < 32; ++i) includes.open(std::to_string(i));
  EXPECT_THAT(refusal(includes, "32"), HasSubstr("more than 32 deep"));
  includes.close();
  for (int i = 32; i < 1000; ++i) {
    includes.open("39");
    includes.close();
  }
  EXPECT_THAT(refusal(includes, "39"), HasSubstr("more than 1000 files"));
}

}  // namespace
}  // namespace isolux
