// Shapes and squares are what a fixed iteration comes to from the nominal ones, x_j −= (Φᵀ(K − ρM)Φ x)_j/(λ_j − λ_k)
// with ρ Rayleigh's quotient: each step knows one power of the parameters' deviations more (Rayleigh & Schrödinger).
#include "mechanics/rest_vibration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mechanics/rest_algebra.hpp"
#include "mechanics/rest_position.hpp"
#include "scalars/algebra/decompositions.hpp"
#include "scalars/algebra/linear_system.hpp"
#include "scalars/algebra/triangle.hpp"
#include "scalars/evaluation/evaluate.hpp"

namespace gamut {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

Matrix symmetricMatrix(std::span<const double> triangle, int size) {
  Matrix m(size, size);
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j) m(i, j) = triangle[triangleEntry(i, j)];
  return m;
}

Program recordPencil(const RestRows& of) {
  const int n = of.coordinates, f = n - of.loops, triangle = f * (f + 1) / 2;
  return record(of.size, of.parameters, of.size + 2 * triangle, [&](auto, const auto& x, const auto& p, auto& y) {
    const LinearRows<Recorded> at = of.at<Recorded>({x.begin(), x.end()}, p);
    std::ranges::copy(at.rows, y.begin());
    // Z, column by column; its rows at free coordinates are those of the unit matrix
    std::vector<std::vector<Recorded>> z;
    std::vector<Recorded> held;
    const auto slope = [&](int row, int column) {
      return at.byPosition[(of.size - of.loops + row) * of.size + column];
    };
    for (int k = 0; k < of.loops; ++k)
      for (const int dependent : of.dependents) held.push_back(slope(k, dependent));
    for (int i = 0; i < n; ++i) {
      if (std::ranges::find(of.dependents, i) != of.dependents.end()) continue;
      std::vector<Recorded>& column = z.emplace_back(n, Recorded(0.0));
      column[i] = Recorded(1.0);
      if (of.loops == 0) continue;
      std::vector<Recorded> right;
      for (int k = 0; k < of.loops; ++k) right.push_back(-slope(k, i));
      LinearSystem<Recorded>(MatrixKind::general, of.loops, held).solve(right);
      for (int k = 0; k < of.loops; ++k) column[of.dependents[k]] = right[k];
    }
    int next = of.size;
    for (const std::vector<Recorded>* m : {&at.byPosition, &at.byAcceleration})
      for (int a = 0; a < f; ++a)
        for (int b = 0; b <= a; ++b) {
          Recorded sum(0.0);
          for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j)
              if (!isKnownZero(z[a][i]) && !isKnownZero(z[b][j])) sum = sum - z[a][i] * (*m)[i * of.size + j] * z[b][j];
          y[next++] = sum;
        }
  });
}

/// By how much each quantity alone, to its ends, couples two modes at most, added up: of ω².
Matrix couplingsOf(const RestRows& of, const RestVibration& vibration, const std::vector<double>& v,
                   const Box& parameters) {
  const int f = vibration.size, triangle = f * (f + 1) / 2;
  const Matrix basis = squareMatrix(vibration.basis, f);
  std::vector<double> values;
  for (const Interval& each : parameters) values.push_back(midpoint(each));
  Evaluator<double> pencil(vibration.pencil);
  Matrix sum = Matrix::Zero(f, f);
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (isThin(parameters[k])) continue;
    std::array<Matrix, 2> stiffness, mass;
    for (int side = 0; side < 2; ++side) {
      std::vector<double> there = values;
      there[k] = side == 0 ? parameters[k].lower() : parameters[k].upper();
      pencil.setParameters(there);
      const std::vector<double> all = pencil(0.0, rooted(of, v, there));
      const std::span<const double> entries = std::span<const double>(all).subspan(of.size);
      stiffness[side] = basis.transpose() * symmetricMatrix(entries.first(triangle), f) * basis;
      mass[side] = basis.transpose() * symmetricMatrix(entries.last(triangle), f) * basis;
    }
    for (int i = 0; i < f; ++i)
      for (int j = 0; j < f; ++j)
        sum(i, j) += 0.5 * std::abs(stiffness[1](i, j) - stiffness[0](i, j) -
                                    vibration.squares[j] * (mass[1](i, j) - mass[0](i, j)));
  }
  return sum;
}

using Position = std::function<std::vector<Recorded>(std::span<const Recorded>)>;

/// ΦᵀKΦ and ΦᵀMΦ of parameters.
struct ModalPencil {
  std::vector<Recorded> stiffness, mass;

  ModalPencil(const RestRows& of, const RestVibration& vibration, const Position& position,
              std::span<const Recorded> parameters) {
    const int f = vibration.size, triangle = f * (f + 1) / 2;
    const std::vector<Recorded> all =
        evaluate<Recorded>(vibration.pencil, position(parameters), {parameters.begin(), parameters.end()});
    const std::span<const Recorded> entries = std::span<const Recorded>(all).subspan(of.size);
    stiffness = congruent<Recorded>(entries.first(triangle), vibration.basis, f, f);
    mass = congruent<Recorded>(entries.last(triangle), vibration.basis, f, f);
  }
  /// K x, M x and Rayleigh's quotient.
  struct Image {
    std::vector<Recorded> held, resisted;
    Recorded quotient;
  };
  Image of(std::span<const Recorded> x) const {
    Image image{times<Recorded>(stiffness, x), times<Recorded>(mass, x), {}};
    Recorded above(0.0), below(0.0);
    for (std::size_t i = 0; i < x.size(); ++i) {
      above = above + x[i] * image.held[i];
      below = below + x[i] * image.resisted[i];
    }
    image.quotient = above / below;
    return image;
  }
};

