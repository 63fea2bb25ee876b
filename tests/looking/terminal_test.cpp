// Terminals' images, read back by decoders of the test's own.
#include "dspm/looking/terminal.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <map>
#include <thread>

#include "dspm/base/colour/rgb.h"
#include "dspm/image/encoding.h"
#include "dspm/image/png.h"
#include "dspm/looking/preview.h"

namespace dspm {
namespace terminal_test {

Image stripes(int width, int height) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) image.at(x, y) = x % 2 == 0 ? Rgb(1, 0, 0) : Rgb(0, 1, y < 7 ? 1 : 0);
  return image;
}

TEST(Terminal, AnswersTellWhatItKnows) {
  EXPECT_EQ(graphics_of_answer("\x1b_Gi=31;OK\x1b\\\x1b[?62;c"), Graphics::kitty);
  EXPECT_EQ(graphics_of_answer("\x1b[?62;4;22c"), Graphics::sixel);
  EXPECT_EQ(graphics_of_answer("\x1b[?62;4c"), Graphics::sixel);
  EXPECT_EQ(graphics_of_answer("\x1b[?4;6c"), Graphics::none) << "a VT132, which has no sixels";
  EXPECT_EQ(graphics_of_answer("\x1b[?64;1;41;14c"), Graphics::none);
  EXPECT_EQ(graphics_of_answer("\x1b_Gi=31;EINVAL:no\x1b\\\x1b[?6c"), Graphics::none);
  EXPECT_EQ(graphics_of_answer(""), Graphics::none);
}

TEST(Terminal, TmuxAndScreenAreNotAskedForKittysImages) {
  EXPECT_EQ(graphics_query("tmux-256color"), "\x1b[c");
  EXPECT_EQ(graphics_query("screen.xterm-256color"), "\x1b[c");
  for (const char* term : {"xterm-kitty", "rxvt-unicode", ""}) {
    EXPECT_TRUE(graphics_query(term).starts_with("\x1b_G")) << term;
    EXPECT_TRUE(graphics_query(term).ends_with("\r\x1b[K\x1b[c")) << "what a terminal prints of it is erased";
  }
}

TEST(Terminal, SixelTerminalsTellTheLargestImage) {
  const TerminalGraphics xterm = sixels_of_answer("\x1b[?2;0;1000;800S\x1b[?63;4;22c");
  EXPECT_EQ(xterm.kind, Graphics::sixel);
  EXPECT_EQ(xterm.max_width, 1000);
  EXPECT_EQ(xterm.max_height, 800);
  const int any = TerminalGraphics().max_width;
  for (const char* answer : {"\x1b[?2;3S\x1b[?63;4c", "\x1b[?2;3;0S\x1b[?62;4c", "\x1b[?62;4c", "", "\x1b[?2;0;0;0S"})
    EXPECT_EQ(sixels_of_answer(answer).max_width, any) << answer + 1;
}

TEST(Terminal, ADescriptorThatIsNoneAnswersNothing) {
  const int null = open("/dev/null", O_RDWR);
  EXPECT_EQ(ask_for_graphics(null, "xterm").kind, Graphics::none);
  EXPECT_EQ(size_of_terminal(null).columns, 80);
  close(null);
}

/// The payloads of kitty's commands, joined.
std::string kitty_payload(const std::string& text, std::vector<std::string>& heads) {
  std::string data;
  for (std::size_t at = 0; (at = text.find("\x1b_G", at)) != text.npos;) {
    const std::size_t semicolon = text.find(';', at), end = text.find("\x1b\\", at);
    heads.push_back(text.substr(at + 3, semicolon - at - 3));
    EXPECT_LE(end - semicolon - 1, 4096u);
    data += text.substr(semicolon + 1, end - semicolon - 1);
    at = end;
  }
  return data;
}

std::string decoded_base64(const std::string& text) {
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0, count = 0;
  for (const char letter : text) {
    if (letter == '=') break;
    bits = bits << 6 | static_cast<unsigned>(letters.find(letter));
    count += 6;
    if (count >= 8) bytes.push_back(static_cast<char>(bits >> (count -= 8) & 255));
  }
  return bytes;
}

TEST(Terminal, KittyGetsThePng) {
  Image noise(70, 50);  // more than one command's payload
  for (std::size_t i = 0; i < noise.pixels.size(); ++i)
    noise.pixels[i] = Rgb(static_cast<float>(i * 7919 % 251) / 251, static_cast<float>(i * 104729 % 241) / 241, 0.5f);
  std::vector<std::string> heads;
  const std::string bytes = decoded_base64(kitty_payload(kitty_image(noise), heads));
  EXPECT_EQ(bytes, png_bytes(noise));
  ASSERT_GT(heads.size(), 1u);
  EXPECT_NE(heads.front().find("a=T,f=100"), std::string::npos);
  EXPECT_EQ(heads.front().find("r="), std::string::npos) << "kitty would stretch it over whole cells";
  EXPECT_TRUE(heads.front().ends_with("m=1"));
  EXPECT_EQ(heads.back(), "m=0");
}

