// Prints a digest of verified inverses, solutions and determinants of matrices of several sizes, badly conditioned ones
// included: the same however this was compiled. Ends with 1 if an enclosure misses an inverse known exactly.
#include "scalars/algebra/verified_algebra.hpp"

#include <bit>
#include <cstdint>
#include <cstdio>
#include <random>

namespace {

using namespace gamut;

std::uint64_t digest = 0xcbf29ce484222325;

void include(const Interval& x) {
  for (const double bound : {x.lower(), x.upper()})
    digest = (digest ^ std::bit_cast<std::uint64_t>(bound)) * 0x100000001b3;
}

template <class T>
void include(const Verified<T>& result) {
  digest = (digest ^ (result ? 1u : 2u)) * 0x100000001b3;
  if (result)
    for (const Interval& x : result->reshaped()) include(x);
}

}  // namespace

int main() {
  std::mt19937 engine(1);
  const auto uniform = [&] { return static_cast<double>(engine()) * 0x1p-31 - 1; };
  for (const int n : {1, 2, 3, 5, 6, 7, 12, 30}) {
    for (int round = 0; round < 40; ++round) {
      Eigen::MatrixXd a(n, n), b(n, 2);
      for (double& x : a.reshaped()) x = uniform();
      for (double& x : b.reshaped()) x = uniform();
      if (round % 2 == 0) a.row(0) = a.row(n - 1) + 1e-9 * a.row(0);
      include(verifiedInverse(a));
      include(verifiedSolve(a, b));
      const auto determinant = verifiedDeterminant(a);
      if (determinant) include(determinant->value);
    }
  }
  // A triangular matrix of small integers has an inverse of integers.
  Eigen::MatrixXd triangle = Eigen::MatrixXd::Identity(12, 12), inverse = triangle;
  for (int i = 0; i + 1 < 12; ++i) triangle(i, i + 1) = 2;
  for (int i = 0; i < 12; ++i)
    for (int j = i + 1; j < 12; ++j) inverse(i, j) = -2 * inverse(i, j - 1);
  const auto enclosed = verifiedInverse(triangle);
  bool holds = static_cast<bool>(enclosed);
  for (int i = 0; i < 12 && holds; ++i)
    for (int j = 0; j < 12; ++j) holds = holds && contains((*enclosed)(i, j), inverse(i, j));
  std::printf("%016llx\n", static_cast<unsigned long long>(digest));
  return holds ? 0 : 1;
}
