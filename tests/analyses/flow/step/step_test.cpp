// One step of the flow, judged in 128 bits. A step's set must hold every trajectory that starts in the set before it;
// its update must hold the set at the step's end; the halves of a bisected set must hold the whole.
#include "analyses/flow/step/step.hpp"

#include <gtest/gtest.h>

#include "analyses/flow/formulation.hpp"
#include "analyses/flow/outputs/outputs.hpp"
#include "analyses/work.hpp"
#include "tests/analyses/reference.hpp"
#include "tests/analyses/sliding_reference.hpp"

namespace gamut::testing {
namespace {

/// A stepper with a random set.
struct Scene {
  int n, symbols;
  std::vector<int> weights;  // of the symbols
  Program f, differentiated;
  std::shared_ptr<const Monomials> monomials;
  FlowStepper stepper;
  FlowSet set;
  Points& points;

  /// `jumps`: of the motion, where it has some.
  Scene(Program motion, int symbolCount, int degree, int frameDegree, int order, double tolerance, Points& random,
        bool isUniform = false, const FlowJumps* jumps = nullptr)
      : n(motion.states()),
        symbols(symbolCount),
        weights(isUniform ? std::vector<int>(at(symbolCount), 1) : randomWeights(symbolCount, random)),
        f(std::move(motion)),
        differentiated(jumps != nullptr ? differentiatedFor(f, {}) : f.differentiated()),
        monomials(std::make_shared<const Monomials>(capped(degree), degree)),
        stepper(differentiated, monomials, frameDegree, order, tolerance, FlowInputs(n, order, {}, 0.1)),
        points(random) {
    stepper.setTime(100, 0x1p-46, {});
    if (jumps != nullptr) stepper.setJumps(*jumps, *jumps, {}, {}, {});
  }

  /// Most scenes weigh all alike, as most flows do.
  static std::vector<int> randomWeights(int count, Points& random) {
    const int most = random.integer(0, 2) == 0 ? 4 : 1;
    std::vector<int> weights;
    for (int i = 0; i < count; ++i) weights.push_back(random.integer(1, most));
    return weights;
  }
  /// Every symbol keeps its first power.
  std::vector<int> capped(int degree) const {
    std::vector<int> result;
    for (const int weight : weights) result.push_back(std::min(weight, std::max(degree, 1)));
    return result;
  }

  /// x = p + C (r + Γ(ξ) s) + w: p around `nominal`, all of the given sizes.
  void fill(const std::vector<double>& nominal, double spread, double R, int generatorCount, double W,
            double parameterRadius, double generatorSize = -1) {
    if (generatorSize < 0) generatorSize = R;
    const double turning = points.integer(0, 2) * 0.15;  // how much generators depend on ξ
    const int N = monomials->count(), NJ = stepper.frameCount();
    for (int i = 0; i < n; ++i)
      for (int g = 0; g < N; ++g)
        set.p.push_back(g == 0 ? nominal[at(i)] : spread * std::ldexp(points.uniform(-1, 1), -2 * monomials->grade(g)));
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) set.C.push_back((i == j ? 1.0 : 0.0) + 0.2 * points.uniform(-1, 1));
    for (int i = 0; i < n; ++i) {
      set.R.push_back(R * points.uniform(0.1, 1));
      set.W.push_back(W * points.uniform(0, 1));
    }
    set.powers = at(NJ);
    for (int i = 0; i < NJ * generatorCount * n; ++i)
      set.generators.push_back(generatorSize * points.uniform(-1, 1) * (i < generatorCount * n ? 1 : turning));
    for (int i = 0; i < f.parameters(); ++i) {
      Embedded p;
      p.centre = nominal[at(n + i)];
      p.radius = parameterRadius;
      if (i < symbols) {
        p.symbol = i;
        p.half = spread * 0.5;
      }
      set.parameters.push_back(p);
    }
    set.centre.assign(at(symbols), 0.0);
    set.half.assign(at(symbols), 1.0);
  }

