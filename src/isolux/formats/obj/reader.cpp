#include "isolux/formats/obj/reader.h"

#include <fmt/format.h>

#include <unordered_map>

#include "isolux/core/error.h"
#include "isolux/core/file.h"
#include "isolux/formats/limits.h"
#include "isolux/formats/obj/geometry.h"
#include "isolux/formats/obj/materials.h"
#include "isolux/formats/statement_reader.h"
#include "isolux/scene/spelling.h"

namespace isolux {
namespace {

/// The faces of one object or group that have one material.
struct Part {
  std::string name;
  Look look;
  TriangleSoup soup;
  std::unordered_map<std::uint32_t, std::uint32_t> points;  ///< the file's number to the soup's
};

class Reader {
 public:
  explicit Reader(const std::filesystem::path& path)
      : includes_(path), assembly_(path.stem().string()) {}

  void read(const SourceText& source);
  SceneFile finish();

 private:
  void read(const Statement& s);
  void read_face(const Statement& s);
  void read_library(const Statement& s);
  void use_material(const Statement& s);
  Part& part();

  Includes includes_;
  Assembly assembly_;
  obj::Vertices vertices_;
  Textures textures_;
  obj::Materials materials_;
  bool has_library_ = false;
  std::string object_, group_;
  Look look_{"unnamed", gray(0.5), {}, true};
  std::map<std::pair<std::string, std::string>, std::size_t> numbers_;  ///< in parts_
  std::vector<Part> parts_;
  Part* part_ = nullptr;  ///< that the next face belongs to; null where not known yet
  Cutting cutting_;
  std::size_t unknown_ = 0;  ///< lines
};

std::string joined(const Statement& s) {
  std::string text;
  for (std::size_t i = 1; i < s.size(); ++i) {
    if (i > 1) text += ' ';
    text += s.word(i);
  }
  return text;
}

Part& Reader::part() {
  if (part_) return *part_;
  const std::string name =
      object_.empty() || group_.empty() ? object_ + group_ : object_ + '/' + group_;
  const auto [number, is_new] = numbers_.try_emplace({name, look_.material}, parts_.size());
  if (is_new) parts_.push_back({name.empty() ? look_.material : name, look_, {}, {}});
  part_ = &parts_[number->second];
  return *part_;
}

void Reader::read_face(const Statement& s) {
  s.expect_arguments(3, Statement::kAnyNumber, "f v1 v2 v3 ...");
  Part& p = part();
  std::vector<std::uint32_t> corners;
  for (std::size_t i = 1; i < s.size(); ++i) {
    const std::uint32_t number = vertices_.corner(s, i);
    const auto [place, is_new] =
        p.points.try_emplace(number, static_cast<std::uint32_t>(p.soup.points.size()));
    if (is_new) p.soup.points.push_back(vertices_.points()[number]);
    corners.push_back(place->second);
  }
  try {
    add_polygon(p.soup, corners, cutting_);
  } catch (const InputError& error) {
    s.fail(0, error.what());
  }
}

void Reader::read_library(const Statement& s) {
  s.expect_arguments(1, Statement::kAnyNumber, "mtllib file ...");
  has_library_ = true;
  const auto read = [&](const SourceText& source) {
    obj::read_materials(source, includes_, textures_, materials_, assembly_.notes());
    includes_.close();
  };
  // One name, perhaps with spaces, else one a word.
  SourceText source;
  try {
    source = includes_.open(joined(s));
  } catch (const InputError& error) {
    if (s.size() == 2) s.fail(1, error.what());
    for (std::size_t i = 1; i < s.size(); ++i) {
      try {
        source = includes_.open(s.word(i));
      } catch (const InputError& fault) {
        s.fail(i, fault.what());
      }
      read(source);
    }
    return;
  }
  read(source);
}

void Reader::use_material(const Statement& s) {
  s.expect_arguments(1, 1, "usemtl name");
  part_ = nullptr;
  if (const auto found = materials_.find(s.word(1)); found != materials_.end()) {
    look_ = found->second;
    return;
  }
  if (has_library_) {
    std::vector<std::string_view> names;
    for (const auto& [name, look] : materials_) names.push_back(name);
    s.fail(1, fmt::format("there is no material {}: {}", in_quotes(s.word(1)),
                          suggestion(s.word(1), names)));
  }
  assembly_.notes().add("materials without a file (mtllib): gray that reflects 0.5");
  look_ = {std::string(s.word(1)), gray(0.5), {}, true};
}

void Reader::read(const Statement& s) {
  const std::string_view word = s.word(0);
  if (word == "v") return vertices_.read(s);
  if (word == "f") return read_face(s);
  if (word == "mtllib") return read_library(s);
  if (word == "usemtl") return use_material(s);
  if (word == "o" || word == "g") {
    part_ = nullptr;
    (word == "o" ? object_ : group_) = joined(s);
    if (word == "o") group_.clear();
    return;
  }
  if (word == "vt" || word == "s") return;
  if (word == "vn") return assembly_.notes().left_out("vn", "faces stay flat");
  if (word == "l" || word == "p") {
    return assembly_.notes().left_out(word == "l" ? "l" : "p", "lines and points have no area");
  }
  if (word == "curv" || word == "surf") {
    return assembly_.notes().left_out(word == "surf" ? "surf" : "curv", "no free-form geometry");
  }
  ++unknown_;
}

void Reader::read(const SourceText& source) {
  StatementReader statements(source);
  while (const auto s = statements.next()) read(*s);
}

SceneFile Reader::finish() {
  assembly_.notes().add("lengths have no unit in OBJ: taken as metres");
  assembly_.notes().add(unknown_, "line", "of unknown words: ignored");
  assembly_.notes().add(cutting_.uncertain, "face", "with sides that cross: cut as a fan");
  for (Part& p : parts_) {
    assembly_.add(p.name, assembly_.mesh(std::move(p.soup), !(max_channel(p.look.exitance) > 0)),
                  p.look);
  }
  return assembly_.finish();
}

}  // namespace

SceneFile read_obj(const std::filesystem::path& path) {
  const SourceText source{path.string(), read_file(path, kLargestMainFile)};
  Reader reader(path);
  reader.read(source);
  try {
    return reader.finish();
  } catch (const InputError& error) {
    throw InputError({source.file}, error.what());
  }
}

}  // namespace isolux
