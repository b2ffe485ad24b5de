#include "base/error.h"
#include "base/image_formats.h"

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstring>
#include <fmt/format.h>
#include <new>
#include <png.h>
#include <type_traits>

namespace shadowbench::png {
namespace {

/// What libpng needs to read or to write a file. It leaves its functions by longjmp when something is wrong.
class Library {
public:
    enum class Does { Read, Write };

    explicit Library(Does does) : does_(does) {
        png_ = does == Does::Read ? png_create_read_struct(PNG_LIBPNG_VER_STRING, this, leave, ignore)
                                  : png_create_write_struct(PNG_LIBPNG_VER_STRING, this, leave, ignore);
        info_ = png_ == nullptr ? nullptr : png_create_info_struct(png_);
        if (info_ != nullptr) return;
        destroy();
        throw std::bad_alloc();
    }
    ~Library() { destroy(); }
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;

    [[nodiscard]] png_structp png() const { return png_; }
    [[nodiscard]] png_infop info() const { return info_; }

    /// Calls `step`; throws BadInput with libpng's reason. All that may fail is called so, and a step makes nothing that a
    /// jump out of it would have to destroy.
    template <typename Step>
    void run(Step step) {
        static_assert(std::is_trivially_destructible_v<Step>);
        if (setjmp(png_jmpbuf(png_)) != 0) throw BadInput(reason_.data());
        step();
    }

private:
    [[noreturn]] static void leave(png_structp png, png_const_charp reason) {
        std::array<char, 160>& kept = static_cast<Library*>(png_get_error_ptr(png))->reason_;
        std::strncpy(kept.data(), reason, kept.size() - 1);
        png_longjmp(png, 1);
    }
    static void ignore(png_structp /*png*/, png_const_charp /*warning*/) {}

    void destroy() {
        if (does_ == Does::Read)
            png_destroy_read_struct(&png_, &info_, nullptr);
        else
            png_destroy_write_struct(&png_, &info_);
    }

    Does does_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
    std::array<char, 160> reason_{};
};

/// A file whose header is read.
class Reader {
public:
    explicit Reader(std::string_view bytes) : left_(bytes) {
        library_.run([this] {
            const png_structp png = library_.png();
            png_set_read_fn(png, &left_, take);
            // What describes the picture is left out, and with it libpng's code for that. Where it lies on a page is read.
            png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
            png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_AS_DEFAULT, reinterpret_cast<png_const_bytep>("oFFs"), 1);
            png_read_info(png, library_.info());
            png_set_expand(png);
            passes_ = png_set_interlace_handling(png);
            png_read_update_info(png, library_.info());
        });
    }

    [[nodiscard]] ImageHeader header() const {
        static const std::array<std::vector<std::string>, 4> names{
            {{"Y"}, {"Y", "A"}, {"R", "G", "B"}, {"R", "G", "B", "A"}}};
        const png_structp png = library_.png();
        const png_infop info = library_.info();
        const int channels = png_get_channels(png, info);
        return {.format = "png",
                .width = static_cast<int>(png_get_image_width(png, info)),
                .height = static_cast<int>(png_get_image_height(png, info)),
                .channels = names.at(static_cast<std::size_t>(channels) - 1),
                .alpha = channels % 2 == 0 ? channels - 1 : -1,
                .bits = png_get_bit_depth(png, info),
                .floats = false,
                .whole = png_get_x_offset_pixels(png, info) == 0 && png_get_y_offset_pixels(png, info) == 0};
    }

    Image<float> channel(int index) {
        const ImageHeader shape = header();
        Image<float> image(shape.width, shape.height);
        const std::size_t rowBytes = png_get_rowbytes(library_.png(), library_.info());
        const std::size_t bytes = static_cast<std::size_t>(shape.bits) / 8, step = bytes * shape.channels.size();
        // Values are multiplied by this, and not divided: earlier scores keep their last bits.
        const float scale = 1.0F / (bytes == 1 ? 255.0F : 65535.0F);
        // Interlaced pixels come in passes over all rows, others row by row.
        std::vector<png_byte> rows(rowBytes * (passes_ == 1 ? 1 : static_cast<std::size_t>(shape.height)));
        for (int pass = 1; pass <= passes_; ++pass) {
            for (int y = 0; y < shape.height; ++y) {
                png_byte* const row = rows.data() + (passes_ == 1 ? 0 : rowBytes * static_cast<std::size_t>(y));
                library_.run([this, row] { png_read_row(library_.png(), row, nullptr); });
                if (pass < passes_) continue;
                const png_byte* from = row + bytes * static_cast<std::size_t>(index);
                for (int x = 0; x < shape.width; ++x, from += step)
                    image(x, y) = scale * static_cast<float>(bytes == 1 ? from[0] : 256 * from[0] + from[1]);
            }
        }
        library_.run([this] { png_read_end(library_.png(), nullptr); }); // so that what is cut off there is refused, too
        return image;
    }

private:
    static void take(png_structp png, png_bytep to, std::size_t count) {
        auto& left = *static_cast<std::string_view*>(png_get_io_ptr(png));
        if (count > left.size()) png_error(png, "it ends too early");
        std::memcpy(to, left.data(), count);
        left.remove_prefix(count);
    }

    std::string_view left_;
    int passes_ = 1;
    Library library_{Library::Does::Read};
};

void append(png_structp png, png_bytep from, std::size_t count) {
    bool fits = true;
    try {
        static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(from), count);
    } catch (const std::bad_alloc&) { // must not pass through libpng
        fits = false;
    }
    if (!fits) png_error(png, "there is not enough memory");
}

} // namespace

ImageHeader headerOf(std::string_view bytes) { return Reader(bytes).header(); }

Image<float> channelOf(std::string_view bytes, int channel) { return Reader(bytes).channel(channel); }

std::string encoded(int width, int height, int channels, const std::vector<std::uint8_t>& pixels) {
    std::string bytes;
    Library library(Library::Does::Write);
    library.run([&] {
        const png_structp png = library.png();
        png_set_write_fn(png, &bytes, append, nullptr);
        const int colours = channels == 1   ? PNG_COLOR_TYPE_GRAY
                            : channels == 3 ? PNG_COLOR_TYPE_RGB
                                            : PNG_COLOR_TYPE_RGB_ALPHA;
        png_set_IHDR(png, library.info(), static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), 8, colours,
                     PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
        png_write_info(png, library.info());
        const std::size_t rowBytes = static_cast<std::size_t>(width) * static_cast<std::size_t>(channels);
        for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) png_write_row(png, pixels.data() + y * rowBytes);
        png_write_end(png, nullptr);
    });
    return bytes;
}

} // namespace shadowbench::png