  std::vector<Precise> monomialsAt(const Vector& xi) const { return valuesOf(*monomials, xi); }
  /// Symbols beyond those of ξ are zero.
  static std::vector<Precise> valuesOf(const Monomials& of, const Vector& xi) {
    std::vector<Precise> values;
    for (int g = 0; g < of.count(); ++g) {
      Precise product(1.0);
      for (int l = 0; l < of.symbols(); ++l)
        product *= at(l) < xi.size() ? Precise(pow(xi[at(l)], of.exponent(g, l)))
                                     : Precise(of.exponent(g, l) == 0 ? 1.0 : 0.0);
      values.push_back(product);
    }
    return values;
  }
  Vector randomSymbols() {
    Vector xi;
    for (int l = 0; l < symbols; ++l) xi.push_back(Precise(points.signedUnit()));
    return xi;
  }
  Precise polynomial(const double* c, int count, const std::vector<Precise>& values, int spacing = 1) const {
    Precise sum(0.0);
    for (int g = 0; g < count; ++g) sum += values[at(g)] * c[g * spacing];
    return sum;
  }
  /// A matrix of polynomials [monomial][row][column] at one ξ.
  std::vector<Vector> matrix(const std::vector<double>& c, const std::vector<Precise>& values) const {
    const int count = static_cast<int>(c.size()) / (n * n);
    std::vector<Vector> m(at(n), Vector(at(n)));
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) m[at(i)][at(j)] = polynomial(&c[at(i * n + j)], count, values, n * n);
    return m;
  }
  /// Γ_j(ξ), [generator][row].
  Vector generatorsOf(const FlowSet& of, const std::vector<Precise>& values) const {
    const std::size_t block = of.generators.size() / of.powers;
    Vector result(block);
    for (std::size_t g = 0; g < of.powers; ++g)
      for (std::size_t c = 0; c < block; ++c) result[c] += values[g] * of.generators[g * block + c];
    return result;
  }
  /// Any r + Γ(ξ) s.
  Vector randomRemainder(const std::vector<Precise>& values) {
    Vector r(at(n));
    for (int i = 0; i < n; ++i) r[at(i)] = Precise(set.R[at(i)]) * points.signedUnit();
    const Vector generators = generatorsOf(set, values);
    for (std::size_t g = 0; g < generators.size(); g += at(n)) {
      const double s = points.signedUnit();
      for (int i = 0; i < n; ++i) r[at(i)] += generators[g + at(i)] * s;
    }
    return r;
  }
  Vector times(const std::vector<Vector>& m, const Vector& v) const {
    Vector result(at(n));
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) result[at(i)] += m[at(i)][at(j)] * v[at(j)];
    return result;
  }

  /// Starts at random places of the set (its corners most of all), followed by the reference into the step.
  void expectTrajectoriesInside(int trajectories) {
    Reference reference(f);
    expectTrajectoriesInside(trajectories, reference, {0.0, 0.4, 1.0});
  }
  template <class Truth>
  void expectTrajectoriesInside(int trajectories, Truth& reference, const std::vector<double>& parts) {
    for (int sample = 0; sample < trajectories; ++sample) {
      const Vector xi = randomSymbols();
      const std::vector<Precise> values = monomialsAt(xi);
      const Vector r = randomRemainder(values);
      Vector start = times(matrix(set.C, values), r);
      for (int i = 0; i < n; ++i)
        start[at(i)] += polynomial(&set.p[at(i * monomials->count())], monomials->count(), values) +
                        Precise(set.W[at(i)]) * points.signedUnit();
      for (const Embedded& p : set.parameters)
        start.push_back(Precise(p.centre) + Precise(p.radius) * points.signedUnit() +
                        (p.symbol >= 0 ? Precise(p.half) * xi[at(p.symbol)] : Precise(0.0)));
      for (double part : parts) {
        const double tau = part * stepper.h();
        const Vector x = reference(start, {tau})[0];
        FlowPoint point;
        stepper.evaluate(set, tau, point);
        const Vector linear = times(matrix(point.psi, values), r);
        for (int i = 0; i < n; ++i) {
          const Precise p = polynomial(&point.p[at(i * monomials->count())], monomials->count(), values);
          ASSERT_LE(Precise(abs(x[at(i)] - p)), Precise(point.radius[at(i)])) << "radius at " << part;
          ASSERT_LE(Precise(abs(x[at(i)] - p - linear[at(i)])), Precise(point.loose[at(i)])) << "loose at " << part;
        }
      }
    }
  }

  /// For random ξ and directions, the support function of C'⁻¹ (Ψ (r + Γ(ξ) s) + w) is below that of r' + Γ'(ξ) s'.
  void expectUpdateInside(int directions) {
    FlowPoint point;
    stepper.evaluate(set, stepper.h(), point);
    const FlowSet before = set;
    stepper.advance(set);
    ASSERT_EQ(set.p, point.p);
    for (int direction = 0; direction < directions; ++direction) {
      const std::vector<Precise> values = monomialsAt(randomSymbols());
      Vector along(at(n));
      if (direction < 2 * n)
        along[at(direction % n)] = 1;
      else
        for (Precise& value : along) value = points.uniform(-1, 1);
      const Vector z = solveTransposed(matrix(set.C, values), along);
      const std::vector<Vector> psi = matrix(point.psi, values);
      Vector zPsi(at(n));
      Precise was(0.0), is(0.0);
      for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) zPsi[at(j)] += z[at(i)] * psi[at(i)][at(j)];
        was += abs(zPsi[at(j)]) * before.R[at(j)] + abs(z[at(j)]) * point.loose[at(j)];
        is += abs(along[at(j)]) * set.R[at(j)];
      }
      was += reach(zPsi, generatorsOf(before, values));
      is += reach(along, generatorsOf(set, values));
      ASSERT_LE(was, is);
      ASSERT_LE(is, was * 100);
    }
  }

  /// What is older is longer, along state `along` most of all, as where a motion shears.
  void stretchOlder(int along) {
    const std::size_t block = set.generators.size() / set.powers;
    for (std::size_t c = 0; c < set.generators.size(); ++c) {
      const double age = static_cast<double>((block - c % block) / at(n));
      set.generators[c] *= c % at(n) == at(along) ? 1 + 100 * age : 1 + age;
    }
  }

  /// Boxes and directions hold what they replace, and no more generators are left than may be.
  void expectMergedInside(std::size_t most, int directions) {
    const FlowSet before = set;
    mergeGenerators(set, *monomials, most);
    ASSERT_EQ(set.generators.size(), most * at(n) * set.powers);
    for (int direction = 0; direction < directions; ++direction) {
      const std::vector<Precise> values = monomialsAt(randomSymbols());
      Vector along(at(n));
      for (Precise& value : along) value = points.uniform(-1, 1);
      const Vector columns = generatorsOf(before, values);
      std::vector<Vector> others;  // every second direction is normal to n - 1 of them: there the set is thin
      const auto takeOff = [&](Vector& from) {
        for (const Vector& other : others) {
          Precise product(0.0), length(0.0);
          for (int i = 0; i < n; ++i) product += from[at(i)] * other[at(i)], length += other[at(i)] * other[at(i)];
          for (int i = 0; i < n && length > 0; ++i) from[at(i)] -= product / length * other[at(i)];
        }
      };
      for (int k = 0; k + 1 < n && direction % 2 == 0; ++k) {
        const int j = points.integer(0, static_cast<int>(columns.size()) / n - 1);
        Vector next(columns.begin() + j * n, columns.begin() + (j + 1) * n);
        takeOff(next);
        takeOff(next);
        others.push_back(next);
      }
      takeOff(along);
      takeOff(along);
      Precise rounding(0.0);  // of the sums here, in 128 bits
      for (const Precise& c : columns) rounding += abs(c);
      ASSERT_LE(reach(along, columns), reach(along, generatorsOf(set, values)) + rounding * Precise(1e-36));
    }
  }

  /// Outputs g, in polynomials of this degree, of random members p + Ψ (r + Γs) + w of the set at a step's end lie
  /// within the radii of these.
  void expectOutputsInside(const Program& g, int members, int degree) {
    FlowPoint point;
    stepper.evaluate(set, stepper.h(), point);
    const auto own = std::make_shared<const Monomials>(capped(degree), degree);
    FlowOutputs outputs(g, own, monomials, {});
    const double t = set.t + stepper.h();
    outputs.evaluate(t, point, set.R, set.parameters);
    Evaluator<Precise> truth(g);
    for (int member = 0; member < members; ++member) {
      const Vector xi = randomSymbols();
      const std::vector<Precise> values = monomialsAt(xi);
      Vector p, x = times(matrix(point.psi, values), randomRemainder(values));
      for (int i = 0; i < n; ++i)
        x[at(i)] += polynomial(&point.p[at(i * monomials->count())], monomials->count(), values) +
                    Precise(point.loose[at(i)]) * points.signedUnit() * 0.99;
      for (const Embedded& q : set.parameters)
        p.push_back(Precise(q.centre) + (q.symbol >= 0 ? Precise(q.half) * xi[at(q.symbol)] : Precise(0.0)));
      truth.setParameters(p);
      const Vector y = truth(Precise(t), x);
      for (int o = 0; o < outputs.count(); ++o) {
        const Precise computed = polynomial(outputs.polynomial(o), own->count(), valuesOf(*own, xi));
        ASSERT_LE(Precise(abs(y[at(o)] - computed)), Precise(outputs.radius(o))) << "output " << o;
      }
    }
  }

  /// Both halves hold their part of the set.
  void expectHalvesInside(int symbol, int samples) {
    const PolynomialRange shift(monomials);
    const FlowSet whole = set;
    FlowSet halves[2];
    halves[1] = stepper.bisect(set, symbol, shift);
    halves[0] = set;
    for (int side : {0, 1})
      for (int sample = 0; sample < samples; ++sample) {
        const FlowSet& half = halves[side];
        const Vector eta = randomSymbols();
        Vector xi = eta;
        xi[at(symbol)] = (eta[at(symbol)] + (side == 0 ? -1 : 1)) / 2;
        const std::vector<Precise> was = monomialsAt(xi), is = monomialsAt(eta);
        const Vector lost = times(sizes(whole.C), apart(generatorsOf(whole, was), generatorsOf(half, is)));
        const int N = monomials->count();
        for (int i = 0; i < n; ++i) {
          const Precise gap = abs(polynomial(&whole.p[at(i * N)], N, was) - polynomial(&half.p[at(i * N)], N, is));
          ASSERT_LE(gap + lost[at(i)], Precise(half.W[at(i)]) - Precise(whole.W[at(i)]));
        }
        for (std::size_t k = 0; k < whole.parameters.size(); ++k) {
          const Embedded &a = whole.parameters[k], &b = half.parameters[k];
          if (a.symbol < 0) continue;
          const Precise gap =
              abs(Precise(a.centre) + a.half * xi[at(a.symbol)] - b.centre - b.half * eta[at(a.symbol)]);
          ASSERT_LE(gap, Precise(b.radius) - Precise(a.radius));
        }
        ASSERT_EQ(half.R, whole.R);
        ASSERT_EQ(half.C, whole.C);
      }
  }

  /// What is rewritten for another degree of the same symbols lies within what W has grown by.
  void expectOtherDegreeInside(int degree, int frameDegree, int samples) {
    const Monomials to(capped(degree), degree);
    const FlowSet before = set;
    changeDegree(set, *monomials, to, frameDegree);
    ASSERT_EQ(set.p.size(), at(n * to.count()));
    ASSERT_EQ(set.powers, at(to.countUpTo(frameDegree)));
    ASSERT_EQ(set.R, before.R);
    ASSERT_EQ(set.C, before.C);
    for (int sample = 0; sample < samples; ++sample) {
      const Vector xi = randomSymbols();
      const std::vector<Precise> was = monomialsAt(xi), is = valuesOf(to, xi);
      const Vector lost = times(sizes(set.C), apart(generatorsOf(before, was), generatorsOf(set, is)));
      for (int i = 0; i < n; ++i) {
        const Precise gap = abs(polynomial(&before.p[at(i * monomials->count())], monomials->count(), was) -
                                polynomial(&set.p[at(i * to.count())], to.count(), is));
        ASSERT_LE(gap + lost[at(i)], Precise(set.W[at(i)]) - Precise(before.W[at(i)]));
      }
    }
  }

  /// Support functions, for random ξ: C (r + Γs) + w and what p loses lie within the fresh symbols' share and the new
  /// w.
  void expectExpansionInside(const std::vector<int>& ofAll, int degree, int frameDegree, int directions) {
    const Monomials to(ofAll, degree);
    const FlowSet before = set;
    expandRemainder(set, *monomials, to, frameDegree);
    ASSERT_EQ(set.p.size(), at(n * to.count()));
    ASSERT_TRUE(set.generators.empty());
    for (int direction = 0; direction < directions; ++direction) {
      const Vector xi = randomSymbols();
      const std::vector<Precise> was = monomialsAt(xi), is = valuesOf(to, xi);
      Vector along(at(n));
      if (direction < 2 * n)
        along[at(direction % n)] = 1;
      else
        for (Precise& value : along) value = points.uniform(-1, 1);
      const std::vector<Vector> C = matrix(before.C, was);
      Vector alongC(at(n));
      Precise moved(0.0), inside(0.0), now(0.0);
      for (int i = 0; i < n; ++i) {
        moved += along[at(i)] * (polynomial(&before.p[at(i * monomials->count())], monomials->count(), was) -
                                 polynomial(&set.p[at(i * to.count())], to.count(), is));
        for (int j = 0; j < n; ++j) alongC[at(j)] += along[at(i)] * C[at(i)][at(j)];
        inside += abs(along[at(i)]) * before.W[at(i)];
        now += abs(along[at(i)]) * set.W[at(i)];
        ASSERT_EQ(set.R[at(i)], 0);
      }
      for (int j = 0; j < n; ++j) {
        inside += abs(alongC[at(j)]) * before.R[at(j)];
        Precise fresh(0.0);
        for (int i = 0; i < n; ++i) fresh += along[at(i)] * set.p[at(i * to.count() + to.linear(symbols + j))];
        now += abs(fresh);
      }
      inside += reach(alongC, generatorsOf(before, was)) + abs(moved);
      ASSERT_LE(inside, now);
    }
  }

 private:
  /// Of a matrix of numbers, the absolute values.
  std::vector<Vector> sizes(const std::vector<double>& m) const {
    std::vector<Vector> result(at(n), Vector(at(n)));
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) result[at(i)][at(j)] = std::fabs(m[at(i * n + j)]);
    return result;
  }
  /// Of two lists of generators, Σ |Γ - Γ'|.
  Vector apart(const Vector& a, const Vector& b) const {
    Vector total(at(n));
    for (std::size_t c = 0; c < a.size(); ++c) total[c % at(n)] += abs(a[c] - b[c]);
    return total;
  }
  Precise reach(const Vector& along, const Vector& generators) const {
    Precise sum(0.0);
    for (std::size_t g = 0; g < generators.size(); g += at(n)) {
      Precise product(0.0);
      for (int i = 0; i < n; ++i) product += along[at(i)] * generators[g + at(i)];
      sum += abs(product);
    }
    return sum;
  }
  /// mᵀ z = v by elimination with row exchanges.
  Vector solveTransposed(const std::vector<Vector>& m, Vector v) const {
    std::vector<Vector> a(at(n), Vector(at(n)));
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) a[at(i)][at(j)] = m[at(j)][at(i)];
    for (int k = 0; k < n; ++k) {
      int pivot = k;
      for (int i = k + 1; i < n; ++i)
        if (abs(a[at(i)][at(k)]) > abs(a[at(pivot)][at(k)])) pivot = i;
      std::swap(a[at(k)], a[at(pivot)]);
      std::swap(v[at(k)], v[at(pivot)]);
      for (int i = k + 1; i < n; ++i) {
        const Precise factor = a[at(i)][at(k)] / a[at(k)][at(k)];
        for (int j = k; j < n; ++j) a[at(i)][at(j)] -= factor * a[at(k)][at(j)];
        v[at(i)] -= factor * v[at(k)];
      }
    }
    for (int k = n; k-- > 0;) {
      for (int j = k + 1; j < n; ++j) v[at(k)] -= a[at(k)][at(j)] * v[at(j)];
      v[at(k)] /= a[at(k)][at(k)];
    }
    return v;
  }
};

