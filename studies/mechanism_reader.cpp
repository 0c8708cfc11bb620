// Elements by their type; numbers that may be parameters; what the Mechanism itself refuses is said at the element.
#include "studies/detail/mechanism_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>

#include "mechanics/names.hpp"

namespace gamut {
namespace {

constexpr Dimension plain{}, length{0, 1, 0, 0}, angle{0, 0, 0, 1}, mass{1, 0, 0, 0}, inertia{1, 2, 0, 0},
    speed{0, 1, -1, 0}, rate{0, 0, -1, 1}, acceleration{0, 1, -2, 0}, stiffness{1, 0, -2, 0}, damping{1, 0, -1, 0},
    turningStiffness{1, 2, -2, -1}, turningDamping{1, 2, -1, -1};

bool isWordCharacter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.'; }

class MechanismReader {
 public:
  MechanismReader(const TomlSource& source, const toml::table& table)
      : source_(source), section_(source, table, "mechanism", {"gravity", "parameters", "element"}) {}

  Mechanism read() {
    readParameters(section_, "");
    if (const toml::node* gravity = section_.find("gravity"))
      guarded(*gravity, [&] { mechanism_.setGravity(vector(*gravity, "mechanism.gravity", acceleration)); });
    const toml::node& list = section_.require("element", "a table [[mechanism.element]] for each element");
    const toml::array& elements = source_.asArray(list, "mechanism.element");
    for (const toml::node& node : elements) readElement(source_.asTable(node, "mechanism.element"));
    guarded(elements, [&] { mechanism_.check(); });
    return std::move(mechanism_);
  }

