#pragma once

#include <set>

#include "isolux/formats/assembly.h"
#include "isolux/formats/mitsuba/document.h"
#include "isolux/formats/texture.h"

namespace isolux::mitsuba {

/// Makes a scene of the elements of a file.
class Builder {
 public:
  Builder(const SourceText& source, const std::filesystem::path& path)
      : includes_(path, Includes::Base::main_file),
        document_(source, includes_),
        assembly_(path.stem().string()) {}

  void read() { add_scene(document_.root()); }
  SceneFile finish();

 private:
  /// What becomes of a BSDF.
  struct Finish {
    std::string name = "unnamed";
    Rgb reflectance = gray(0.5);
    bool two_sided = false;
    bool clear = false;  ///< light passes as if nothing were there
  };
  struct Part {
    std::string name;
    std::shared_ptr<const Shape> shape;
    Look look;
  };
  class Entered;

  void add_scene(const Element& scene);
  void add_shape(const Element& shape);
  void add_instance(const Element& shape);
  void add_emitter(const Element& emitter);
  void add_sensor(const Element& sensor);
  /// The surface of a shape, with its look; null where it is left out.
  Part part(const Element& shape);
  const std::vector<Part>& parts_of_group(const Element& group);
  std::shared_ptr<const Shape> surface(const Element& shape, bool two_sided);
  std::shared_ptr<const Shape> mesh(const Element& shape, const Affine& map, bool flipped,
                                    bool two_sided);

  /// The first child, or the first that a child refers to, with that tag; null where there is none.
  const Element* child(const Element& object, std::string_view tag) const;
  Finish finish_of(const Element& bsdf);
  Finish new_finish(const Element& bsdf);
  Finish blend(const Element& bsdf);
  /// The colour that a parameter says, or the mean of its texture.
  Rgb color(const Element& object, std::string_view name, double otherwise);
  Rgb mean(const Element& texture);
  Rgb new_mean(const Element& texture);

  Includes includes_;
  Document document_;
  Assembly assembly_;
  Textures images_;
  std::set<const Element*> entered_;  ///< BSDFs and textures that are being looked at
  std::map<const Element*, Finish> finishes_;
  std::map<const Element*, Rgb> means_;
  std::map<const Element*, std::vector<Part>> groups_;
};

}  // namespace isolux::mitsuba