constexpr double horizon = 4;
constexpr double quantum = 0x1p-50;  // of a horizon of 4 s

/// Autonomous systems of one to three states with one parameter (sets are at any time, the reference starts at t = 0).
std::vector<std::pair<Program, std::vector<double>>> motionsOfManyKinds() {
  return {{record(2, 1,
                  [](auto, const auto& x, const auto& p, auto& dx) {
                    dx[0] = x[1];
                    dx[1] = -p[0] * sin(x[0]);
                  }),
           {1.0, 0.5, 4.0}},
          {record(2, 1,
                  [](auto, const auto& x, const auto& p, auto& dx) {
                    dx[0] = sqr(x[0]) - p[0] * x[1];
                    dx[1] = 1.0 / (2.0 + x[0] * x[1]);
                  }),
           {0.5, 0.8, 1.0}},
          {record(3, 1,
                  [](auto, const auto& x, const auto& p, auto& dx) {
                    dx[0] = 2.0 * (x[1] - x[0]);
                    dx[1] = x[0] * (p[0] - x[2]) - x[1];
                    dx[2] = x[0] * x[1] - exp(0.5 * x[2]);
                  }),
           {1.0, 0.5, 0.25, 3.0}},
          {record(1, 1, [](auto, const auto& x, const auto& p, auto& dx) { dx[0] = p[0] - x[0] * sqr(x[0]); }),
           {1.5, 0.5}}};
}

TEST(FlowStep, HoldsEveryTrajectoryThatStartsInTheSet) {
  Points points(5);
  int steps = 0;
  for (int round = 0; round < 25; ++round)
    for (const auto& [f, nominal] : motionsOfManyKinds()) {
      const int symbols = points.integer(0, 2), degree = symbols == 0 ? 0 : points.integer(1, 4);
      Scene scene(f, symbols, degree, points.integer(0, 3), points.integer(4, 14),
                  std::pow(10.0, -points.integer(3, 14)), points);
      const double R = std::pow(10.0, -points.integer(1, 14)) * points.integer(0, 1);
      scene.fill(nominal, std::pow(10.0, -points.integer(1, 3)), R, points.integer(0, 3), R * points.integer(0, 1),
                 R * 0.1);
      if (scene.stepper.certify(scene.set, horizon, quantum) != StepOutcome::stepped) continue;
      ++steps;
      scene.expectTrajectoriesInside(4);
      if (HasFatalFailure()) return;
    }
  EXPECT_GT(steps, 80);
}

