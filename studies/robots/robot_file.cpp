// A robot's file, and those that it includes, in one text; which format it is.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <vector>

#include "studies/readable.hpp"
#include "studies/robots/mesh.hpp"
#include "studies/robots/robot_formats.hpp"
#include "studies/study.hpp"

namespace gamut {
namespace {

constexpr std::uintmax_t mostBytes = 4'000'000;       // meshes lie in files of their own
constexpr std::uintmax_t mostMeshBytes = 64'000'000;  // of one
constexpr const char* aDescription = "a robot's description (URDF, MJCF or SDFormat)";

/// Or a byte more than `most`.
std::string bytesOf(const std::string& path, std::uintmax_t most) {
  std::ifstream file(path, std::ios::binary);
  std::string text(most + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text;
}

std::string textOfFile(const std::string& path) {
  if (const std::string fault = whyUnreadable(path); !fault.empty()) throw StudyError(path, fault, aDescription);
  std::string text = bytesOf(path, mostBytes);
  if (text.size() > mostBytes)
    throw StudyError(path, fmt::format("has more than {} MB", mostBytes / 1'000'000),
                     std::string(aDescription) + " without meshes");
  return text;
}

/// Takes what a file includes, and what that includes, from the folder of the first file.
class Included {
 public:
  explicit Included(const std::string& path) : folder_(std::filesystem::path(path).parent_path()) {}

  void addFrom(const std::string& text, const std::string& name) {
    std::optional<XmlSource> source;
    try {
      source.emplace(text, name);
    } catch (const StudyError&) {  // the reader will say so
      return;
    }
    const std::string_view format = source->root().Name();
    if (format.starts_with("mujoco")) add(*source, source->root());
    if (format == "robot") addMeshes(source->root());
  }

  const NamedTexts& texts() const { return texts_; }

 private:
  void add(const XmlSource& source, const XmlSource::Element& parent) {
    for (const auto* e = parent.FirstChildElement(); e != nullptr; e = e->NextSiblingElement())
      if (std::string_view(e->Name()) != "include")
        add(source, *e);
      else if (const char* file = e->Attribute("file"); file != nullptr && *file != '\0' && !texts_.contains(file))
        addFile(source, *e, file);
  }

  /// What holds the meshes of <collision>, of files that are at hand.
  void addMeshes(const XmlSource::Element& robot) {
    for (const auto* link = robot.FirstChildElement("link"); link != nullptr; link = link->NextSiblingElement("link"))
      for (const auto* shape = link->FirstChildElement("collision"); shape != nullptr;
           shape = shape->NextSiblingElement("collision")) {
        const auto* form = shape->FirstChildElement("geometry");
        const auto* mesh = form == nullptr ? nullptr : form->FirstChildElement("mesh");
        const char* name = mesh == nullptr ? nullptr : mesh->Attribute("filename");
        if (name != nullptr && *name != '\0' && !texts_.contains(name)) addMesh(name);
      }
  }

  void addMesh(const std::string& name) {
    const std::string path = pathOfMesh(name);
    if (path.empty()) return;
    try {
      const std::string bytes = bytesOf(path, mostMeshBytes);
      if (bytes.size() > mostMeshBytes)
        throw std::invalid_argument(fmt::format("has more than {} MB", mostMeshBytes / 1'000'000));
      if (const std::optional<MeshHull> hull = hullOfMesh(bytes, name)) texts_[name] = writtenHull(*hull);
    } catch (const std::invalid_argument& error) {
      texts_[name] = std::string(brokenMesh) + error.what();
    }
  }

  /// Beside the robot; of a package in one of the folders that this lies in, or that it is. Empty where there is none.
  std::string pathOfMesh(std::string name) const {
    constexpr std::string_view file = "file://", package = "package://";
    if (name.starts_with(file)) name.erase(0, file.size());
    const bool isOfPackage = name.starts_with(package);
    if (isOfPackage) name.erase(0, package.size());
    std::error_code error;
    std::filesystem::path folder = std::filesystem::absolute(folder_ / ".", error).parent_path();
    for (;; folder = folder.parent_path()) {
      std::vector<std::filesystem::path> paths = {folder / name};
      if (isOfPackage) paths.push_back(folder / name.substr(std::min(name.size(), name.find('/') + 1)));
      for (const std::filesystem::path& path : paths)
        if (std::filesystem::is_regular_file(path, error)) return path.string();
      if (!isOfPackage || folder == folder.parent_path()) return {};
    }
  }

  void addFile(const XmlSource& source, const XmlSource::Element& at, const std::string& file) {
    const std::string path = (folder_ / file).string();
    std::string text;
    try {
      text = textOfFile(path);
    } catch (const StudyError& error) {
      source.fail(at.GetLineNum(), error.place() + ": " + error.problem(), error.expected());
    }
    bytes_ += text.size();
    if (bytes_ > mostBytes)
      source.fail(at.GetLineNum(), fmt::format("included files have more than {} MB", mostBytes / 1'000'000),
                  "a robot without meshes");
    addFrom(texts_[file] = std::move(text), path);
  }

  std::filesystem::path folder_;
  NamedTexts texts_;
  std::uintmax_t bytes_ = 0;
};

}  // namespace

std::string textOfRobot(const std::string& path) {
  std::string text = textOfFile(path);
  Included included(path);
  included.addFrom(text, path);
  if (included.texts().empty()) return text;
  NamedTexts all = included.texts();
  all[""] = std::move(text);
  return inOneText(all);
}

Robot readRobotText(const std::string& text, const std::string& name, bool takesShapes) {
  NamedTexts texts;
  if (text.starts_with('{')) try {
      texts = namedTextsIn(text);
    } catch (const std::invalid_argument&) {  // it is no XML either, which is said
    }
  const XmlSource source(texts.contains("") ? texts[""] : text, name);
  texts.erase("");
  const XmlSource::Element& root = source.root();
  const std::string_view word = root.Name();
  if (word == "robot") return readUrdf(source, texts, takesShapes);
  if (word == "mujoco") return readMjcf(source, texts, takesShapes);
  if (word == "sdf") return readSdf(source, takesShapes);
  source.fail(root.GetLineNum(), fmt::format("the outermost element is <{}>", shortened(word)),
              "<robot> (URDF), <mujoco> (MJCF) or <sdf> (SDFormat)");
}

}  // namespace gamut
