#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <system_error>

#include "isolux/formats/radiance/reader.h"
#include "isolux/scene/spelling.h"

namespace isolux::radiance {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMostSettings = 100'000;
constexpr std::string_view kNoPerspective = "views that are no plain perspectives: left out";

/// A line "NAME= values" of a project.
struct Setting {
  std::string name;  ///< in small letters
  Statement values;
};

/// Whether the name is that of the variable or its beginning, of at least 3 letters.
bool names(const std::string& name, std::string_view variable) {
  return name.size() >= std::min<std::size_t>(3, variable.size()) && variable.starts_with(name);
}

std::optional<Setting> read_setting(const SourceText& source, const Statement& line) {
  std::vector<Statement::Word> words;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const SourceLocation at = line.location(i);
    words.push_back({line.word(i), at.line, at.column});
  }
  if (words.empty()) return std::nullopt;
  std::string name(words[0].text.substr(0, words[0].text.find('=')));
  const bool apart = name.size() == words[0].text.size();
  const std::size_t holder = apart ? 1 : 0;  // of the '='
  const std::size_t sign = words.size() > holder ? words[holder].text.find('=') : name.npos;
  if (sign == name.npos || (apart && sign > 0)) {
    line.fail(0, "a line of a project is 'NAME= values'");
  }
  words[holder].text.remove_prefix(sign + 1);
  words[holder].column += static_cast<int>(sign) + 1;
  words.erase(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(holder) +
                                 (words[holder].text.empty() ? 1 : 0));
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return Setting{std::move(name), Statement(source.file, std::move(words))};
}

/// The axis that a word such as "Y" or "-z" names; z where it names none.
Vec3 axis_of(std::string_view word) {
  const double sign = word.starts_with('-') ? -1 : 1;
  switch (word.empty() ? 'z' : std::tolower(static_cast<unsigned char>(word.back()))) {
    case 'x':
      return {sign, 0, 0};
    case 'y':
      return {0, sign, 0};
    default:
      return {0, 0, sign};
  }
}

}  // namespace

void Reader::read_project(const SourceText& source) {
  std::vector<Setting> settings;
  Scanner scanner(source);
  while (const auto line = scanner.line()) {
    if (settings.size() == kMostSettings)
      line->fail(0, fmt::format("more than {} settings", kMostSettings));
    if (auto setting = read_setting(source, *line)) settings.push_back(std::move(*setting));
  }
  // In the order in which rad hands the files on; those of OBJECTS the files of the scene name.
  for (const std::string_view variable : {"materials", "illum", "scene"}) {
    for (const Setting& setting : settings) {
      if (names(setting.name, variable)) read_project_files(source, setting.values);
    }
  }
  Vec3 up{0, 0, 1};
  for (const Setting& setting : settings) {
    if (names(setting.name, "up") && setting.values.size() > 0)
      up = axis_of(setting.values.word(0));
  }
  for (const Setting& setting : settings) {
    if (names(setting.name, "view")) read_project_view(setting.values, up);
  }
}

/// Reads files, and commands in quotes.
void Reader::read_project_files(const SourceText& source, const Statement& words) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words.word(i).starts_with('!')) {
      const SourceLocation at = words.location(i);
      read(Scanner(source, {words.word(i), at.line, at.column}), {});
    } else {
      read_file(words, i, {});
    }
  }
}

void Reader::read_project_view(const Statement& words, const Vec3& up) {
  View view;
  view.up = up;
  std::size_t first = 0;
  if (words.size() > 0 && !words.word(0).starts_with('-'))
    view.name = clean_name(words.word(first++));
  read_view(words, first, includes_, view);
  if (!add_camera(view)) notes_.add(std::string(kNoPerspective));
}

bool Reader::add_camera(const View& view) {
  constexpr std::size_t kMostCameras = 100;
  auto& cameras = result_.scene.cameras;
  const auto camera = camera_of(view);
  if (camera && cameras.size() < kMostCameras) cameras.push_back(*camera);
  has_own_view_ |= camera.has_value();
  return camera.has_value();
}

void Reader::add_view_files() {
  constexpr std::uintmax_t kMostBytes = 64 << 10;
  std::vector<fs::path> files;
  std::error_code failure;
  const fs::path folder = file_.has_parent_path() ? file_.parent_path() : fs::path(".");
  fs::directory_iterator entry(folder, failure);
  for (const fs::directory_iterator end; !failure && entry != end; entry.increment(failure)) {
    const fs::path extension = entry->path().extension();
    std::error_code unreadable;
    if ((extension == ".vf" || extension == ".vp") && entry->file_size(unreadable) <= kMostBytes &&
        !unreadable) {
      files.push_back(entry->path().filename());
    }
  }
  const auto is_own = [&](const fs::path& file) { return file.stem() == file_.stem(); };
  std::sort(files.begin(), files.end(), [&](const fs::path& a, const fs::path& b) {
    return is_own(a) != is_own(b) ? is_own(a) : a < b;
  });
  bool own_view = false;
  for (const fs::path& file : files) {
    std::optional<View> view;
    try {
      Includes includes(file_, Includes::Base::main_file);
      view = view_of_file(includes.open(file.string()), includes);
    } catch (const InputError&) {
      view.reset();  // others may stand here too
    }
    if (view) view->name = clean_name(file.stem().string());
    const bool added = view && add_camera(*view);
    if (is_own(file) && !added) notes_.add(std::string(kNoPerspective));
    own_view |= is_own(file) && added;
  }
  has_own_view_ = own_view;
}

}  // namespace isolux::radiance
