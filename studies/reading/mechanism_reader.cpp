// Elements by their type; numbers that may be parameters; what the Mechanism itself refuses is said at the element.
#include "studies/reading/mechanism_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "mechanics/description/names.hpp"
#include "mechanics/description/orientation.hpp"
#include "mechanics/description/refusal.hpp"
#include "mechanics/description/words.hpp"
#include "mechanics/model.hpp"
#include "studies/assumed_rows.hpp"
#include "studies/printable.hpp"
#include "studies/reading/settings_reader.hpp"
#include "studies/reading/table_reader.hpp"
#include "studies/robots/robot.hpp"
#include "studies/robots/robot_elements.hpp"
#include "studies/words.hpp"

namespace gamut {
namespace {

bool isWordCharacter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.'; }

class MechanismReader {
 public:
  /// `dependents`: of loops that name none, by the element that closes each; others are closed by those that stand
  /// last. `redundant`: rows of loops that state none, likewise.
  MechanismReader(const TomlSource& source, const toml::table& table, const std::vector<Described>& types,
                  const std::optional<FilesAtHand>& files, DependentsOf dependents = {},
                  std::map<std::string, std::size_t> redundant = {})
      : source_(source),
        types_(types),
        atHand_(files),
        dependents_(std::move(dependents)),
        redundant_(std::move(redundant)),
        section_(source, table, "mechanism", keysOf(described(table.contains("urdf") || table.contains("robot")))) {}

  ReadMechanism read() {
    readParameters(section_, "");
    if (const toml::node* gravity = section_.find("gravity")) guarded(*gravity, [&] { setGravity(*gravity); });
    const toml::node* shaking = section_.find("base_acceleration");
    if (shaking != nullptr) guarded(*shaking, [&] { setBaseAcceleration(*shaking); });
    const char* const word = section_.find("robot") != nullptr ? "robot" : "urdf";
    const toml::node* robot = section_.find(word);
    if (robot != nullptr) addRobot(*robot, section_.nameOf(word));
    const std::size_t ofRobot = mechanism_.elements().size();
    const toml::node* element = section_.find("element");
    if (element != nullptr || (robot == nullptr && section_.find("parameters") == nullptr)) {
      const toml::node& list = section_.require(
          "element", "a table [[mechanism.element]] for each element, or in kinematics parameters alone");
      const toml::array& elements = source_.asArray(list, "mechanism.element");
      for (const toml::node& node : elements) readElement(source_.asTable(node, "mechanism.element"));
      for (std::size_t i = 0; i < elements.size(); ++i)
        guarded(elements[i], [&] { mechanism_.checkSignals(mechanism_.elements()[ofRobot + i].name()); });
    }
    if (const toml::node* loops = section_.find("loops")) readLoops(*loops);
    guarded(robot != nullptr ? *robot : element != nullptr ? *element : section_.table(), [&] { mechanism_.check(); });
    return {std::move(mechanism_), std::move(places_), std::move(files_), std::move(notes_)};
  }

 private:
  void readLoops(const toml::node& node) {
    const std::string word = source_.asChoice(node, "mechanism.loops", {"dependent", "multipliers"});
    if (!mechanism_.isClosed())
      source_.fail(node, "mechanism.loops is given, but nothing closes a loop", "no such key");
    if (word == "multipliers") mechanism_.holdLoops();
  }

  std::function<void(Settings&)> described(bool hasRobot) {
    return [this, hasRobot](Settings& settings) { describeMechanism(settings, hasRobot, choices_); };
  }

  /// A column of a table of this name.
  TimeTable tableOf(const std::string& name, const std::string& column, const std::string& unit) {
    const TableFiles files(source_, files_.tables, atHand_);
    return readTable(files.textOf(name), files.pathOf(name), column, unit);
  }

  // ---- A robot ------------------------------------------------------------------------------------------------------

  void addRobot(const toml::node& node, const std::string& key) {
    if (const toml::node* other = section_.find("urdf"); other != nullptr && other != &node)
      source_.fail(*other, "'urdf' beside 'robot'", "one robot");
    const std::string path = source_.asText(node, key);
    const std::string found = (source_.folder() / path).string();
    files_.robot = atHand_ ? atHand_->robot : textOfRobotAt(node, found);
    readSettings(section_, described(true));
    const Robot robot =
        readRobotText(files_.robot, atHand_ ? path + " in " + source_.name() : found, choices_.collision);
    notes_ = robot.notes;
    if (robot.isWorld && choices_.isFree)
      source_.fail(*section_.find("base"), "mechanism.base is \"free\", but the robot's file says itself what is free",
                   "\"fixed\", or no such key");
    if (robot.gravity && section_.find("gravity") == nullptr)
      guarded(node, [&] { mechanism_.setGravity({(*robot.gravity)[0], (*robot.gravity)[1], (*robot.gravity)[2]}); });

    const toml::node* initial = section_.find("initial");
    std::map<std::string, const toml::node*> given;
    if (initial != nullptr)
      collect(source_.asTable(*initial, "mechanism.initial",
                              "a table of values by their names, such as { shoulder.angle = \"30 deg\" }"),
              "", given);
    std::vector<RobotElement> elements;
    guarded(node, [&] { elements = robotElements(robot, choices_, mechanism_); });
    std::vector<std::string> known;
    for (RobotElement& element : elements) {
      InitialValues initialValues(*this, element.element.name(), given, known);
      element.element.describe(initialValues);
      places_[element.element.name()] = &section_.table();
      try {
        mechanism_.add(element.element);
      } catch (const WrongNumber& error) {
        guarded(node, [&]() -> void { throw error; });
      } catch (const Refusal& error) {
        refuseRobot(element.place, error.problem(), error.expected());
      } catch (const std::invalid_argument& error) {
        refuseRobot(element.place, error.what());
      }
    }
    if (!given.empty()) {
      const auto& [name, place] = *given.begin();
      source_.fail(*place, fmt::format("the robot has no initial value '{}'", name), expectedName(name, known));
    }
  }

