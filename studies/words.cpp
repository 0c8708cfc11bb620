// Numbers by fmt (to nearest) and by Interval's text (outward, exact).
#include "studies/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "scalars/interval.hpp"

namespace gamut {

namespace {

constexpr double leastTold = 1e-24;  ///< of any unit: its least prefix
constexpr double billionth = 1e-9;

/// "19600" of "1.96e+04": up to ten million without powers of ten.
std::string inFull(const std::string& text) {
  constexpr int most = 6;
  const auto e = text.find("e+");
  if (e == text.npos || text.size() > e + 4) return text;
  const int exponent = std::stoi(text.substr(e + 2));
  const auto point = text.find('.');
  std::string digits = text.substr(0, e);
  if (exponent > most) return text;
  std::size_t decimals = 0;
  if (point != text.npos) {
    decimals = e - point - 1;
    digits.erase(point, 1);
  }
  if (decimals > static_cast<std::size_t>(exponent)) return text;  // never of %g
  return digits.append(static_cast<std::size_t>(exponent) - decimals, '0');
}

/// The least power of ten that is not below x > 0.
std::string powerAbove(double x) {
  for (int exponent = static_cast<int>(std::floor(std::log10(x)));; ++exponent)
    if (std::string text = fmt::format("{:g}", std::pow(10, exponent)); Interval(text).lower() >= x) return text;
}

}  // namespace

std::string numberText(double x, int digits) {
  return std::isnan(x) ? "none" : inFull(fmt::format("{:.{}g}", x, digits));
}

std::string tellingText(double x, double size, int digits) {
  const double least = std::max(billionth * size, leastTold);
  return std::abs(x) < least ? "less than " + powerAbove(least) : numberText(x, digits);
}

std::string timeText(double time, int digits) { return numberText(time, digits) + " s"; }

std::string reachedText(double time) {
  const std::string text = numberText(time, 6);
  return (std::strtod(text.c_str(), nullptr) <= time ? text : outwardText(time, time, 6).first) + " s";
}

std::string cpuText(double seconds) {
  return seconds < leastCpuTold ? "less than 0.01 s" : fmt::format("{:.2f} s", seconds);
}

std::string atMostText(double x, int digits) {
  if (std::isnan(x)) return "none";
  return std::isinf(x) ? numberText(x) : outwardText(x, x, digits).second;
}

std::string atMostText(double x, int digits, double size) {
  const double least = std::max(billionth * size, leastTold);
  return x < least && x != 0 ? powerAbove(least) : atMostText(x, digits);
}

bool isLittle(double x, double size) { return std::abs(x) <= billionth * size; }

std::string timesText(double ratio) {
  constexpr double hardly = 1e-3;
  const double more = ratio - 1;
  if (isLittle(more, 1)) return "1";
  return atMostText(ratio, more > 0 && more < hardly ? 5 : 4);
}

std::pair<std::string, std::string> outwardText(double lower, double upper, int digits) {
  if (!(lower <= upper)) return {"none", "none"};
  if (std::isinf(lower) && std::isinf(upper)) return {numberText(lower), numberText(upper)};
  const std::string text = toString(Interval(lower, upper), digits);  // "[lower, upper]"
  const auto comma = text.find(',');
  return {inFull(text.substr(1, comma - 1)), inFull(text.substr(comma + 2, text.size() - comma - 3))};
}

namespace {

/// Both ends outward, as they are.
using BothEnds = std::pair<std::string, std::string>;

/// With so many decimals.
BothEnds fixedText(double lower, double upper, int decimals) {
  const std::string text = toFixedString(Interval(lower, upper), decimals);  // "[lower, upper]"
  const auto comma = text.find(',');
  return {text.substr(1, comma - 1), text.substr(comma + 2, text.size() - comma - 3)};
}

/// `outward`, or "about 0.2" where that is the decimal nearest to an end that lies beyond it by no more than is little.
std::string aboutText(double end, bool isLower, const std::string& nearest, const std::string& outward, double little) {
  const double decimal = std::strtod(nearest.c_str(), nullptr), beyond = isLower ? decimal - end : end - decimal;
  return outward != nearest && beyond >= 0 && beyond <= little ? "about " + numberText(decimal + 0.0, 15) : outward;
}

/// Of bounds so far apart: what counts for nothing beside that, or is some roundings of them.
double littleOf(double shown, double greatest) {
  constexpr double roundings = 16 * std::numeric_limits<double>::epsilon();
  return std::max(billionth * shown, roundings * greatest);
}

/// Numbers from here to there are told without powers of ten.
bool isLegible(double size) {
  constexpr double small = 1e-4, great = 1e7;
  return size >= small && size < great;
}

/// How bounds of this width are told.
struct Digits {
  double little = 0;    ///< what is beyond a decimal by that is about it
  int significant = 0;  ///< 0: as many decimals as follow
  int decimals = 0;

