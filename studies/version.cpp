// Versions at run time where the library tells them, otherwise those of the headers.
#include "studies/version.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <gmp.h>
#include <gsl/gsl_version.h>
#include <mpfr.h>
#include <sundials/sundials_config.h>
#include <unistd.h>

#include <Eigen/Core>
#include <array>
#include <boost/version.hpp>
#include <ctime>

#include "studies/results/results_file.hpp"

namespace gamut {

std::string version() { return GAMUT_VERSION; }

std::vector<LibraryInfo> libraryVersions() {
  return {
      {"Boost", fmt::format("{}.{}.{}", BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100)},
      {"Eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"GMP", gmp_version},
      {"GSL", gsl_version},
      {"HDF5", hdf5Version()},
      {"MPFR", mpfr_get_version()},
      {"SUNDIALS", SUNDIALS_VERSION},
  };
}

std::string hostName() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

std::string dateTime() { return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))); }

}  // namespace gamut
