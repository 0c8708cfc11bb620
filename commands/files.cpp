// Notes go to standard error: they are no answer.
#include "commands/files.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "commands/options.hpp"
#include "commands/preparation.hpp"
#include "commands/standard_streams.hpp"
#include "studies/running/dead_point.hpp"

namespace gamut {

StudyText readStudyFile(const std::string& path) {
  if (path != "-") return {textOfStudy(path), path};
  const std::string name = "standard input";
  try {
    return {readIn(), name};
  } catch (const ReadError& error) {
    throw StudyError(name, fmt::format("cannot be read ({})", error.what()), "a study file (TOML)");
  }
}

std::string nameOfStudy(const std::string& path) {
  if (path == "-") return "study";
  const std::filesystem::path file = std::filesystem::absolute(path);
  return file.stem() == "study" && file.has_parent_path() && file.parent_path().has_filename()
             ? file.parent_path().filename().string()
             : file.stem().string();
}

Machine readMachine(const std::string& path, bool isQuiet, std::optional<double> timeLimit) {
  const auto [text, name] = readStudyFile(path);
  Machine machine = prepared(readStudyText(text, name), isQuiet, timeLimit);
  if (isQuiet) return machine;
  for (const std::string& note : machine.study.notes) fmt::print(stderr, "{}\n", note);
  if (const std::string note = noteOfDeadPoint(machine.study); !note.empty()) fmt::print(stderr, "{}\n", note);
  return machine;
}

Study studyOf(const Results& results, const std::string& path) {
  FilesAtHand files{results.robotText, {}};
  try {
    files.tables = namedTextsIn(results.tablesText);
  } catch (const std::invalid_argument& error) {
    throw UsageError(path + ": " + error.what());
  }
  return readStudyText(results.studyText, results.studyFile + " in " + path, elementTypes(), files);
}

std::string pageBeside(const std::string& results, const std::string& asked) {
  namespace fs = std::filesystem;
  const std::string page = asked.empty() ? fs::path(results).replace_extension(".html").string() : asked;
  if (fs::absolute(results).lexically_normal() == fs::absolute(page).lexically_normal())
    throw UsageError(page + ": is both results and report; expected two names");
  return page;
}

std::string shellQuoted(const std::string& path) {
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-+/,:@%";
  if (path.find_first_not_of(plain) == std::string::npos) return path;
  std::string result = "'";
  for (const char c : path) result += c == '\'' ? "'\\''" : std::string(1, c);
  return result + "'";
}

OutputFile reserve(const std::string& path, const std::string& input, bool force) {
  std::error_code error;
  if (std::filesystem::equivalent(path, input, error)) throw UsageError(path + ": cannot be written; it is the input");
  return {path, force ? OutputFile::Existing::isReplaced : OutputFile::Existing::isKept};
}

}  // namespace gamut
