#include "isolux/image/exr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStandardAttributes.h>
#include <gtest/gtest.h>

#include "isolux/core/error.h"
#include "isolux/core/file.h"
#include "solution/small_solution.h"

namespace isolux {
namespace {

TEST(Exr, HoldsTheLuminancesAsFloats) {
  Picture picture(3, 2);
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 3; ++x) picture.at(x, y) = {x + 0.25, 1e6 * y, -1.5};
  }
  picture.at(0, 0) = {1e300, 0, 0};
  const TemporaryFolder folder;
  write_exr(picture, folder / "a.exr");

  Imf::InputFile file((folder / "a.exr").c_str());
  EXPECT_EQ(Imf::whiteLuminance(file.header()), 1);
  EXPECT_EQ(file.header().dataWindow().max.x, 2);
  EXPECT_EQ(file.header().dataWindow().max.y, 1);
  std::vector<float> green(6), red(6);
  Imf::FrameBuffer frame;
  const auto slice = [](std::vector<float>& v) {
    return Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(v.data()), sizeof(float),
                      3 * sizeof(float));
  };
  frame.insert("R", slice(red));
  frame.insert("G", slice(green));
  file.setFrameBuffer(frame);
  file.readPixels(0, 1);
  EXPECT_EQ(red[0], std::numeric_limits<float>::max());
  for (int i = 1; i < 6; ++i) {
    EXPECT_EQ(red[i], static_cast<float>(picture.pixels[i].r));
    EXPECT_EQ(green[i], static_cast<float>(picture.pixels[i].g));
  }
}

TEST(Exr, EqualPicturesGiveEqualBytes) {
  const TemporaryFolder folder;
  const Picture picture(5, 4);
  write_exr(picture, folder / "a.exr");
  write_exr(picture, folder / "b.exr");
  EXPECT_EQ(read_file(folder / "a.exr"), read_file(folder / "b.exr"));
}

TEST(Exr, RefusesAnEmptyPictureAndAFolderThatIsNotThere) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_exr(Picture(), folder / "a.exr"), InputError);
  EXPECT_THROW(write_exr(Picture(1, 1), folder / "none/a.exr"), InputError);
}

}  // namespace
}  // namespace isolux
