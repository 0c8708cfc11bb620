// The kept form: nothing is read that evaluators could stumble over.
#include "scalars/program/program_text.hpp"

#include <algorithm>
#include <charconv>
#include <istream>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include "scalars/index.hpp"
#include "scalars/operations/all.hpp"
#include "scalars/program/recorder.hpp"

namespace gamut {
namespace {

/// Of programs without linear systems, and with them.
constexpr std::string_view header = "gamut-program 1", headerWithSystems = "gamut-program 2";

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

std::string_view nameOf(MatrixKind kind) { return kind == MatrixKind::general ? "general" : "positiveDefinite"; }

/// More words than any line of a program has but those of linear systems.
constexpr std::size_t tooMany = 5;

/// What is between single blanks, the first words.
std::vector<std::string_view> split(std::string_view all, std::size_t most) {
  std::vector<std::string_view> result;
  for (std::size_t begin = 0; begin <= all.size() && result.size() < most;) {
    const std::size_t end = std::min(all.find(' ', begin), all.size());
    result.push_back(all.substr(begin, end - begin));
    begin = end + 1;
  }
  return result;
}

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
  std::vector<std::string_view> words(std::string_view expected) { return split(line(expected), tooMany); }
  /// All words of the line that was read last.
  std::vector<std::string_view> allWords() const { return split(line_, line_.size() + 1); }

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

/// "sine", "tanh"
std::string nounOf(Op op) {
  const std::string_view noun = withFunction(op, [](auto f) { return f.noun; });
  return std::string(noun.empty() ? nameOf(op) : noun);
}

/// Of an operation that another always follows.
std::string pairText(Op op) { return "a " + nounOf(op) + " is followed by its " + nounOf(twinOf(op)); }

/// What has been read so far; every node in it may be relied on.
struct Parts : detail::NodeList {
  int states = 0, parameters = 0;
  bool hasSystems = false;  // by the header
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

/// The nodes in words from `first` on, each before the node that comes next.
std::vector<int> readOperands(const Lines& lines, const std::vector<std::string_view>& words, std::size_t first,
                              const Parts& parts) {
  std::vector<int> operands;
  for (std::size_t i = first; i < words.size(); ++i) {
    const auto operand = readNumber(words[i]);
    if (!operand || detail::at(*operand) >= parts.nodes.size())
      lines.fail("an operand is a node before this one, 0 to " + std::to_string(parts.nodes.size() - 1) + ", not " +
                 quoted(words[i]));
    operands.push_back(*operand);
  }
  return operands;
}

/// "matrix general 4 5 6 7"
void readMatrix(const Lines& lines, Parts& parts) {
  const auto words = lines.allWords();
  const std::string_view kind = words.size() > 1 ? words[1] : "";
  LinearMatrix matrix;
  for (MatrixKind known : {MatrixKind::general, MatrixKind::positiveDefinite})
    if (nameOf(known) == kind) matrix.kind = known;
  if (nameOf(matrix.kind) != kind)
    lines.fail("a matrix is 'general' or 'positiveDefinite', not " + quoted(lines.text()));
  matrix.entries = readOperands(lines, words, 2, parts);
  while (detail::at(matrix.size) * detail::at(matrix.size) < matrix.entries.size()) ++matrix.size;
  if (matrix.size == 0 || detail::at(matrix.size) * detail::at(matrix.size) != matrix.entries.size())
    lines.fail("a matrix has as many columns as rows, not " + std::to_string(matrix.entries.size()) + " entries");
  for (int i = 0; i < matrix.size && matrix.kind == MatrixKind::positiveDefinite; ++i)
    for (int j = 0; j < i; ++j)
      if (matrix.entry(i, j) != matrix.entry(j, i))
        lines.fail("the entries (i, j) and (j, i) of a positive definite matrix are the same node, not " +
                   std::to_string(matrix.entry(i, j)) + " and " + std::to_string(matrix.entry(j, i)));
  parts.matrices.push_back(std::move(matrix));
}

/// "14 solution 0 1 2" or "14 solution 0 transposed 1 2", behind the matrix if it is its first solution.
void readSolution(const Lines& lines, bool isFirst, Parts& parts) {
  const auto words = lines.allWords();
  LinearSolution solution;
  const auto number = words.size() > 2 ? readNumber(words[2]) : std::nullopt;
  if (!number || detail::at(*number) >= parts.matrices.size())
    lines.fail("a solution is one of a matrix before it, not " + quoted(lines.text()));
  solution.matrix = *number;
  if (isFirst && detail::at(*number) + 1 != parts.matrices.size())
    lines.fail("a matrix is followed by its first solution, not by one of matrix " + std::to_string(*number));
  const LinearMatrix& matrix = parts.matrices[*number];
  solution.transposed = words.size() > 3 && words[3] == "transposed";
  if (solution.transposed && matrix.kind == MatrixKind::positiveDefinite)
    lines.fail("a positive definite matrix is not transposed: " + quoted(lines.text()));
  solution.rightSide = readOperands(lines, words, solution.transposed ? 4 : 3, parts);
  if (solution.rightSide.size() != detail::at(matrix.size))
    lines.fail("a solution of " + std::to_string(matrix.size) + " equations has as many right-hand sides, not " +
               std::to_string(solution.rightSide.size()));
  parts.solutions.push_back(std::move(solution));
  parts.push({Op::solution, static_cast<int>(parts.solutions.size()) - 1, 0});
}

/// How many components of the last solution are still to come.
int missingComponents(const Parts& parts) {
  const Node& last = parts.nodes.back();
  if (last.op != Op::solution) return 0;
  return static_cast<int>(parts.solutions[last.a].rightSide.size()) - 1 - last.b;
}

Node readOperation(const Lines& lines, const std::vector<std::string_view>& words, Op op, const Parts& parts) {
  const int number = static_cast<int>(parts.nodes.size());
  const bool hasDenominator = isFunction(op) && withFunction(op, [](auto f) { return f.hasDenominator; });
  const bool hasSecond = operandsOf(op) == 2 || hasDenominator;
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
  if (hasDenominator)
    withFunction(op, [&](auto f) {
      if constexpr (f.hasDenominator)
        if (!f.isDenominator(parts, node.b, node.a)) lines.fail(f.denominatorMessage(node.b, quoted(lines.text())));
    });
  return node;
}

void readNode(Lines& lines, Parts& parts) {
  const int number = static_cast<int>(parts.nodes.size());
  auto words = lines.words("node " + std::to_string(number));
  const bool isNext = !inputAt(parts, number).empty() || hasTwin(parts.nodes.back().op) || missingComponents(parts) > 0;
  const bool hasMatrix = parts.hasSystems && words[0] == "matrix" && !isNext;
  if (hasMatrix) {
    readMatrix(lines, parts);
    words = lines.words("the matrix's first solution");
  }
  if (words[0] != std::to_string(number))
    lines.fail("node " + std::to_string(number) + " is expected, not " + quoted(lines.text()));
  if (const int missing = inputAt(parts, number).empty() ? missingComponents(parts) : 0; missing > 0) {
    const Node& last = parts.nodes.back();
    const std::string expected = std::to_string(number) + " component " + std::to_string(last.b + 1);
    if (lines.text() != expected) lines.fail(quoted(expected) + " is expected, not " + quoted(lines.text()));
    parts.push({Op::solution, last.a, last.b + 1});
    return;
  }
  const auto op = words.size() > 1 ? readOp(words[1]) : std::nullopt;
  if (hasMatrix && op != Op::solution)
    lines.fail("a matrix is followed by its first solution, not by " + quoted(lines.text()));
  if (!op || (op == Op::solution && !parts.hasSystems))
    lines.fail("an operation is expected behind the number, not " + quoted(lines.text()));
  if (const std::string input = inputAt(parts, number); !input.empty()) {
    if (lines.text() != std::to_string(number) + " " + input)
      lines.fail(quoted(std::to_string(number) + " " + input) + " is expected, not " + quoted(lines.text()));
    parts.push({*op, *op == Op::time ? -1 : *op == Op::state ? number : number - parts.states});
    return;
  }
  const Node before = parts.nodes.back();
  if (hasTwin(before.op) && *op != twinOf(before.op)) lines.fail(pairText(before.op) + ", not by " + quoted(words[1]));
  if (*op == Op::constant) {
    parts.constants.push_back(readConstant(lines, words));
    parts.push({Op::constant, static_cast<int>(parts.constants.size()) - 1});
    return;
  }
  if (*op == Op::solution) return readSolution(lines, hasMatrix, parts);
  if (!isOperation(*op)) lines.fail("inputs come before all other nodes, not " + quoted(lines.text()));
  const Node node = readOperation(lines, words, *op, parts);
  if (isTwin(*op) && (twinOf(before.op) != *op || isTwin(before.op) || before.a != node.a))
    lines.fail("a " + nounOf(*op) + " follows the " + nounOf(gamut::before(*op)) + " of the same node, not " +
               quoted(lines.text()));
  parts.push(node);
}

/// Writes the nodes down without rules: each gets its own number again.
Program assembled(const Parts& parts, const std::vector<int>& outputs) {
  Recorder recorder(parts.states, parts.parameters, RuleSet::none());
  for (std::size_t i = detail::at(recorder.size()); i < parts.nodes.size(); ++i) {
    const Node& n = parts.nodes[i];
    if (n.op == Op::constant) {
      recorder.constant(parts.constants[n.a]);
    } else if (n.op == Op::solution && n.b == 0) {
      const LinearSolution& solution = parts.solutions[n.a];
      if (detail::at(solution.matrix) == recorder.table().matrices.size())
        recorder.matrix(parts.matrices[solution.matrix]);
      recorder.solve(solution.matrix, solution.transposed, solution.rightSide);
    } else if (!isTwin(n.op) && n.op != Op::solution) {  // these come with the first of their pairs and components
      recorder.emit(n.op, n.a, n.b);
    }
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
  line(std::string(program.matrices().empty() ? header : headerWithSystems));
  line("states " + std::to_string(program.states()));
  line("parameters " + std::to_string(program.parameters()));
  line("nodes " + std::to_string(program.nodes().size()));
  const auto add = [](std::string& text, const std::vector<int>& nodes) {
    for (int node : nodes) text += ' ' + std::to_string(node);
  };
  std::size_t matrices = 0;  // that have been written
  for (std::size_t i = 0; i < program.nodes().size(); ++i) {
    const Node& n = program.nodes()[i];
    std::string text = std::to_string(i) + ' ' + std::string(nameOf(n.op));
    if (n.op == Op::solution && n.b > 0) {
      text = std::to_string(i) + " component " + std::to_string(n.b);
    } else if (n.op == Op::solution) {
      const LinearSolution& solution = program.solutions()[n.a];
      if (detail::at(solution.matrix) == matrices) {
        const LinearMatrix& matrix = program.matrices()[matrices++];
        std::string entries = "matrix " + std::string(nameOf(matrix.kind));
        add(entries, matrix.entries);
        line(std::move(entries));
      }
      text += ' ' + std::to_string(solution.matrix) + (solution.transposed ? " transposed" : "");
      add(text, solution.rightSide);
    } else if (n.op == Op::constant) {
      const Interval& value = program.constants()[n.a];
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
  Parts parts;
  parts.hasSystems = lines.line(quoted(header)) == headerWithSystems;
  if (!parts.hasSystems && lines.text() != header)
    lines.fail(quoted(header) + " is expected, not " + quoted(lines.text()));
  parts.states = lines.count("states");
  parts.parameters = lines.count("parameters");
  const int nodes = lines.count("nodes");
  const long long inputs = 1LL + parts.states + parts.parameters;
  if (nodes < inputs)
    lines.fail("at least " + std::to_string(inputs) + " nodes are expected, one for each input, not " +
               std::to_string(nodes));
  for (int i = 0; i < nodes; ++i) readNode(lines, parts);
  if (const Op last = parts.nodes.back().op; hasTwin(last))
    lines.fail(pairText(last) + ", not by the end of the nodes");
  if (missingComponents(parts) > 0)
    lines.fail("component " + std::to_string(parts.nodes.back().b + 1) + " is expected, not the end of the nodes");
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
