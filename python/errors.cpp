#include <pybind11/pybind11.h>

#include <string>

#include "python/doors.hpp"
#include "studies/atomic_file.hpp"
#include "studies/comparing/shared.hpp"
#include "studies/results/results_file.hpp"
#include "studies/study.hpp"

namespace gamut::python {
namespace {

namespace py = pybind11;

/// Makes one of gamut.errors the interpreter's error.
template <class... Arguments>
void raise(const char* name, const Arguments&... arguments) {
  const py::object type = py::module_::import("gamut.errors").attr(name);
  PyErr_SetObject(type.ptr(), type(arguments...).ptr());
}

void translate(std::exception_ptr thrown) try {
  if (thrown) std::rethrow_exception(thrown);
} catch (const StudyError& error) {
  raise("StudyError", error.place(), error.problem(), error.expected());
} catch (const ResultsFileError& error) {
  raise("ResultsFileError", error.what());
} catch (const NotComparable& error) {
  raise("NotComparable", error.what());
} catch (const OutputRefused& error) {
  const std::string said = error.what(), option = "--force";
  const auto at = said.rfind(option);
  if (at == said.npos)
    PyErr_SetString(PyExc_OSError, said.c_str());
  else
    PyErr_SetString(PyExc_FileExistsError, (said.substr(0, at) + "overwrite=True").c_str());
} catch (const WriteError& error) {
  PyErr_SetString(PyExc_OSError, error.what());
}

}  // namespace

void bindErrors() { py::register_exception_translator(translate); }

}  // namespace gamut::python