Program recordShapes(const RestRows& of, const RestVibration& vibration, const Matrix& couplings,
                     const Position& position) {
  constexpr int steps = 2;
  constexpr double apart = 0.5;  // a coupling, of the distance of two ω², that they bear
  const int f = vibration.size, wanted = static_cast<int>(vibration.modes.size());
  return record(0, of.parameters, wanted * f, [&](auto, const auto&, const auto& p, auto& y) {
    const ModalPencil pencil(of, vibration, position, p);
    for (int w = 0; w < wanted; ++w) {
      const int k = vibration.number(w);
      std::vector<Recorded> x(f, Recorded(0.0));
      x[k] = Recorded(1.0);
      for (int step = 0; step < steps; ++step) {
        const ModalPencil::Image image = pencil.of(x);
        for (int j = 0; j < f; ++j) {
          const double distance = vibration.squares[j] - vibration.squares[k];
          if (j != k && couplings(j, k) < apart * std::abs(distance))
            x[j] = x[j] - (image.held[j] - image.quotient * image.resisted[j]) / Recorded(distance);
        }
      }
      std::ranges::copy(x, y.begin() + w * f);
    }
  });
}

Program recordQuotients(const RestRows& of, const RestVibration& vibration, const Position& position) {
  const int f = vibration.size, wanted = static_cast<int>(vibration.modes.size());
  return record(0, of.parameters, wanted, [&](auto, const auto&, const auto& p, auto& y) {
    const ModalPencil pencil(of, vibration, position, p);
    const std::vector<Recorded> shapes = evaluate<Recorded>(vibration.shapes, {}, {p.begin(), p.end()});
    for (int w = 0; w < wanted; ++w) y[w] = pencil.of(std::span<const Recorded>(shapes).subspan(w * f, f)).quotient;
  });
}

}  // namespace

bool hasPotential(const RestRows& of, const std::vector<double>& v, const Box& parameters) {
  constexpr int points = 16;
  for (int k = 0; k < points; ++k) {
    std::vector<double> values;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      const double turns = std::sqrt(static_cast<double>(i) + 2.0) * k + 0.5;  // the middle first
      values.push_back(parameters[i].lower() +
                       (turns - std::floor(turns)) * (parameters[i].upper() - parameters[i].lower()));
    }
    if (!ReducedMotion(of, of.at<double>(v, values)).isSymmetric()) return false;
  }
  return true;
}

RestVibration vibrationOf(const RestRows& of, const std::vector<double>& v, const Box& parameters,
                          const std::function<std::vector<Recorded>(std::span<const Recorded>)>& position,
                          const std::vector<int>& wanted,
                          const std::function<Program(const Program&, double)>& approximated) {
  RestVibration vibration;
  vibration.pencil = recordPencil(of);
  const int f = vibration.size = of.coordinates - of.loops, triangle = f * (f + 1) / 2;
  std::vector<double> values;
  for (const Interval& each : parameters) values.push_back(midpoint(each));
  const std::vector<double> all = evaluate<double>(vibration.pencil, v, values);
  const std::span<const double> entries = std::span<const double>(all).subspan(of.size);
  const Matrix mass = symmetricMatrix(entries.last(triangle), f);
  if (!choleskyFactorOf(mass) || !isInvertible(mass)) refuseMassless(of);
  const PencilPairs pairs = pencilPairsOf(symmetricMatrix(entries.first(triangle), f), mass);
  vibration.squares.assign(pairs.values.begin(), pairs.values.end());
  for (int i = 0; i < f; ++i)
    for (int j = 0; j < f; ++j) vibration.basis.push_back(pairs.vectors(i, j));
  vibration.unstable = static_cast<int>((pairs.values.array() <= 0).count());
  for (const int mode : wanted)
    if (vibration.unstable + mode <= f) vibration.modes.push_back(mode - 1);
  constexpr double coarse = 0.2;  // an error of the shape enters the quotient squared
  const Program shapes = recordShapes(of, vibration, couplingsOf(of, vibration, v, parameters), position);
  vibration.shapes = of.dependsOnParameters ? approximated(shapes, coarse) : shapes;
  const Program quotients = recordQuotients(of, vibration, position);
  vibration.near = of.dependsOnParameters ? approximated(quotients, 1) : quotients;
  return vibration;
}

std::vector<double> squaresOf(std::span<const double> triangles, int size) {
  const int triangle = size * (size + 1) / 2;
  if (!std::ranges::all_of(triangles, [](double x) { return std::isfinite(x); }))
    return std::vector<double>(size, std::numeric_limits<double>::quiet_NaN());
  const Vector squares =
      pencilValuesOf(symmetricMatrix(triangles.first(triangle), size), symmetricMatrix(triangles.last(triangle), size));
  return {squares.begin(), squares.end()};
}

}  // namespace gamut
