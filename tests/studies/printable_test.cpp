// What a terminal would obey, or nobody would see, is shown; of what is endless a part.
#include "studies/printable.hpp"

#include <gmock/gmock.h>

namespace gamut {
namespace {

TEST(Printable, ShowsWhatChangesWhatIsSeen) {
  const struct {
    const char *text, *shown;
  } cases[] = {
      {"\x1b[2J", "\\u001b[2J"},
      {"a\nb\tc\r", "a\\nb\\tc\\u000d"},
      {"\u202egnp.exe", "\\u202egnp.exe"},
      {"\u2066a\u2069", "\\u2066a\\u2069"},
      {"\u200b\u200e\u061c\ufeff", "\\u200b\\u200e\\u061c\\ufeff"},
      {"\u2028\u2029", "\\u2028\\u2029"},
      {"\u0085", "\\u0085"},
      {"\U000e0041", "\\U000e0041"},
      {"± 5 µm, φ̇, 質量, שלום, 👩\u200d🔧", "± 5 µm, φ̇, 質量, שלום, 👩\u200d🔧"},  // with a joiner
      {"\xe2\x80", "\xe2\x80"},                                                // no UTF-8
  };
  for (const auto& c : cases) {
    EXPECT_EQ(printable(c.text), c.shown);
    EXPECT_EQ(hasControlCharacters(c.text), printable(c.text) != c.text) << c.shown;
  }
  EXPECT_EQ(printableLines("a\n\tb\u202e\n"), "a\n\tb\\u202e\n");
}

TEST(Printable, ShortensWhatIsEndlessBetweenCharacters) {
  EXPECT_EQ(shortened("short", 10), "short");
  const std::string found = shortened(std::string(1000000, 'a') + "end", 100);
  EXPECT_THAT(found, ::testing::StartsWith("aaaa"));
  EXPECT_THAT(found, ::testing::EndsWith("aend"));
  EXPECT_THAT(found, ::testing::HasSubstr(" … (1000003 characters) … "));
  EXPECT_LT(found.size(), 150u);
  std::string text;
  for (int i = 0; i < 1000; ++i) text += "µ";
  for (std::size_t most = 20; most < 30; ++most) EXPECT_TRUE(isUtf8(shortened(text, most))) << most;
}

}  // namespace
}  // namespace gamut
