// Intervals, recorded numbers, programs. Functions are methods of the names that NumPy asks objects for.
#include <fmt/format.h>
#include <pybind11/operators.h>
#include <pybind11/stl.h>

#include <cmath>
#include <optional>
#include <sstream>

#include "python/doors.hpp"
#include "python/recording.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "scalars/interval.hpp"
#include "scalars/recorded.hpp"

namespace gamut::python {
namespace {

namespace py = pybind11;
using namespace py::literals;

template <class S>
S numberOf(const py::handle& value);
template <>
Interval numberOf<Interval>(const py::handle& value) {
  return enclosing(value);
}
template <>
Recorded numberOf<Recorded>(const py::handle& value) {
  return py::isinstance<Recorded>(value) ? value.cast<Recorded>() : Recorded(enclosing(value));
}

/// Left to the other operand where it is no number, or one that knows more.
template <class S>
bool isOurs(const py::handle& value) {
  return py::isinstance<S>(value) || py::isinstance<Interval>(value) || isNumber(value);
}

template <class S>
S power(const S& x, const S& y) {
  return S(pow(x, y));
}

/// By squares, where a program has no power as great.
template <class S>
S wholePower(const S& x, long exponent) {
  constexpr long most = 1024;
  if (exponent < 0) return S(S(1.0) / wholePower(x, -exponent));
  if (exponent < most) return S(pow(x, static_cast<int>(exponent)));
  const S half = sqr(wholePower(x, exponent / 2));
  return exponent % 2 == 0 ? half : S(half * x);
}

/// The whole number that this is, exactly, as Python compares them; nothing of others.
std::optional<long> wholeNumberIn(const py::handle& value) {
  constexpr long most = 1L << 31;
  if (!isNumber(value)) return {};
  const auto whole = py::reinterpret_steal<py::object>(PyNumber_Long(value.ptr()));
  if (!whole) PyErr_Clear();
  if (!whole || !whole.equal(value) || !(-py::int_(most) <= whole && whole <= py::int_(most))) return {};
  return whole.cast<long>();
}

/// A power that is known: a whole one, or any.
template <class S>
S powerOf(const S& x, const py::handle& exponent) {
  const std::optional<long> whole = wholeNumberIn(exponent);
  return whole ? wholePower(x, *whole) : power(x, numberOf<S>(exponent));
}

/// What all numbers of ours can.
template <class S>
void bindArithmetic(py::class_<S>& number) {
  const auto operation = [&](const char* name, auto compute) {
    number.def(name, [compute](const S& x, const py::object& y) -> py::object {
      if (!isOurs<S>(y)) return py::reinterpret_borrow<py::object>(Py_NotImplemented);
      return py::cast(compute(x, y));
    });
  };
  operation("__add__", [](const S& x, const py::object& y) { return S(x + numberOf<S>(y)); });
  operation("__radd__", [](const S& x, const py::object& y) { return S(numberOf<S>(y) + x); });
  operation("__sub__", [](const S& x, const py::object& y) { return S(x - numberOf<S>(y)); });
  operation("__rsub__", [](const S& x, const py::object& y) { return S(numberOf<S>(y) - x); });
  operation("__mul__", [](const S& x, const py::object& y) { return S(x * numberOf<S>(y)); });
  operation("__rmul__", [](const S& x, const py::object& y) { return S(numberOf<S>(y) * x); });
  operation("__truediv__", [](const S& x, const py::object& y) { return S(x / numberOf<S>(y)); });
  operation("__rtruediv__", [](const S& x, const py::object& y) { return S(numberOf<S>(y) / x); });
  operation("__pow__", [](const S& x, const py::object& y) { return powerOf(x, y); });
  operation("__rpow__", [](const S& x, const py::object& y) { return power(numberOf<S>(y), x); });
  operation("arctan2", [](const S& y, const py::object& x) { return S(atan2(y, numberOf<S>(x))); });
  operation("hypot", [](const S& x, const py::object& y) { return S(hypot(x, numberOf<S>(y))); });
  operation("minimum", [](const S& x, const py::object& y) { return S(min(x, numberOf<S>(y))); });
  operation("maximum", [](const S& x, const py::object& y) { return S(max(x, numberOf<S>(y))); });
  number.def("__neg__", [](const S& x) { return S(-x); }).def("__pos__", [](const S& x) { return x; });
#define GAMUT_METHOD(name, function) number.def(name, [](const S& x) { return S(function(x)); });
  GAMUT_METHOD("__abs__", abs)
  GAMUT_METHOD("absolute", abs)
  GAMUT_METHOD("fabs", abs)
  GAMUT_METHOD("square", sqr)
  GAMUT_METHOD("sqrt", sqrt)
  GAMUT_METHOD("cbrt", cbrt)
  GAMUT_METHOD("exp", exp)
  GAMUT_METHOD("exp2", exp2)
  GAMUT_METHOD("expm1", expm1)
  GAMUT_METHOD("log", log)
  GAMUT_METHOD("log2", log2)
  GAMUT_METHOD("log10", log10)
  GAMUT_METHOD("log1p", log1p)
  GAMUT_METHOD("sin", sin)
  GAMUT_METHOD("cos", cos)
  GAMUT_METHOD("tan", tan)
  GAMUT_METHOD("arcsin", asin)
  GAMUT_METHOD("arccos", acos)
  GAMUT_METHOD("arctan", atan)
  GAMUT_METHOD("sinh", sinh)
  GAMUT_METHOD("cosh", cosh)
  GAMUT_METHOD("tanh", tanh)
  GAMUT_METHOD("arcsinh", asinh)
  GAMUT_METHOD("arccosh", acosh)
  GAMUT_METHOD("arctanh", atanh)
  GAMUT_METHOD("sign", sign)
#undef GAMUT_METHOD
}

void bindInterval(py::module_& module) {
  py::class_<Interval> interval(module, "Interval",
                                "All numbers from lower to upper, both included. Operations enclose every result.");
  interval
      .def(py::init([](const py::object& value) { return enclosing(value); }), "value"_a,
           "Of a float, which is itself; of an int, a Fraction, a Decimal or a text (\"0.1\", \"[0.1, 0.2]\"), which "
           "are "
           "enclosed; of a pair of bounds.")
      .def(py::init([](const py::object& lower, const py::object& upper) {
             return enclosing(py::make_tuple(lower, upper));
           }),
           "lower"_a, "upper"_a)
      .def_property_readonly("lower", [](const Interval& x) { return x.lower(); })
      .def_property_readonly("upper", [](const Interval& x) { return x.upper(); })
      .def_property_readonly("width", [](const Interval& x) { return width(x); })
      .def_property_readonly("middle", [](const Interval& x) { return midpoint(x); })
      .def("__contains__",
           [](const Interval& x, py::object value) {  // Python compares ints, floats, fractions and decimals exactly
             if (py::hasattr(value, "ndim") && py::hasattr(value, "item"))
               value = value.attr("item")();  // NumPy does not
             if (!py::isinstance<Interval>(value))
               return py::object(py::float_(x.lower())) <= value && value <= py::object(py::float_(x.upper()));
             const auto part = value.cast<Interval>();
             return x.lower() <= part.lower() && part.upper() <= x.upper();
           })
      .def(
          "__eq__",
          [](const Interval& x, const Interval& y) { return x.lower() == y.lower() && x.upper() == y.upper(); },
          py::is_operator())
      .def("__hash__", [](const Interval& x) { return py::hash(py::make_tuple(x.lower(), x.upper())); })
      .def(py::pickle([](const Interval& x) { return py::make_tuple(x.lower(), x.upper()); },
                      [](const py::tuple& ends) { return Interval(ends[0].cast<double>(), ends[1].cast<double>()); }))
      .def("__format__",
           [](const Interval& x, const py::str& how) {
             const auto ends = {py::float_(x.lower()), py::float_(x.upper())};
             std::string text;
             for (const py::float_& end : ends)
               text += (text.empty() ? "[" : ", ") + end.attr("__format__")(how).cast<std::string>();
             return text + "]";
           })
      .def("__iter__", [](const Interval& x) { return py::iter(py::make_tuple(x.lower(), x.upper())); })
      .def("__repr__", [](const Interval& x) {
        return x.lower() == x.upper() ? fmt::format("Interval({})", x.lower())
                                      : fmt::format("Interval({}, {})", x.lower(), x.upper());
      });
  bindArithmetic(interval);
}

/// What was asked of a recorded number that it cannot say, in the words of the refusal: NumPy keeps it to itself.
thread_local const char* refusal = nullptr;

/// Python asks a number that is not there yet.
template <class Result>
auto refused(const char* instead) {
  return [instead](const Recorded&, const py::args&) -> Result {
    refusal = instead;
    throw py::type_error(instead);
  };
}

constexpr const char* noBranch =
    "a recorded number has no value yet, so that nothing can depend on how great it is; write gamut.where(x - limit, "
    "above, below), which chooses by the sign of the first, gamut.minimum, gamut.maximum or abs";
constexpr const char* noValue =
    "a recorded number has no value yet, so that it is no float; write gamut.sin, gamut.exp and the like, not those of "
    "math";

void bindRecorded(py::module_& module) {
  py::class_<Recorded> recorded(
      module, "Recorded",
      "A number of a right-hand side that is being recorded: what is done with it is written down.");
  recorded.def(py::init([](const py::object& value) { return numberOf<Recorded>(value); }));
  bindArithmetic(recorded);
  for (const char* name : {"__lt__", "__le__", "__gt__", "__ge__", "__eq__", "__ne__", "__bool__"})
    recorded.def(name, refused<bool>(noBranch));
  recorded.def("__float__", refused<double>(noValue)).def("__int__", refused<int>(noValue));
  recorded.def("__index__", refused<int>(noValue)).attr("__hash__") = py::none();
  recorded.def("__repr__", [](const Recorded&) { return "<a recorded number>"; });
  module.def("where", [](const py::object& c, const py::object& x, const py::object& y) {
    return where(numberOf<Recorded>(c), numberOf<Recorded>(x), numberOf<Recorded>(y));
  });
}

template <class S>
std::vector<S> evaluated(const Program& program, const py::sequence& x, const py::sequence& p, const py::object& t) {
  const auto numbers = [](const py::sequence& all) {
    std::vector<S> result;
    for (const py::handle each : all)
      if constexpr (std::is_same_v<S, double>)
        result.push_back(py::float_(py::reinterpret_borrow<py::object>(each)));
      else
        result.push_back(enclosing(each));
    return result;
  };
  Evaluator<S> evaluator(program);
  evaluator.setParameters(numbers(p));
  return evaluator(numbers(py::make_tuple(t)).front(), numbers(x));
}

/// Floats of floats; intervals where one of the numbers is.
py::object valuesOf(const Program& program, const py::sequence& x, const py::sequence& p, const py::object& t) {
  if (x.size() != static_cast<std::size_t>(program.states()) ||
      p.size() != static_cast<std::size_t>(program.parameters()))
    throw std::invalid_argument(fmt::format("the program takes {} states and {} parameters, not {} and {}",
                                            program.states(), program.parameters(), x.size(), p.size()));
  bool areFloats = !py::isinstance<Interval>(t);
  for (const py::sequence& all : {x, p})
    for (const py::handle each : all) areFloats = areFloats && !py::isinstance<Interval>(each);
  return areFloats ? py::cast(evaluated<double>(program, x, p, t)) : py::cast(evaluated<Interval>(program, x, p, t));
}

void bindProgram(py::module_& module) {
  py::class_<Program>(module, "Program", "A recorded function y = f(t, x, p): a straight line of operations.")
      .def(py::init([](const py::function& function, int states, int parameters) {
             return recordedFrom(function, states, parameters);
           }),
           "function"_a, "states"_a, "parameters"_a = 0)
      .def_property_readonly("states", &Program::states)
      .def_property_readonly("parameters", &Program::parameters)
      .def_property_readonly("outputs", &Program::outputs)
      .def_property_readonly("operations", &Program::operations)
      .def("differentiated", &Program::differentiated, "with_parameters"_a = false,
           "Its outputs, then their derivatives by each state (and parameter), output by output.")
      .def("__call__", valuesOf, "x"_a, "p"_a = py::tuple(), "t"_a = 0.0,
           "Of floats a list of floats; of Intervals, or some of them, enclosures.")
      .def("__str__", [](const Program& program) {
        std::ostringstream text;
        text << program;
        return text.str();
      });
}

}  // namespace

bool isNumber(const py::handle& value) {
  if (PyFloat_Check(value.ptr()) != 0 || PyLong_Check(value.ptr()) != 0) return true;
  if (py::hasattr(value, "ndim")) return value.attr("ndim").cast<int>() == 0 && PyNumber_Check(value.ptr()) != 0;
  return py::hasattr(value, "as_integer_ratio");  // fractions and decimals
}

Interval enclosing(const py::handle& value) {
  if (py::isinstance<Interval>(value)) return value.cast<Interval>();
  if (PyFloat_Check(value.ptr()) != 0) return Interval(PyFloat_AsDouble(value.ptr()));
  if (PyLong_Check(value.ptr()) != 0 || py::isinstance<py::str>(value))
    return Interval(py::str(value).cast<std::string>());
  if (py::isinstance<py::tuple>(value) || py::isinstance<py::list>(value) ||
      (py::hasattr(value, "ndim") && !isNumber(value))) {
    const auto ends = py::list(py::reinterpret_borrow<py::object>(value));
    if (ends.size() == 2) return {enclosing(ends[0]).lower(), enclosing(ends[1]).upper()};
  }
  if (isNumber(value) && py::hasattr(value, "as_integer_ratio")) {
    const py::tuple ratio = value.attr("as_integer_ratio")();
    return enclosing(ratio[0]) / enclosing(ratio[1]);
  }
  if (isNumber(value) && py::hasattr(value, "item")) {
    const py::object item = value.attr("item")();
    if (!item.get_type().is(py::type::of(value))) return enclosing(item);
  }
  throw py::type_error("expected a number, a text that is one, or a pair of bounds, not " +
                       py::repr(value).cast<std::string>());
}

Program recordedFrom(const py::function& function, int states, int parameters) {
  if (states < 0 || parameters < 0)
    throw std::invalid_argument("numbers of states and parameters must not be negative");
  const auto called = [&](const auto& t, const auto& x, const auto& p) {
    py::list allX, allP;
    for (int i = 0; i < states; ++i) allX.append(Recorded(x[static_cast<std::size_t>(i)]));
    for (int i = 0; i < parameters; ++i) allP.append(Recorded(p[static_cast<std::size_t>(i)]));
    refusal = nullptr;
    const py::object returned = function(Recorded(t), allX, allP);
    if (refusal != nullptr) throw py::type_error(refusal);
    if (!py::isinstance<py::sequence>(returned) && !py::hasattr(returned, "ndim"))
      throw py::type_error("the function is to return a list of numbers, not " +
                           py::repr(returned).cast<std::string>());
    return py::list(returned);
  };
  std::size_t outputs = 0;  // they are counted first
  record(states, parameters, 0, [&](auto t, const auto& x, const auto& p, auto&) { outputs = called(t, x, p).size(); });
  return record(states, parameters, static_cast<int>(outputs), [&](auto t, const auto& x, const auto& p, auto& y) {
    const py::list values = called(t, x, p);
    if (values.size() != outputs) throw std::invalid_argument("the function returns now more numbers, now fewer");
    for (std::size_t i = 0; i < outputs; ++i) y[i] = numberOf<Recorded>(values[i]);
  });
}

void bindNumbers(py::module_& module) {
  bindInterval(module);
  bindRecorded(module);
  bindProgram(module);
}

}  // namespace gamut::python
