// Intervals, recorded numbers, programs. Functions are methods of the names that NumPy asks objects for.
#include <fmt/format.h>
#include <pybind11/operators.h>
#include <pybind11/stl.h>

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

/// A power that is known: a whole one, or any.
template <class S>
S power(const S& x, double exponent) {
  const auto whole = static_cast<int>(exponent);
  return std::abs(exponent) < 1024 && whole == exponent ? S(pow(x, whole)) : S(pow(x, S(exponent)));
}

/// What all numbers of ours can.
template <class S>
void bindArithmetic(py::class_<S>& number) {
  number.def(py::self + py::self)
      .def(py::self - py::self)
      .def(py::self * py::self)
      .def(py::self / py::self)
      .def(-py::self)
      .def(double() + py::self)
      .def(double() - py::self)
      .def(double() * py::self)
      .def(double() / py::self)
      .def("__pos__", [](const S& x) { return x; })
      .def("__pow__", power<S>)
      .def("__pow__", [](const S& x, const S& y) { return S(pow(x, y)); })
      .def("__rpow__", [](const S& y, double x) { return S(pow(S(x), y)); });
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
  number.def("arctan2", [](const S& y, const S& x) { return S(atan2(y, x)); })
      .def("hypot", [](const S& x, const S& y) { return S(hypot(x, y)); })
      .def("minimum", [](const S& x, const S& y) { return S(min(x, y)); })
      .def("maximum", [](const S& x, const S& y) { return S(max(x, y)); });
}

void bindInterval(py::module_& module) {
  py::class_<Interval> interval(module, "Interval",
                                "All numbers from lower to upper, both included. Operations enclose every result.");
  interval.def(py::init<double>(), "value"_a)
      .def(py::init<double, double>(), "lower"_a, "upper"_a)
      .def(py::init([](const std::string& text) { return Interval(text); }), "text"_a,
           "An enclosure of a decimal, \"0.1\", or of bounds, \"[0.1, 0.2]\".")
      .def_property_readonly("lower", [](const Interval& x) { return x.lower(); })
      .def_property_readonly("upper", [](const Interval& x) { return x.upper(); })
      .def_property_readonly("width", [](const Interval& x) { return width(x); })
      .def_property_readonly("middle", [](const Interval& x) { return midpoint(x); })
      .def("__contains__", [](const Interval& x, double value) { return contains(x, value); })
      .def("__contains__", [](const Interval& x,
                              const Interval& part) { return x.lower() <= part.lower() && part.upper() <= x.upper(); })
      .def("__eq__",
           [](const Interval& x, const Interval& y) { return x.lower() == y.lower() && x.upper() == y.upper(); })
      .def("__hash__", [](const Interval& x) { return py::hash(py::make_tuple(x.lower(), x.upper())); })
      .def("__iter__", [](const Interval& x) { return py::iter(py::make_tuple(x.lower(), x.upper())); })
      .def("__repr__", [](const Interval& x) {
        return x.lower() == x.upper() ? fmt::format("Interval({})", x.lower())
                                      : fmt::format("Interval({}, {})", x.lower(), x.upper());
      });
  bindArithmetic(interval);
  py::implicitly_convertible<double, Interval>();
  py::implicitly_convertible<py::int_, Interval>();
}

/// Python asks a number that is not there yet.
template <class Result>
auto refused(const char* instead) {
  return [instead](const Recorded&, const py::args&) -> Result {
    throw py::type_error(
        std::string("a recorded number has no value yet, so that nothing can depend on how great it is; ") + instead);
  };
}

void bindRecorded(py::module_& module) {
  py::class_<Recorded> recorded(
      module, "Recorded",
      "A number of a right-hand side that is being recorded: what is done with it is written down.");
  recorded.def(py::init<double>()).def(py::init<Interval>());
  bindArithmetic(recorded);
  const char* const choose = "write gamut.where(condition, above, below), gamut.minimum, gamut.maximum or abs";
  for (const char* name : {"__lt__", "__le__", "__gt__", "__ge__", "__eq__", "__ne__", "__bool__"})
    recorded.def(name, refused<bool>(choose));
  const char* const compute = "write gamut.sin, gamut.exp and the like, or NumPy's, not those of math";
  recorded.def("__float__", refused<double>(compute)).def("__int__", refused<int>(compute));
  recorded.def("__index__", refused<int>(compute)).attr("__hash__") = py::none();
  recorded.def("__repr__", [](const Recorded&) { return "<a recorded number>"; });
  py::implicitly_convertible<double, Recorded>();
  py::implicitly_convertible<py::int_, Recorded>();
  py::implicitly_convertible<Interval, Recorded>();
  module.def("where", [](const Recorded& c, const Recorded& x, const Recorded& y) { return where(c, x, y); });
}

template <class S>
std::vector<S> evaluated(const Program& program, const std::vector<S>& x, const std::vector<S>& p, const S& t) {
  if (static_cast<int>(x.size()) != program.states() || static_cast<int>(p.size()) != program.parameters())
    throw std::invalid_argument(fmt::format("the program takes {} states and {} parameters, not {} and {}",
                                            program.states(), program.parameters(), x.size(), p.size()));
  Evaluator<S> evaluator(program);
  evaluator.setParameters(p);
  return evaluator(t, x);
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
      .def("__call__", evaluated<double>, "x"_a, "p"_a = std::vector<double>(), "t"_a = 0.0)
      .def("__call__", evaluated<Interval>, "x"_a, "p"_a = std::vector<Interval>(), "t"_a = Interval(0.0))
      .def("__str__", [](const Program& program) {
        std::ostringstream text;
        text << program;
        return text.str();
      });
}

}  // namespace

Program recordedFrom(const py::function& function, int states, int parameters) {
  if (states < 0 || parameters < 0)
    throw std::invalid_argument("numbers of states and parameters must not be negative");
  const auto called = [&](const auto& t, const auto& x, const auto& p) {
    py::list allX, allP;
    for (int i = 0; i < states; ++i) allX.append(Recorded(x[static_cast<std::size_t>(i)]));
    for (int i = 0; i < parameters; ++i) allP.append(Recorded(p[static_cast<std::size_t>(i)]));
    return py::list(function(Recorded(t), allX, allP));
  };
  std::size_t outputs = 0;  // they are counted first
  record(states, parameters, 0, [&](auto t, const auto& x, const auto& p, auto&) { outputs = called(t, x, p).size(); });
  return record(states, parameters, static_cast<int>(outputs), [&](auto t, const auto& x, const auto& p, auto& y) {
    const py::list values = called(t, x, p);
    if (values.size() != outputs) throw std::invalid_argument("the function returns now more numbers, now fewer");
    for (std::size_t i = 0; i < outputs; ++i) y[i] = values[i].cast<Recorded>();
  });
}

void bindNumbers(py::module_& module) {
  bindInterval(module);
  bindRecorded(module);
  bindProgram(module);
}

}  // namespace gamut::python
