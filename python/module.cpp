#include "python/doors.hpp"

PYBIND11_MODULE(_gamut, module) {
  using namespace gamut::python;
  module.doc() = "What the package gamut stands on.";
  bindErrors();
  bindNumbers(module);
  bindFlow(module);
  bindStudies(module);
  bindResults(module);
  bindSweeps(module);
}
