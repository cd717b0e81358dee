#include <fmt/format.h>

#include <numbers>

#include "isolux/formats/limits.h"
#include "isolux/formats/rayshade/parser.h"
#include "isolux/scene/spelling.h"

namespace isolux::rayshade {
namespace {

constexpr int kDeepest = 100;  ///< of groups and references in each other

struct GroupKind {
  std::string_view word;
  std::optional<CsgOperation> operation;
};

constexpr GroupKind kGroups[] = {{"list", std::nullopt},
                                 {"grid", std::nullopt},
                                 {"union", CsgOperation::unite},
                                 {"intersect", CsgOperation::intersect},
                                 {"difference", CsgOperation::subtract}};

const GroupKind* find_group(std::string_view word) {
  for (const GroupKind& kind : kGroups) {
    if (kind.word == word) return &kind;
  }
  return nullptr;
}

/// Whether a node is nothing but triangles, so that the next may join them.
Facets* loose_triangles(Node& node) {
  Facets* facets = std::get_if<Facets>(&node.geometry);
  return facets && !facets->polygon && !node.map && node.name.empty() ? facets : nullptr;
}

/// Puts a node among others; triangles of one surface in a row become one mesh.
void add_member(std::vector<std::shared_ptr<Node>>& members, std::shared_ptr<Node> node) {
  Facets* more = loose_triangles(*node);
  Facets* last = more && !members.empty() ? loose_triangles(*members.back()) : nullptr;
  if (!last || members.back()->surface != node->surface) {
    members.push_back(std::move(node));
    return;
  }
  const auto first = static_cast<std::uint32_t>(last->soup.points.size());
  last->soup.points.insert(last->soup.points.end(), more->soup.points.begin(),
                           more->soup.points.end());
  for (auto triangle : more->soup.triangles) {
    for (std::uint32_t& corner : triangle) corner += first;
    last->soup.triangles.push_back(triangle);
  }
}

/// What a node holds, whichever kind it is.
std::vector<NodePtr> parts(const Node& node) {
  if (const auto* group = std::get_if<Group>(&node.geometry)) return group->members;
  if (const auto* reference = std::get_if<Reference>(&node.geometry)) return {reference->target};
  return {};
}

}  // namespace

bool Parser::starts_object(const Token& token) {
  return token.is("object") || (token.kind == Token::Kind::word &&
                                (find_group(token.text) || primitives().contains(token.text)));
}

std::vector<std::string_view> Parser::object_words() {
  std::vector<std::string_view> words = {"surface", "applysurf", "name", "object"};
  for (const GroupKind& kind : kGroups) words.push_back(kind.word);
  for (const auto& [word, primitive] : primitives()) words.push_back(word);
  return words;
}

bool Parser::object_item(Members& members) {
  if (tokens_.accept("surface")) {
    surface_definition();
  } else if (tokens_.accept("applysurf")) {
    current_.back() = surface();
  } else if (tokens_.accept("name")) {
    const std::string name = tokens_.name("the name of an object");
    if (!starts_object(tokens_.peek())) {
      fail(tokens_.peek().place, fmt::format("an object must follow the name {}", in_quotes(name)));
    }
    const std::shared_ptr<Node> node = object();
    node->name = name;
    named_.insert_or_assign(name, node);
  } else if (starts_object(tokens_.peek())) {
    auto node = object();
    const Facets* facets = std::get_if<Facets>(&node->geometry);
    const bool empty = facets && facets->soup.triangles.empty();
    if (!empty) add_member(members, std::move(node));
  } else {
    return false;
  }
  return true;
}

std::shared_ptr<Node> Parser::object() {
  const auto node = std::make_shared<Node>();
  const Token token = tokens_.take();
  node->place = token.place;
  if (token.is("object")) {
    reference(*node);
  } else if (const GroupKind* kind = find_group(token.text)) {
    node->word = kind->word;
    node->geometry = Group{kind->operation, {}};
    group(*node);
  } else {
    const auto found = primitives().find(token.text);
    node->word = found->first;
    if (node->word != "heightfield") node->surface = optional_surface();
    (this->*found->second)(*node);
  }
  node->map = transforms();
  skip_textures();
  finish(*node);
  return node;
}

void Parser::group(Node& node) {
  Group& group = std::get<Group>(node.geometry);
  if (current_.size() > kDeepest) {
    fail(node.place, fmt::format("groups nested more than {} deep", kDeepest));
  }
  if (node.word == "grid") tokens_.skip_numbers(3);
  current_.push_back(nullptr);
  Members members;
  while (!tokens_.accept("end")) {
    if (tokens_.peek().kind == Token::Kind::end) {
      fail(node.place, fmt::format("this {} lacks its 'end'", in_quotes(node.word)));
    }
    if (!object_item(members)) unknown_word(true);
  }
  current_.pop_back();
  node.surface = current_.back();
  if (group.operation && members.size() < 2) {
    fail(node.place, fmt::format("{} needs two objects at least", in_quotes(node.word)));
  }
  group.members.assign(members.begin(), members.end());
}

void Parser::reference(Node& node) {
  node.surface = surface_before_name();
  const Place place = tokens_.peek().place;
  const std::string name = tokens_.name("the name of an object");
  const auto found = named_.find(name);
  if (found == named_.end()) {
    std::vector<std::string_view> known;
    for (const auto& [other, target] : named_) known.push_back(other);
    fail(place, fmt::format("no object is named {}: {}", in_quotes(name), suggestion(name, known)));
  }
  node.word = found->second->word;
  node.geometry = Reference{found->second};
  mentioned_.insert(found->second.get());
}

void Parser::finish(Node& node) {
  const std::vector<NodePtr> held = parts(node);
  if (!held.empty()) node.leaves = 0;
  for (const NodePtr& part : held) {
    node.leaves += part->leaves;
    node.depth = std::max(node.depth, part->depth + 1);
    node.has_planes |= part->has_planes;
    if (node.leaves > kMostObjects) {
      fail(node.place, fmt::format("more than {} objects, counting each mention", kMostObjects));
    }
  }
  node.has_planes |= std::holds_alternative<Plane>(node.geometry);
  if (node.depth > kDeepest) {
    fail(node.place, fmt::format("objects nested more than {} deep", kDeepest));
  }
}

std::optional<Affine> Parser::transforms() {
  std::optional<Affine> map;
  for (;;) {
    const Token& next = tokens_.peek();
    const bool another =
        next.is("translate") || next.is("rotate") || next.is("scale") || next.is("transform");
    if (!another) return map;
    const Token token = tokens_.take();
    map = transform(token.text) * map.value_or(Affine{});
    if (!map->inverse() || !is_finite(map->translation)) {
      fail(token.place,
           fmt::format("{} flattens the object, or stretches it too much", in_quotes(token.text)));
    }
  }
}

Affine Parser::transform(std::string_view word) {
  const Place place = tokens_.peek().place;
  const Vec3 first = tokens_.vector();
  if (word == "translate") return Affine::translate(first);
  if (word == "scale") return Affine::scale(first);
  if (word == "rotate") {
    if (!(length(first) > 0) || !std::isfinite(length(first))) {
      fail(place, "the axis of 'rotate' must not be 0");
    }
    return Affine::rotate(first, std::fmod(tokens_.number(), 360.0) * std::numbers::pi / 180);
  }
  // Points are rows that the matrix stands behind: its rows are the columns of ours.
  const Vec3 second = tokens_.vector(), third = tokens_.vector();
  Affine map;
  for (int i = 0; i < 3; ++i) map.linear[i] = {first[i], second[i], third[i]};
  if (tokens_.number_follows()) map.translation = tokens_.vector();
  return map;
}

}  // namespace isolux::rayshade