  std::string textOfRobotAt(const toml::node& node, const std::string& path) const {
    try {
      return textOfRobot(path);
    } catch (const StudyError& error) {
      source_.fail(node, error.place() + ": " + error.problem(), error.expected());
    }
  }

  [[noreturn]] static void refuseRobot(const std::string& place, const std::string& what,
                                       const std::string& expected = "") {
    throw StudyError(place, withoutSemicolons(what), expected.empty() ? "a robot whose parts fit together" : expected);
  }

  /// Every value in tables within tables, by the names of all of them.
  void collect(const toml::table& table, const std::string& prefix,
               std::map<std::string, const toml::node*>& values) const {
    for (const auto& [key, value] : table) {
      const std::string name = prefix + std::string(key.str());
      if (const toml::table* inner = value.as_table())
        collect(*inner, name + ".", values);
      else if (!values.emplace(name, &value).second)
        source_.fail(value, fmt::format("'{}' is given twice", name), "one value for each");
    }
  }

  /// Gives an element of the robot the initial values that the study states for it, and takes them off the list.
  class InitialValues final : public Onlooker {
   public:
    InitialValues(MechanismReader& reader, std::string element, std::map<std::string, const toml::node*>& given,
                  std::vector<std::string>& known)
        : reader_(reader), element_(std::move(element)), given_(given), known_(known) {}

    void coordinate(const Word& position, Expression& initial, Coordinate /*kind*/, const Word& rate,
                    Expression& initialRate) override {
      this->position(position, initial);
      speed(rate, initialRate);
    }
    void coordinates(const Word& position, ExpressionVector& initial, Coordinate /*kind*/, const Word& rate,
                     ExpressionVector& initialRates) override {
      vector(position, initial);
      vector(rate, initialRates);
    }
    /// By `roll`, `pitch` and `yaw`, or by a quaternion's `w` … `z`.
    void orientation(const Word& word, std::vector<FixedRotation>& initial, const Word& rate,
                     ExpressionVector& initialRates) override {
      initial = rollPitchYaw();
      for (FixedRotation& turn : initial) position({word.key + "." + turn.key, word.unit}, turn.angle);
      Quaternion<Expression> e = {0.0, 0.0, 0.0, 0.0};
      const std::size_t before = given_.size();
      for (std::size_t i = 0; i < 4; ++i) position({word.key + "." + quaternionComponents[i], "1"}, e[i]);
      if (given_.size() < before) initial = {byQuaternion(e)};
      vector(rate, initialRates);
    }
    void position(const Word& word, Expression& initial) override {
      const std::string name = element_ + "." + word.key;
      known_.push_back(name);
      const auto found = given_.find(name);
      if (found == given_.end()) return;
      initial = reader_.number(*found->second, name, "mechanism.initial." + name, word.unit);
      given_.erase(found);
    }
    void speed(const Word& word, Expression& initial) override { position(word, initial); }

   private:
    /// As a list, or by components.
    void vector(const Word& word, ExpressionVector& vector) {
      const std::string name = element_ + "." + word.key;
      const auto found = given_.find(name);
      if (found == given_.end()) {
        for (std::size_t i = 0; i < 3; ++i) position({word.key + "." + components[i], word.unit}, vector[i]);
        return;
      }
      reader_.readNumbers(*found->second, name, "mechanism.initial." + name, vector, components, 3, word.unit);
      given_.erase(found);
    }

    MechanismReader& reader_;
    std::string element_;
    std::map<std::string, const toml::node*>& given_;
    std::vector<std::string>& known_;
  };

  // ---- Gravity, parameters, elements --------------------------------------------------------------------------------

  void setGravity(const toml::node& node) {
    ExpressionVector gravity = {0.0, 0.0, 0.0};
    readNumbers(node, "gravity", "mechanism.gravity", gravity, components, 3, "m/s^2");
    mechanism_.setGravity(gravity);
  }

