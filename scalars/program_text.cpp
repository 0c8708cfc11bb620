// The kept form: nothing is read that evaluators could stumble over.
#include "scalars/program_text.hpp"

#include <algorithm>
#include <charconv>
#include <istream>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include "scalars/recorder.hpp"

namespace gamut {
namespace {

constexpr std::string_view header = "gamut-program 1";

// Numbers are read only in the form in which they are written: then no digit is overlooked or rounded away.

/// What toExactString writes, of a finite number.
std::optional<double> readHexadecimal(std::string_view text) {
  const bool isNegative = text.starts_with('-');
  const std::string_view digits = text.substr(std::min(text.size(), std::size_t{isNegative ? 3u : 2u}));  // behind 0x
  double value = 0;
  const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::hex);
  if (result.ec != std::errc()) return {};
  if (isNegative) value = -value;
  return toExactString(value) == text ? std::optional(value) : std::nullopt;
}

std::optional<int> readNumber(std::string_view text) {
  int value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  return result.ec == std::errc() && value >= 0 && std::to_string(value) == text ? std::optional(value) : std::nullopt;
}

std::optional<Op> readOp(std::string_view text) {
  for (int i = 0; i < opCount; ++i)
    if (nameOf(static_cast<Op>(i)) == text) return static_cast<Op>(i);
  return {};
}

/// Text in a message: quoted, printable and not longer than a line.
std::string quoted(std::string_view text) {
  std::string result = "'";
  for (char c : text.substr(0, 60)) result += c >= ' ' && c <= '~' ? c : '?';
  return result + (text.size() > 60 ? "...'" : "'");
}

/// More words than any line of a program has.
constexpr std::size_t tooMany = 5;

/// One line at a time, split at single blanks.
class Lines {
 public:
  explicit Lines(std::istream& in) : in_(in) {}

  [[noreturn]] void fail(const std::string& what) const {
    throw std::invalid_argument("program, line " + std::to_string(number_) + ": " + what);
  }

  const std::string& line(std::string_view expected) {
    ++number_;
    if (!std::getline(in_, line_)) fail("the text ends where " + std::string(expected) + " is expected");
    if (line_.ends_with('\r')) line_.pop_back();
    return line_;
  }

  /// The words of the next line; no more than tooMany of them.
  std::vector<std::string_view> words(std::string_view expected) {
    const std::string_view all = line(expected);
    std::vector<std::string_view> result;
    for (std::size_t begin = 0; begin <= all.size() && result.size() < tooMany;) {
      const std::size_t end = std::min(all.find(' ', begin), all.size());
      result.push_back(all.substr(begin, end - begin));
      begin = end + 1;
    }
    return result;
  }

  /// True if there is another line, which then is the current one.
  bool hasMore() {
    ++number_;
    return static_cast<bool>(std::getline(in_, line_));
  }

  /// A line "name 7".
  int count(const std::string& name) {
    const auto expected = quoted(name) + " and a number";
    const auto all = words(expected);
    const auto value = all.size() == 2 && all[0] == name ? readNumber(all[1]) : std::nullopt;
    if (!value) fail(expected + " is expected, not " + quoted(line_));
    return *value;
  }

  const std::string& text() const { return line_; }

