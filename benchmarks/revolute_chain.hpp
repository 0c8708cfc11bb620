// Forward dynamics of a serial arm with seven revolute joints, of the build of a KUKA iiwa (own numbers), for any
// scalar: the articulated-body algorithm (R. Featherstone, Rigid Body Dynamics Algorithms 2008, ch. 7).
//
// Every joint turns about the z axis of its link's frame. The frames differ by a shift along y or z of the link before
// and a quarter turn about x, both known when this is compiled, so that nothing is multiplied by their zeros and ones.
// Vectors are in the link's own frame, inertias about its origin. Accelerations are the classical ones of the origins,
// so that linear velocities are not needed: the bias force of a link is (ω × I ω, ω × (ω × h)).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace gamut::benchmarks {

inline constexpr int joints = 7;

template <class T>
struct Vector {
  T x, y, z;
  friend Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vector operator*(const T& s, const Vector& a) { return {s * a.x, s * a.y, s * a.z}; }
  friend T dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  friend Vector cross(const Vector& a, const Vector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
};

template <class T>
struct Symmetric {
  T xx, xy, xz, yy, yz, zz;
  friend Vector<T> operator*(const Symmetric& s, const Vector<T>& a) {
    return {s.xx * a.x + s.xy * a.y + s.xz * a.z, s.xy * a.x + s.yy * a.y + s.yz * a.z,
            s.xz * a.x + s.yz * a.y + s.zz * a.z};
  }
};

/// Three rows.
template <class T>
struct Matrix {
  Vector<T> x, y, z;
  friend Vector<T> operator*(const Matrix& m, const Vector<T>& a) { return {dot(m.x, a), dot(m.y, a), dot(m.z, a)}; }
};

/// Mass (kg), first moment (kg m) and inertia about the link's origin (kg m²).
template <class T>
struct Link {
  T mass;
  Vector<T> moment;
  Symmetric<T> inertia;
};

template <class T>
using Arm = std::array<Link<T>, joints>;

template <class T>
using JointValues = std::array<T, joints>;

/// Where joint i sits on the link before: a shift (m) along that link's y or z, then a quarter turn about x, which maps
/// z to -y. The first joint stands on the base, without a turn. So the arm is straight up at q = 0.
struct Seat {
  char axis;
  double length;
};
inline constexpr std::array<Seat, joints> seats{
    {{'z', 0.16}, {'z', 0.2}, {'y', 0.21}, {'z', -0.22}, {'y', -0.18}, {'z', 0.22}, {'y', 0.08}}};
inline constexpr double gravity = 9.81;  // m/s², along -z of the base

/// Links of these masses: the shares of the centre of mass and of the radii of gyration are fixed.
template <class T>
Arm<T> armOf(const JointValues<T>& masses) {
  constexpr double centre[joints][3] = {{0.0, -0.03, 0.12}, {0.0, 0.06, 0.04},   {0.0, 0.03, 0.13}, {0.0, 0.07, 0.03},
                                        {0.0, 0.02, 0.08},  {0.0, 0.005, 0.004}, {0.001, 0.0, 0.02}};
  constexpr double gyration[joints][3] = {{0.03, 0.025, 0.012},   {0.015, 0.013, 0.011}, {0.025, 0.023, 0.0075},
                                          {0.03, 0.026, 0.01},    {0.016, 0.015, 0.006}, {0.003, 0.0028, 0.002},
                                          {0.0035, 0.0034, 0.003}};  // m², about the centre of mass
  Arm<T> arm;
  for (std::size_t i = 0; i < joints; ++i) {
    const double x = centre[i][0], y = centre[i][1], z = centre[i][2];
    const T& m = masses[i];
    arm[i].mass = m;
    arm[i].moment = {m * x, m * y, m * z};
    arm[i].inertia = {m * (gyration[i][0] + y * y + z * z), m * (-x * y), m * (-x * z),
                      m * (gyration[i][1] + x * x + z * z), m * (-y * z), m * (gyration[i][2] + x * x + y * y)};
  }
  return arm;
}
inline constexpr JointValues<double> usualMasses{5.8, 6.3, 3.5, 3.6, 3.4, 1.8, 1.2};

template <class T>
class ForwardDynamics {
 public:
  /// Joint accelerations (rad/s²) from angles (rad), velocities (rad/s) and torques (N m).
  static JointValues<T> of(const Arm<T>& arm, const JointValues<T>& q, const JointValues<T>& v,
                           const JointValues<T>& torque) {
    ForwardDynamics arms{arm, q, v, torque};
    return arms.passes(std::make_index_sequence<joints - 1>());
  }

 private:
  ForwardDynamics(const Arm<T>& arm, const JointValues<T>& q, const JointValues<T>& v, const JointValues<T>& torque)
      : arm_(arm), q_(q), v_(v), torque_(torque) {}

