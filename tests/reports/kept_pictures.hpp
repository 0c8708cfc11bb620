// Pictures of pages that are held against those that are kept. Where letters and lines are drawn otherwise than on the
// machine that these come from (other fonts, another browser), which a sample of both tells, nothing can be compared.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "tests/reports/in_chromium.hpp"
#include "tests/studies/temporary_folder.hpp"

namespace gamut {

class KeptPictures : public InChromium {
 protected:
  /// What is drawn, and what is done to the page before.
  struct Picture {
    std::string name;
    Chromium::Screen screen;
    std::string doing = "";
  };
  /// Where pictures are kept, below tests/reports, and how small: 2 is half as wide and high.
  struct Place {
    std::string folder;
    int reduction = 1;

    std::string of(const std::string& name) const {
      return GAMUT_SOURCE_DIR "/tests/reports/" + folder + "/" + name + ".png";
    }
  };

  static bool isKeeping() { return std::getenv("GAMUT_KEEP_PICTURES") != nullptr; }

  void SetUp() override {
    InChromium::SetUp();
    if (!IsSkipped() && !HasFatalFailure()) std::filesystem::create_directories(GAMUT_PICTURES);
  }

  /// Where what is drawn of a page, once its scripts are done, lies.
  static std::string draw(const std::string& page, const Picture& picture) {
    const std::string png = chromium->picture(
        page,
        "const root = document.documentElement, frame = () => new Promise(then => requestAnimationFrame(then));"
        // To whole pixels: letters between them are smoothed otherwise.
        "const seen = name => scrollTo(0, Math.round(scrollY - 80 +"
        "  document.querySelector(name).getBoundingClientRect().top));"
        "const drawn = async () => { await frame(); await frame(); await frame(); };"
        "while (root.dataset.page !== 'ready' || root.dataset.plots === 'waiting') await frame();" +
            picture.doing + ";await drawn();",
        picture.screen);
    return written(picture.name, png);
  }

  /// A line for each that differs from what is kept; or keeps them.
  static std::string difference(const std::string& page, const std::vector<Picture>& pictures, const Place& place) {
    std::string pairs;
    for (const Picture& picture : pictures)
      pairs += fmt::format(" '{}' '{}'", draw(page, picture), place.of(picture.name));
    return compared(pairs, place.reduction);
  }

  /// How letters and lines are drawn otherwise; empty where they are not.
  std::string differenceOfSample() {
    const std::string page = folder_.path("sample.html");
    std::ofstream(page)
        << "<!DOCTYPE html><meta charset=\"utf-8\"><body style=\"margin: 8px; font: 16px/1.5 system-ui, "
           "-apple-system, 'Segoe UI', Roboto, 'Noto Sans', 'DejaVu Sans', sans-serif\">"
           "<p>In some cases, 0123456789 ± 3.7 m/s²</p><p style=\"font-size: 11px\">guaranteed, probable, "
           "possible</p><b>Quantities</b> <code>gamut run</code><svg width=\"200\" height=\"30\"><path "
           "d=\"M0 28C60 -20 90 60 200 3\" fill=\"none\" stroke=\"#1f5f99\"/></svg>";
    const std::string png = chromium->picture(page, "await document.fonts.ready;", {400, 200});
    return compared(fmt::format(" '{}' '{}'", written("sample", png), Place{"pictures"}.of("sample")), 1);
  }

  TemporaryFolder folder_;

 private:
  static std::string written(const std::string& name, const std::string& png) {
    std::string file = GAMUT_PICTURES "/" + name + ".png";
    std::ofstream(file, std::ios::binary) << png;
    return file;
  }

  static std::string compared(const std::string& pairs, int reduction) {
    const std::string command =
        fmt::format("'{}' {}/tests/reports/page/compare_pictures.mjs {} --reduced {}{}", GAMUT_NODE, GAMUT_SOURCE_DIR,
                    isKeeping() ? "--keep" : "", reduction, pairs);
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> output(::popen(command.c_str(), "r"), ::pclose);
    std::array<char, 4096> text{};
    std::string all;
    while (std::fgets(text.data(), text.size(), output.get()) != nullptr) all += text.data();
    return all;
  }
};

}  // namespace gamut
