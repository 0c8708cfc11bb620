#include "mechanics/rest_damped_mode.hpp"

#include <algorithm>
#include <cmath>

#include "mechanics/rest_algebra.hpp"
#include "scalars/algebra/decompositions.hpp"
#include "scalars/algebra/linear_system.hpp"

namespace gamut {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

std::vector<std::complex<double>> eigenvaluesOf(const RestRows& of, const LinearRows<double>& at) {
  const Matrix f0 = squareMatrix(at.byPosition, of.size), f1 = squareMatrix(at.byRate, of.size);
  const ReducedMotion reduced(of, at);
  const int f = static_cast<int>(reduced.mass.rows()), n = of.coordinates, z = of.ownStates;
  if (!isInvertible(reduced.mass)) refuseMassless(of);
  Matrix a = Matrix::Zero(2 * f + z, 2 * f + z);
  a.block(0, f, f, f).setIdentity();
  a.block(f, 0, f, f) = -safelySolved(reduced.mass, reduced.stiffness);
  a.block(f, f, f, f) = -safelySolved(reduced.mass, reduced.damping);
  if (z > 0) {
    a.block(f, 2 * f, f, z) = safelySolved(reduced.mass, reduced.tangents.transpose() * f0.block(0, n, n, z));
    a.block(2 * f, 0, z, f) = f0.block(n, 0, z, n) * reduced.tangents;
    a.block(2 * f, f, z, f) = f1.block(n, 0, z, n) * reduced.tangents;
    a.block(2 * f, 2 * f, z, z) = f0.block(n, n, z, z);
  }
  const Eigen::VectorXcd values = eigenvaluesOf(a);
  std::vector<std::complex<double>> all(values.begin(), values.end());
  std::ranges::stable_sort(all, {}, [](const std::complex<double>& s) { return std::abs(s); });
  return all;
}

/// One of each pair.
std::vector<std::complex<double>> modesAmong(const std::vector<std::complex<double>>& eigenvalues) {
  std::vector<std::complex<double>> modes;
  for (const std::complex<double>& s : eigenvalues)
    if (s.imag() > 1e-9 * std::abs(s)) modes.push_back(s);
  return modes;
}

namespace {

/// The unit vector v with the least |m v|, by the decomposition of a real matrix: m v by the parts of v.
Eigen::VectorXcd leastMoved(const Eigen::MatrixXcd& m) {
  const Eigen::Index n = m.rows();
  Matrix parts(2 * n, 2 * n);
  parts << m.real(), -m.imag(), m.imag(), m.real();
  const Vector v = rightSingularVectorsOf(parts).col(2 * n - 1);
  return v.head(n) + std::complex<double>(0, 1) * v.tail(n);
}

}  // namespace

DampedMode::DampedMode(const RestRows& of, const LinearRows<double>& at, int its, std::complex<double> s)
    : number(its) {
  const Eigen::MatrixXcd pencil = squareMatrix(at.byPosition, of.size).cast<std::complex<double>>() +
                                  s * squareMatrix(at.byRate, of.size) +
                                  s * s * squareMatrix(at.byAcceleration, of.size);
  const Vector row = pencil.cwiseAbs().rowwise().maxCoeff().unaryExpr([](double x) { return x > 0 ? 1 / x : 1.0; });
  const Eigen::VectorXcd shape = leastMoved(row.asDiagonal() * pencil);
  const int told = of.coordinates + of.ownStates;
  const double length = shape.head(told).squaredNorm();
  for (int i = 0; i < of.size; ++i) nominal.push_back(shape[i].real());
  for (int i = 0; i < of.size; ++i) nominal.push_back(shape[i].imag());
  nominal.push_back(s.real());
  nominal.push_back(s.imag());
  for (int i = 0; i < of.size; ++i) dual.push_back(i < told ? shape[i].real() / length : 0.0);
  for (int i = 0; i < of.size; ++i) dual.push_back(i < told ? -shape[i].imag() / length : 0.0);
  constexpr int steps = 4;
  for (int i = 0; i < steps; ++i) {
    const std::vector<double> rows = rowsOf<double>(at, nominal);
    const int size = static_cast<int>(rows.size());
    const Vector step = ScaledMatrix(squareMatrix(slopesOf<double>(at, nominal), size))
                            .solve(Eigen::Map<const Vector>(rows.data(), size));
    if (!step.array().isFinite().all()) break;
    nominal = stepped(std::move(nominal), step, -1);
  }
  const std::span<const double> w(nominal);
  unit.assign(w.size() - 2, unitOf(w.first(w.size() - 2)));
  unit.resize(w.size(), unitOf(w.last(2)));
}

template <class S>
std::vector<S> DampedMode::rowsOf(const LinearRows<S>& at, std::span<const S> w) const {
  const int n = at.size;
  const auto times = [&](const std::vector<S>& m, int column) {
    std::vector<S> result;
    for (int i = 0; i < n; ++i) {
      S sum(0.0);
      for (int j = 0; j < n; ++j) sum = sum + m[i * n + j] * w[column * n + j];
      result.push_back(std::move(sum));
    }
    return result;
  };
  const auto along = [&](int row, int column) {
    S sum(0.0);
    for (int j = 0; j < n; ++j) sum = sum + S(dual[row * n + j]) * w[column * n + j];
    return sum;
  };
  std::vector<S> rows, lower;
  const S &re = w[2 * n], &im = w[2 * n + 1], reSquare = re * re - im * im, imSquare = S(2.0) * re * im;
  const std::vector<S> f0r = times(at.byPosition, 0), f0i = times(at.byPosition, 1), f1r = times(at.byRate, 0),
                       f1i = times(at.byRate, 1), f2r = times(at.byAcceleration, 0), f2i = times(at.byAcceleration, 1);
  for (int i = 0; i < n; ++i) {
    rows.push_back(f0r[i] + re * f1r[i] - im * f1i[i] + reSquare * f2r[i] - imSquare * f2i[i]);
    lower.push_back(f0i[i] + re * f1i[i] + im * f1r[i] + reSquare * f2i[i] + imSquare * f2r[i]);
  }
  rows.insert(rows.end(), lower.begin(), lower.end());
  rows.push_back(along(0, 0) - along(1, 1) - S(1.0));
  rows.push_back(along(0, 1) + along(1, 0));
  return rows;
}

template <class S>
std::vector<S> DampedMode::slopesOf(const LinearRows<S>& at, std::span<const S> w) const {
  const int n = at.size, size = static_cast<int>(w.size());
  std::vector<S> slopes(static_cast<std::size_t>(size) * size, S(0.0));
  const auto entry = [&](int i, int j) -> S& { return slopes[i * size + j]; };
  const auto times = [&](const std::vector<S>& m, int row, int column) {
    S sum(0.0);
    for (int j = 0; j < n; ++j) sum = sum + m[row * n + j] * w[column * n + j];
    return sum;
  };
  const S &re = w[2 * n], &im = w[2 * n + 1], reSquare = re * re - im * im, imSquare = S(2.0) * re * im,
          twoRe = S(2.0) * re, twoIm = S(2.0) * im;
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n; ++k) {
      const int ik = i * n + k;
      const S real = at.byPosition[ik] + re * at.byRate[ik] + reSquare * at.byAcceleration[ik],
              imaginary = im * at.byRate[ik] + imSquare * at.byAcceleration[ik];
      entry(i, k) = entry(n + i, n + k) = real;
      entry(n + i, k) = imaginary;
      entry(i, n + k) = -imaginary;
    }
    // (F_1 + 2 s F_2) φ
    const S real = times(at.byRate, i, 0) + twoRe * times(at.byAcceleration, i, 0) -
                   twoIm * times(at.byAcceleration, i, 1),
            imaginary = times(at.byRate, i, 1) + twoRe * times(at.byAcceleration, i, 1) +
                        twoIm * times(at.byAcceleration, i, 0);
    entry(i, 2 * n) = entry(n + i, 2 * n + 1) = real;
    entry(n + i, 2 * n) = imaginary;
    entry(i, 2 * n + 1) = -imaginary;
  }
  for (int k = 0; k < n; ++k) {
    const S re0(dual[k]), im0(dual[n + k]);
    entry(2 * n, k) = entry(2 * n + 1, n + k) = re0;
    entry(2 * n, n + k) = -im0;
    entry(2 * n + 1, k) = im0;
  }
  return slopes;
}

std::vector<Recorded> DampedMode::rooted(const LinearRows<Recorded>& at, std::vector<Recorded> w) const {
  constexpr int steps = 4;
  for (int i = 0; i < steps; ++i) {
    std::vector<Recorded> step = rowsOf<Recorded>(at, w);
    LinearSystem<Recorded>(MatrixKind::general, static_cast<int>(w.size()), slopesOf<Recorded>(at, w)).solve(step);
    for (std::size_t k = 0; k < w.size(); ++k) w[k] = w[k] - step[k];
  }
  return w;
}

template std::vector<double> DampedMode::rowsOf(const LinearRows<double>&, std::span<const double>) const;
template std::vector<Recorded> DampedMode::rowsOf(const LinearRows<Recorded>&, std::span<const Recorded>) const;
template std::vector<double> DampedMode::slopesOf(const LinearRows<double>&, std::span<const double>) const;
template std::vector<Recorded> DampedMode::slopesOf(const LinearRows<Recorded>&, std::span<const Recorded>) const;

}  // namespace gamut