/// Two surfaces that solutions pass, at once or one after the other; each sign's push moves the other's argument too,
/// and varies with the states.
Program twoSurfaces(double tilt, Points& points) {
  const auto any = [&](double size) { return size * std::ldexp(points.integer(-8, 8), -3); };
  double A[3][3], push[3][2], bend[3][2];
  for (int i = 0; i < 3; ++i) {
    for (double& entry : A[i]) entry = any(1);
    for (int k = 0; k < 2; ++k) push[i][k] = any(0.5), bend[i][k] = points.integer(0, 1) * any(0.5);
  }
  return record(3, 1, [&](auto, const auto& x, const auto& p, auto& dx) {
    const Recorded s[2] = {sign(x[0] + 0.5 * x[2]), sign(x[1] - tilt * x[2] - 0.25 * p[0])};
    for (int i = 0; i < 3; ++i) {
      dx[i] = A[i][0] * x[0] + A[i][1] * x[1] + A[i][2] * sin(x[2]) + (i == 2 ? p[0] : -2.0 - p[0]);
      for (int k = 0; k < 2; ++k) dx[i] = dx[i] + p[0] * push[i][k] * s[k] + bend[i][k] * x[2] * s[k];
    }
  });
}

/// What is uncertain besides hides no truncation, and is none: it asks for no bisection.
TEST(FlowStep, RadiiOfParametersAreNoTruncation) {
  const Program f = record(1, 1, [](auto, const auto& x, const auto& p, auto& dx) { dx[0] = p[0] * sin(x[0]); });
  Points points(3);
  for (const double radius : {0.0, 1e-6, 1e-3}) {
    Scene scene(f, 1, 4, 1, 10, 1e-12, points, true);
    scene.set.p = {1.0, 0.01, 0.0, 0.0, 0.0};
    scene.set.C = {1.0};
    scene.set.R = scene.set.W = {0.0};
    Embedded p;
    p.centre = 0.5;
    p.radius = radius;
    scene.set.parameters = {p};
    scene.set.centre = {0.0};
    scene.set.half = {1.0};
    EXPECT_EQ(scene.stepper.certify(scene.set, 1, quantum, {.truncation = 1e-9}), StepOutcome::stepped) << radius;
    EXPECT_EQ(scene.stepper.certify(scene.set, 1, quantum, {.truncation = 1e-16}), StepOutcome::splitWanted) << radius;
  }
}

/// Two kinks and a jump, passed at once or one after the other; one of the kinks bends what the other's argument does.
Program twoKinks(double tilt, bool hasJump, Points& points) {
  const auto any = [&](double size) { return size * std::ldexp(points.integer(-8, 8), -3); };
  double A[3][3], push[3][3], bend[3];
  for (int i = 0; i < 3; ++i) {
    for (double& entry : A[i]) entry = any(1);
    for (double& entry : push[i]) entry = any(8);
    push[i][2] = hasJump ? any(0.25) : 0.0;
    bend[i] = points.integer(0, 1) * any(2);
  }
  return record(3, 1, [&](auto, const auto& x, const auto& p, auto& dx) {
    const Recorded u[2] = {x[0] + 0.5 * x[2], x[1] - tilt * x[2] - 0.25 * p[0]};
    const Recorded k[2] = {abs(u[0]), abs(u[1])};
    for (int i = 0; i < 3; ++i) {
      dx[i] = A[i][0] * x[0] + A[i][1] * x[1] + A[i][2] * sin(x[2]) + (i == 2 ? p[0] : -2.0 - p[0]);
      dx[i] = dx[i] + p[0] * push[i][0] * k[0] + push[i][1] * k[1] + bend[i] * x[2] * k[0] * k[1];
      if (push[i][2] != 0) dx[i] = dx[i] + push[i][2] * sign(u[1]);
    }
  });
}

/// The same with u sign u for |u|, whose events a reference locates.
Program withSigns(const Program& f) {
  Recorder recorder(f.states(), f.parameters(), RuleSet::none());
  std::vector<int> instead(f.nodes().size(), -1), outputs;
  const std::vector<int> plain = recorder.append(f);
  for (std::size_t i = 0; i < instead.size(); ++i)
    if (const Node& node = f.nodes()[i]; node.op == Op::abs) {
      const int u = plain[static_cast<std::size_t>(node.a)];
      instead[i] = recorder.mul(u, recorder.sign(u));
    }
  const std::vector<int> here = recorder.append(f, {}, instead);
  for (const int output : f.outputNodes()) outputs.push_back(here[static_cast<std::size_t>(output)]);
  return recorder.finish(outputs);
}

/// Random machines with two surfaces, u = x0 + x2/2 and u = x1 - tilt x2 - p0/4, whose arguments fall.
struct PassingMachine {
  Program f, truth;    // the truth with u sign u for |u|
  std::size_t atOnce;  // so many jumps and kinks there are
};

template <class Make>
void expectPassingInside(unsigned seed, Make make) {
  Points points(seed);
  int passed = 0, all = 0;
  for (int round = 0; round < 300; ++round) {
    const double tilt = 0.125 * points.integer(-4, 4);
    const PassingMachine machine = make(tilt, points);
    const FlowJumps jumps(differentiatedFor(machine.f, {}), {});
    const int symbols = points.integer(0, 2), degree = symbols == 0 ? 0 : points.integer(1, 3);
    Scene scene(machine.f, symbols, degree, points.integer(0, 2), points.integer(6, 14), 1e-8, points, false, &jumps);
    const double size = std::pow(10.0, -points.integer(1, 6)), near = 4 * size;
    const double R = size * points.integer(0, 1) * std::pow(10.0, -points.integer(0, 3));
    // Both arguments are some sizes above zero, or one far above.
    const double third = points.uniform(-0.5, 0.5), parameter = 0.5;
    const double first = near - 0.5 * third, second = (points.integer(0, 3) > 0 ? near : 0.5) + 0.125 + tilt * third;
    scene.fill({first, second, third, parameter}, size, R, points.integer(0, 3), R * points.integer(0, 1), R * 0.1);
    const auto isStepped = [&] { return scene.stepper.certify(scene.set, horizon, quantum) == StepOutcome::stepped; };
    bool goesOn = isStepped();
    for (int before = 0; before < 8 && goesOn && scene.stepper.crossings() == 0; ++before) {
      scene.stepper.advance(scene.set);
      scene.set.arguments.clear();  // of the set itself all is followed
      goesOn = isStepped();
    }
    if (!goesOn || scene.stepper.crossings() == 0) continue;
    ++passed;
    all += scene.stepper.crossings() == machine.atOnce ? 1 : 0;
    SlidingReference reference(machine.truth, [](const auto&, const Vector&, Vector&) {});
    scene.expectTrajectoriesInside(2, reference, {0.4, 0.8, 0.95, 1.0});
    if (::testing::Test::HasFatalFailure()) return;
    scene.expectUpdateInside(4);
    if (::testing::Test::HasFatalFailure()) return;
  }
  EXPECT_GT(passed, 80) << all;
  EXPECT_GT(all, 20) << passed;
}

TEST(FlowStep, HoldsEveryTrajectoryThatPassesJumps) {
  expectPassingInside(27, [](double tilt, Points& points) {
    const Program f = twoSurfaces(tilt, points);
    return PassingMachine{f, f, 2};
  });
}

TEST(FlowStep, HoldsEveryTrajectoryThatPassesKinks) {
  expectPassingInside(28, [](double tilt, Points& points) {
    const bool hasJump = points.integer(0, 2) == 0;
    const Program f = twoKinks(tilt, hasJump, points);
    return PassingMachine{f, withSigns(f), hasJump ? std::size_t{3} : std::size_t{2}};
  });
}

