// Each line marked so must be refused by the compiler, as it would branch on the values of intervals; every other line
// must be accepted. (Sizes differ from line to line, so that no template is instantiated for two lines.)
#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>

#include "scalars/eigen.hpp"
#include "scalars/interval.hpp"

using gamut::Interval;
template <int n>
using Square = Eigen::Matrix<Interval, n, n>;
template <int n>
using Vector = Eigen::Matrix<Interval, n, 1>;

void accepted(const Square<3>& a, const Vector<3>& v) {
  a.inverse();
  a.determinant();
  v.norm();
  (v / v.norm()).eval();
  v.maxCoeff();  // by the max of intervals, which encloses the greatest element
}
void partialPivLu(const Square<5>& a) { a.partialPivLu(); }                         // refused
void fullPivLu(const Square<6>& a) { a.fullPivLu(); }                               // refused
void householderQr(const Square<7>& a) { a.householderQr(); }                       // refused
void pivotingQr(const Square<8>& a) { a.colPivHouseholderQr(); }                    // refused
void cholesky(const Square<9>& a) { a.llt(); }                                      // refused
void robustCholesky(const Square<10>& a) { a.ldlt(); }                              // refused
void largeInverse(const Square<13>& a) { a.inverse().eval(); }                      // refused
void largeDeterminant(const Square<14>& a) { a.determinant(); }                     // refused
void whereGreatest(const Vector<16>& v, int& i) { v.maxCoeff(&i); }                 // refused
void approximately(const Vector<18>& v) { v.isApprox(2 * v); }                      // refused
void nearZero(const Vector<19>& v) { v.isZero(); }                                  // refused
void equal(const Vector<20>& v) { static_cast<void>(v == 2 * v); }                  // refused
void normalised(const Vector<21>& v) { v.normalized(); }                            // refused
void robustNorm(const Vector<22>& v) { v.stableNorm(); }                            // refused
void comparedByElement(const Vector<23>& v) { (v.array() < 2 * v.array()).any(); }  // refused
void toDoubles(const Vector<24>& v) { v.cast<double>().eval(); }                    // refused
void fromMatrix(const Square<3>& a) { Eigen::Quaternion<Interval> q(a); }           // refused
void inverted(const Eigen::Quaternion<Interval>& q) { q.inverse(); }                // refused
