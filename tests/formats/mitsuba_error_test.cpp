#include "formats/refusal.h"

namespace isolux {
namespace {
using testing::HasSubstr;
using testing::StartsWith;

TEST(MitsubaErrors, GiveTheExactPlace) {
  const std::string disk = "<shape type='disk'/>";
  // Each within <scene>, from the second line on.
  const std::pair<std::string, const char*> cases[] = {
      {"<shpe type='disk'/>", "2:1: there is no element 'shpe': did you mean 'shape'?"},
      {" text", "2:2: unexpected text"},
      {"<shape/>", "2:1: <shape> needs type=\"...\""},
      {"<shape type='disk'>", "3:3: malformed XML: Start-end tags mismatch"},
      {"<shape type='disk'></disk>", "2:22: malformed XML: Start-end tags mismatch"},
      {"<shape type=disk/>", "2:13: malformed XML: Error parsing element attribute"},
      {"<shape type='disk/>", "2:14: malformed XML: Error parsing element attribute"},
      {"<!-- open", "3:9: malformed XML: Error parsing comment"},
      {"<scene version='3.0.0'/>", "2:1: <scene> must be the outermost element"},
      {"<ref id='a'/>", "2:1: there is nothing with id 'a': there are none"},
      {"<bsdf type='diffuse' id='a'/><bsdf type='diffuse' id='a'/>",
       "2:30: the id 'a' comes twice"},
      {"<alias id='a' as='b'/>", "2:1: there is nothing with id 'a' before"},
      {"<default name='a'/>", "2:1: <default> needs value=\"...\""},
      {"<shape type='$kind'/>", "2:1: there is no parameter 'kind': there are none"},
      {"<include/>", "2:1: <include> needs filename=\"...\""},
      {"<include filename='a.xml'/>", "2:1: 'a.xml' includes itself"},
      {"<include filename='/etc/passwd'/>", "2:1: '/etc/passwd' can't be included"},
      {"<include filename='../a.xml'/>", "2:1: '../a.xml' lies outside the folder"},
      {"<include filename='b.xml'/>", "2:1: there is no file 'b.xml'"},
      {"<shape type='obj'/>", "2:1: a mesh needs a <string> named 'filename'"},
      {"<shape type='obj'>\n<string name='filename' value='b.obj'/></shape>",
       "3:1: there is no file 'b.obj'"},
      {"<shape type='sphere'><float name='radius' value='x'/></shape>",
       "2:22: expected a finite number, not 'x'"},
      {"<shape type='sphere'><float name='radius' value='1e999'/></shape>",
       "2:22: expected a finite number, not '1e999'"},
      {"<shape type='sphere'><float name='radius' value='.nan'/></shape>",
       "2:22: expected a finite number, not '.nan'"},
      {"<shape type='sphere'><float name='radius' value='1 2'/></shape>",
       "2:22: value must be one number"},
      {"<shape type='sphere'><float name='radius' value='-1'/></shape>",
       "2:22: 'radius' must be positive"},
      {"<shape type='sphere'><string name='radius' value='1'/></shape>",
       "2:22: 'radius' must be a <float>"},
      {"<shape type='sphere'><point name='center' value='1 2'/></shape>",
       "2:22: value must be three numbers"},
      {"<shape type='sphere'><float name='center' value='1'/></shape>",
       "2:22: 'center' must be a <point> or a <vector>"},
      {"<shape type='disk'><boolean name='flip_normals' value='yes'/></shape>",
       "2:20: 'flip_normals' must be a <boolean>, true or false"},
      {"<shape type='disk'><float name='to_world' value='1'/></shape>",
       "2:20: 'to_world' must be a <transform>"},
      {"<shape type='disk'><transform name='to_world'>\n<scale x='0'/></transform></shape>",
       "3:1: the transform flattens everything"},
      {"<shape type='disk'><transform name='to_world'>\n<rotate angle='9'/></transform></shape>",
       "3:1: the axis of <rotate> must not be zero"},
      {"<shape type='disk'><transform name='to_world'>\n<rotate x='1'/></transform></shape>",
       "3:1: <rotate> needs angle=\"...\""},
      {"<shape type='disk'><transform name='to_world'>\n<matrix value='1 2'/></transform></shape>",
       "3:1: a matrix has 16 or 9 numbers"},
      {"<shape type='disk'><transform name='to_world'>\n<matrix value='1 0 0 0 0 1 0 0 0 0 1 0 0 0 "
       "1 1'/></transform></shape>",
       "3:1: the last row of a matrix must be 0 0 0 1"},
      {"<shape type='disk'><transform name='to_world'>\n<lookat origin='0 0 0' target='0 0 0' "
       "up='0 1 0'/></transform></shape>",
       "3:1: <lookat> needs a target, and 'up' not along the view"},
      {"<shape type='disk'><transform name='to_world'>\n<disk/></transform></shape>",
       "3:1: there is no element 'disk'"},
      {"<shape type='disk'><transform name='to_world'>\n<float value='1'/></transform></shape>",
       "3:1: <float> is no step of a transform"},
      {"<shape type='disk'><bsdf type='twosided'/></shape>", "2:20: 'twosided' needs a <bsdf>"},
      {"<shape type='disk'><bsdf type='blendbsdf'/></shape>",
       "2:20: 'blendbsdf' needs two <bsdf> within"},
      {"<bsdf type='twosided' id='a'><ref id='a'/></bsdf>\n<shape type='disk'><ref "
       "id='a'/></shape>",
       "2:1: this refers to itself"},
      {"<shape type='disk'><bsdf type='diffuse'>\n<rgb name='reflectance' value='1 2'/></bsdf>"
       "</shape>",
       "3:1: a color has three numbers, or one"},
      {"<shape type='disk'><bsdf type='diffuse'>\n<rgb name='reflectance' value='#12345g'/></bsdf>"
       "</shape>",
       "3:1: '#12345g' is no color"},
      {"<shape type='disk'><bsdf type='diffuse'>\n<rgb name='reflectance' value='-1'/></bsdf>"
       "</shape>",
       "3:1: a color must not be negative"},
      {"<shape type='disk'><bsdf type='diffuse'>\n<string name='reflectance' value='a'/></bsdf>"
       "</shape>",
       "3:1: <string> is no color"},
      {"<shape type='disk'><bsdf type='diffuse'>\n<spectrum name='reflectance' value='500:1 "
       "400:1'/></bsdf></shape>",
       "3:1: the wavelengths of a spectrum must rise"},
      {"<shape type='disk'><bsdf type='diffuse'>\n<spectrum name='reflectance' value='500:1 "
       "2'/></bsdf></shape>",
       "3:1: a spectrum is a number, or nanometres:value pairs"},
      {"<shape type='instance'/>", "2:1: an instance needs a <ref>"},
      {"<shape type='shapegroup' id='g'><shape type='instance'/></shape>"
       "<shape type='instance'><ref id='g'/></shape>",
       "2:33: a group can't have a shape of type 'instance'"},
      {"<shape type='disk'><emitter type='area'><rgb name='radiance' value='1e300'/></emitter>"
       "</shape>",
       "2:1: a light is stronger than"},
      {"<emitter type='point'><rgb name='intensity' value='1e300'/></emitter>" + disk,
       "2:1: a light is stronger than"},
      {"<emitter type='spot'><float name='cutoff_angle' value='0'/></emitter>",
       "2:1: 'cutoff_angle' must be up to 180 degrees"},
      {"<emitter type='directional'><vector name='direction' x='0'/></emitter>",
       "2:1: the direction of a light must not be zero"},
      {"<sensor type='perspective'>\n<float name='fov' value='180'/></sensor>",
       "3:1: 'fov' must lie between 0 and 180 degrees"},
      {"<sensor type='perspective'><float name='fov' value='9'/>\n<string name='fov_axis' "
       "value='z'/></sensor>",
       "3:1: 'fov_axis' must be x, y, diagonal, smaller or larger"},
      {"<sensor type='perspective'>\n<string name='focal_length' value='0mm'/></sensor>",
       "3:1: 'focal_length' must be a length such as 50mm"},
      {"<sensor type='perspective'><film type='hdrfilm'>\n<integer name='width' value='0'/></film>"
       "</sensor>",
       "3:1: 'width' must be 1 to 32768"},
  };
  for (const auto& [text, expected] : cases) {
    EXPECT_THAT(refusal_of("a.xml", "<scene version='3.0.0'>\n" + text + "\n</scene>\n"),
                StartsWith(std::string("a.xml:") + expected))
        << text;
  }
}

TEST(MitsubaErrors, OtherFilesAreNoScenes) {
  EXPECT_EQ(refusal_of("a.xml", ""), "a.xml:1:1: there is no <scene>");
  EXPECT_EQ(refusal_of("a.xml", "hello"), "a.xml:1:1: there is no <scene>");
  EXPECT_EQ(refusal_of("a.xml", "<?xml version='1.0'?>\n<html/>"),
            "a.xml:2:1: expected <scene>, not <html>: no scene of Mitsuba");
  EXPECT_EQ(refusal_of("a.xml", "<scene version='3.0.0'/>"), "a.xml: the scene has no surfaces");
  EXPECT_EQ(refusal_of("a.xml", std::string("<scene>\n\0</scene>", 17)),
            "a.xml:2:1: a byte of 0 in a text");
}

TEST(MitsubaErrors, FaultsOfIncludedFilesLieThere) {
  const TemporaryFolder folder;
  folder.write("b.xml", "<scene version='3.0.0'>\n <shape/></scene>");
  const auto file =
      folder.write("a.xml", "<scene version='3.0.0'><include filename='b.xml'/></scene>");
  try {
    load_scene_file(file);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              (folder.path() / "b.xml").string() + ":2:2: <shape> needs type=\"...\"");
  }
}

// Entities are not expanded, parameters only so far, and nothing nests without end.
TEST(MitsubaErrors, BombsDoNotGoOff) {
  std::string entities = "<!DOCTYPE lolz [<!ENTITY a0 'x'>";
  for (int i = 1; i < 40; ++i) {
    const std::string before = "&a" + std::to_string(i - 1) + ";";
    entities += "<!ENTITY a" + std::to_string(i) + " '" + before + before + "'>";
  }
  EXPECT_THAT(
      refusal_of("a.xml", entities + "]><scene version='3.0.0'><shape type='sphere'>"
                                     "<float name='radius' value='&a39;'/></shape></scene>"),
      HasSubstr("expected a finite number, not '&a39;'"));

  std::string parameters = "<scene version='3.0.0'><default name='a0' value='xxxxxxxxxx'/>";
  for (int i = 1; i < 60; ++i) {
    const std::string before = "$a" + std::to_string(i - 1) + " ";
    parameters += "<default name='a" + std::to_string(i) + "' value='" + before + before + "'/>";
  }
  EXPECT_THAT(refusal_of("a.xml", parameters + "</scene>"), HasSubstr("parameters grow too long"));

  std::string deep = "<scene version='3.0.0'>";
  for (int i = 0; i < 100'000; ++i) deep += "<bsdf>";
  for (int i = 0; i < 100'000; ++i) deep += "</bsdf>";
  EXPECT_THAT(refusal_of("a.xml", deep + "</scene>"), HasSubstr("1:408: elements nest too deep"));

  std::string chain = "<scene version='3.0.0'><bsdf type='diffuse' id='b0'/>";
  for (int i = 1; i < 500; ++i) {
    chain += "<bsdf type='twosided' id='b" + std::to_string(i) + "'><ref id='b" +
             std::to_string(i - 1) + "'/></bsdf>";
  }
  EXPECT_THAT(refusal_of("a.xml", chain + "<shape type='disk'><ref id='b499'/></shape></scene>"),
              HasSubstr("elements refer to one another too deep"));

  // Each blend has the one before it twice: 2^50 ways.
  std::string blends = "<scene version='3.0.0'><bsdf type='diffuse' id='b0'/>";
  for (int i = 1; i <= 50; ++i) {
    const std::string ref = "<ref id='b" + std::to_string(i - 1) + "'/>";
    blends += "<bsdf type='blendbsdf' id='b" + std::to_string(i) + "'>" + ref + ref + "</bsdf>";
  }
  EXPECT_EQ(refusal_of("a.xml", blends + "<shape type='disk'><ref id='b50'/></shape></scene>"), "");

  std::string many = "<scene version='3.0.0'>";
  for (int i = 0; i < 1'000'001; ++i) many += "<bsdf/>";
  EXPECT_THAT(refusal_of("a.xml", many + "</scene>"),
              HasSubstr("more than 1000000 elements and attributes"));
}

TEST(MitsubaErrors, DamagedFilesDoNoHarm) {
  expect_no_harm(
      "a.xml",
      "<scene version='3.0.0'><default name='r' value='2'/><sensor type='perspective'>"
      "<float name='fov' value='40'/><transform name='to_world'>"
      "<lookat origin='0,0,5' target='0,0,0' up='0,1,0'/></transform></sensor>"
      "<bsdf type='twosided' id='white'><bsdf type='diffuse'>"
      "<rgb name='reflectance' value='.5,.4,.3'/></bsdf></bsdf>"
      "<shape type='sphere'><float name='radius' value='$r'/><ref id='white'/></shape>"
      "<shape type='rectangle'><transform name='to_world'><rotate x='1' angle='30'/></transform>"
      "<emitter type='area'><spectrum name='radiance' value='400:1, 700:2'/></emitter></shape>"
      "</scene>",
      2000);
}

}  // namespace
}  // namespace isolux
