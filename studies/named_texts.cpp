// As JSON, which every program can read.
#include "studies/named_texts.hpp"

#include <nlohmann/json.hpp>
#include <stdexcept>

namespace gamut {

std::string inOneText(const NamedTexts& texts) {
  // Bytes that are no UTF-8 are nobody's numbers: where they stand, the reader of tables has refused them.
  return texts.empty() ? "" : nlohmann::json(texts).dump(1, ' ', false, nlohmann::json::error_handler_t::replace);
}

NamedTexts namedTextsIn(const std::string& text) {
  if (text.empty()) return {};
  try {
    return nlohmann::json::parse(text).get<NamedTexts>();
  } catch (const nlohmann::json::exception&) {
    throw std::invalid_argument("its tables are no JSON object of texts");
  }
}

}  // namespace gamut
