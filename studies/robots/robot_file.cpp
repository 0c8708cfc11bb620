// A robot's file, and those that it includes, in one text; which format it is.
#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>

#include "studies/readable.hpp"
#include "studies/robots/robot_formats.hpp"
#include "studies/study.hpp"

namespace gamut {
namespace {

constexpr std::uintmax_t mostBytes = 4'000'000;  // meshes lie in files of their own
constexpr const char* aDescription = "a robot's description (URDF, MJCF or SDFormat)";

std::string textOfFile(const std::string& path) {
  if (const std::string fault = whyUnreadable(path); !fault.empty()) throw StudyError(path, fault, aDescription);
  std::ifstream file(path, std::ios::binary);
  std::string text(mostBytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
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
      if (!std::string_view(source->root().Name()).starts_with("mujoco")) return;
    } catch (const StudyError&) {  // the reader will say so
      return;
    }
    add(*source, source->root());
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
  if (word == "robot") return readUrdf(source, takesShapes);
  if (word == "mujoco") return readMjcf(source, texts, takesShapes);
  if (word == "sdf") return readSdf(source, takesShapes);
  source.fail(root.GetLineNum(), fmt::format("the outermost element is <{}>", shortened(word)),
              "<robot> (URDF), <mujoco> (MJCF) or <sdf> (SDFormat)");
}

}  // namespace gamut