  Digits(double lower, double upper, double size, int resolved, double widest) {
    const double greatest = std::max(std::abs(lower), std::abs(upper)), width = std::max(upper - lower, widest),
                 shown = std::max(width, std::max(billionth * std::max(size, greatest), leastTold));
    little = littleOf(shown, greatest);
    if (isLegible(greatest))
      decimals = std::clamp(resolved - 1 - static_cast<int>(std::floor(std::log10(shown))), 0, 15);
    else
      significant = std::clamp(digitsFor(greatest, shown, resolved), 1, 17);
  }
  BothEnds outward(double lower, double upper) const {
    return significant > 0 ? outwardText(lower, upper, significant) : fixedText(lower, upper, decimals);
  }
  std::string nearest(double x) const {
    return significant > 0 ? numberText(x, significant) : fmt::format("{:.{}f}", x, decimals);
  }
};

/// Bounds of which nothing, or hardly anything, is to be told; empty of others.
BothEnds trivialBounds(double lower, double upper, double size, int resolved) {
  const double greatest = std::max(std::abs(lower), std::abs(upper));
  if (!(lower <= upper) || std::isinf(greatest)) return outwardText(lower, upper, resolved);
  if (greatest == 0) return {"0", "0"};
  const double least = std::max(billionth * std::max(size, greatest), leastTold);
  if (greatest > least) return {};
  const std::string little = powerAbove(least);
  return {lower < 0 ? "-" + little : "0", upper > 0 ? little : "0"};
}

}  // namespace

BothEnds outwardBounds(double lower, double upper, double size, int resolved, double widest) {
  BothEnds ends = trivialBounds(lower, upper, size, resolved);
  return ends.first.empty() ? Digits(lower, upper, size, resolved, widest).outward(lower, upper) : ends;
}

BothEnds boundsText(double lower, double upper, double size, int resolved, double widest) {
  BothEnds ends = trivialBounds(lower, upper, size, resolved);
  if (lower <= upper && !ends.first.empty() && std::isfinite(upper - lower)) {  // nothing beside what it may be
    if (lower < 0) ends.first = "about 0";
    if (upper > 0) ends.second = "about 0";
  }
  if (!ends.first.empty()) return ends;
  const Digits digits(lower, upper, size, resolved, widest);
  const auto [below, above] = digits.outward(lower, upper);
  return {aboutText(lower, true, digits.nearest(lower), below, digits.little),
          aboutText(upper, false, digits.nearest(upper), above, digits.little)};
}

BothEnds peaksText(double least, double greatest) {
  const double size = std::max(std::abs(least), std::abs(greatest));
  if (!(least <= greatest) || !isLegible(size)) return boundsText(least, greatest);
  constexpr int digits = 4, most = 3;  // of its own; beyond those that the width has
  const auto decimalsFor = [](double x) { return digits - 1 - static_cast<int>(std::floor(std::log10(x))); };
  const double shown = std::max(greatest - least, billionth * size);
  const int common = std::clamp(decimalsFor(shown), 0, 15 - most);
  const auto outward = [](double peak, bool isLeast, int decimals) {
    const BothEnds both = fixedText(peak, peak, decimals);
    return isLeast ? both.first : both.second;
  };
  const auto end = [&](double peak, bool isLeast) -> std::string {
    if (peak == 0 || (isLittle(peak, size) && (peak > 0) == isLeast)) return "0";
    const std::string about = aboutText(peak, isLeast, fmt::format("{:.{}f}", peak, common),
                                        outward(peak, isLeast, common), littleOf(shown, size));
    return about.starts_with("about")
               ? about
               : outward(peak, isLeast, std::clamp(decimalsFor(std::abs(peak)), common, common + most));
  };
  return {end(least, true), end(greatest, false)};
}

std::string intervalText(double lower, double upper, int digits) {
  const auto [below, above] = outwardText(lower, upper, digits);
  return below == "none" ? below : "[" + below + ", " + above + "]";
}

int digitsFor(double magnitude, double width, int resolved) {
  if (!(width > 0) || !(magnitude > 0) || std::isinf(magnitude) || std::isinf(width))
    return std::clamp(resolved, 4, 17);
  const double leading = std::ceil(std::log10(magnitude / width));
  return std::clamp(resolved + static_cast<int>(std::clamp(leading, -20.0, 20.0)), 4, 17);
}

std::string withErrorText(double x, double error) {
  const auto place = [](double y) { return static_cast<int>(std::floor(std::log10(std::abs(y)))); };
  constexpr int legible = 7;  // decimals
  constexpr double most = 1e7;
  if (const int decimals = error > 0 && std::isfinite(error) ? 1 - place(error) : -1;
      decimals >= 0 && decimals <= legible && std::abs(x) < most)
    return fmt::format("{:.{}f} ± {:.{}f}", x, decimals, error, decimals);
  const bool isOrdered = x != 0 && error > 0;
  return fmt::format("{} ± {}", numberText(x, isOrdered ? std::clamp(place(x) - place(error) + 2, 1, 17) : 4),
                     numberText(error, 2));
}

std::string countText(long long count, std::string_view singular) {
  return fmt::format("{} {}{}", count, singular, count == 1 ? "" : "s");
}

std::string rangeText(double lower, double upper, int digits) {
  const auto [below, above] = outwardText(lower, upper, digits);
  const auto stated = [](double bound) -> std::string {
    constexpr double roundings = 8;  // of a number and its tolerance, outward
    for (int n = 1; n <= 12 && std::isfinite(bound); ++n) {
      const std::string text = fmt::format("{:.{}g}", bound, n);
      const Interval decimal(text);
      const double ulp = std::nextafter(std::abs(bound), std::numeric_limits<double>::infinity()) - std::abs(bound);
      if (std::abs(midpoint(decimal) - bound) <= roundings * ulp) return inFull(text);
    }
    return "";
  };
  const std::string least = stated(lower), greatest = stated(upper);
  return fmt::format("[{}, {}]", least.empty() ? below : least, greatest.empty() ? above : greatest);
}

std::string inUnit(const std::string& number, const std::string& unit) {
  return unit.empty() || unit == "1" ? number : number + " " + unit;
}

std::string headingOf(const std::string& name, const std::string& unit) {
  return unit.empty() || unit == "1" ? name : fmt::format("{} ({})", name, unit);
}

std::string csvHeading(const std::string& name, const std::string& unit) {
  const std::string text = headingOf(name, unit);
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

}  // namespace gamut