// Sets so wide, and equations so steep, that derivatives along the polynomials alone, which rest, say far too little.
TEST(FlowStep, HoldsEveryTrajectoryOfWideRemaindersUnderSteepEquations) {
  const Program f = record(2, 0, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = exp(6.0 * x[0]) - 1.0 + x[1];
    dx[1] = -x[1] * cos(3.0 * x[0]);
  });
  Points points(12);
  int steps = 0;
  for (int round = 0; round < 60; ++round) {
    Scene scene(f, 0, 0, 0, points.integer(4, 10), std::pow(10.0, -points.integer(1, 5)), points);
    const double size = points.uniform(0.05, 0.4);
    const int kind = round % 3;  // all in W, all in R, in both
    scene.fill({0, 0}, 0, kind == 0 ? 0 : size, 0, kind == 1 ? 0 : size, 0);
    if (scene.stepper.certify(scene.set, horizon, quantum) != StepOutcome::stepped) continue;
    ++steps;
    scene.expectTrajectoriesInside(5);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(steps, 30);
}

TEST(FlowStep, UpdateHoldsTheSetAtItsEnd) {
  Points points(6);
  int steps = 0;
  for (int round = 0; round < 40; ++round)
    for (const auto& [f, nominal] : motionsOfManyKinds()) {
      const int symbols = points.integer(0, 2), degree = symbols == 0 ? 0 : points.integer(1, 4);
      Scene scene(f, symbols, degree, points.integer(0, 3), points.integer(6, 14),
                  std::pow(10.0, -points.integer(5, 14)), points);
      const double R = std::pow(10.0, -points.integer(2, 14)) * points.integer(0, 1);
      scene.fill(nominal, std::pow(10.0, -points.integer(1, 3)), R, points.integer(0, 3), R * points.integer(0, 1), 0);
      if (scene.stepper.certify(scene.set, horizon, quantum) != StepOutcome::stepped) continue;
      ++steps;
      scene.expectUpdateInside(8);
      if (HasFatalFailure()) return;
    }
  EXPECT_GT(steps, 120);
}

// With no box to hide it, rounding of the generators themselves must be covered.
TEST(FlowStep, UpdateHoldsASetOfGeneratorsAlone) {
  Points points(13);
  for (int round = 0; round < 40; ++round)
    for (const auto& [f, nominal] : motionsOfManyKinds()) {
      const int symbols = points.integer(0, 1), degree = symbols == 0 ? 0 : points.integer(1, 4);
      Scene scene(f, symbols, degree, points.integer(0, 1), 16, 1e-14, points);
      scene.fill(nominal, 1e-4, 0, points.integer(1, 6), 0, 0, std::pow(10.0, -points.integer(4, 8)));
      if (scene.stepper.certify(scene.set, horizon, quantum) != StepOutcome::stepped) continue;
      scene.expectUpdateInside(8);
      if (HasFatalFailure()) return;
    }
}

// x'' = x: coefficients of one sign, so that the bound of the second derivative is nearly reached at the step's end, by
// the remainder around zero as by the polynomials without one.
TEST(FlowStep, NothingLeavesItsChordByMoreThanTheSag) {
  Points points(14);
  const Program f = record(2, 0, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = x[1];
    dx[1] = x[0];
  });
  for (int round = 0; round < 40; ++round) {
    Scene scene(f, round % 2, round % 2, round % 2, 14, 1e-6, points);
    const bool moves = round % 4 > 1;
    scene.fill({moves ? 1.0 : 0.0, moves ? 1.0 : 0.0}, 1e-6, moves ? 0.0 : 0.1, moves ? 0 : 2, 0, 0);
    ASSERT_EQ(scene.stepper.certify(scene.set, horizon, quantum), StepOutcome::stepped);
    const double h = scene.stepper.h(), length = h * std::ldexp(1.0, -points.integer(0, 5));
    std::vector<FlowSag> sag;
    scene.stepper.sag(h - length, h, sag);
    for (int sample = 0; sample < 8; ++sample) {
      const std::vector<Precise> values = scene.monomialsAt(scene.randomSymbols());
      const double sign = points.signedUnit() < 0 ? -1 : 1;
      const Vector r{scene.set.R[0] * Precise(sign), scene.set.R[1] * Precise(sign)};
      Vector q[3];  // at both ends and in the middle of the step's last piece
      for (int k = 0; k < 3; ++k) {
        FlowPoint point;
        scene.stepper.evaluate(scene.set, h - 0.5 * k * length, point);
        q[k] = scene.times(scene.matrix(point.psi, values), r);
        for (int i = 0; i < 2; ++i)
          q[k][at(i)] += scene.polynomial(&point.p[at(i * scene.monomials->count())], scene.monomials->count(), values);
      }
      for (std::size_t i = 0; i < 2; ++i) {  // beyond the rounding of the three evaluations
        const Precise departure = q[1][i] - (q[0][i] + q[2][i]) / 2;
        ASSERT_TRUE(encloses(sag[i].whole() + Interval(-1e-14, 1e-14), departure))
            << "of length " << length << " of " << h;
      }
    }
  }
}

// A chain at rest in which each state feels the next one only once that has moved: every attempt at a tube reaches one
// link further, so that a step must be refused although the tubes of the links before it hold.
/// Damped motions whose steps are longer than |∂f/∂x| would allow: coupled rates, a reaction that keeps a sum, a slow
/// state that a fast one drives, and a spring that is damped by far too much.
std::vector<std::pair<Program, std::vector<double>>> dampedMotions() {
  return {{record(2, 1,
                  [](auto, const auto& x, const auto& p, auto& dx) {
                    dx[0] = x[1];
                    dx[1] = -200.0 * p[0] * x[1] - 300.0 * sin(x[0]);
                  }),
           {0.5, -0.6, 1.0}},
          {record(3, 1,
                  [](auto, const auto& x, const auto& p, auto& dx) {
                    const auto first = 0.5 * x[0], second = 400.0 * sqr(x[1]), third = p[0] * x[1] * x[2];
                    dx[0] = third - first;
                    dx[1] = first - third - second;
                    dx[2] = second;
                  }),
           {1.0, 0.004, 0.5, 200.0}},
          {record(3, 1,
                  [](auto, const auto& x, const auto& p, auto& dx) {
                    dx[0] = 0.5 * x[1] - 0.2 * x[0] * x[2];
                    dx[1] = -150.0 * x[1] + 60.0 * x[2] + 100.0 * cos(x[0]);
                    dx[2] = 40.0 * x[1] - 180.0 * x[2] + p[0];
                  }),
           {0.5, 0.7, 0.3, 20.0}}};
}

/// Random members of a set that a step starts from have no greater ∂f_i/∂x_i than it counts with.
void expectDampingBounded(Scene& scene, int members) {
  Evaluator<Precise> derivatives(scene.differentiated);
  for (int member = 0; member < members; ++member) {
    const Vector xi = scene.randomSymbols();
    const std::vector<Precise> values = scene.monomialsAt(xi);
    Vector x = scene.times(scene.matrix(scene.set.C, values), scene.randomRemainder(values)), p;
    for (int i = 0; i < scene.n; ++i)
      x[at(i)] += scene.polynomial(&scene.set.p[at(i * scene.monomials->count())], scene.monomials->count(), values) +
                  Precise(scene.set.W[at(i)]) * scene.points.signedUnit();
    for (const Embedded& q : scene.set.parameters)
      p.push_back(Precise(q.centre) + Precise(q.radius) * scene.points.signedUnit() +
                  (q.symbol >= 0 ? Precise(q.half) * xi[at(q.symbol)] : Precise(0.0)));
    derivatives.setParameters(p);
    const Vector all = derivatives(Precise(0.0), x);
    for (int i = 0; i < scene.n; ++i)
      ASSERT_LE(all[at(scene.n + i * scene.n + i)], Precise(scene.stepper.series().dampingBound(i))) << "state " << i;
  }
}

