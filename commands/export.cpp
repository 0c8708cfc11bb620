// gamut export: results as tables, for spreadsheets and programs that read CSV; one on standard output, or all of them
// in a folder, which is there whole or not at all.
#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <stdio.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "commands/options.hpp"
#include "commands/standard_streams.hpp"
#include "commands/table.hpp"
#include "mechanics/description/names.hpp"
#include "reports/tables.hpp"
#include "reports/text_table.hpp"
#include "studies/atomic_file.hpp"
#include "studies/printable.hpp"
#include "studies/results/results_file.hpp"

namespace gamut::commands {
namespace {

namespace fs = std::filesystem;

struct ExportArguments {
  std::string results, folder, table;
  bool force = false;
};

/// A folder that becomes `path` when all is in it, under another name beside it until then.
class OutputFolder {
 public:
  /// Throws OutputRefused if something is there that is to be kept, WriteError if no folder can be made.
  OutputFolder(std::string path, bool force) : path_(std::move(path)) {
    fs::path target = fs::path(path_).lexically_normal();
    if (!target.has_filename()) target = target.parent_path();
    target_ = fs::absolute(target);
    checkTarget(force);
    removeAbandoned();
    part_ = target_.parent_path() / (prefix() + std::to_string(::getpid()));
    std::error_code error;
    if (!fs::create_directory(part_, error)) fail(error ? error.message() : "it is being written");
  }
  /// Without finish() nothing is left behind.
  ~OutputFolder() {
    std::error_code ignored;
    fs::remove_all(part_, ignored);
  }
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  void add(const std::string& name, const std::string& content) const {
    try {
      replaceFile((part_ / name).string(), content);
    } catch (const WriteError& error) {
      const std::string what = error.what();
      fail(what.substr(std::min(what.size(), what.rfind("; ") + 2)));
    }
  }

  /// In one step, where the file system can.
  void finish() const {
    std::error_code error;
    if (!fs::exists(target_, error)) {
      fs::rename(part_, target_, error);
      if (error) fail(error.message());
      return;
    }
    if (::renameat2(AT_FDCWD, part_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) != 0)
      fail(std::strerror(errno));  // what was there is as it was
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw WriteError(fmt::format("{}: cannot be written; {}", path_, why));
  }

  std::string prefix() const { return fmt::format(".{}.gamut-part.", target_.filename().string()); }

  /// A folder of tables alone may be replaced.
  void checkTarget(bool force) const {
    std::error_code error;
    if (!fs::is_directory(target_.parent_path(), error))
      throw OutputRefused(
          fmt::format("{}: cannot be written; there is no folder {}", path_, target_.parent_path().string()));
    if (!fs::exists(fs::symlink_status(target_, error))) return;
    if (!fs::is_directory(fs::symlink_status(target_, error)))
      throw OutputRefused(path_ + ": cannot be written; it is there and no folder");
    if (!force) throw OutputRefused(path_ + ": exists already; expected another name, or --force");
    for (const fs::directory_entry& entry : fs::directory_iterator(target_))
      if (entry.path().extension() != ".csv" || !entry.is_regular_file())
        throw OutputRefused(fmt::format("{}: is not replaced, as it holds {}, which is no table; expected another name",
                                        path_, printable(entry.path().filename().string())));
  }

  /// What a program that was killed left.
  void removeAbandoned() const {
    std::error_code error;
    std::vector<fs::path> abandoned;
    for (const fs::directory_entry& entry : fs::directory_iterator(target_.parent_path(), error)) {
      const std::string name = entry.path().filename().string();
      if (!name.starts_with(prefix())) continue;
      const int writer = std::atoi(name.c_str() + prefix().size());
      if (writer > 0 && ::kill(writer, 0) != 0 && errno == ESRCH) abandoned.push_back(entry.path());
    }
    for (const fs::path& path : abandoned) fs::remove_all(path, error);
  }

  std::string path_;
  fs::path target_, part_;
};

std::string listOf(const std::vector<ResultTable>& tables) {
  std::vector<std::vector<std::string>> rows = {{"table", "rows", "columns", "of"}};
  for (const ResultTable& table : tables)
    rows.push_back({table.name, std::to_string(table.rows), std::to_string(table.columns), table.meaning});
  return textTable(rows, 4);
}

ExitCode sayTables(const ExportArguments& arguments) {
  if (!arguments.table.empty() && !arguments.folder.empty())
    throw UsageError("--table and --csv at a time; expected one of them");
  const Results results = readResults(arguments.results);
  const std::vector<ResultTable> tables = tablesOf(results);
  if (!arguments.folder.empty()) {
    const OutputFolder folder(arguments.folder, arguments.force);
    for (const ResultTable& table : tables) folder.add(table.name + ".csv", table.csv());
    folder.finish();
    fmt::print("{}: {} tables\n", printable(arguments.folder), tables.size());
    return done;
  }
  if (arguments.table.empty()) {
    sayOut(listOf(tables));
    return done;
  }
  const auto table = std::ranges::find(tables, arguments.table, &ResultTable::name);
  if (table == tables.end()) {
    std::vector<std::string> names;
    for (const ResultTable& one : tables) names.push_back(one.name);
    throw UsageError(fmt::format("{}: holds no table '{}'; expected {}", arguments.results, printable(arguments.table),
                                 expectedName(arguments.table, names)));
  }
  sayOut(table->csv());
  return done;
}

}  // namespace

Action exportTables(CLI::App& command) {
  const auto arguments = std::make_shared<ExportArguments>();
  addResults(command, arguments->results);
  command.add_option("--csv", arguments->folder, "All tables, in a folder of this name")->type_name("FOLDER");
  command.add_option("--table", arguments->table, "One table, on standard output")->type_name("TABLE");
  command.add_flag("--force", arguments->force, "Overwrite an existing folder of tables");
  command.footer("Without --csv and --table the tables that there are.");
  return [arguments] { return sayTables(*arguments); };
}

}  // namespace gamut::commands
