// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/io/text.h"

#include <gmock/gmock.h>

#include "io/synthetic_folder.h"

namespace spslam {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(LineReader, SkipsCommentsBlanksMarksAndCarriageReturns) {
  LineReader reader("\xEF\xBB\xBF# head\r\n\r\n  a  b\t c \r\n\n#x\nlast", "f");
  ASSERT_TRUE(reader.next());
  EXPECT_EQ(reader.number(), 3);
  EXPECT_THAT(reader.fields(), ElementsAre("a", "b", "c"));
  ASSERT_TRUE(reader.next());
  EXPECT_EQ(reader.number(), 6);
  EXPECT_EQ(reader.line(), "last");
  EXPECT_FALSE(reader.next());
}

TEST(LineReader, SeparatesByCommaAndKeepsEmptyFields) {
  LineReader reader(" 1 ,, x y,\r\n", "f");
  ASSERT_TRUE(reader.next());
  EXPECT_THAT(reader.fields(','), ElementsAre("1", "", "x y", ""));
}

TEST(LineReader, Numbers) {
  LineReader reader("x\n", "f");
  ASSERT_TRUE(reader.next());
  EXPECT_EQ(reader.real("-1.5e3"), -1500);
  EXPECT_EQ(reader.real("+2"), 2);
  EXPECT_EQ(reader.real("1e-400"), 0) << "smaller than any double";
  for (const char* word : {"", "+", "+-1", "1.5x", "nan", "inf", "-inf", "1e400", "0x10", "1,5"})
    EXPECT_THAT(message_of([&] { reader.real(word); }), HasSubstr("f:1: ")) << word;
  EXPECT_EQ(reader.integer("1403715273262142976"), 1403715273262142976);
  for (const char* word : {"", "1.0", "99999999999999999999"})
    EXPECT_THAT(message_of([&] { reader.integer(word); }), HasSubstr("not a whole number")) << word;
}

TEST(Text, FilesThatCannotBe) {
  const TemporaryFolder folder;
  EXPECT_THAT(message_of([&] { read_text_file(folder.path() / "none"); }), HasSubstr("does not exist"));
  EXPECT_THAT(message_of([&] { read_text_file(folder.path()); }), HasSubstr("is a folder"));
  EXPECT_THROW(write_text_file(folder.path() / "none" / "file", "x"), OutputError);
  write_text_file(folder.path() / "file", "a\r\nb");
  EXPECT_EQ(read_text_file(folder.path() / "file"), "a\r\nb");
}

TEST(Text, TimesAreSecondsOrDates) {
  EXPECT_THAT(parse_times("0.5\n1.5\n", "t"), testing::ElementsAre(0.5, 1.5));
  const std::vector<double> dates =
      parse_times("1970-01-02 00:00:01.5\r\n2011-09-26 13:02:25.964389445\n2012-02-29 23:59:60\n", "t");
  ASSERT_EQ(dates.size(), 3u);
  EXPECT_DOUBLE_EQ(dates[0], 86401.5);
  EXPECT_NEAR(dates[1], 1317042145.964389, 1e-6);
  EXPECT_DOUBLE_EQ(dates[2], 1330560000);
  for (const char* wrong :
       {"2011-09-31 00:00:00", "2011-09-26 24:00:00", "2011-09-26 00:60:00", "2011-13-01 00:00:00",
        "2011-09-26 00:00:61", "2011-09-26 00:00", "26.9.2011 00:00:00", "2011-09-26 a:0:0", "1 2"})
    EXPECT_THROW(parse_times(wrong, "t"), InputError) << wrong;
}

TEST(Text, WordsInMessagesAreShortAndPrintable) {
  EXPECT_EQ(in_quotes("a\x01z\xff"), "'a?z?'");
  EXPECT_EQ(in_quotes(std::string(50, 'x')), "'" + std::string(40, 'x') + "...'");
}

TEST(Text, NumbersHaveAFixedFormat) {
  EXPECT_EQ(fixed_text(1403715273.25, 9), "1403715273.250000000");
  EXPECT_EQ(scientific_text(-0.5, 3), "-5.000e-01");
}

}  // namespace
}  // namespace spslam
