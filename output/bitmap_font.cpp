#include "dspm/output/bitmap_font.h"

#include <cstdint>

#include "dspm/base/colour/rgb.h"

namespace dspm {

namespace {

// Space to tilde: nine rows of five pixels each, the first row and the left pixel in the highest bits; the letters
// stand on the seventh row.
constexpr int kGlyphWidth = 5, kGlyphHeight = 9;
constexpr std::uint64_t kGlyphs[] = {
    0x000000000000, 0x042108401000, 0x0a5280000000, 0x0a57d5f52800, 0x047d1c5f1000, 0x19c88889cc00, 0x0c9499593400,
    0x042100000000, 0x022210820800, 0x082084222000, 0x00255d520000, 0x00213e420000, 0x000000021100, 0x00001c000000,
    0x000000001000, 0x010888884000, 0x0e8ceb98b800, 0x046108423800, 0x0e8844447c00, 0x0e884c18b800, 0x0232a5f10800,
    0x1f878218b800, 0x06443d18b800, 0x1f0888442000, 0x0e8c5d18b800, 0x0e8c5e113000, 0x000100001000, 0x000100021100,
    0x001110410000, 0x0007c1f00000, 0x004104440000, 0x0e8844401000, 0x0e8deb683800, 0x0e8c7f18c400, 0x1e8c7d18f800,
    0x0e8c2108b800, 0x1e8c6318f800, 0x1f843d087c00, 0x1f843d084000, 0x0e8c2f18bc00, 0x118c7f18c400, 0x0e2108423800,
    0x071084293000, 0x119531494400, 0x108421087c00, 0x11dd6b18c400, 0x11ce6b39c400, 0x0e8c6318b800, 0x1e8c7d084000,
    0x0e8c63593400, 0x1e8c7d494400, 0x0e8c1c18b800, 0x1f2108421000, 0x118c6318b800, 0x118c62a51000, 0x118c6b5dc400,
    0x118a88a8c400, 0x118a88421000, 0x1f0888887c00, 0x0e4210843800, 0x108208208400, 0x0e1084213800, 0x045440000000,
    0x0000000003e0, 0x082080000000, 0x000382f8bc00, 0x1087a318f800, 0x0003a308b800, 0x010be318bc00, 0x0003a3f83800,
    0x064a38842000, 0x0003e318bc2e, 0x1085b318c400, 0x040308423800, 0x020184210a4c, 0x1084a98a4800, 0x0c2108423800,
    0x0006ab5ad400, 0x0005b318c400, 0x0003a318b800, 0x0007a318fa10, 0x0003e318bc21, 0x0005b3084000, 0x0003e0e0f800,
    0x084710849800, 0x00046319b400, 0x000463151000, 0x00046b5aa800, 0x000454454400, 0x00046318bc2e, 0x0007c4447c00,
    0x022110420800, 0x042108421000, 0x082104422000, 0x00022a200000,
};

std::uint64_t glyph_of(char c) { return c >= ' ' && c <= '~' ? kGlyphs[c - ' '] : kGlyphs['?' - ' ']; }

}  // namespace

void draw_text(Image& image, int left, int top, std::string_view text, int scale, const Rgb& color) {
  for (const char c : text) {
    const std::uint64_t glyph = glyph_of(c);
    for (int y = 0; y < kGlyphHeight * scale; ++y) {
      for (int x = 0; x < kGlyphWidth * scale; ++x) {
        const int bit = kGlyphWidth * kGlyphHeight - 1 - (y / scale * kGlyphWidth + x / scale);
        const bool inside = left + x >= 0 && left + x < image.width && top + y >= 0 && top + y < image.height;
        if (inside && (glyph >> bit & 1) != 0) image.at(left + x, top + y) = color;
      }
    }
    left += kTextAdvance * scale;
  }
}

}  // namespace dspm