/// The pixels that a sixel terminal paints, as numbers of its palette's percentages.
std::map<std::pair<int, int>, std::string> painted(const std::string& text) {
  std::map<std::pair<int, int>, std::string> pixels;
  std::map<int, std::string> palette;
  int x = 0, top = 0, colour = 0;
  for (std::size_t i = text.find('q') + 1; i < text.size() && text[i] != '\x1b';) {
    const char kind = text[i];
    const auto until = [&](const char* set) {
      const std::size_t end = text.find_first_not_of(set, i + 1);
      const std::string part = text.substr(i + 1, end - i - 1);
      i = end;
      return part;
    };
    if (kind == '"') {
      until("0123456789;");
    } else if (kind == '#') {
      const std::string part = until("0123456789;");
      colour = std::stoi(part);
      if (const std::size_t at = part.find(";2;"); at != part.npos) palette[colour] = part.substr(at + 3);
    } else if (kind == '$') {
      x = 0, ++i;
    } else if (kind == '-') {
      x = 0, top += 6, ++i;
    } else {
      const int count = kind == '!' ? std::stoi(until("0123456789")) : 1;
      const int bits = text[i++] - 63;
      for (int k = 0; k < count; ++k, ++x)
        for (int b = 0; b < 6; ++b)
          if ((bits >> b & 1) != 0) pixels[{x, top + b}] = palette.at(colour);
    }
  }
  return pixels;
}

TEST(Terminal, SixelsPaintEveryPixel) {
  const auto pixels = painted(sixel_image(stripes(20, 15)));
  EXPECT_EQ(pixels.size(), 300u);
  EXPECT_EQ(pixels.at({0, 0}), "100;0;0");
  EXPECT_EQ(pixels.at({19, 6}), "0;100;100");
  EXPECT_EQ(pixels.at({19, 14}), "0;100;0");
}

TEST(Terminal, SixelsDitherToTheMean) {
  Image grey(40, 40);
  for (Rgb& pixel : grey.pixels) pixel = Rgb(srgb_to_linear(0.47f));
  double sum = 0;
  for (const auto& [place, colour] : painted(sixel_image(grey))) sum += std::stoi(colour);
  EXPECT_NEAR(sum / 1600, 47, 1);
}

/// A terminal that answers as a sixel terminal does.
TEST(Terminal, IsAskedAndAnswers) {
  const int master = posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_EQ(grantpt(master) + unlockpt(master), 0);
  const winsize window{30, 100, 1000, 600};
  ioctl(master, TIOCSWINSZ, &window);
  const int terminal = open(ptsname(master), O_RDWR | O_NOCTTY);
  EXPECT_EQ(size_of_terminal(terminal).cell_width, 10);
  EXPECT_EQ(size_of_terminal(terminal).cell_height, 20);
  EXPECT_EQ(ask_for_graphics(terminal, "xterm").kind, Graphics::none)
      << "it is not the terminal of this process: a job of another one";
  close(terminal);
  close(master);
}

/// The rows that a text goes up, down and feeds.
int rows_of(const std::string& text, char letter) {
  const std::size_t end = text.rfind(letter);
  return std::stoi(text.substr(text.rfind('[', end) + 1));
}

TEST(Preview, IsNoLargerThanTheTerminalTakes) {
  Preview preview({Graphics::sixel, 50, 40}, {.columns = 40, .rows = 24, .cell_width = 10, .cell_height = 20});
  EXPECT_NE(preview.show(stripes(100, 40)).find("\"1;1;50;20#"), std::string::npos);
  EXPECT_NE(preview.show(stripes(50, 80)).find("\"1;1;25;40#"), std::string::npos);
}

TEST(Preview, StaysInItsPlaceWhileLinesFollow) {
  Preview preview({Graphics::kitty}, {.columns = 40, .rows = 24, .cell_width = 10, .cell_height = 20});
  EXPECT_EQ(preview.width(), 400);
  EXPECT_EQ(preview.height(), 16 * 20);
  const Image image = stripes(100, 95);  // five rows
  const std::string first = preview.show(image);
  EXPECT_TRUE(
      first.starts_with("\n\n\n\n\n\r\x1b[5A\x1b"
                        "7"))
      << "makes room";
  EXPECT_EQ(rows_of(first, 'B'), 5);
  preview.text_follows("a line of forty letters, in f\u00fcnf W\u00f6rtern\n");
  preview.text_follows(std::string(50, 'x') + "\n");  // wraps
  preview.text_follows("\r[====]");
  const std::string second = preview.show(image);
  EXPECT_TRUE(second.starts_with("\r\x1b[8A")) << "five rows and three lines up, where it was";
  preview.fit_into({.columns = 50, .rows = 24, .cell_width = 10, .cell_height = 20});
  EXPECT_TRUE(preview.show(image).starts_with("\n\n\n\n\n\r\x1b[5A")) << "the window has changed: again below";
  for (int i = 0; i < 20; ++i) preview.text_follows("line\n");
  EXPECT_TRUE(preview.show(image).starts_with("\n\n\n\n\n\r\x1b[5A")) << "it has left the screen: again below";
}

}  // namespace terminal_test
}  // namespace dspm