  void setBaseAcceleration(const toml::node& node) {
    const std::string what = "mechanism.base_acceleration";
    const Word word{"base_acceleration", "m/s^2", ""};
    const toml::array& list = listOf(node, what, components, 3, dimensionOf(word.unit));
    ExpressionVector acceleration = {0.0, 0.0, 0.0};
    for (std::size_t i = 0; i < 3; ++i) acceleration[i] = signal(list[i], word.key + "." + components[i], what, word);
    mechanism_.setBaseAcceleration(acceleration);
    mechanism_.checkSignals(word.key);
  }

  static constexpr const char* thatFits = "a mechanism that can be assembled";

  /// What the mechanism refuses is an error of the file at this place.
  template <class Action>
  void guarded(const toml::node& at, const Action& action) const {
    try {
      action();
    } catch (const UnknownName& unknown) {
      const auto stated = places_.find(unknown.number());
      const toml::node* place = stated == places_.end() ? textWith(at, unknown.word()) : stated->second;
      source_.fail(place == nullptr ? at : *place, unknown.problem(), unknown.expected());
    } catch (const WrongUnit& error) {
      const auto stated = statedWithUnit_.find(error.parameter());
      const toml::node* place = stated == statedWithUnit_.end() ? textWith(at, error.parameter()) : stated->second;
      source_.fail(place == nullptr ? at : *place, error.problem(), error.expected());
    } catch (const WrongNumber& error) {
      const auto place = places_.find(error.number());
      source_.fail(place == places_.end() ? at : *place->second, error.problem(), error.expected());
    } catch (const UnitError& error) {  // which may quote what the user wrote, semicolons included
      source_.fail(at, error.problem(), error.expected());
    } catch (const Refusal& error) {
      source_.failWith(at, error.problem(), error.expected().empty() ? thatFits : error.expected());
    } catch (const std::invalid_argument& error) {
      source_.failWith(at, error.what(), thatFits);
    }
  }

  /// The first text within a node in which the name stands as a word; what names the element or its kind is none that
  /// refers to another.
  static const toml::node* textWith(const toml::node& node, const std::string& name) {
    if (const auto* text = node.as_string()) {
      const std::string& words = text->get();
      for (std::size_t at = words.find(name); at != std::string::npos; at = words.find(name, at + 1)) {
        const std::size_t end = at + name.size();
        if ((at == 0 || !isWordCharacter(words[at - 1])) && (end == words.size() || !isWordCharacter(words[end])))
          return &node;
      }
      return nullptr;
    }
    const toml::node* first = nullptr;
    const auto look = [&](const toml::node& part) {
      const toml::node* found = textWith(part, name);
      if (found != nullptr && (first == nullptr || found->source().begin < first->source().begin)) first = found;
    };
    if (const toml::array* list = node.as_array())
      for (const toml::node& part : *list) look(part);
    if (const toml::table* table = node.as_table())
      for (const auto& [key, part] : *table)
        if (key.str() != "type" && key.str() != "name") look(part);
    return first;
  }

