#include "picture.hpp"

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>
#define STBTT_STATIC
#define STB_TRUETYPE_IMPLEMENTATION
#include <fmt/format.h>
#include <stb/stb_truetype.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace penumbra::pictures {
namespace {

constexpr Rgb white{255, 255, 255}, ink{34, 36, 40}, soft_ink{98, 102, 110}, not_asked{196, 198, 202};

std::uint8_t byte(float x) { return static_cast<std::uint8_t>(saturate(x) * 255.0F + 0.5F); }

std::uint8_t encode(float linear) {
    const float x = saturate(linear);
    return byte(x <= 0.0031308F ? 12.92F * x : 1.055F * std::pow(x, 1.0F / 2.4F) - 0.055F);
}

Rgb blend(const Rgb& a, const Rgb& b, float t) {
    Rgb result;
    for (int c = 0; c < 3; ++c) result[c] = byte(mix(static_cast<float>(a[c]), static_cast<float>(b[c]), t) / 255.0F);
    return result;
}

/// The font of text in pictures; without it (Debian package fonts-dejavu-core) there are pictures without
/// text.
class Font {
  public:
    static const Font& get() {
        static const Font font;
        return font;
    }

    float width(const std::string& text, float size) const {
        float x = 0.0F;
        each_glyph(text, size, [&](int, float advance) { x += advance; });
        return x;
    }

    /// Writes from `x` to the right on the baseline `y`; `size` is the height of the line in pixels.
    void draw(Image<Rgb>& picture, float x, float y, float size, const std::string& text, const Rgb& color) const {
        each_glyph(text, size, [&](int glyph, float advance) {
            const float scale = stbtt_ScaleForPixelHeight(&info_, size), whole = std::floor(x);
            int width = 0, height = 0, left = 0, top = 0;
            unsigned char* cover = stbtt_GetGlyphBitmapSubpixel(&info_, scale, scale, x - whole, 0.0F, glyph, &width,
                                                                &height, &left, &top);
            for (int j = 0; j < height; ++j) {
                for (int i = 0; i < width; ++i) {
                    const int px = static_cast<int>(whole) + left + i, py = static_cast<int>(y) + top + j;
                    if (px < 0 || py < 0 || px >= picture.width() || py >= picture.height()) continue;
                    const float alpha = static_cast<float>(cover[j * width + i]) / 255.0F;
                    picture(px, py) = blend(picture(px, py), color, alpha);
                }
            }
            stbtt_FreeBitmap(cover, nullptr);
            x += advance;
        });
    }

  private:
    Font() {
        for (const char* name :
             {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", "/usr/share/fonts/TTF/DejaVuSans.ttf",
              "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf"}) {
            std::ifstream file(name, std::ios::binary);
            data_.assign(std::istreambuf_iterator<char>(file), {});
            if (data_.empty()) continue;
            const auto* bytes = reinterpret_cast<const unsigned char*>(data_.data());
            usable_ = stbtt_InitFont(&info_, bytes, stbtt_GetFontOffsetForIndex(bytes, 0)) != 0;
            if (usable_) return;
        }
        fmt::print(stderr, "DejaVuSans.ttf not found: pictures will have no text (package fonts-dejavu-core)\n");
    }