  template <std::size_t... i>
  JointValues<T> passes(std::index_sequence<i...>) {
    w_[0] = {T(0.0), T(0.0), v_[0]};
    (velocities<i + 1>(), ...);
    const Vector<T> none{T(0.0), T(0.0), T(0.0)};
    Articulated outer{{T(0.0), T(0.0), T(0.0), T(0.0), T(0.0), T(0.0)},
                      {none, none, none},
                      {T(0.0), T(0.0), T(0.0), T(0.0), T(0.0), T(0.0)},
                      none,
                      none};
    ((outer = carried<joints - 1 - i>(withLink<joints - 1 - i>(outer))), ...);
    // The first link turns about the vertical: only its inertia about that axis counts, and its bias does no work.
    const T inertia = outer.a.zz + arm_[0].inertia.zz;
    result_[0] = (torque_[0] - outer.n.z - outer.b.z.z * gravity) / inertia;
    angular_ = {T(0.0), T(0.0), result_[0]};
    linear_ = {T(0.0), T(0.0), T(gravity)};
    (accelerate<i + 1>(), ...);
    return result_;
  }

  /// Inertia [[A, B], [Bᵀ, C]] and bias (n, f) of a body with all that hangs on it: moment = A α + B a + n, and so on.
  struct Articulated {
    Symmetric<T> a;
    Matrix<T> b;
    Symmetric<T> c;
    Vector<T> n, f;
  };

  /// From the link before to link i, and back.
  template <std::size_t i>
  Vector<T> toLink(const Vector<T>& a) const {
    return {c_[i] * a.x + s_[i] * a.z, c_[i] * a.z - s_[i] * a.x, -a.y};
  }
  template <std::size_t i>
  Vector<T> toParent(const Vector<T>& a) const {
    return {c_[i] * a.x - s_[i] * a.y, -a.z, s_[i] * a.x + c_[i] * a.y};
  }

  /// The block xx, xy, yy of R M Rᵀ for the turn R about z; the trace stays.
  struct Block {
    T xx, xy, yy;
  };
  template <std::size_t i>
  Block turned(const T& xx, const T& xy, const T& yy) const {
    const T u = c_[i] * xx - s_[i] * xy, v = c_[i] * xy - s_[i] * yy, first = c_[i] * u - s_[i] * v;
    return {first, s_[i] * u + c_[i] * v, xx + yy - first};
  }

  /// Joint i > 0: its angle's sine and cosine, the link's velocity and what its acceleration owes to velocities.
  template <std::size_t i>
  void velocities() {
    using std::cos, std::sin;
    s_[i] = sin(q_[i]);
    c_[i] = cos(q_[i]);
    w_[i] = toLink<i>(w_[i - 1]);
    const Vector<T>& w = w_[i];
    turning_[i] = {w.y * v_[i], -(w.x * v_[i]), T(0.0)};
    w_[i].z = w.z + v_[i];
    outer_[i] = {-(w.y * w.y + w.z * w.z), w.x * w.y, w.x * w.z,
                 -(w.x * w.x + w.z * w.z), w.y * w.z, -(w.x * w.x + w.y * w.y)};
    if constexpr (i > 1) {
      const Symmetric<T>& o = outer_[i - 1];
      constexpr double d = seats[i].length;
      if constexpr (seats[i].axis == 'y')
        centripetal_[i] = toLink<i>({d * o.xy, d * o.yy, d * o.yz});
      else
        centripetal_[i] = toLink<i>({d * o.xz, d * o.yz, d * o.zz});
    }
  }

  /// Adds link i itself: its bias is (ω × I ω, (ω ωᵀ - |ω|²) h).
  template <std::size_t i>
  Articulated withLink(const Articulated& outer) const {
    const Link<T>& link = arm_[i];
    const Vector<T>& h = link.moment;
    Articulated body = outer;
    const Symmetric<T>& j = link.inertia;
    body.a = {body.a.xx + j.xx, body.a.xy + j.xy, body.a.xz + j.xz,
              body.a.yy + j.yy, body.a.yz + j.yz, body.a.zz + j.zz};
    body.b.x.y = body.b.x.y - h.z;
    body.b.x.z = body.b.x.z + h.y;
    body.b.y.x = body.b.y.x + h.z;
    body.b.y.z = body.b.y.z - h.x;
    body.b.z.x = body.b.z.x - h.y;
    body.b.z.y = body.b.z.y + h.x;
    body.c.xx = body.c.xx + link.mass;
    body.c.yy = body.c.yy + link.mass;
    body.c.zz = body.c.zz + link.mass;
    body.n = body.n + cross(w_[i], j * w_[i]);
    body.f = body.f + outer_[i] * h;
    return body;
  }

