#include "isolux/image/exr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "isolux/core/error.h"
#include "isolux/core/file.h"

namespace isolux {
namespace {

/// A file in memory.
class MemoryStream : public Imf::OStream {
 public:
  MemoryStream() : Imf::OStream("memory") {}

  void write(const char data[], int size) override {
    const auto end = position_ + static_cast<std::size_t>(size);
    if (bytes_.size() < end) bytes_.resize(end);
    std::copy_n(data, size, bytes_.begin() + static_cast<std::ptrdiff_t>(position_));
    position_ = end;
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }

  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  std::size_t position_ = 0;
};

std::vector<float> floats(const Picture& picture) {
  std::vector<float> values;
  values.reserve(3 * picture.pixels.size());
  const auto add = [&](double x) {
    constexpr double kMax = std::numeric_limits<float>::max();
    values.push_back(static_cast<float>(std::clamp(x, -kMax, kMax)));
  };
  for (const Rgb& c : picture.pixels) add(c.r), add(c.g), add(c.b);
  return values;
}

std::string encode(const Picture& picture) {
  Imf::Header header(picture.width, picture.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::addChromaticities(header, Imf::Chromaticities());  // the default is Rec. 709
  Imf::addWhiteLuminance(header, 1);

  std::vector<float> values = floats(picture);
  constexpr std::size_t kPixelBytes = 3 * sizeof(float);
  Imf::FrameBuffer frame;
  constexpr std::array kNames = {"R", "G", "B"};
  for (std::size_t k = 0; k < kNames.size(); ++k) {
    header.channels().insert(kNames[k], Imf::Channel(Imf::FLOAT));
    frame.insert(kNames[k], Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data() + k),
                                       kPixelBytes, kPixelBytes * picture.width));
  }
  MemoryStream stream;
  {
    Imf::OutputFile file(stream, header);
    file.setFrameBuffer(frame);
    file.writePixels(picture.height);
  }
  return stream.bytes();
}

}  // namespace

void write_exr(const Picture& luminance, const std::filesystem::path& path) {
  if (luminance.pixels.empty()) throw InputError({path.string()}, "the picture has no pixels");
  std::string bytes;
  try {
    bytes = encode(luminance);
  } catch (const std::exception& error) {
    throw InputError({path.string()}, fmt::format("can't be encoded: {}", error.what()));
  }
  write_file(path, bytes);
}

}  // namespace isolux