    /// Calls use(glyph, advance) for each character of UTF-8 text.
    template <class Use>
    void each_glyph(const std::string& text, float size, Use&& use) const {
        if (!usable_) return;
        const float scale = stbtt_ScaleForPixelHeight(&info_, size);
        for (std::size_t i = 0; i < text.size();) {
            const unsigned lead = static_cast<unsigned char>(text[i++]);
            unsigned point = lead < 0x80U ? lead : lead < 0xE0U ? lead & 0x1FU : lead < 0xF0U ? lead & 0xFU : lead & 7U;
            while (i < text.size() && (static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80U)
                point = point << 6U | (static_cast<unsigned char>(text[i++]) & 0x3FU);
            const int glyph = stbtt_FindGlyphIndex(&info_, static_cast<int>(point));
            int advance = 0, bearing = 0;
            stbtt_GetGlyphHMetrics(&info_, glyph, &advance, &bearing);
            use(glyph, static_cast<float>(advance) * scale);
        }
    }

    std::vector<char> data_;
    stbtt_fontinfo info_{};
    bool usable_ = false;
};

void fill(Image<Rgb>& picture, int x0, int y0, int x1, int y1, const Rgb& color) {
    for (int y = std::max(y0, 0); y < std::min(y1, picture.height()); ++y)
        for (int x = std::max(x0, 0); x < std::min(x1, picture.width()); ++x) picture(x, y) = color;
}

void paste(Image<Rgb>& onto, const Image<Rgb>& picture, int x0, int y0) {
    for (int y = 0; y < picture.height(); ++y) std::copy_n(picture.row(y), picture.width(), onto.row(y + y0) + x0);
}

/// A colour bar from −scale to +scale with five numbers below it, in the strip of the picture from row `top`
/// on.
void draw_legend(Image<Rgb>& picture, int top, float scale, float text) {
    const Font& font = Font::get();
    const std::string dark = "too dark", bright = "too bright";
    const int pad = static_cast<int>(text), thick = std::max(6, static_cast<int>(text * 0.8F));
    const int words = static_cast<int>(std::max(font.width(dark, text), font.width(bright, text))) + 2 * pad;
    const int x0 = words, x1 = picture.width() - words;
    if (x1 - x0 < 8) return;
    const int y0 = top + pad / 2, y1 = y0 + thick;
    for (int x = x0; x < x1; ++x) {
        const float at = (static_cast<float>(x - x0) + 0.5F) / static_cast<float>(x1 - x0);
        fill(picture, x, y0, x + 1, y1, difference_color((2.0F * at - 1.0F) * scale, scale));
    }
    const float baseline = static_cast<float>(y1) - 0.1F * text;
    font.draw(picture, static_cast<float>(x0 - pad / 2) - font.width(dark, text), baseline, text, dark, soft_ink);
    font.draw(picture, static_cast<float>(x1 + pad / 2), baseline, text, bright, soft_ink);
    // every second number goes where they would run into each other
    const float widest = font.width("+0.1250", text);
    const int step = static_cast<float>(x1 - x0) < 4.0F * widest ? 2 : 1;
    for (int tick = -2; tick <= 2; tick += step) {
        const int x = x0 + (x1 - x0 - 1) * (tick + 2) / 4;
        fill(picture, x, y1, x + 1, y1 + 4, soft_ink);
        const float value = scale * static_cast<float>(tick) / 2.0F;
        const std::string number = tick == 0 ? "0" : fmt::format("{}{:.3g}", tick < 0 ? "−" : "+", std::abs(value));
        font.draw(picture, static_cast<float>(x) - 0.5F * font.width(number, text),
                  static_cast<float>(y1) + 4.0F + text * 0.95F, text, number, ink);
    }
}

}  // namespace

Rgb encode(const Vec3<float>& linear) { return Rgb(encode(linear.x), encode(linear.y), encode(linear.z)); }

Image<Rgb> visibility_picture(const Image<float>& visibility) {
    Image<Rgb> picture(visibility.width(), visibility.height());
    for (std::size_t i = 0; i < visibility.size(); ++i) picture.data()[i] = Rgb(encode(visibility.data()[i]));
    return picture;
}

Image<Rgb> shaded_picture(const Image<float>& visibility, const Image<float>& cosine, const Image<Vec3<float>>& base,
                          float ambient) {
    Image<Rgb> picture(visibility.width(), visibility.height());
    for (std::size_t i = 0; i < visibility.size(); ++i) {
        const float direct = saturate(visibility.data()[i]) * saturate(cosine.data()[i]);
        const float light = cosine.data()[i] < 0.0F ? 1.0F : ambient + (1.0F - ambient) * direct;
        picture.data()[i] = encode(base.data()[i] * light);
    }
    return picture;
}

Rgb difference_color(float error, float scale) {
    static constexpr std::array<Rgb, 11> map = {{{0, 18, 97},
                                                 {3, 62, 125},
                                                 {30, 111, 157},
                                                 {113, 168, 196},
                                                 {201, 221, 231},
                                                 {252, 251, 250},
                                                 {234, 206, 189},
                                                 {211, 151, 116},
                                                 {190, 101, 51},
                                                 {139, 39, 6},
                                                 {89, 0, 8}}};
    const float at = scale > 0.0F ? saturate(0.5F + 0.5F * error / scale) * 10.0F : 5.0F;
    const auto i = std::min(static_cast<std::size_t>(at), std::size_t{9});
    return blend(map[i], map[i + 1], at - static_cast<float>(i));
}

Image<Rgb> difference_picture(const Image<float>& method, const Image<float>& truth, float scale) {
    const float text = std::max(11.0F, static_cast<float>(method.width()) / 40.0F);
    const int strip = static_cast<int>(text * 3.2F);
    Image<Rgb> picture(method.width(), method.height() + strip, white);
    for (std::size_t i = 0; i < method.size(); ++i) {
        const float m = method.data()[i], t = truth.data()[i];
        picture.data()[i] = m < 0.0F || t < 0.0F ? not_asked : difference_color(m - t, scale);
    }
    draw_legend(picture, method.height(), scale, text);
    return picture;
}

Image<Rgb> side_by_side(const std::vector<Panel>& panels) {
    int width = 0, height = 0;
    std::ptrdiff_t lines = 0;
    for (const Panel& panel : panels) {
        width += panel.picture.width();
        height = std::max(height, panel.picture.height());
        lines = std::max(lines, 1 + std::count(panel.title.begin(), panel.title.end(), '\n'));
    }
    if (width == 0) return {};
    const int count = static_cast<int>(panels.size());
    const float text = std::max(13.0F, static_cast<float>(width / count) / 30.0F);
    const int gap = static_cast<int>(text * 0.75F), head = static_cast<int>(text * 1.35F * static_cast<float>(lines));
    Image<Rgb> picture(width + gap * (count - 1), head + height, white);
    int x = 0;
    for (const Panel& panel : panels) {
        float size = text, y = text;
        std::size_t first = 0;
        for (std::size_t end = 0; end != std::string::npos; first = end + 1) {
            end = panel.title.find('\n', first);
            Font::get().draw(picture, static_cast<float>(x), y, size, panel.title.substr(first, end - first),
                             first == 0 ? ink : soft_ink);
            size = text * 0.85F, y += text * 1.25F;
        }
        paste(picture, panel.picture, x, head);
        x += panel.picture.width() + gap;
    }
    return picture;
}

void write_png(const std::filesystem::path& file, const Image<Rgb>& picture) {
    static_assert(sizeof(Rgb) == 3);
    if (picture.empty() || stbi_write_png(file.string().c_str(), picture.width(), picture.height(), 3, picture.data(),
                                          picture.width() * 3) == 0)
        throw std::runtime_error(fmt::format("cannot write picture '{}'", file.string()));
}

}  // namespace penumbra::pictures
