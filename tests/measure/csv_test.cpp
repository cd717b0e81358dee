#include "isolux/measure/csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "isolux/core/error.h"

namespace isolux {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

TEST(PointsCsv, AnyOrderOtherColumnsAndUntidyTextAreFine) {
  const std::string text =
      "\xef\xbb\xbf\r\n nz ,name,\"x\",y,z,nx,ny\r\n"
      "2,\"a, \"\"b\"\"\",0.5, +1e-1 ,-3,0,0\r\n"
      "\r\n"
      "0,, \"7\" ,8,9,3e200,4e200,more";
  const std::vector<MeasurePoint> points = read_points(text, "p.csv");
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0].position, (Vec3{0.5, 0.1, -3}));
  EXPECT_EQ(points[0].normal, (Vec3{0, 0, 1}));
  EXPECT_EQ(points[1].position, (Vec3{7, 8, 9}));
  EXPECT_NEAR(points[1].normal.x, 0.6, 1e-15);
  EXPECT_NEAR(points[1].normal.y, 0.8, 1e-15);
}

TEST(PointsCsv, ErrorsNameTheirPlace) {
  const std::string header = "x,y,z,nx,ny,nz\n";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "p.csv: has no points"},
      {header, "p.csv: has no points"},
      {"\n\n", "p.csv: has no points"},
      {"x,y,z,nx,ny\n1,2,3,0,0\n", "p.csv:1:1: the header lacks column 'nz'"},
      {"1,2,3,0,0,1\n", "p.csv:1:1: the header lacks column 'x'"},
      {"x,y,x,z,nx,ny,nz\n", "p.csv:1:5: column 'x' is there twice"},
      {header + "1,2,3,0,0,1\n1,2,3,0,1\n", "p.csv:3:1: the row has 5 values"},
      {header + "1, two,3,0,0,1\n", "p.csv:2:4: 'y' must be a finite number, not 'two'"},
      {header + "1,,3,0,0,1\n", "p.csv:2:3: 'y' must be a finite number, not ''"},
      {header + "1,2 m,3,0,0,1\n", "p.csv:2:3: 'y' must"},
      {header + "1,2,nan,0,0,1\n", "p.csv:2:5: 'z' must"},
      {header + "1,2,1e999,0,0,1\n", "p.csv:2:5: 'z' must"},
      {header + "1,2,inf,0,0,1\n", "p.csv:2:5: 'z' must"},
      {header + "1,2,+-3,0,0,1\n", "p.csv:2:5: 'z' must"},
      {header + "1;2;3;0;0;1\n", "p.csv:2:1: "},
      {header + "1,2,3,0,0,0\n", "p.csv:2:7: the normal"},
      {header + "1,\"2,3,0,0,1\n", "p.csv:2:3: a quote is never closed"},
      {header + "\"1\"2,2,3,0,0,1\n", "p.csv:2:4: text follows a closing quote"},
      {std::string("x,y,z,nx,ny,nz\n\0,2,3,0,0,1", 26), "p.csv:2:1: 'x' must"},
  };
  for (const auto& [text, message] : cases) {
    EXPECT_THAT([&] { read_points(text, "p.csv"); }, ThrowsMessage<InputError>(StartsWith(message)))
        << text;
  }
  EXPECT_THROW(load_points("no such file.csv"), InputError);
}

TEST(MeasurementsCsv, HasNineDigits) {
  const Measurement m{{{1.0 / 3, 2, -3e-7}, {0, 0, 1}}, {100, 200.123456789, 0}, 1.5};
  EXPECT_EQ(measurements_to_csv({&m, 1}),
            "x,y,z,nx,ny,nz,Er,Eg,Eb,E,error\n"
            "0.333333333,2,-3e-07,0,0,1,100,200.123457,0,164.388296,1.5\n");
}

}  // namespace
}  // namespace isolux
