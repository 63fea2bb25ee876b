// Tokens and numbers. Numbers are compared with the C library's.
#include "dspm/lang/lexer.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

namespace dspm {
namespace {

struct Text {
  explicit Text(std::string content) : file{"text", std::move(content)}, source(file), lexer(source) {}

  SourceFile file;
  SourceText source;
  Lexer lexer;
};

template <class Number>
std::vector<Number> numbers(const std::string& list) {
  Text text(list + "]");
  std::vector<Number> values;
  text.lexer.numbers_to_bracket(values);
  return values;
}

template <class Number>
std::string failure(const std::string& list) {
  try {
    numbers<Number>(list);
  } catch (const SyntaxError& error) {
    return error.what();
  }
  return "none";
}

TEST(Lexer, TellsTokensApart) {
  Text text("Shape \"a b\" [1 -.5e3] # comment \r\ntrue");
  const Token::Kind kinds[] = {Token::Kind::word,    Token::Kind::string, Token::Kind::open,
                               Token::Kind::number,  Token::Kind::number, Token::Kind::close,
                               Token::Kind::comment, Token::Kind::word,   Token::Kind::end};
  const std::string_view texts[] = {"Shape", "\"a b\"", "[", "1", "-.5e3", "]", "# comment", "true", ""};
  for (std::size_t i = 0; i < std::size(kinds); ++i) {
    const Token token = text.lexer.next_or_comment();
    EXPECT_EQ(token.kind, kinds[i]) << i;
    EXPECT_EQ(token.text, texts[i]) << i;
  }
}

TEST(Lexer, CountsLinesAndColumnsFromOne) {
  Text text("ab\n\n  cd\r\n ef");
  text.lexer.next();
  const SourceLocation cd = text.lexer.locate(text.lexer.next().text), ef = text.lexer.locate(text.lexer.next().text);
  EXPECT_EQ(cd.line, 3);
  EXPECT_EQ(cd.column, 3);
  EXPECT_EQ(cd.length, 2);
  EXPECT_EQ(ef.line, 4);
  EXPECT_EQ(ef.column, 2);
}

TEST(Lexer, ResolvesEscapes) {
  Text text(R"("a\"b\\c\n\t")");
  EXPECT_EQ(text.lexer.unquoted(text.lexer.next()), "a\"b\\c\n\t");
}

TEST(Lexer, ReadsNumbers) {
  EXPECT_EQ(numbers<float>("1 +2 -3 .5 5. 1e3 1E-2#c\n7\t8"),
            (std::vector<float>{1, 2, -3, .5f, 5, 1e3f, 1e-2f, 7, 8}));
  EXPECT_EQ(numbers<int>("0 -7 +12 2147483647 -2147483648"),
            (std::vector<int>{0, -7, 12, 2147483647, -2147483647 - 1}));
}

TEST(Lexer, ReadsListsOfAnyLength) {
  for (const int count : {0, 1, 63, 64, 65, 128, 1000}) {
    std::string list;
    std::vector<int> expected;
    for (int i = 0; i < count; ++i) expected.push_back(i * i), list += std::to_string(i * i) + " ";
    EXPECT_EQ(numbers<int>(list), expected);
  }
}

TEST(Lexer, TakesTinyNumbersForZero) {
  EXPECT_EQ(numbers<float>("1e-60 -1e-400 1e-45"), (std::vector<float>{0, 0, 1e-45f}));
}

TEST(Lexer, RefusesWhatIsNoNumber) {
  EXPECT_EQ(failure<float>("nan"), "numbers must be finite");
  EXPECT_EQ(failure<float>("1 -inf"), "numbers must be finite");
  EXPECT_EQ(failure<float>("1e39"), "this number is too large");
  EXPECT_EQ(failure<float>("1e999"), "this number is too large");
  EXPECT_EQ(failure<float>("1.2.3"), "expected a number");
  EXPECT_EQ(failure<float>("0x10"), "expected a number");
  EXPECT_EQ(failure<float>("-"), "expected a number");
  EXPECT_EQ(failure<float>("+-1"), "expected a number");
  EXPECT_EQ(failure<int>("1.5"), "expected an integer");
  EXPECT_EQ(failure<int>("3000000000"), "this integer does not fit into 32 bits");
  EXPECT_EQ(failure<int>("abc"), "expected an integer");
}

TEST(Lexer, ReadsFloatsAsTheCLibraryDoes) {
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> mantissa(-10, 10);
  std::uniform_int_distribution<int> exponent(-44, 37), digits(1, 17);
  std::string list;
  std::vector<float> expected;
  for (int i = 0; i < 20000; ++i) {
    char word[64];
    std::snprintf(word, sizeof word, "%.*fe%d", digits(rng), mantissa(rng), exponent(rng));
    expected.push_back(std::strtof(word, nullptr));
    list += std::string(word) + (i % 7 == 0 ? "\n" : " ");
  }
  EXPECT_EQ(numbers<float>(list), expected);
}

TEST(Lexer, FindsTheNextDirectiveAfterAMistake) {
  Text text("junk [ 1 2 \"Not This\" ] \"nor this\nor This } Shape");
  text.lexer.next();
  text.lexer.skip_to_directive();
  EXPECT_EQ(text.lexer.next().text, "This");  // the first word of a line whose string was not closed on the line before
  text.lexer.skip_to_directive();
  EXPECT_EQ(text.lexer.next().text, "Shape");
}

}  // namespace
}  // namespace dspm
