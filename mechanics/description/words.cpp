// A visitor that only listens.
#include "mechanics/description/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace gamut {
namespace {

class Listener final : public Fields {
 public:
  Listener(ElementWords& words, Coordinate kind) : words_(words), kind_(kind) {}

  void frame(const Word& word, std::string& /*name*/) override { required(word, Kind::name); }
  /// One that has the element's own name is said with that.
  void movedFrame(const Word& word, std::string& /*name*/, const std::string& /*from*/) override {
    if (word.key != "name") required(word, Kind::name);
  }
  void choice(const Word& word, std::string& /*value*/, const std::vector<std::string>& choices) override {
    key(word, {Kind::word, choices});
  }
  void axis(const Word& word, Axis& /*axis*/) override { key(word, {Kind::direction}); }
  void rotations(const Word& word, std::vector<FixedRotation>& /*rotations*/) override { key(word, {Kind::rotation}); }
  void count(const Word& word, std::size_t& /*number*/, std::size_t most) override {
    key(word, {Kind::whole, {}, 0, most});
  }
  void number(const Word& word, Expression& /*number*/) override { key(word, {Kind::number}); }
  void numbers(const Word& word, std::span<Expression> numbers, std::span<const char* const> /*names*/,
               std::size_t least) override {
    key(word, {Kind::numbers, {}, least, numbers.size()});
  }
  void points(const Word& word, std::vector<ExpressionVector>& /*points*/) override { key(word, {Kind::points}); }
  void coordinate(const Word& position, Expression& initial, Coordinate /*kind*/, const Word& rate,
                  Expression& initialRate) override {
    this->position(position, initial);
    speed(rate, initialRate);
  }
  void coordinates(const Word& position, ExpressionVector& /*initial*/, Coordinate /*kind*/, const Word& rate,
                   ExpressionVector& /*initialRates*/) override {
    initial(position, three_, "[0, 0, 0]");
    initial(rate, three_, "[0, 0, 0]");
  }
  void orientation(const Word& word, std::vector<FixedRotation>& /*initial*/, const Word& rate,
                   ExpressionVector& /*initialRates*/) override {
    initial(word, {Kind::rotation}, "{ axis = \"x\", angle = \"0 deg\" }");
    initial(rate, three_, "[0, 0, 0]");
  }
  void position(const Word& word, Expression& /*initial*/) override { initial(word, {Kind::number}, "0"); }
  void speed(const Word& word, Expression& initial) override { position(word, initial); }
  std::string state(const Word& word, Expression& /*initial*/) override {
    key(word, {Kind::number});
    return "unit";
  }
  Coordinate coordinateOf(const Word& word, std::string& /*name*/) override {
    required(word, Kind::name);
    return kind_;
  }
  void dependentCoordinates(const Word& word, std::vector<std::string>& /*names*/, const Loop& /*loop*/) override {
    key(word, {Kind::names});
  }
  void table(const Word& file, const Word& column, Coordinate /*kind*/, TimeTable& /*table*/) override {
    key(file, {Kind::name});
    key(column, {Kind::name});
  }
  void timeFunction(const Word& word, Expression& /*number*/) override { key(word, {Kind::number}); }
  void signal(const Word& word, Expression& /*number*/) override { key(word, {Kind::number}); }
  void signals(const Word& word, ExpressionVector& /*vector*/) override { key(word, three_); }
  void measure(const Word& word) override { words_.measured.push_back(word); }

 private:
  using Kind = Written::Kind;

  void key(const Word& word, Written written) { words_.keys.push_back({word, std::move(written)}); }
  void required(Word word, Kind kind) {
    word.isRequired = true;
    key(word, {kind});
  }
  void initial(const Word& word, Written written, const char* example) {
    words_.keys.push_back({word, std::move(written), true, example});
  }

  const Written three_ = {Kind::numbers, {}, 3, 3};
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
      const auto& [word, written, isInitial, example] = turning.keys[i];
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
