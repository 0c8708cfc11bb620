// What a study names stands in quotes; names of files that are not there yet are watched too, so that a fault of that
// kind goes when they come.
#include "commands/watched_files.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <string_view>
#include <utility>

namespace gamut {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t mostText = 4 << 20;  // bytes of a study that are looked through
constexpr std::size_t mostFiles = 64;

bool endsWithAny(std::string_view text, std::initializer_list<std::string_view> ends) {
  return text.size() < 1024 && std::ranges::any_of(ends, [&](std::string_view end) { return text.ends_with(end); });
}
bool mayBeRobot(std::string_view text) { return endsWithAny(text, {".urdf", ".xml", ".mjcf", ".sdf", ".world"}); }
bool mayBeFile(std::string_view text) {
  return mayBeRobot(text) || endsWithAny(text, {".csv", ".txt", ".dat", ".tsv", ".stl", ".STL", ".obj", ".OBJ"});
}

/// A mesh "package://arm/mesh.stl" is looked for beside the robot.
std::string withoutScheme(const std::string& name) {
  constexpr std::string_view file = "file://", package = "package://";
  if (name.starts_with(file)) return name.substr(file.size());
  if (!name.starts_with(package)) return name;
  const std::size_t slash = name.find('/', package.size());
  return slash == std::string::npos ? std::string() : name.substr(slash + 1);
}

std::vector<std::string> namedIn(const std::string& text) {
  std::vector<std::string> names;
  for (std::size_t begin = 0;
       (begin = text.find_first_of("\"'", begin)) != std::string::npos && names.size() < mostFiles;) {
    const std::size_t end = text.find_first_of(std::string{text[begin], '\n'}, begin + 1);
    if (end == std::string::npos) break;
    if (const std::string name = text.substr(begin + 1, end - begin - 1); text[end] == text[begin] && mayBeFile(name))
      names.push_back(name);
    begin = end + 1;
  }
  return names;
}

}  // namespace

WatchedFiles::WatchedFiles(std::string study) : study_(std::move(study)) {
  nameFiles();
  settled_ = seen_ = looks();
}

bool WatchedFiles::haveChanged() {
  std::vector<Look> now = looks();
  if (now != seen_) {
    seen_ = std::move(now);
    return false;
  }
  if (seen_ == settled_) return false;
  nameFiles();
  settled_ = seen_ = looks();
  return true;
}

/// A study that is not there names what it did.
void WatchedFiles::nameFiles() {
  std::ifstream file(study_, std::ios::binary);
  if (!file && !files_.empty()) return;
  files_.assign(1, study_);
  constexpr int deepest = 3;  // a robot that includes another, with meshes
  nameFilesIn(study_, deepest);
}

void WatchedFiles::nameFilesIn(const std::string& path, int deepest) {
  std::ifstream file(path, std::ios::binary);
  std::string text(mostText, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
  for (const std::string& name : namedIn(text)) {
    const std::string named = (fs::path(path).parent_path() / withoutScheme(name)).string();
    if (files_.size() > mostFiles || std::ranges::find(files_, named) != files_.end()) continue;
    files_.push_back(named);
    if (deepest > 1 && mayBeRobot(named)) nameFilesIn(named, deepest - 1);
  }
}

WatchedFiles::Look WatchedFiles::lookAt(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return {};
  const auto whole = [](auto number) { return static_cast<std::uint64_t>(number); };
  return {whole(status.st_dev), whole(status.st_ino), whole(status.st_size), whole(status.st_mtim.tv_sec),
          whole(status.st_mtim.tv_nsec)};
}

std::vector<WatchedFiles::Look> WatchedFiles::looks() const {
  std::vector<Look> found;
  for (const std::string& file : files_) found.push_back(lookAt(file));
  return found;
}

}  // namespace gamut