/// At many times of a step, of sets whose W decays; and beside chords there is room for all that is loose at any time.
TEST(FlowStep, HoldsEveryTrajectoryOfDampedMotionsAtEveryTime) {
  Points points(29);
  int steps = 0, longSteps = 0;
  for (int round = 0; round < 8; ++round)
    for (const auto& [f, nominal] : dampedMotions()) {
      const int symbols = points.integer(0, 2), degree = symbols == 0 ? 0 : points.integer(1, 4);
      Scene scene(f, symbols, degree, points.integer(0, 2), points.integer(12, 30),
                  std::pow(10.0, -points.integer(3, 14)), points);
      const double R = std::pow(10.0, -points.integer(3, 14)) * points.integer(0, 1);
      scene.fill(nominal, std::pow(10.0, -points.integer(3, 6)), R, points.integer(0, 3),
                 std::pow(10.0, -points.integer(4, 14)), R * 0.1);
      if (scene.stepper.certify(scene.set, horizon, quantum) != StepOutcome::stepped) continue;
      ++steps;
      longSteps += scene.stepper.h() * 200 > 4.5 ? 1 : 0;  // of no comparison with |∂f/∂x|
      Reference reference(f);
      scene.expectTrajectoriesInside(3, reference, {0.0, 1e-3, 0.02, 0.1, 0.3, 0.7, 1.0});
      if (HasFatalFailure()) return;
      expectDampingBounded(scene, 8);
      std::vector<FlowSag> sag;
      scene.stepper.sag(0, std::ldexp(scene.stepper.h(), -40), sag);  // so short that nothing curves
      for (int i = 0; i < scene.n && scene.stepper.isDamped(); ++i) {
        const double loose = scene.stepper.looseBound(i);
        ASSERT_GE(sag[at(i)].rest, loose) << "state " << i;
      }
      if (HasFatalFailure()) return;
    }
  EXPECT_GT(steps, 15);
  EXPECT_GT(longSteps, 5);
}

/// Of four symbols and more, errors are compared about the flow at the centre.
TEST(FlowStep, HoldsEveryTrajectoryOfWhatTurnsAtEveryTime) {
  const Program f = record(4, 3, [](auto t, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[2];
    dx[1] = x[3];
    dx[2] = -p[0] * sin(x[0]) + p[1] * (x[1] - x[0]) - 10.0 * x[2];
    dx[3] = -p[2] * x[1] * (1.0 + 0.2 * sqr(x[1])) + p[1] * (x[0] - x[1]) + sin(3.0 * t);
  });
  Points points(31);
  int steps = 0, about = 0;
  for (int round = 0; round < 12; ++round) {
    Scene scene(f, points.integer(4, 6), points.integer(1, 3), points.integer(0, 2), points.integer(8, 20),
                std::pow(10.0, -points.integer(3, 12)), points);
    const double R = std::pow(10.0, -points.integer(3, 14)) * points.integer(0, 1);
    scene.fill({0.3, -0.2, 1, 2, 900, 100, 400}, std::pow(10.0, -points.integer(1, 5)), R, points.integer(0, 3),
               std::pow(10.0, -points.integer(4, 14)), R * 0.1);
    if (scene.stepper.certify(scene.set, horizon, quantum) != StepOutcome::stepped) continue;
    ++steps;
    about += scene.stepper.isAboutCentre() ? 1 : 0;
    Reference reference(f);
    scene.expectTrajectoriesInside(3, reference, {0.0, 1e-3, 0.02, 0.1, 0.3, 0.7, 1.0});
    if (HasFatalFailure()) return;
    std::vector<FlowSag> sag;
    scene.stepper.sag(0, std::ldexp(scene.stepper.h(), -40), sag);  // so short that nothing curves
    for (int i = 0; i < scene.n && scene.stepper.isAboutCentre(); ++i) {
      const double loose = scene.stepper.looseBound(i);
      ASSERT_GE(sag[at(i)].rest, loose) << "state " << i;
    }
  }
  EXPECT_GT(steps, 6);
  EXPECT_GT(about, 5);
}

// What is loose at the start turns about within a step; of where solutions start no more is known than that.
TEST(FlowStep, WhatTurnsLeavesAChordFromItsStartByNoMoreThanTheSag) {
  constexpr double w = 0x1p-10, length = 6.5;
  const Program f = record(2, 0, [](auto t, const auto& x, const auto&, auto& dx) {
    dx[0] = x[1];
    dx[1] = 2 * w / length * t - x[0];
  });
  Points points(32);
  Scene scene(f, 4, 1, 0, 30, 1e-6, points, true);
  scene.fill({0, 2 * w / length}, 0, 0, 0, 0, 0);
  scene.set.C = {1, 0, 0, 1};
  scene.set.W = {w, 0};
  ASSERT_EQ(scene.stepper.certify(scene.set, length, quantum), StepOutcome::stepped);
  ASSERT_TRUE(scene.stepper.isAboutCentre());
  ASSERT_EQ(scene.stepper.h(), length);
  FlowPoint end;
  scene.stepper.evaluate(scene.set, length, end);
  std::vector<FlowSag> sag;
  scene.stepper.sag(0, length, sag);
  std::vector<double> times;
  for (int i = 1; i < 64; ++i) times.push_back(length * i / 64);
  Reference reference(f);
  for (const double side : {-1.0, 1.0}) {
    const Interval chord = overChord(Interval(side * w), inflated(Interval(end.p[0]), end.radius[0]), sag[0]);
    for (const Vector& x : reference({Precise(side * w), Precise(2 * w / length)}, times))
      ASSERT_THAT(chord, Encloses(x[0])) << "from " << side * w;
  }
}

/// Whichever set was stepped before, so that threads decide nothing: not even how much work is counted.
TEST(FlowStep, DependsOnItsSetAlone) {
  const Program turns = record(2, 3, [](auto t, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = -900.0 * x[0] + p[0] * sin(p[1] * t) + p[2];
  });
  const Program touches = record(2, 3, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = -9.0 * p[0] * x[0] - p[1] * abs(x[0] - 0.1) + p[2] / (0.05 + abs(x[1]));
  });
  Points points(33);
  int steps = 0;
  for (int round = 0; round < 40; ++round) {
    const bool hasKinks = round % 2 == 1;
    const int degree = points.integer(1, 3), frame = points.integer(0, 1), order = points.integer(6, 12);
    const double tolerance = std::pow(10.0, -points.integer(3, 10));
    const auto scene = [&] {
      return Scene(hasKinks ? touches : turns, 4, degree, frame, order, tolerance, points, true);
    };
    Scene used = scene(), fresh = scene();
    const double size = points.uniform(0.001, 0.3);
    used.fill({0.1, -0.2, 1, 2, 3}, size, 1e-3, 1, 1e-6, 0);
    fresh.fill({points.uniform(0.05, 0.15), 0.1, 1, 2, 3}, size / 4, 1e-6, 1, 1e-9, 0);
    for (FlowSet* set : {&used.set, &fresh.set}) set->nextStep = 0x1p-8;
    used.stepper.certify(used.set, horizon, quantum);
    const auto certify = [&](FlowStepper& stepper, std::uint64_t& work) {
      const std::uint64_t began = Work::counted();
      const StepOutcome outcome = stepper.certify(fresh.set, horizon, quantum);
      work = Work::counted() - began;
      return outcome;
    };
    std::uint64_t workOfUsed = 0, workOfFresh = 0;
    const StepOutcome outcome = certify(used.stepper, workOfUsed);
    ASSERT_EQ(outcome, certify(fresh.stepper, workOfFresh)) << "round " << round;
    EXPECT_EQ(workOfUsed, workOfFresh) << "round " << round;
    if (outcome != StepOutcome::stepped) continue;
    ++steps;
    EXPECT_EQ(used.stepper.h(), fresh.stepper.h()) << "round " << round;
    for (int i = 0; i < 2; ++i) EXPECT_EQ(used.stepper.looseBound(i), fresh.stepper.looseBound(i)) << "round " << round;
  }
  EXPECT_GT(steps, 20);
}

