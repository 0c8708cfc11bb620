// A file of tolerances: numbers for all outputs, then a table for each output that has its own.
#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <optional>

#include "studies/readable.hpp"
#include "studies/reading/toml_source.hpp"
#include "studies/tolerances.hpp"

namespace gamut {
namespace {

constexpr const char* expectedFile = "a file of tolerances (TOML)";

/// A plain number or per cent, 0 or more.
std::optional<double> share(const TomlSection& section, std::string_view key) {
  const toml::node* node = section.find(key);
  if (node == nullptr) return std::nullopt;
  const double value = nearest(section.source().asAmount(*node, section.nameOf(key), Dimension{}));
  if (value < 0)
    section.source().fail(*node, section.nameOf(key) + " is negative", "0 or more, such as 0.01 or \"1 %\"");
  return value;
}

/// What the table states; the rest stays.
void read(const TomlSection& section, OutputTolerances& tolerances) {
  tolerances.wider = share(section, "wider").value_or(tolerances.wider);
  tolerances.gap = share(section, "gap").value_or(tolerances.gap);
  if (const auto stated = share(section, "overestimation")) tolerances.overestimation = stated;
}

}  // namespace

Tolerances readTolerancesText(const std::string& text, const std::string& name,
                              const std::vector<std::string>& outputs) {
  const TomlSource source(text, name, expectedFile);
  const TomlSection file(source, source.root(), "", {"wider", "gap", "overestimation", "shorter", "cpu", "output"});
  Tolerances tolerances;
  read(file, tolerances);
  tolerances.shorter = share(file, "shorter").value_or(tolerances.shorter);
  if (file.find("cpu") != nullptr) tolerances.cpu = file.positive("cpu", 1);
  const toml::node* node = file.find("output");
  if (node == nullptr) return tolerances;
  const TomlSection tables(source, source.asTable(*node, "output"), "output", outputs);
  for (const auto& [key, value] : tables.table()) {
    const std::string output(key.str()), place = fmt::format("output.\"{}\"", output);
    const TomlSection section(source, source.asTable(value, place), place, {"wider", "gap", "overestimation"});
    read(section, tolerances.of.emplace(output, tolerances).first->second);
  }
  return tolerances;
}

Tolerances readTolerances(const std::string& path, const std::vector<std::string>& outputs) {
  if (const std::string fault = whyUnreadable(path); !fault.empty()) throw StudyError(path, fault, expectedFile);
  std::ifstream file(path, std::ios::binary);
  return readTolerancesText({std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()}, path, outputs);
}

}  // namespace gamut
