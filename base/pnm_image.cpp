#include "base/error.h"
#include "base/image_formats.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace shadowbench::pnm {
namespace {

bool isBlank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// What is left of a file, from the front.
class Input {
public:
    explicit Input(std::string_view bytes) : left_(bytes) {}

    [[nodiscard]] std::string_view left() const { return left_; }

    char character() {
        if (left_.empty()) throw BadInput("it ends too early");
        const char c = left_.front();
        left_.remove_prefix(1);
        return c;
    }

    /// After blanks and comments.
    template <typename Number>
    Number number(const char* meaning) {
        skipBlanks();
        if (left_.empty()) throw BadInput("it ends too early");
        Number number{};
        const auto [end, failed] = std::from_chars(left_.data(), left_.data() + left_.size(), number);
        if (failed != std::errc()) throw BadInput(fmt::format("its {} is no number that is possible there", meaning));
        left_.remove_prefix(static_cast<std::size_t>(end - left_.data()));
        return number;
    }

    void skipBlanks() {
        while (!left_.empty() && (isBlank(left_.front()) || left_.front() == '#'))
            left_.remove_prefix(left_.front() == '#' ? std::min(left_.find('\n'), left_.size()) : 1);
    }

private:
    std::string_view left_;
};

struct File {
    char kind; // '1' to '6', 'F' or 'f'
    int width, height;
    unsigned most = 1; // that an integer is
    float scale = 1;   // of floats
    bool isLittleEndian = false;
    Input pixels;

    [[nodiscard]] bool isFloat() const { return kind == 'F' || kind == 'f'; }
    [[nodiscard]] bool isText() const { return kind >= '1' && kind <= '3'; }
    [[nodiscard]] std::size_t channels() const { return kind == '3' || kind == '6' || kind == 'F' ? 3 : 1; }
    [[nodiscard]] std::size_t rowValues() const { return static_cast<std::size_t>(width) * channels(); }
    [[nodiscard]] std::size_t valueBytes() const { return isFloat() ? 4 : most > 255 ? 2 : 1; }
    /// Of text: the least.
    [[nodiscard]] std::size_t rowBytes() const {
        return kind == '4' ? (static_cast<std::size_t>(width) + 7) / 8 : rowValues() * (isText() ? 1 : valueBytes());
    }
};

File opened(std::string_view bytes) {
    Input input(bytes.substr(1)); // after "P"
    const char kind = input.character();
    const int width = input.number<int>("width"), height = input.number<int>("height");
    if (width < 1 || height < 1) throw BadInput(fmt::format("it has {} × {} pixels", width, height));
    File file{.kind = kind, .width = width, .height = height, .pixels = input};
    if (file.isFloat()) {
        const auto scale = file.pixels.number<float>("scale");
        file.scale = std::abs(scale);
        file.isLittleEndian = scale < 0;
    } else if (kind != '1' && kind != '4') {
        file.most = file.pixels.number<unsigned>("maximum");
        if (file.most < 1 || file.most > 65535)
            throw BadInput(fmt::format("its maximum is {}; expected 1 to 65535", file.most));
    }
    if (!isBlank(file.pixels.character())) throw BadInput("its header is damaged: no blank ends it");
    return file;
}

/// An integer as a share of its maximum; where that is all of its bytes, with the last bits of the same integer in a PNG.
float shareOf(unsigned value, const File& file) {
    const double full = file.most > 255 ? 65535 : 255;
    return static_cast<float>(std::min(value, file.most) * full / file.most) * (1 / static_cast<float>(full));
}

Image<float> textChannel(File& file, std::size_t channel) {
    Image<float> image(file.width, file.height);
    for (float& pixel : image)
        for (std::size_t c = 0; c < file.channels(); ++c) {
            unsigned value = 0;
            if (file.kind == '1') { // digits need no blanks between them
                file.pixels.skipBlanks();
                const char digit = file.pixels.character();
                if (digit != '0' && digit != '1') throw BadInput("a pixel is neither 0 nor 1");
                value = digit == '0' ? 1 : 0; // 1 is black
            } else {
                value = file.pixels.number<unsigned>("pixel");
            }
            if (c == channel) pixel = shareOf(value, file);
        }
    return image;
}

float floatAt(const char* bytes, const File& file) {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < sizeof bits; ++i)
        bits = bits << 8U | static_cast<unsigned char>(bytes[file.isLittleEndian ? 3 - i : i]);
    return file.scale * std::bit_cast<float>(bits);
}

float valueAt(const char* row, std::size_t i, const File& file) {
    if (file.kind == '4') return (static_cast<unsigned char>(row[i / 8]) >> (7 - i % 8) & 1U) == 0 ? 1 : 0; // 1 is black
    const char* const bytes = row + i * file.valueBytes();
    if (file.isFloat()) return floatAt(bytes, file);
    const auto at = [&](int place) { return unsigned{static_cast<unsigned char>(bytes[place])}; };
    return shareOf(file.valueBytes() == 1 ? at(0) : at(0) << 8U | at(1), file);
}

} // namespace

ImageHeader headerOf(std::string_view bytes) {
    const File file = opened(bytes);
    return {.format = "pnm",
            .width = file.width,
            .height = file.height,
            .channels = file.channels() == 3 ? std::vector<std::string>{"R", "G", "B"} : std::vector<std::string>{"Y"},
            .bits = static_cast<int>(8 * file.valueBytes()),
            .floats = file.isFloat()};
}

Image<float> channelOf(std::string_view bytes, int channel) {
    File file = opened(bytes);
    const auto index = static_cast<std::size_t>(channel);
    const std::string_view data = file.pixels.left();
    if (data.size() / file.rowBytes() < static_cast<std::size_t>(file.height)) throw BadInput("it ends too early");
    if (file.isText()) return textChannel(file, index);
    Image<float> image(file.width, file.height);
    for (int y = 0; y < file.height; ++y) {
        const int fromTop = file.isFloat() ? file.height - 1 - y : y; // PFM begins with the row at the bottom
        const char* const row = data.data() + static_cast<std::size_t>(fromTop) * file.rowBytes();
        for (int x = 0; x < file.width; ++x)
            image(x, y) = valueAt(row, static_cast<std::size_t>(x) * file.channels() + index, file);
    }
    return image;
}

} // namespace shadowbench::pnm
