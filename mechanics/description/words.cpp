// A visitor that only listens.
#include "mechanics/description/words.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace gamut {
namespace {

class Listener final : public Fields {
 public:
  Listener(ElementWords& words, Coordinate kind) : words_(words), kind_(kind) {}

  void frame(const Word& word, std::string& /*name*/) override { required(word); }
  /// One that has the element's own name is said with that.
  void movedFrame(const Word& word, std::string& /*name*/, const std::string& /*from*/) override {
    if (word.key != "name") required(word);
  }
  void choice(const Word& word, std::string& /*value*/, const std::vector<std::string>& /*choices*/) override {
    key(word);
  }
  void axis(const Word& word, Axis& /*axis*/) override { key(word); }
  void rotations(const Word& word, std::vector<FixedRotation>& /*rotations*/) override { key(word); }
  void count(const Word& word, std::size_t& /*number*/, std::size_t /*most*/) override { key(word); }
  void number(const Word& word, Expression& /*number*/) override { key(word); }
  void numbers(const Word& word, std::span<Expression> /*numbers*/, std::span<const char* const> /*names*/,
               std::size_t /*least*/) override {
    key(word);
  }
  void points(const Word& word, std::vector<ExpressionVector>& /*points*/) override { key(word); }
  void coordinate(const Word& position, Expression& /*initial*/, Coordinate /*kind*/, const Word& rate,
                  Expression& /*initialRate*/) override {
    initial(position, "0");
    initial(rate, "0");
  }
  void coordinates(const Word& position, ExpressionVector& /*initial*/, Coordinate /*kind*/, const Word& rate,
                   ExpressionVector& /*initialRates*/) override {
    initial(position, "[0, 0, 0]");
    initial(rate, "[0, 0, 0]");
  }
  void orientation(const Word& word, std::vector<FixedRotation>& /*initial*/, const Word& rate,
                   ExpressionVector& /*initialRates*/) override {
    initial(word, "{ axis = \"x\", angle = \"0 deg\" }");
    initial(rate, "[0, 0, 0]");
  }
  void position(const Word& word, Expression& /*initial*/) override { initial(word, "0"); }
  void speed(const Word& word, Expression& /*initial*/) override { initial(word, "0"); }
  std::string state(const Word& word, Expression& /*initial*/) override {
    key(word);
    return "unit";
  }
  Coordinate coordinateOf(const Word& word, std::string& /*name*/) override {
    required(word);
    return kind_;
  }
  void dependentCoordinates(const Word& word, std::vector<std::string>& /*names*/, const Loop& /*loop*/) override {
    key(word);
  }
  void table(const Word& file, const Word& column, Coordinate /*kind*/, TimeTable& /*table*/) override {
    key(file);
    key(column);
  }
  void timeFunction(const Word& word, Expression& /*number*/) override { key(word); }
  void signal(const Word& word, Expression& /*number*/) override { key(word); }
  void signals(const Word& word, ExpressionVector& /*vector*/) override { key(word); }
  void measure(const Word& word) override { words_.measured.push_back(word); }

 private:
  void key(const Word& word) { words_.keys.push_back({word}); }
  void required(Word word) {
    word.isRequired = true;
    key(word);
  }
  void initial(const Word& word, const char* example) { words_.keys.push_back({word, true, example}); }

  ElementWords& words_;
  Coordinate kind_;
};

/// "N m/rad or N/m" where the two differ.
std::string eitherUnit(const std::string& turning, const std::string& sliding) {
  return turning == sliding ? turning : turning + " or " + sliding;
}

}  // namespace

ElementWords wordsOf(Described element, Coordinate kind) {
  ElementWords words;
  Listener listener(words, kind);
  element.describe(listener);
  return words;
}

std::string elementPage(const std::vector<Described>& types) {
  std::string page;
  for (const Described& type : types) {
    const ElementWords turning = wordsOf(type), sliding = wordsOf(type, Coordinate::displacement);
    page += fmt::format("### `{}`\n\n{}.\n\n| key | unit | meaning |\n|---|---|---|\n", type.type(), type.summary());
    for (std::size_t i = 0; i < turning.keys.size(); ++i) {
      const auto& [word, isInitial, example] = turning.keys[i];
      const std::string meaning =
          word.isRequired ? fmt::format("{}{}required", word.meaning, word.meaning.empty() ? "" : "; ") : word.meaning;
      page += fmt::format("| `{}{}` | {} | {} |\n", isInitial ? "initial." : "", word.key,
                          eitherUnit(word.unit, sliding.keys[i].word.unit), meaning);
    }
    if (!turning.measured.empty()) page += "\nIt measures:";
    for (std::size_t i = 0; i < turning.measured.size(); ++i) {
      const Word& word = turning.measured[i];
      page += fmt::format("{} `NAME.{}` ({}), {}", i == 0 ? "" : ";", word.key,
                          eitherUnit(word.unit, sliding.measured[i].unit), word.meaning);
    }
    page += turning.measured.empty() ? "\n" : ".\n\n";
  }
  return page;
}

}  // namespace gamut
