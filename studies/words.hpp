// Numbers as people read them: sensible digits, guaranteed bounds rounded outward.
#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace gamut {

/// x rounded to nearest, to so many significant digits, without trailing zeros: "1.004", "19600", "-2.5e-07", "none"
/// for NaN. As all that follows, in powers of ten below 0.0001 and from ten million on only.
std::string numberText(double x, int digits = 4);

/// The same beside numbers of this size: "less than 1e-09" of what is hardly anything there.
std::string tellingText(double x, double size, int digits = 3);

/// "0.29 s".
std::string timeText(double time, int digits = 6);

/// The same of a time up to which something was reached: no more than that, in six digits.
std::string reachedText(double time);

/// "0.45 s" of CPU; of what took hardly any "less than 0.01 s".
std::string cpuText(double seconds);
constexpr double leastCpuTold = 0.01;  ///< s

/// x rounded up, never below x: for figures that promise "at most". Beside numbers of a `size` no less than a billionth
/// of that, nor than any unit's least prefix makes of it.
std::string atMostText(double x, int digits = 4);
std::string atMostText(double x, int digits, double size);

/// Whether x is hardly anything beside numbers of this size: no more than a billionth of it.
bool isLittle(double x, double size);

/// How many times as wide an enclosure is, rounded up: "1.013"; "1.0001" of what is hardly more than 1, and "1" of what
/// is so to a billionth.
std::string timesText(double ratio);

/// Decimals of lower rounded down and of upper rounded up: the printed pair holds the interval.
/// Infinite ends give "-inf", "inf"; both are "none" where there is no interval (a NaN, or lower > upper).
std::pair<std::string, std::string> outwardText(double lower, double upper, int digits);

/// Bounds of one quantity, rounded outward, with the digits that their width justifies (`resolved` of it, or of the
/// `widest` of those beside them), and no more than show a billionth of `size`: "[-114.38, 51.46]".
std::pair<std::string, std::string> outwardBounds(double lower, double upper, double size = 0, int resolved = 4,
                                                  double widest = 0);

/// The same, and "about 0.2" of what is beyond a decimal by no more than a billionth of the width, or by roundings;
/// "about 0" of what is no more than a billionth of `size`.
std::pair<std::string, std::string> boundsText(double lower, double upper, double size = 0, int resolved = 4,
                                               double widest = 0);

/// The least and the greatest of a motion, as bounds are told, with up to four digits of each one's own: "-0.9587",
/// "104.4".
std::pair<std::string, std::string> peaksText(double least, double greatest);

/// "[lower, upper]" rounded outward, or "none".
std::string intervalText(double lower, double upper, int digits);

/// The significant digits with which numbers of this magnitude show a width to `resolved` digits; from 4 to 17.
int digitsFor(double magnitude, double width, int resolved);

/// "-55.6164 ± 0.0017", "0.3130 ± 0.0042": both to the second digit of the error, where that is above 0.
std::string withErrorText(double x, double error);

/// "1 sample", "4096 samples".
std::string countText(long long count, std::string_view singular);

/// "[0.795, 0.805]", as a study states it: each bound by the shortest decimal from which it is some outward roundings
/// away at most, if that has no more than twelve digits; otherwise rounded outward to `digits`.
std::string rangeText(double lower, double upper, int digits);

/// "0.29 m", or the number alone of what has no unit: an empty one, or "1".
std::string inUnit(const std::string& number, const std::string& unit);

/// "angle (rad)", or the name alone.
std::string headingOf(const std::string& name, const std::string& unit);

/// The same, quoted where CSV asks for it.
std::string csvHeading(const std::string& name, const std::string& unit);

}  // namespace gamut
