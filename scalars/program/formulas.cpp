// The readable form: what is used once is written where it is used, unless the line grows too long.
#include <algorithm>
#include <array>
#include <charconv>
#include <ostream>

#include "scalars/index.hpp"
#include "scalars/operations/all.hpp"
#include "scalars/program/passes.hpp"
#include "scalars/program/program_text.hpp"

namespace gamut {
namespace {

using detail::at;

/// How tightly a formula's outermost operation binds: what binds less than its place asks for gets parentheses.
enum Binding { sum, product, power, atom };

struct Formula {
  std::string text;
  Binding binding = atom;
};

constexpr std::size_t longestInside = 48;

/// A double in full; of the enclosure of a number the shortest decimal that cannot be told from it, in braces; of a
/// wide interval both ends.
std::string textOf(const Interval& c) {
  if (isThin(c)) return toString(c.lower());
  for (int digits = 1; digits <= 17 && radius(c) <= 1e-15 * magnitude(c); ++digits) {
    std::array<char, 40> places{};
    const auto result =
        std::to_chars(places.data(), places.data() + places.size(), midpoint(c), std::chars_format::general, digits);
    const std::string text(places.data(), result.ptr);
    if (!isDisjoint(Interval(text), c)) return '{' + text + '}';
  }
  return toString(c);
}

std::string nameIn(const std::vector<std::string>& names, int i, char letter) {
  return at(i) < names.size() ? names[i] : letter + std::to_string(i);
}

class Printer {
 public:
  Printer(const Program& program, const ProgramNames& names)
      : program_(program),
        names_(names),
        formulas_(program.nodes().size()),
        uses_(countedUses(program)),
        isWritten_(program.matrices().size()) {}

  std::string text() {
    std::array<std::string, 2> lines;  // what depends on parameters alone, and the rest
    for (int i = 0; i < static_cast<int>(formulas_.size()); ++i) {
      if (uses_[i].count == 0) continue;
      if (program_.nodes()[i].op == Op::solution) {
        if (program_.nodes()[i].b == 0) writeSolution(i, lines);
        continue;
      }
      Formula formula = formulaOf(i);
      if (isOperation(program_.nodes()[i].op) && !isWrittenInside(i, formula)) {
        const std::string name = 'v' + std::to_string(i);
        lines[program_.isInvariant(i) ? 0 : 1] += "  " + name + " = " + formula.text + '\n';
        formula = {name, atom};
      }
      formulas_[i] = std::move(formula);
    }
    std::string all = lines[0].empty() ? "" : "for given parameters:\n" + lines[0] + "for every state:\n";
    all += lines[1];
    for (int i = 0; i < program_.outputs(); ++i)
      all += "  " + nameIn(names_.outputs, i, 'y') + " = " + formulas_[program_.outputNodes()[i]].text + '\n';
    return all;
  }

 private:
  struct Uses {
    int count = 0;
    bool byOutput = false;
    bool byVarying = false;
  };

  /// Uses in formulas that some output needs.
  static std::vector<Uses> countedUses(const Program& program) {
    std::vector<Uses> uses(program.nodes().size());
    for (int output : program.outputNodes()) {
      ++uses[output].count;
      uses[output].byOutput = true;
    }
    const auto use = [&uses](int node, bool byVarying) {
      ++uses[node].count;
      uses[node].byVarying = uses[node].byVarying || byVarying;
    };
    std::vector<char> isUsed(program.matrices().size());
    for (int i = static_cast<int>(uses.size()) - 1; i >= 0; --i) {
      const Node& n = program.nodes()[i];
      if (uses[i].count == 0) continue;
      const bool varies = !program.isInvariant(i);
      for (int k = 0; k < operandsOf(n.op); ++k) use(k == 0 ? n.a : n.b, varies);
      if (n.op != Op::solution) continue;
      if (n.b > 0) {  // written with component 0
        ++uses[i - n.b].count;
        continue;
      }
      const LinearSolution& solution = program.solutions()[n.a];
      for (int r : solution.rightSide) use(r, varies);
      if (isUsed[solution.matrix] != 0) continue;
      isUsed[solution.matrix] = 1;
      for (int entry : program.matrices()[solution.matrix].entries)
        use(entry, !program.isInvariantMatrix(solution.matrix));
    }
    return uses;
  }

  /// "[a, b, c]".
  template <class Item>
  static std::string list(int count, Item item) {
    std::string text = "[";
    for (int k = 0; k < count; ++k) text += (k == 0 ? "" : ", ") + item(k);
    return text + ']';
  }

