// gamut quantities: what of a study's mechanism can be uncertain, and what can be looked at, each with its value at the
// start. The study need not be written further than that.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "commands/files.hpp"
#include "commands/options.hpp"
#include "commands/standard_streams.hpp"
#include "commands/table.hpp"
#include "reports/text_table.hpp"
#include "studies/known_quantities.hpp"
#include "studies/study.hpp"
#include "studies/words.hpp"

namespace gamut::commands {
namespace {

struct QuantitiesArguments {
  std::string study;
  bool json = false;
};

/// With their values at the start.
std::vector<KnownQuantity> outputsOf(const Mechanism& mechanism, const std::string& study) try {
  return measurableOf(mechanism);
} catch (const std::invalid_argument& error) {
  throw UsageError(study + ": " + error.what());
}

std::string text(std::string_view title, const std::vector<KnownQuantity>& quantities, const char* instead) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& [name, unit, nominal] : quantities)
    rows.push_back(
        {name, std::isfinite(nominal) ? inUnit(fmt::format("{:.12g}", nominal), unit) : "has no value at the start"});
  return fmt::format("{}\n{}", title, rows.empty() ? instead : textTable(rows, 2));
}

std::string json(const std::vector<KnownQuantity>& numbers, const std::vector<KnownQuantity>& outputs) {
  using Json = nlohmann::ordered_json;
  const auto list = [](const std::vector<KnownQuantity>& quantities) {
    Json array = Json::array();
    for (const KnownQuantity& q : quantities)
      array.push_back({{"quantity", q.name},
                       {"unit", q.unit},
                       {"nominal", std::isfinite(q.nominal) ? Json(q.nominal) : Json(nullptr)}});
    return array;
  };
  return Json{{"uncertain", list(numbers)}, {"output", list(outputs)}}.dump() + "\n";
}

ExitCode list(const QuantitiesArguments& arguments) {
  const StudyText study = readStudyFile(arguments.study);
  const Mechanism mechanism = readMechanismText(study.text, study.name);
  const std::vector<KnownQuantity> numbers = numbersOf(mechanism), outputs = outputsOf(mechanism, study.name);
  sayOut(arguments.json ? json(numbers, outputs)
                        : text("What can be uncertain, with its nominal value:", numbers, "  nothing\n") + "\n" +
                              text("What can be an output, with its value at the start:", outputs,
                                   "  nothing moves: any formula of the numbers above, such as \"a - 2*b\"\n"));
  return done;
}

}  // namespace

Action quantities(CLI::App& command) {
  const auto arguments = std::make_shared<QuantitiesArguments>();
  addStudy(command, arguments->study);
  command.add_flag("--json", arguments->json, "One JSON object, for programs");
  return [arguments] { return list(*arguments); };
}

}  // namespace gamut::commands