 private:
  std::istream& in_;
  std::string line_;
  int number_ = 0;
};

/// What has been read so far; every node in it may be relied on.
struct Parts : detail::NodeList {
  int states = 0, parameters = 0;
};

/// The one input that node i must be; nothing behind the inputs.
std::string inputAt(const Parts& parts, int i) {
  if (i < parts.states) return "state " + std::to_string(i);
  if (i < parts.states + parts.parameters) return "parameter " + std::to_string(i - parts.states);
  return i == parts.states + parts.parameters ? "time" : "";
}

Interval readConstant(const Lines& lines, const std::vector<std::string_view>& words) {
  const auto lower = words.size() == 4 ? readHexadecimal(words[2]) : std::nullopt;
  const auto upper = words.size() == 4 ? readHexadecimal(words[3]) : std::nullopt;
  if (!lower || !upper) lines.fail("a constant has two finite ends such as -0x1.8p+3, not " + quoted(lines.text()));
  if (!(*lower <= *upper)) lines.fail("the ends of a constant are in order, not " + quoted(lines.text()));
  return {*lower, *upper};
}

Node readOperation(const Lines& lines, const std::vector<std::string_view>& words, Op op, const Parts& parts) {
  const int number = static_cast<int>(parts.nodes.size());
  const bool hasSecond = operandsOf(op) == 2 || op == Op::log || op == Op::atan;
  const std::size_t expected = hasSecond ? 4 : 3;
  if (words.size() != expected)
    lines.fail(std::string(nameOf(op)) + " has " + (hasSecond ? "2 operands" : "1 operand") + ", not " +
               std::to_string(std::count(lines.text().begin(), lines.text().end(), ' ') - 1) + ": " +
               quoted(lines.text()));
  Node node{op};
  for (std::size_t i = 2; i < expected; ++i) {
    const auto operand = readNumber(words[i]);
    if (!operand || *operand >= number)
      lines.fail("an operand is a node before this one, 0 to " + std::to_string(number - 1) + ", not " +
                 quoted(words[i]));
    (i == 2 ? node.a : node.b) = *operand;
  }
  if (op == Op::log && node.b != node.a)
    lines.fail("both operands of log are the same node, not " + quoted(lines.text()));
  if (op == Op::atan && !parts.isOnePlusSquare(node.b, node.a))
    lines.fail("the second operand of atan is 1 plus the square of the first, which node " + std::to_string(node.b) +
               " is not");
  return node;
}

void readNode(Lines& lines, Parts& parts) {
  const int number = static_cast<int>(parts.nodes.size());
  const auto words = lines.words("node " + std::to_string(number));
  if (words[0] != std::to_string(number))
    lines.fail("node " + std::to_string(number) + " is expected, not " + quoted(lines.text()));
  const auto op = words.size() > 1 ? readOp(words[1]) : std::nullopt;
  if (!op) lines.fail("an operation is expected behind the number, not " + quoted(lines.text()));
  if (const std::string input = inputAt(parts, number); !input.empty()) {
    if (lines.text() != std::to_string(number) + " " + input)
      lines.fail(quoted(std::to_string(number) + " " + input) + " is expected, not " + quoted(lines.text()));
    parts.push({*op, *op == Op::time ? -1 : *op == Op::state ? number : number - parts.states});
    return;
  }
  const Node before = parts.nodes.back();
  if (before.op == Op::sin && *op != Op::cos)
    lines.fail("a sine is followed by its cosine, not by " + quoted(words[1]));
  if (*op == Op::constant) {
    parts.constants.push_back(readConstant(lines, words));
    parts.push({Op::constant, static_cast<int>(parts.constants.size()) - 1});
    return;
  }
  if (!isOperation(*op)) lines.fail("inputs come before all other nodes, not " + quoted(lines.text()));
  const Node node = readOperation(lines, words, *op, parts);
  if (*op == Op::cos && (before.op != Op::sin || before.a != node.a))
    lines.fail("a cosine follows the sine of the same node, not " + quoted(lines.text()));
  parts.push(node);
}

/// Writes the nodes down without rules: each gets its own number again.
Program assembled(const Parts& parts, const std::vector<int>& outputs) {
  Recorder recorder(parts.states, parts.parameters, RuleSet::none());
  for (std::size_t i = detail::at(recorder.size()); i < parts.nodes.size(); ++i) {
    const Node& n = parts.nodes[i];
    if (n.op == Op::constant)
      recorder.constant(parts.constants[detail::at(n.a)]);
    else if (n.op != Op::cos)  // comes with its sine
      recorder.emit(n.op, n.a, n.b);
  }
  return recorder.program(outputs);
}

}  // namespace

void saveProgram(std::ostream& out, const Program& program) {
  // Whatever the stream's locale, flags and width: unformatted output, a line at a time.
  const auto line = [&out](std::string text) {
    text += '\n';
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
  };
  line(std::string(header));
  line("states " + std::to_string(program.states()));
  line("parameters " + std::to_string(program.parameters()));
  line("nodes " + std::to_string(program.nodes().size()));
  for (std::size_t i = 0; i < program.nodes().size(); ++i) {
    const Node& n = program.nodes()[i];
    std::string text = std::to_string(i) + ' ' + std::string(nameOf(n.op));
    if (n.op == Op::constant) {
      const Interval& value = program.constants()[detail::at(n.a)];
      text += ' ' + toExactString(value.lower()) + ' ' + toExactString(value.upper());
    } else {
      if (n.a >= 0) text += ' ' + std::to_string(n.a);
      if (n.b >= 0) text += ' ' + std::to_string(n.b);
    }
    line(std::move(text));
  }
  line("outputs " + std::to_string(program.outputs()));
  for (int output : program.outputNodes()) line(std::to_string(output));
  line("end");
}

Program loadProgram(std::istream& in) {
  Lines lines(in);
  if (lines.line(quoted(header)) != header) lines.fail(quoted(header) + " is expected, not " + quoted(lines.text()));
  Parts parts;
  parts.states = lines.count("states");
  parts.parameters = lines.count("parameters");
  const int nodes = lines.count("nodes");
  const long long inputs = 1LL + parts.states + parts.parameters;
  if (nodes < inputs)
    lines.fail("at least " + std::to_string(inputs) + " nodes are expected, one for each input, not " +
               std::to_string(nodes));
  for (int i = 0; i < nodes; ++i) readNode(lines, parts);
  if (parts.nodes.back().op == Op::sin) lines.fail("a sine is followed by its cosine, not by the end of the nodes");
  const int outputCount = lines.count("outputs");
  std::vector<int> outputs;
  for (int i = 0; i < outputCount; ++i) {
    const std::string& line = lines.line("an output");
    const auto node = readNumber(line);
    if (!node || *node >= nodes)
      lines.fail("an output is a node, 0 to " + std::to_string(nodes - 1) + ", not " + quoted(line));
    outputs.push_back(*node);
  }
  if (lines.line("'end'") != "end") lines.fail("'end' is expected, not " + quoted(lines.text()));
  if (lines.hasMore()) lines.fail("nothing is expected behind 'end', not " + quoted(lines.text()));
  return assembled(parts, outputs);
}

}  // namespace gamut