TEST(FlowStep, RefusesAStepWhoseTubeIsNotProved) {
  constexpr int links = 6;
  const Program f = record(links, 0, [](auto, const auto& x, const auto&, auto& dx) {
    for (std::size_t i = 0; i + 1 < links; ++i) dx[i] = 0.5 * sqr(x[i + 1]);
    dx[links - 1] = 0.0;
  });
  Points points(16);
  for (int round = 0; round < 4; ++round) {
    Scene scene(f, 0, 0, 0, 8, 1e-6, points);
    scene.fill(std::vector<double>(links, 0.0), 0, 1e-30, 0, 0, 0);
    for (int i = 0; i < links; ++i)
      for (int j = 0; j < links; ++j) scene.set.C[at(i * links + j)] = i == j ? 1.0 : 0.0;
    scene.set.R.back() = 1.5;
    ASSERT_EQ(scene.stepper.certify(scene.set, 1, quantum), StepOutcome::stepped);
    scene.expectTrajectoriesInside(8);
    if (HasFatalFailure()) return;
  }
}

// Generators whose ξ-dependence is as large as they are, in two symbols and high degree: what is beyond it is cut off.
TEST(FlowStep, UpdateHoldsGeneratorsThatTurnWithTheSymbols) {
  const Program f = record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = p[0] * x[1];
    dx[1] = -p[0] * sin(x[0]);
  });
  Points points(17);
  for (int round = 0; round < 20; ++round) {
    Scene scene(f, 2, 3, round % 4, 10, 1e-12, points, true);
    scene.fill({0.5, 0.5, 1.0}, 0.3, 1e-4, 4, 1e-6, 0);
    for (double& value : scene.set.generators) value = 1e-4 * points.uniform(-1, 1);
    if (scene.stepper.certify(scene.set, 0x1p-2, quantum) != StepOutcome::stepped) continue;
    scene.expectUpdateInside(30);
    if (HasFatalFailure()) return;
  }
}

TEST(FlowStep, UpdateHoldsTheSetWhenOldGeneratorsMerge) {
  Points points(7);
  const auto [f, nominal] = motionsOfManyKinds()[0];
  for (const int symbols : {0, 1}) {
    Scene scene(f, symbols, 3 * symbols, 2 * symbols, 10, 1e-11, points);
    scene.fill(nominal, 1e-3 * symbols, 1e-12, 0, 0, 0);
    for (int step = 0; step < 100; ++step) {
      ASSERT_EQ(scene.stepper.certify(scene.set, 100, 0x1p-46), StepOutcome::stepped);
      scene.expectUpdateInside(4);
      if (HasFatalFailure()) return;
    }
  }
}

/// Errors (1, -1)/100 and (1, 1)/100 at each step of x' = v, h = 1, the velocity's scale 1e-3 and 1e3: how far the set
/// reaches a hundred steps on, merged on the way or not.
TEST(FlowStep, MergedErrorsShearAsTheyDid) {
  for (const double scale : {1e-3, 1.0, 1e3}) {
    FlowSet kept, merged;
    const Monomials none({}, 0);
    for (FlowSet* set : {&kept, &merged}) {
      set->R.assign(2, 0.0);
      set->units = {0, std::ilogb(scale)};
      for (int step = 0; step < 200; ++step) {
        for (std::size_t c = 0; c < set->generators.size(); c += 2)
          set->generators[c] += set->generators[c + 1] / scale;
        for (const double sign : {-1.0, 1.0}) {
          set->generators.push_back(0.01);
          set->generators.push_back(sign * 0.01 * scale);
        }
        if (set == &merged && set->generators.size() > 80) mergeGenerators(*set, none, 20);
      }
    }
    EXPECT_LE(merged.generators.size(), 80U);
    std::vector<double> before(2, 0.0), now(2, 0.0);
    addColumnSizes(kept.generators, before);
    addColumnSizes(merged.generators, now);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_GE(now[i], before[i] * (1 - 1e-12)) << i;
      EXPECT_LE(now[i], 1.5 * before[i]) << i << ", boxes alone: a thousandfold";
    }
  }
}

TEST(FlowStep, BoxesHoldTheGeneratorsThatTheyReplace) {
  Points points(18);
  for (int round = 0; round < 40; ++round)
    for (const auto& [f, nominal] : motionsOfManyKinds()) {
      const int symbols = points.integer(0, 2);
      Scene scene(f, symbols, symbols == 0 ? 0 : points.integer(1, 4), points.integer(0, 3), 8, 1e-12, points);
      scene.fill(nominal, 0.1, 1e-3, 20, 0, 0);
      if (round % 2 == 0) scene.set.units.assign(nominal.size() - 1, -3);
      if (round % 4 >= 2) scene.stretchOlder(round % 3 == 0 ? 0 : scene.n - 1);
      scene.expectMergedInside(at(points.integer(scene.n, 19)), 12);
      if (HasFatalFailure()) return;
    }
}

TEST(FlowStep, HalvesOfABisectedSetHoldIt) {
  Points points(8);
  for (int round = 0; round < 40; ++round)
    for (const auto& [f, nominal] : motionsOfManyKinds()) {
      const int symbols = points.integer(1, 3);
      Scene scene(f, symbols, points.integer(1, 6), points.integer(0, 3), 8, 1e-12, points);
      scene.fill(nominal, 0.3, 1e-3, points.integer(0, 3), round % 2 * 1e-16, round % 3 * 1e-15);
      scene.expectHalvesInside(points.integer(0, symbols - 1), 4);
      if (HasFatalFailure()) return;
      // A remainder far greater than the polynomials: it is the frame's rounding that counts.
      Scene loose(f, symbols, points.integer(2, 4), 2, 8, 1e-12, points);
      loose.fill(std::vector<double>(nominal.size(), 0.0), 1e-20, 1e3, 1, 0, 0);
      loose.expectHalvesInside(points.integer(0, symbols - 1), 4);
      if (HasFatalFailure()) return;
    }
}

TEST(FlowStep, OutputsHoldThoseOfEveryMemberOfTheSet) {
  Points points(15);
  int steps = 0;
  for (int round = 0; round < 60; ++round)
    for (const auto& [f, nominal] : motionsOfManyKinds()) {
      const int symbols = points.integer(0, 2), degree = symbols == 0 ? 0 : points.integer(1, 4);
      Scene scene(f, symbols, degree, points.integer(0, 2), 12, 1e-12, points);
      // From remainders so wide that g bends over them to such that only rounding is left; box, generators or both.
      const double size = std::pow(10.0, -points.integer(1, 13));
      const int kind = round % 3;
      scene.fill(nominal, std::pow(10.0, -points.integer(2, 8)), kind == 0 ? 0 : size, kind == 1 ? 0 : 2, 0, 0, size);
      if (scene.stepper.certify(scene.set, horizon, quantum) != StepOutcome::stepped) continue;
      ++steps;
      const Program g = record(f.states(), 1, 3, [](auto t, const auto& x, const auto& p, auto& y) {
        y[0] = 2.0 * x[0];
        y[1] = sqr(x[0]) * x.back();
        y[2] = sin(3.0 * x[0]) / (4.0 + sqr(x.back())) + t * p[0];
      });
      scene.expectOutputsInside(g, 6, degree);
      if (symbols > 0) scene.expectOutputsInside(g, 6, points.integer(1, degree));
      if (HasFatalFailure()) return;
    }
  EXPECT_GT(steps, 150);
}