  /// "M0 = [[v7, 1], [1, v9]]" before its first solution, and "[v10, v11] = solve(M0, [x0, x1])".
  void writeSolution(int first, std::array<std::string, 2>& lines) {
    const LinearSolution& solution = program_.solutions()[program_.nodes()[first].a];
    const LinearMatrix& matrix = program_.matrices()[solution.matrix];
    const std::string name = 'M' + std::to_string(solution.matrix);
    if (isWritten_[solution.matrix] == 0) {
      isWritten_[solution.matrix] = 1;
      const auto row = [&](int i) {
        return list(matrix.size, [&](int j) { return formulas_[matrix.entry(i, j)].text; });
      };
      lines[program_.isInvariantMatrix(solution.matrix) ? 0 : 1] +=
          "  " + name + " = " + list(matrix.size, row) +
          (matrix.kind == MatrixKind::positiveDefinite ? ", positive definite\n" : "\n");
    }
    const std::string components = list(matrix.size, [&](int k) {
      formulas_[first + k] = {'v' + std::to_string(first + k), atom};
      return formulas_[first + k].text;
    });
    lines[program_.isInvariant(first) ? 0 : 1] +=
        "  " + components + " = solve(" + (solution.transposed ? "transpose(" + name + ')' : name) + ", " +
        list(matrix.size, [&](int k) { return formulas_[solution.rightSide[k]].text; }) + ")\n";
  }

  bool isWrittenInside(int i, const Formula& formula) const {
    const Uses& uses = uses_[i];
    if (uses.count != 1) return false;
    if (program_.isInvariant(i) && program_.parameters() > 0) return !uses.byVarying && !uses.byOutput;
    return uses.byOutput || formula.text.size() <= longestInside;
  }

  /// The formula of an operand, in parentheses where it binds less than asked for.
  std::string operand(int i, Binding least) const {
    const Formula& f = formulas_[i];
    return f.binding >= least ? f.text : '(' + f.text + ')';
  }

  Formula formulaOf(int i) const {
    const Node& n = program_.nodes()[i];
    switch (n.op) {
      case Op::state:
        return {nameIn(names_.states, n.a, 'x')};
      case Op::parameter:
        return {nameIn(names_.parameters, n.a, 'p')};
      case Op::time:
        return {"t"};
      case Op::constant: {
        const std::string text = textOf(program_.constants()[n.a]);
        return {text, text.front() == '-' ? product : atom};
      }
      case Op::add:
        return {operand(n.a, sum) + " + " + operand(n.b, product), sum};
      case Op::sub:
        return {operand(n.a, sum) + " - " + operand(n.b, product), sum};
      case Op::neg:
        return {'-' + operand(n.a, power), sum};
      case Op::mul:
        // A reciprocal that is written here is a division.
        if (isQuotient(n.b)) return {operand(n.a, product) + formulas_[n.b].text.substr(1), product};
        if (isQuotient(n.a)) return {operand(n.b, product) + formulas_[n.a].text.substr(1), product};
        return {operand(n.a, product) + " * " + operand(n.b, power), product};
      case Op::sqr:
        return {operand(n.a, atom) + "^2", power};
      case Op::recip:
        return {"1 / " + operand(n.a, power), product};
      case Op::solution:
        return {};  // written by writeSolution
      default:
        return withFunction(n.op, [&](auto f) -> Formula {
          if (!f.before.empty()) return {std::string(f.before) + formulas_[n.a].text + std::string(f.behind), power};
          return {std::string(nameOf(n.op)) + '(' + formulas_[n.a].text + ')'};
        });
    }
  }

  /// True for a reciprocal that has no name: its formula begins with "1 / ".
  bool isQuotient(int i) const { return program_.nodes()[i].op == Op::recip && formulas_[i].binding == product; }

  const Program& program_;
  const ProgramNames& names_;
  std::vector<Formula> formulas_;
  std::vector<Uses> uses_;
  std::vector<char> isWritten_;  // of matrices
};

/// "3 states", "1 state".
std::string counted(int count, const std::string& what) {
  return std::to_string(count) + ' ' + what + (count == 1 ? "" : "s");
}

}  // namespace

void print(std::ostream& out, const Program& program, const ProgramNames& names) {
  const ProgramCounts counts = countsOf(program);
  std::string text = counted(program.states(), "state") + ", " + counted(program.parameters(), "parameter") + ", " +
                     counted(program.outputs(), "output") + "; " + counted(counts.operations, "operation");
  const char* before = ": ";
  for (int i = 0; i < opCount; ++i) {
    if (counts.of[i] == 0) continue;
    text += before + std::to_string(counts.of[i]) + ' ' + std::string(nameOf(static_cast<Op>(i)));
    before = ", ";
  }
  if (counts.invariant > 0) text += "; " + std::to_string(counts.invariant) + " once for given parameters";
  if (counts.fusedProducts > 0)
    text += "; " + counted(counts.fusedProducts, "product") + " inside " + counted(counts.sums, "sum");
  text += '\n' + Printer(program, names).text();
  out.write(text.data(), static_cast<std::streamsize>(text.size()));  // whatever the stream's locale, flags and width
}

std::ostream& operator<<(std::ostream& out, const Program& program) {
  print(out, program);
  return out;
}

}  // namespace gamut