  /// What link i - 1 feels of the body that hangs on joint i > 0, when the joint gives way along its axis.
  template <std::size_t i>
  Articulated carried(const Articulated& body) {
    const Vector<T> a{body.a.xz, body.a.yz, body.a.zz}, b = body.b.z;
    const T inverse = T(1.0) / a.z, rest = torque_[i] - body.n.z, yielded = inverse * rest;
    a_[i] = inverse * a;
    b_[i] = inverse * b;
    yielded_[i] = yielded;

    const Vector<T>&da = a_[i], &db = b_[i];
    const T axx = body.a.xx - a.x * da.x, axy = body.a.xy - a.x * da.y, ayy = body.a.yy - a.y * da.y;
    const Vector<T> bx{body.b.x.x - a.x * db.x, body.b.x.y - a.x * db.y, body.b.x.z - a.x * db.z};
    const Vector<T> by{body.b.y.x - a.y * db.x, body.b.y.y - a.y * db.y, body.b.y.z - a.y * db.z};
    const Symmetric<T> c{body.c.xx - b.x * db.x, body.c.xy - b.x * db.y, body.c.xz - b.x * db.z,
                         body.c.yy - b.y * db.y, body.c.yz - b.y * db.z, body.c.zz - b.z * db.z};
    const Vector<T>& t = turning_[i];
    Vector<T> n{body.n.x + a.x * yielded + axx * t.x + axy * t.y, body.n.y + a.y * yielded + axy * t.x + ayy * t.y,
                torque_[i]};
    Vector<T> f{body.f.x + b.x * yielded + bx.x * t.x + by.x * t.y, body.f.y + b.y * yielded + bx.y * t.x + by.y * t.y,
                body.f.z + b.z * yielded + bx.z * t.x + by.z * t.y};
    if constexpr (i > 1) {
      const Vector<T>& p = centripetal_[i];
      n.x = n.x + dot(bx, p);
      n.y = n.y + dot(by, p);
      f = f + c * p;
    }

    // Turned into the frame of link i - 1, where the y row of B is zero, as is that of A.
    const Block turnedA = turned<i>(axx, axy, ayy), turnedC = turned<i>(c.xx, c.xy, c.yy);
    const T &cosine = c_[i], &sine = s_[i];
    const Symmetric<T> pc{turnedC.xx, sine * c.yz - cosine * c.xz,    turnedC.xy,
                          c.zz,       -(sine * c.xz + cosine * c.yz), turnedC.yy};
    const Vector<T> ux = toParent<i>(bx), uy = toParent<i>(by);
    const Vector<T> px{cosine * ux.x - sine * uy.x, cosine * ux.y - sine * uy.y, cosine * ux.z - sine * uy.z};
    const Vector<T> pz{sine * ux.x + cosine * uy.x, sine * ux.y + cosine * uy.y, sine * ux.z + cosine * uy.z};
    n = toParent<i>(n);
    f = toParent<i>(f);

    // Shifted by p to the origin of link i - 1: B becomes B + P C and A becomes A + P Bᵀ - (B + P C) P, P a = p × a.
    constexpr double d = seats[i].length;
    if constexpr (seats[i].axis == 'y') {
      const Vector<T> sx{px.x + d * pc.xz, px.y + d * pc.yz, px.z + d * pc.zz};
      const Vector<T> sz{pz.x - d * pc.xx, pz.y - d * pc.xy, pz.z - d * pc.xz};
      return {{turnedA.xx + d * (px.z + sx.z), T(0.0), turnedA.xy + d * (pz.z - sx.x), T(0.0), T(0.0),
               turnedA.yy - d * (pz.x + sz.x)},
              {sx, {T(0.0), T(0.0), T(0.0)}, sz},
              pc,
              {n.x + d * f.z, n.y, n.z - d * f.x},
              f};
    } else {
      const Vector<T> sx{px.x - d * pc.xy, px.y - d * pc.yy, px.z - d * pc.yz};
      const Vector<T> sy{d * pc.xx, d * pc.xy, d * pc.xz};
      return {{turnedA.xx - d * (px.y + sx.y), d * sx.x, turnedA.xy - d * pz.y, d * sy.x, d * pz.x, turnedA.yy},
              {sx, sy, pz},
              pc,
              {n.x - d * f.y, n.y + d * f.x, n.z},
              f};
    }
  }

  /// Joint i > 0: the accelerations of its link, from those of the link before.
  template <std::size_t i>
  void accelerate() {
    constexpr double d = seats[i].length;
    const Vector<T>&w = angular_, &l = linear_;
    const Vector<T> seat = seats[i].axis == 'y' ? Vector<T>{l.x - d * w.z, l.y, l.z + d * w.x}
                                                : Vector<T>{l.x + d * w.y, l.y - d * w.x, l.z};
    linear_ = toLink<i>(seat);
    if constexpr (i > 1) linear_ = linear_ + centripetal_[i];
    angular_ = toLink<i>(angular_);
    angular_.x = angular_.x + turning_[i].x;
    angular_.y = angular_.y + turning_[i].y;
    result_[i] = yielded_[i] - (a_[i].x * angular_.x + a_[i].y * angular_.y + angular_.z) - dot(b_[i], linear_);
    angular_.z = angular_.z + result_[i];
  }

  const Arm<T>& arm_;
  const JointValues<T>&q_, &v_, &torque_;
  JointValues<T> s_, c_, yielded_, result_;
  std::array<Vector<T>, joints> w_, turning_, centripetal_, a_, b_;
  std::array<Symmetric<T>, joints> outer_;
  Vector<T> angular_, linear_;
};

}  // namespace gamut::benchmarks