TEST(FlowStep, OutputsLeaveTheirChordsByNoMoreThanTheirSag) {
  Points points(21);
  // x = p(ξ) + t p'(ξ), exactly.
  const Program f = record(2, 1, 2, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = x[1];
    dx[1] = 0.0 * x[1];
  });
  const Program g = record(2, 1, 3, [](auto t, const auto& x, const auto& p, auto& y) {
    y[0] = sqr(x[0]);
    y[1] = sin(3.0 * x[0]) / (4.0 + sqr(x[1])) + t * p[0];
    y[2] = x[0] * exp(x[1]);
  });
  int widest = 0;
  for (int round = 0; round < 60; ++round) {
    const int symbols = points.integer(1, 4), degree = points.integer(1, 6);
    Scene scene(f, symbols, degree, points.integer(0, 2), 8, 1e-10, points, true);
    scene.fill({0.7, 0.9, 0.4}, 0.5, 0, 0, 0, 0);
    ASSERT_EQ(scene.stepper.certify(scene.set, horizon, quantum), StepOutcome::stepped);
    const int own = points.integer(1, degree);
    FlowOutputChords chords(g, std::make_shared<const Monomials>(scene.capped(own), own), scene.monomials, 8, horizon,
                            quantum);
    const double h = scene.stepper.h(), from = points.integer(0, 1) * 0.3 * h, to = from + 0.6 * h;
    chords.load(scene.stepper, 0, scene.set.parameters, from, to);
    std::vector<FlowSag> sag;
    chords.sag(from, to, sag);
    Evaluator<Precise> truth(g);
    for (int member = 0; member < 30; ++member) {
      const Vector xi = scene.randomSymbols();
      const std::vector<Precise> values = scene.monomialsAt(xi);
      const int N = scene.monomials->count();
      const Precise x0 = scene.polynomial(&scene.set.p[0], N, values),
                    x1 = scene.polynomial(&scene.set.p[at(N)], N, values);
      const Embedded& q = scene.set.parameters[0];
      truth.setParameters(Vector{Precise(q.centre) + Precise(q.half) * xi[at(q.symbol)]});
      const auto outputsAt = [&](const Precise& t) {
        const Vector x{Precise(x0 + t * x1), x1};
        return Vector(truth(t, x));
      };
      const Precise share(points.uniform(0, 1)), t = from + share * (Precise(to) - from);
      const Vector begin = outputsAt(Precise(from)), end = outputsAt(Precise(to)), y = outputsAt(t);
      for (std::size_t o = 0; o < 3; ++o) {
        const auto& [bend, rest] = sag[o];
        if (!isBounded(bend)) continue;
        widest += own < degree ? 1 : 0;
        const Precise chord = (1 - share) * begin[o] + share * end[o], bow = 4 * share * (1 - share);
        ASSERT_LE(chord + bow * bend.lower() - rest, y[o]) << round << ' ' << o;
        ASSERT_GE(chord + bow * bend.upper() + rest, y[o]) << round << ' ' << o;
      }
    }
  }
  EXPECT_GT(widest, 500);
}

TEST(FlowStep, ChordsKnowWhatTheirPolynomialsLack) {
  Points points(22);
  const Program f = record(3, 1, 3, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = x[1];
    dx[1] = x[2];
    dx[2] = 0.0 * x[2];
  });
  const Program g = record(3, 1, 2, [](auto t, const auto& x, const auto&, auto& y) {
    y[0] = 1.0 * x[0];
    y[1] = t * x[0];
  });
  constexpr int degree = 3;
  Scene scene(f, 2, degree, 1, 8, 1e-10, points, true);
  const auto sagsIn = [&](int own) {
    EXPECT_EQ(scene.stepper.certify(scene.set, horizon, quantum), StepOutcome::stepped);
    FlowOutputChords chords(g, std::make_shared<const Monomials>(scene.capped(own), own), scene.monomials, 8, horizon,
                            quantum);
    std::vector<FlowSag> sag;
    chords.load(scene.stepper, 0, scene.set.parameters, 0, scene.stepper.h());
    chords.sag(0, scene.stepper.h(), sag);
    return sag;
  };
  scene.fill({0, 0, 0, 1}, 0, 0, 0, 0, 0);
  const int N = scene.monomials->count();
  scene.set.p[at(3 * N - 1)] = 0.5;  // an acceleration that depends on the highest power of a symbol alone
  {
    const Interval sag = sagsIn(degree - 1)[0].whole();
    const double h = scene.stepper.h(), bow = 0.5 * h * h / 8;
    EXPECT_GE(sag.upper(), bow);
    EXPECT_LE(sag.lower(), -bow);
  }
  scene.set.p[at(3 * N - 1)] = 0;
  scene.set.W = {0, 0.25, 0};  // what no polynomial tells: x = w t
  const Interval sag = sagsIn(degree)[1].whole();
  const double h = scene.stepper.h(), bow = 0.25 * h * h / 4;
  EXPECT_GE(sag.upper(), bow);
  EXPECT_LE(sag.lower(), -bow);
}

TEST(FlowStep, SetsOfAnotherDegreeHoldWhatTheyWere) {
  Points points(10);
  for (int round = 0; round < 40; ++round)
    for (const auto& [f, nominal] : motionsOfManyKinds()) {
      const int symbols = points.integer(1, 3);
      Scene scene(f, symbols, points.integer(1, 5), points.integer(0, 3), 8, 1e-12, points);
      scene.fill(nominal, 0.3, 1e-3, points.integer(0, 3), round % 2 * 1e-16, 0);
      const int degree = points.integer(1, 6);
      scene.expectOtherDegreeInside(degree, points.integer(0, degree), 4);
      if (HasFatalFailure()) return;
    }
}

TEST(FlowStep, FreshSymbolsHoldTheRemainder) {
  Points points(11);
  for (int round = 0; round < 40; ++round)
    for (const auto& [f, nominal] : motionsOfManyKinds()) {
      const int symbols = points.integer(0, 2), weight = symbols == 0 ? 1 : points.integer(1, 2);
      Scene scene(f, symbols, symbols == 0 ? 0 : points.integer(1, 4), points.integer(0, 2), 8, 1e-12, points);
      scene.fill(nominal, 0.1, std::pow(10.0, -points.integer(1, 9)), points.integer(0, 5), round % 2 * 1e-14, 0);
      std::vector<int> weights(at(symbols), 1);
      weights.resize(at(symbols + scene.n), weight);
      scene.expectExpansionInside(weights, points.integer(2, 4), 1, 12);
      if (HasFatalFailure()) return;
    }
}

TEST(FlowStep, StaysWithinTheTimeLeftAndOnTheGrid) {
  Points points(9);
  const auto [f, nominal] = motionsOfManyKinds()[0];
  Scene scene(f, 0, 0, 0, 12, 1e-15, points);
  scene.fill(nominal, 0, 0, 0, 0, 0);
  while (scene.set.t < horizon) {
    ASSERT_EQ(scene.stepper.certify(scene.set, horizon, quantum), StepOutcome::stepped);
    const double before = scene.set.t;
    scene.stepper.advance(scene.set);
    EXPECT_EQ(scene.set.t - before, scene.stepper.h());
    EXPECT_EQ(std::fmod(scene.set.t, quantum), 0);
    ASSERT_LE(scene.set.t, horizon);
  }
}

}  // namespace
}  // namespace gamut::testing