 private:
  /// What the mechanism refuses is an error of the file at this place.
  template <class Action>
  void guarded(const toml::node& at, const Action& action) const {
    try {
      action();
    } catch (const UnknownName& unknown) {
      const toml::node* place = textWith(at, unknown.word());
      source_.fail(place == nullptr ? at : *place, unknown.problem(), unknown.expected());
    } catch (const WrongUnit& error) {
      const auto stated = statedWithUnit_.find(error.parameter());
      const toml::node* place = stated == statedWithUnit_.end() ? textWith(at, error.parameter()) : stated->second;
      source_.fail(place == nullptr ? at : *place, error.what(), "a parameter in " + error.wanted());
    } catch (const UnitError& error) {
      source_.fail(at, error);
    } catch (const std::invalid_argument& error) {
      source_.failWith(at, error.what(), "a mechanism that can be assembled");
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
    for (const auto& [position, key] : keys) {
      const toml::node& value = *table.get(key);
      const std::string what = section.nameOf("parameters." + key);
      const std::string name = prefix + key;
      if (value.is_string()) {
        const Expression formula = source_.asExpression(value, what);
        if (!formula.isConstant()) {
          guarded(value, [&] { mechanism_.addDerived(name, formula); });
          statedWithUnit_[name] = &value;
          continue;
        }
      }
      const Amount amount = source_.asAnyAmount(value, what);
      const std::string unit = amount.hasUnit ? unitOf(amount.dimension) : "";
      guarded(value, [&] { mechanism_.addParameter(name, enclose(amount), unit); });
      if (amount.hasUnit) statedWithUnit_[name] = &value;
    }
  }

  void readElement(const toml::table& table) {
    const toml::node* type = table.get("type");
    const std::string expected = "type = \"revolute\", \"prismatic\", \"link\", \"mass\" or \"spring-damper\"";
    if (type == nullptr) source_.fail(table, "'mechanism.element.type' is missing", expected);
    const std::string kind =
        source_.asChoice(*type, "mechanism.element.type", {"revolute", "prismatic", "link", "mass", "spring-damper"});
    if (kind == "revolute") {
      readRevolute(table);
    } else if (kind == "prismatic") {
      readPrismatic(table);
    } else if (kind == "link") {
      readLink(table);
    } else if (kind == "mass") {
      readMass(table);
    } else if (table.contains("joint")) {
      readJointSpring(table);
    } else {
      readSpring(table);
    }
  }

  TomlSection element(const toml::table& table, std::vector<std::string> keys) {
    keys.insert(keys.begin(), {"type", "name", "parameters"});
    TomlSection section(source_, table, "mechanism.element", std::move(keys));
    readParameters(section, section.text("name") + ".");
    return section;
  }

  TomlSection initial(const TomlSection& joint, const std::string& position) {
    static const toml::table none;
    const toml::node* node = joint.find("initial");
    const toml::table& table = node == nullptr ? none : source_.asTable(*node, joint.nameOf("initial"));
    return {source_, table, "mechanism.element.initial", {position, "rate"}};
  }

  void readRevolute(const toml::table& table) {
    const TomlSection section = element(table, {"from", "to", "axis", "initial"});
    const TomlSection start = initial(section, "angle");
    Revolute joint{section.text("name"), section.text("from"),          section.text("to"),
                   axis(section),        number(start, "angle", angle), number(start, "rate", rate)};
    guarded(table, [&] { mechanism_.add(std::move(joint)); });
  }

  void readPrismatic(const toml::table& table) {
    const TomlSection section = element(table, {"from", "to", "axis", "initial"});
    const TomlSection start = initial(section, "displacement");
    Prismatic joint{section.text("name"),
                    section.text("from"),
                    section.text("to"),
                    axis(section),
                    number(start, "displacement", length),
                    number(start, "rate", speed)};
    guarded(table, [&] { mechanism_.add(std::move(joint)); });
  }

  void readLink(const toml::table& table) {
    const TomlSection section = element(table, {"from", "to", "vector", "rotation"});
    const toml::node& offset = section.require("vector", "the place of frame 'to' in frame 'from', [x, y, z] in m");
    Link link{section.text("name"), section.text("from"), section.text("to"),
              vector(offset, section.nameOf("vector"), length), rotations(section)};
    guarded(table, [&] { mechanism_.add(std::move(link)); });
  }

  void readMass(const toml::table& table) {
    const TomlSection section = element(table, {"at", "mass", "centre", "inertia"});
    const toml::node& weight = section.require("mass", "the mass in kg, or with a unit such as \"250 g\"");
    Mass body{section.text("name"), section.text("at"), number(section, "mass", mass)};
    const Expression given = body.mass;
    if (const toml::node* centre = section.find("centre"))
      body.centre = vector(*centre, section.nameOf("centre"), length);
    if (const toml::node* node = section.find("inertia")) {
      const toml::array& list = source_.asArray(*node, section.nameOf("inertia"));
      if (list.size() != 3 && list.size() != 6)
        source_.fail(*node, fmt::format("{} has {} numbers", section.nameOf("inertia"), list.size()),
                     "[xx, yy, zz] or [xx, yy, zz, xy, yz, zx] in kg m^2");
      for (std::size_t i = 0; i < list.size(); ++i)
        body.inertia[i] = number(list[i], section.nameOf("inertia"), inertia);
    }
    guarded(table, [&] { mechanism_.add(std::move(body)); });
    const std::string fault = mechanism_.inertiaFault(std::get<Mass>(mechanism_.elements().back()), {});
    if (!fault.empty()) source_.fail(*section.find("inertia"), fault, "an inertia that a body can have");
    const Interval value = mechanism_.rangeOf(given);
    if (value.lower() < 0) source_.fail(weight, section.nameOf("mass") + " is negative", "a mass of at least 0 kg");
  }

  void readSpring(const toml::table& table) {
    const TomlSection section =
        element(table, {"from", "to", "joint", "stiffness", "rest_length", "damping", "from_point", "to_point"});
    Spring spring{section.text("name"),
                  section.text("from"),
                  section.text("to"),
                  number(section, "stiffness", stiffness),
                  number(section, "rest_length", length),
                  number(section, "damping", damping)};
    if (const toml::node* p = section.find("from_point"))
      spring.fromPoint = vector(*p, section.nameOf("from_point"), length);
    if (const toml::node* p = section.find("to_point")) spring.toPoint = vector(*p, section.nameOf("to_point"), length);
    guarded(table, [&] { mechanism_.add(std::move(spring)); });
  }

  void readJointSpring(const toml::table& table) {
    const TomlSection section = element(table, {"joint", "stiffness", "rest", "damping"});
    const std::string joint = section.text("joint");
    const std::vector<std::string> states = mechanism_.stateNames();
    const auto has = [&](const char* state) { return std::ranges::find(states, joint + state) != states.end(); };
    const bool slides = has(".displacement");
    if (!slides && !has(".angle"))  // refused before its numbers are, whose units depend on the joint
      guarded(table, [&] { mechanism_.add(JointSpring{section.text("name"), joint, 0.0, 0.0, 0.0}); });
    JointSpring spring{section.text("name"), joint, number(section, "stiffness", slides ? stiffness : turningStiffness),
                       number(section, "rest", slides ? length : angle),
                       number(section, "damping", slides ? damping : turningDamping)};
    guarded(table, [&] { mechanism_.add(std::move(spring)); });
  }

  /// "x", "-y", … or a direction [x, y, z].
  Axis axis(const TomlSection& section) const {
    const toml::node& node = section.require("axis", "\"x\", \"y\", \"z\", the same with a minus sign, or [x, y, z]");
    return axis(node, section.nameOf("axis"));
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
      source_.fail(node, fmt::format("{} has {} numbers", what, list.size()), "three numbers [x, y, z]");
    double direction[3];
    for (std::size_t i = 0; i < 3; ++i) direction[i] = nearest(source_.asAmount(list[i], what, plain));
    if (direction[0] == 0 && direction[1] == 0 && direction[2] == 0)
      source_.fail(node, what + " is the zero vector", "a direction");
    return {direction[0], direction[1], direction[2]};
  }

  /// A list of { axis, angle }; whole quarter turns are exact.
  std::vector<FixedRotation> rotations(const TomlSection& link) {
    std::vector<FixedRotation> result;
    const toml::node* node = link.find("rotation");
    if (node == nullptr) return result;
    const std::string name = link.nameOf("rotation");
    for (const toml::node& entry : source_.asArray(*node, name)) {
      const TomlSection section(source_, source_.asTable(entry, name), name, {"axis", "angle"});
      FixedRotation rotation{axis(section)};
      const toml::node& turn = section.require("angle", "an angle such as \"90 deg\"");
      rotation.angle = number(turn, section.nameOf("angle"), angle);
      setQuarterTurns(rotation);
      result.push_back(std::move(rotation));
    }
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

  ExpressionVector vector(const toml::node& node, const std::string& what, const Dimension& dimension) {
    const toml::array& list = source_.asArray(node, what);
    if (list.size() != 3)
      source_.fail(node, fmt::format("{} has {} numbers", what, list.size()),
                   fmt::format("three, [x, y, z] in {}", unitOf(dimension)));
    return {number(list[0], what, dimension), number(list[1], what, dimension), number(list[2], what, dimension)};
  }

  /// 0 if the key is missing.
  Expression number(const TomlSection& section, std::string_view key, const Dimension& dimension) {
    const toml::node* node = section.find(key);
    return node == nullptr ? Expression(0.0) : number(*node, section.nameOf(key), dimension);
  }

  /// A number, or a formula; the names in it and their units are the mechanism's to check.
  Expression number(const toml::node& node, const std::string& what, const Dimension& dimension) {
    if (!node.is_string()) return enclose(source_.asAmount(node, what, dimension));
    Expression formula = source_.asExpression(node, what);
    const std::vector<std::string>& names = formula.names();
    const bool isUnit = names.size() == 1 && !mechanism_.knows(names[0]) && names[0].find('.') == std::string::npos;
    if (formula.amount() || isUnit) source_.asAmount(node, what, dimension);  // refuses a unit that there is not
    try {
      if (std::ranges::all_of(names, [&](const std::string& name) { return mechanism_.knows(name); }))
        mechanism_.check(formula, what, dimension);
    } catch (const UnitError& error) {
      source_.fail(node, error);
    } catch (const WrongUnit&) {  // whose place is where the parameter got its unit: the mechanism will say it
    }
    return formula;
  }

  const TomlSource& source_;
  TomlSection section_;
  Mechanism mechanism_;
  std::map<std::string, const toml::node*> statedWithUnit_;  // parameters
};

}  // namespace

Mechanism readMechanism(const TomlSource& source, const toml::table& table) {
  return MechanismReader(source, table).read();
}

}  // namespace gamut