  /// The table `parameters` of the mechanism ("name") or of an element ("element.name").
  void readParameters(const TomlSection& section, const std::string& prefix) {
    const toml::node* node = section.find("parameters");
    if (node == nullptr) return;
    const toml::table& table = source_.asTable(*node, section.nameOf("parameters"));
    std::vector<std::pair<toml::source_position, std::string>> keys;  // in the order of the file
    for (const auto& [key, value] : table) keys.emplace_back(key.source().begin, std::string(key.str()));
    std::sort(keys.begin(), keys.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<std::string> formulas;
    for (const auto& [position, key] : keys) {
      const toml::node& value = *table.get(key);
      const std::string what = section.nameOf("parameters." + key), name = prefix + key;
      places_[name] = &value;
      if (value.is_string()) {
        const Expression formula = source_.asExpression(value, what);
        if (!formula.isConstant()) {
          formulas.push_back(key);
          continue;
        }
        if (!formula.amount()) {  // "sqrt(2) m": a number, but no rational one
          guarded(value, [&] { addConstant(name, formula); });
          continue;
        }
      }
      const Amount amount = source_.asAnyAmount(value, what);
      const std::string unit = amount.hasUnit ? unitOf(amount.dimension) : "";
      guarded(value, [&] { mechanism_.addParameter(name, amount, unit); });
      if (amount.hasUnit) statedWithUnit_[name] = &value;
    }
    addFormulas(section, table, prefix, formulas);
  }

  void addConstant(const std::string& name, const Expression& formula) {
    const auto none = [](const std::string&) -> Dimension { throw std::logic_error("a constant has no names"); };
    const Dimension dimension = formula.dimension(none);
    mechanism_.addParameter(name, formula.evaluate<Interval>([](const std::string&) { return Interval::entire(); }),
                            dimension == Dimension{} ? "" : unitOf(dimension));
  }

  /// Each when those that it follows from are known, whatever the order of the file.
  void addFormulas(const TomlSection& section, const toml::table& table, const std::string& prefix,
                   std::vector<std::string> keys) {
    const auto formulaOf = [&](const std::string& key) {
      return source_.asExpression(*table.get(key), section.nameOf("parameters." + key));
    };
    const auto waitsFor = [&](const std::string& key) {
      std::vector<std::string> open = formulaOf(key).names();
      std::erase_if(open, [&](const std::string& name) {
        return std::ranges::none_of(keys, [&](const std::string& other) { return prefix + other == name; });
      });
      return open;
    };
    while (!keys.empty()) {
      auto next = std::ranges::find_if(keys, [&](const std::string& key) { return waitsFor(key).empty(); });
      if (next == keys.end())
        source_.fail(*table.get(keys.front()),
                     fmt::format("'{}' follows from '{}', which follows from it, or from others that do",
                                 prefix + keys.front(), waitsFor(keys.front()).front()),
                     "formulas of which none leads back to itself");
      const toml::node& value = *table.get(*next);
      guarded(value, [&] { mechanism_.addDerived(prefix + *next, formulaOf(*next)); });
      statedWithUnit_[prefix + *next] = &value;
      keys.erase(next);
    }
  }

  void readElement(const toml::table& table) {
    std::vector<std::string> words;
    for (const Described& type : types_) words.push_back(type.type());
    const toml::node* type = table.get("type");
    if (type == nullptr)
      source_.fail(table, "'mechanism.element.type' is missing",
                   fmt::format("type = one of: {}", fmt::join(words, ", ")));
    const std::string word = source_.asChoice(*type, "mechanism.element.type", words);
    Described element = *std::ranges::find(types_, word, &Described::type);

    std::vector<std::string> keys = {"type", "name", "parameters"}, initialKeys, examples;
    for (const auto& [key, written, isInitial, example] : wordsOf(element).keys) {
      (isInitial ? initialKeys : keys).push_back(key.key);
      if (isInitial) examples.push_back(fmt::format("{} = {}", key.key, example));
    }
    if (!initialKeys.empty()) keys.emplace_back("initial");
    const TomlSection section(source_, table, "mechanism.element", keys);
    element.setName(section.text("name"));
    places_[element.name()] = &table;
    readParameters(section, element.name() + ".");
    static const toml::table none;
    const toml::node* node = initialKeys.empty() ? nullptr : section.find("initial");
    const std::string expected = fmt::format("a table, such as {{ {} }}", fmt::join(examples, ", "));
    const TomlSection initial(source_,
                              node == nullptr ? none : source_.asTable(*node, section.nameOf("initial"), expected),
                              "mechanism.element.initial", initialKeys);
    Filler filler(*this, section, initial);
    element.describe(filler);
    guarded(table, [&] { mechanism_.add(element); });
    for (const Fault& fault : mechanism_.faults(mechanism_.elements().back(), {})) {
      const toml::node* at = section.find(fault.key);
      source_.failWith(at == nullptr ? table : *at, fault.sentence, fault.expected);
    }
  }

  /// Gives a description what the file says.
  class Filler final : public Fields {
   public:
    Filler(MechanismReader& reader, const TomlSection& section, const TomlSection& initial)
        : reader_(reader), section_(section), initial_(initial) {}

    void frame(const Word& word, std::string& name) override {
      section_.require(word.key, fmt::format("{}, by its name in quotes", word.meaning));
      name = section_.text(word.key);
    }
    void movedFrame(const Word& word, std::string& name, const std::string& /*from*/) override { frame(word, name); }
    void choice(const Word& word, std::string& value, const std::vector<std::string>& choices) override {
      if (const toml::node* node = section_.find(word.key))
        value = section_.source().asChoice(*node, section_.nameOf(word.key), choices);
    }
    void axis(const Word& word, Axis& axis) override {
      if (word.isRequired || section_.find(word.key) != nullptr) axis = reader_.axis(section_, word.key);
    }
    void rotations(const Word& word, std::vector<FixedRotation>& rotations) override {
      rotations = reader_.rotations(section_, section_, word.key);
    }
    void count(const Word& word, std::size_t& number, std::size_t most) override {
      const auto tried = reader_.redundant_.find(section_.text("name"));
      if (const toml::node* node = section_.find(word.key))
        number = static_cast<std::size_t>(
            section_.source().asInteger(*node, section_.nameOf(word.key), 0, static_cast<std::int64_t>(most)));
      else if (tried != reader_.redundant_.end())
        number = std::min(tried->second, most);
    }
    void number(const Word& word, Expression& number) override {
      if (const toml::node* node = given(section_, word))
        number = reader_.number(*node, named(word), section_.nameOf(word.key), word.unit);
    }
    void numbers(const Word& word, std::span<Expression> numbers, std::span<const char* const> names,
                 std::size_t least) override {
      if (const toml::node* node = given(section_, word))
        reader_.readNumbers(*node, named(word), section_.nameOf(word.key), numbers, names, least, word.unit);
    }
    void points(const Word& word, std::vector<ExpressionVector>& points) override {
      const toml::node* node = given(section_, word);
      if (node == nullptr) return;
      const std::string what = section_.nameOf(word.key);
      const toml::array* list = node->as_array();
      if (list == nullptr || list->empty())
        section_.source().fail(*node, fmt::format("'{}' is no list", what), "a list of points, [x, y, z] each");
      points.clear();
      for (std::size_t i = 0; i < list->size(); ++i)
        reader_.readNumbers((*list)[i], fmt::format("{}.{}", named(word), i + 1), what,
                            points.emplace_back(ExpressionVector{0.0, 0.0, 0.0}), components, 3, word.unit);
    }
    void coordinate(const Word& position, Expression& initial, Coordinate /*kind*/, const Word& rate,
                    Expression& initialRate) override {
      this->position(position, initial);
      speed(rate, initialRate);
    }
    void coordinates(const Word& position, ExpressionVector& initial, Coordinate /*kind*/, const Word& rate,
                     ExpressionVector& initialRates) override {
      initialVector(position, initial);
      initialVector(rate, initialRates);
    }
    void orientation(const Word& word, std::vector<FixedRotation>& initial, const Word& rate,
                     ExpressionVector& initialRates) override {
      if (initial_.find(word.key) != nullptr) initial = reader_.rotations(section_, initial_, word.key);
      initialVector(rate, initialRates);
    }
    void position(const Word& word, Expression& initial) override {
      if (const toml::node* node = initial_.find(word.key))
        initial = reader_.number(*node, named(word), initial_.nameOf(word.key), word.unit);
    }
    void speed(const Word& word, Expression& initial) override { position(word, initial); }
    std::string state(const Word& word, Expression& initial) override {
      const toml::node* node = section_.find(word.key);
      if (node == nullptr) return "1";
      if (node->is_string()) initial = section_.source().asExpression(*node, section_.nameOf(word.key));
      if (initial.isConstant()) {
        const Amount amount = section_.source().asAnyAmount(*node, section_.nameOf(word.key));
        if (!node->is_string()) initial = enclose(amount);
        return unitOf(amount.dimension);
      }
      Dimension dimension;
      reader_.guarded(*node, [&] { dimension = reader_.mechanism_.dimensionOf(initial); });
      return unitOf(dimension);
    }
    Coordinate coordinateOf(const Word& word, std::string& name) override {
      frame(word, name);
      const toml::node& node = *section_.find(word.key);
      Coordinate kind{};
      reader_.guarded(node, [&] { kind = reader_.mechanism_.coordinate(name, section_.text("name")).kind; });
      return kind;
    }
    void dependentCoordinates(const Word& word, std::vector<std::string>& names, const Loop& /*loop*/) override {
      const toml::node* node = section_.find(word.key);
      const auto chosen = reader_.dependents_.find(section_.text("name"));
      if (node == nullptr && chosen != reader_.dependents_.end()) names = chosen->second;
      if (node == nullptr) return;
      const std::string what = section_.nameOf(word.key);
      const TomlSource& source = section_.source();
      if (!node->is_array()) source.fail(*node, what + " is no list", "a list of coordinates, such as [\"rocker\"]");
      for (const toml::node& name : *node->as_array()) {
        names.push_back(source.asText(name, what));
        reader_.guarded(name, [&] { reader_.mechanism_.coordinate(names.back(), section_.text("name")); });
      }
      if (names.empty()) source.fail(*node, what + " is empty", "names of coordinates, or no list");
    }
    void table(const Word& file, const Word& column, Coordinate kind, TimeTable& table) override {
      const toml::node& node = *given(section_, file);
      const toml::node& name = *given(section_, column);
      const std::string path = section_.source().asText(node, section_.nameOf(file.key));
      const std::string wanted = section_.source().asText(name, section_.nameOf(column.key));
      try {
        table = reader_.tableOf(path, wanted, unitOf(kind));
      } catch (const UnknownName& unknown) {
        section_.source().fail(name, unknown.problem(), unknown.expected());
      } catch (const std::invalid_argument& error) {
        section_.source().failWith(node, error.what(), "a CSV file, named as seen from the study's folder");
      }
    }
    void timeFunction(const Word& word, Expression& number) override { signal(word, number); }
    void signal(const Word& word, Expression& number) override {
      if (const toml::node* node = given(section_, word))
        number = reader_.signal(*node, named(word), section_.nameOf(word.key), word);
    }
    void signals(const Word& word, ExpressionVector& vector) override {
      const toml::node* node = given(section_, word);
      if (node == nullptr) return;
      const toml::array& list = reader_.listOf(*node, section_.nameOf(word.key), components, 3, dimensionOf(word.unit));
      for (std::size_t i = 0; i < 3; ++i)
        vector[i] = reader_.signal(list[i], named(word) + "." + components[i], section_.nameOf(word.key), word);
    }
    void measure(const Word& /*word*/) override {}

   private:
    void initialVector(const Word& word, ExpressionVector& vector) {
      if (const toml::node* node = initial_.find(word.key))
        reader_.readNumbers(*node, named(word), initial_.nameOf(word.key), vector, components, 3, word.unit);
    }
    std::string named(const Word& word) const { return section_.text("name") + "." + word.key; }
    static const toml::node* given(const TomlSection& section, const Word& word) {
      if (!word.isRequired) return section.find(word.key);
      const std::string unit = word.unit.empty() || word.unit == "1" ? "" : fmt::format(" in {}", word.unit);
      return &section.require(word.key,
                              word.key + unit + (word.meaning.empty() ? "" : fmt::format(": {}", word.meaning)));
    }

    MechanismReader& reader_;
    const TomlSection& section_;
    const TomlSection& initial_;
  };

  /// "x", "-y", … or a direction [x, y, z].
  Axis axis(const TomlSection& section, const std::string& key) const {
    const toml::node& node = section.require(key, "\"x\", \"y\", \"z\", the same with a minus sign, or [x, y, z]");
    return axis(node, section.nameOf(key));
  }

  Axis axis(const toml::node& node, const std::string& what) const {
    if (!node.is_array()) {
      const std::string word = source_.asChoice(node, what, {"x", "y", "z", "-x", "-y", "-z"});
      const double sign = word.front() == '-' ? -1 : 1;
      const char letter = word.back();
      return {letter == 'x' ? sign : 0, letter == 'y' ? sign : 0, letter == 'z' ? sign : 0};
    }
    const toml::array& list = *node.as_array();
    if (list.size() != 3)
      source_.fail(node, fmt::format("{} has {}", what, countText(static_cast<long long>(list.size()), "number")),
                   "three numbers [x, y, z]");
    double direction[3];
    for (std::size_t i = 0; i < 3; ++i) direction[i] = nearest(source_.asAmount(list[i], what, Dimension{}));
    if (direction[0] == 0 && direction[1] == 0 && direction[2] == 0)
      source_.fail(node, what + " is the zero vector", "a direction");
    return {direction[0], direction[1], direction[2]};
  }

  /// [{ axis, angle }, …] or one alone, { roll, pitch, yaw } or { quaternion = [w, x, y, z] }; whole quarter turns are
  /// exact.
  std::vector<FixedRotation> rotations(const TomlSection& element, const TomlSection& section, const std::string& key) {
    const toml::node* node = section.find(key);
    if (node == nullptr) return {};
    const std::string what = section.nameOf(key), name = fmt::format("{}.{}", element.text("name"), key);
    const auto turned = [&](const toml::node& turn, FixedRotation rotation, const std::string& number) {
      rotation.angle = this->number(turn, fmt::format("{}.{}", name, number), what, "rad");
      setQuarterTurns(rotation);
      return rotation;
    };
    const auto aboutAxis = [&](const toml::node& entry, const std::string& number) {
      const TomlSection part(source_, source_.asTable(entry, what), what, {"axis", "angle"});
      return turned(part.require("angle", "an angle such as \"90 deg\""), {.axis = axis(part, "axis")}, number);
    };
    std::vector<FixedRotation> result;
    if (const toml::array* list = node->as_array()) {
      for (const toml::node& entry : *list) result.push_back(aboutAxis(entry, std::to_string(result.size() + 1)));
      return result;
    }
    if (!node->is_table())
      source_.fail(*node, what + " is no rotation",
                   "[{ axis, angle }, …], { axis, angle }, { roll, pitch, yaw } or { quaternion = [w, x, y, z] }");
    if (node->as_table()->contains("axis")) {
      result.push_back(aboutAxis(*node, "angle"));
      result[0].key = "angle";
      return result;
    }
    const TomlSection part(source_, *node->as_table(), what, {"roll", "pitch", "yaw", "quaternion"});
    if (const toml::node* quaternion = part.find("quaternion")) {
      for (const char* angle : {"roll", "pitch", "yaw"})
        if (const toml::node* other = part.find(angle))
          source_.fail(*other, fmt::format("'{}' beside a quaternion", angle), "one of the two");
      Quaternion<Expression> e = {0.0, 0.0, 0.0, 0.0};
      readNumbers(*quaternion, name, part.nameOf("quaternion"), e, quaternionComponents, 4, "1");
      return {byQuaternion(e)};
    }
    for (FixedRotation& rotation : result = rollPitchYaw())
      if (const toml::node* angle = part.find(rotation.key)) rotation = turned(*angle, rotation, rotation.key);
    return result;
  }

  static void setQuarterTurns(FixedRotation& rotation) {
    const std::optional<Amount> amount = rotation.angle.amount();
    if (!amount || amount->piPower != 1) return;
    const mpq_class quarters = amount->value * 2;  // of rational * pi: quarter turns are halves of pi
    if (quarters.get_den() != 1 || !quarters.get_num().fits_sint_p()) return;
    rotation.quarterTurns = static_cast<int>(quarters.get_num().get_si());
    rotation.angle = 0.0;
  }

  /// A list of numbers of these names; all, or the first `least`.
  const toml::array& listOf(const toml::node& node, const std::string& what, std::span<const char* const> names,
                            std::size_t least, const Dimension& dimension) const {
    const std::size_t most = names.size();
    std::string expected = fmt::format("[{}]", fmt::join(names, ", "));
    if (dimension != Dimension{}) expected += " in " + unitOf(dimension);
    if (least < most) expected = fmt::format("[{}] or {}", fmt::join(names.first(least), ", "), expected);
    if (!node.is_array()) source_.fail(node, what + " is no list of numbers", expected);
    const toml::array& list = *node.as_array();
    if (list.size() != least && list.size() != most)
      source_.fail(node, fmt::format("{} has {}", what, countText(static_cast<long long>(list.size()), "number")),
                   expected);
    return list;
  }

  void readNumbers(const toml::node& node, const std::string& name, const std::string& what,
                   std::span<Expression> numbers, std::span<const char* const> names, std::size_t least,
                   const std::string& unit) {
    const toml::array& list = listOf(node, what, names, least, dimensionOf(unit));
    for (std::size_t i = 0; i < list.size(); ++i) numbers[i] = number(list[i], name + "." + names[i], what, unit);
  }

  /// An expression of motion; its names are the mechanism's to check when all elements are known.
  Expression signal(const toml::node& node, const std::string& name, const std::string& what, const Word& word) {
    places_[name] = &node;
    if (!node.is_string()) return enclose(source_.asAmount(node, what, dimensionOf(word.unit)));
    const Expression expression = source_.asExpression(node, what, true);
    if (expression.amount()) source_.asAmount(node, what, dimensionOf(word.unit));  // refuses another unit
    return expression;
  }

  /// A number, or a formula; the names in it and their units are the mechanism's to check.
  Expression number(const toml::node& node, const std::string& name, const std::string& what, const std::string& unit) {
    const Dimension dimension = dimensionOf(unit);
    places_[name] = &node;
    if (!node.is_string()) {
      const Amount plain = source_.asAmount(node, what, dimension);
      noteTurns(node, name, unit, nearest(plain));
      return Expression(plain);
    }
    Expression formula = source_.asExpression(node, what);
    const std::vector<std::string>& names = formula.names();
    const bool isUnit =
        names.size() == 1 && names[0] != "t" && !mechanism_.knows(names[0]) && names[0].find('.') == std::string::npos;
    if (formula.amount() || isUnit) source_.asAmount(node, what, dimension);  // refuses a unit that there is not
    try {
      if (std::ranges::all_of(names, [&](const std::string& used) { return mechanism_.knows(used); }))
        mechanism_.check(formula, name, unit);
    } catch (const UnitError& error) {
      source_.fail(node, error.problem(), error.expected());
    } catch (const WrongUnit&) {  // whose place is where the parameter got its unit: the mechanism will say it
    }
    return formula;
  }

  /// What has no unit is in radians: degrees may be meant where it is more than a turn.
  void noteTurns(const toml::node& node, const std::string& name, const std::string& unit, double value) {
    constexpr double turn = 6.2832;  // hardly more than 2 pi
    if (unit == "rad" && std::abs(value) > turn)
      notes_.push_back(source_.note(
          node,
          fmt::format("'{}' is {:.6g} rad, more than a turn; degrees would be \"{:.6g} deg\"", name, value, value)));
  }

  const TomlSource& source_;
  const std::vector<Described>& types_;
  const std::optional<FilesAtHand>& atHand_;
  const DependentsOf dependents_;
  const std::map<std::string, std::size_t> redundant_;
  RobotChoices choices_;
  TomlSection section_;
  Mechanism mechanism_;
  FilesAtHand files_;
  std::vector<std::string> notes_;
  std::map<std::string, const toml::node*> statedWithUnit_;  // parameters
  std::map<std::string, const toml::node*> places_;
};

}  // namespace

namespace {

/// Quantities that are stated to be uncertain, whatever else is wrong with them.
std::set<std::string> uncertainIn(const TomlSource& source) {
  std::set<std::string> names;
  const auto add = [&](const toml::node& node) {
    if (const auto name = node.value<std::string>()) names.insert(*name);
  };
  if (const toml::array* tables = source.root()["uncertain"].as_array())
    for (const toml::node& each : *tables) {
      const toml::table* table = each.as_table();
      const toml::node* quantity = table == nullptr ? nullptr : table->get("quantity");
      if (quantity == nullptr) continue;
      add(*quantity);
      if (const toml::array* several = quantity->as_array())
        for (const toml::node& one : *several) add(one);
    }
  return names;
}

}  // namespace

TomlSource::Names namesStatedIn(const TomlSource& source) {
  TomlSource::Names names;
  const auto mechanism = source.root()["mechanism"];
  if (const toml::table* parameters = mechanism["parameters"].as_table())
    for (const auto& [key, value] : *parameters) names.parameters.emplace(key.str());
  if (const toml::array* elements = mechanism["element"].as_array())
    for (const toml::node& element : *elements)
      if (const toml::table* table = element.as_table(); table != nullptr && (*table)["type"] == "state")
        if (const auto name = (*table)["name"].value<std::string>()) names.states.insert(*name);
  return names;
}

namespace {

/// What of redundant rows is assumed, by element; none where the machine does not close.
std::vector<std::pair<std::string, std::string>> assumptionsIn(const Mechanism& mechanism) {
  std::vector<std::pair<std::string, std::string>> notes;
  if (std::ranges::all_of(mechanism.loops(), [](const auto& loop) { return loop.redundant == 0; })) return notes;
  try {
    for (const Assumption& assumption : assumptionsOn(mechanism))
      notes.emplace_back(assumption.element, assumption.sentence + ", is assumed, not proved");
  } catch (const UnfitPart&) {  // a machine says so
  }
  return notes;
}

/// Whether elements of this type close loops.
bool closesLoops(const std::string& type, std::vector<Described> types) {
  class Finder final : public Onlooker {
   public:
    void dependentCoordinates(const Word&, std::vector<std::string>&, const Loop&) override { closes = true; }
    bool closes = false;
  } finder;
  const auto found = std::ranges::find(types, type, &Described::type);
  if (found != types.end()) found->describe(finder);
  return finder.closes;
}

/// "`redundant = 3` of 'D', which assumes that …, as it seems": where a single loop that states none would close with
/// rows that follow from the others; empty where none would.
std::string seemingRedundancy(const TomlSource& source, const toml::table& table, const std::vector<Described>& types,
                              const std::optional<FilesAtHand>& files) {
  constexpr std::size_t most = 5;  // rows
  const toml::array* elements = table["element"].as_array();
  for (std::size_t i = 0; elements != nullptr && i < elements->size(); ++i) {
    const toml::table* element = (*elements)[i].as_table();
    const auto type = element == nullptr ? std::optional<std::string>() : (*element)["type"].value<std::string>();
    if (!type || !closesLoops(*type, types) || element->contains("redundant")) continue;
    const std::string name = (*element)["name"].value_or(std::string());
    for (std::size_t rows = 1; rows <= most; ++rows) try {
        const ReadMechanism trial = MechanismReader(source, table, types, files, {}, {{name, rows}}).read();
        for (const Assumption& assumption : assumptionsOn(trial.mechanism))
          if (assumption.element == name)
            return fmt::format("`redundant = {}` of '{}', which assumes, as it seems, {}", rows, name,
                               assumption.sentence);
      } catch (const StudyError&) {
      } catch (const UnfitPart&) {
      }
  }
  return {};
}

ReadMechanism readWithFirmDependents(const TomlSource& source, const toml::table& table,
                                     const std::vector<Described>& types, const std::optional<FilesAtHand>& files) {
  ReadMechanism read = MechanismReader(source, table, types, files).read();
  if (!read.mechanism.isClosed()) return read;
  const DependentsOf firmer = firmerDependents(read.mechanism, uncertainIn(source));
  if (firmer.empty()) return read;
  ReadMechanism other = MechanismReader(source, table, types, files, firmer).read();
  if (!startsClosed(other.mechanism)) return read;
  for (const Mechanism::Closed& loop : read.mechanism.loops())
    if (const auto at = firmer.find(loop.element); at != firmer.end() && at->second != loop.by)
      other.notes.push_back(source.note(
          *other.places.at(loop.element),
          fmt::format("the loop '{}' is closed by {}, as {}, which stand last, hold it weakly where it starts",
                      loop.element, fmt::join(at->second, ", "), fmt::join(loop.by, ", "))));
  return other;
}

}  // namespace

ReadMechanism readMechanism(const TomlSource& source, const toml::table& table, const std::vector<Described>& types,
                            const std::optional<FilesAtHand>& files) {
  const auto firm = [&] {
    try {
      return readWithFirmDependents(source, table, types, files);
    } catch (const StudyError& error) {
      const std::string redundancy = seemingRedundancy(source, table, types, files);
      if (redundancy.empty()) throw;
      throw StudyError(error.place(), error.problem(),
                       error.expected().empty() ? redundancy : error.expected() + ", or " + redundancy);
    }
  };
  ReadMechanism read = firm();
  if (read.mechanism.isClosed() && !startsClosed(read.mechanism))
    if (const std::string redundancy = seemingRedundancy(source, table, types, files); !redundancy.empty())
      read.notes.push_back(source.note(*read.places.at(read.mechanism.loops().front().element),
                                       "the loops do not close as they are; they do with " + redundancy));
  for (const Mechanism::LeftOut& leftOut : read.mechanism.leftOut())
    read.notes.push_back(source.note(*read.places.at(leftOut.element), leftOut.sentence));
  for (const auto& [element, sentence] : assumptionsIn(read.mechanism))
    read.notes.push_back(source.note(*read.places.at(element), sentence));
  return read;
}

}  // namespace gamut
