// The project's own image type: the one pixel container that crosses folder borders.
#pragma once

#include <cassert>
#include <cstddef>
#include <vector>

namespace shadowbench {

/// width × height pixels, row 0 at the top, pixel (x, y) has its centre at (x + ½, y + ½).
template <typename T>
class Image {
public:
    Image() = default;
    Image(int width, int height, T fill = T{})
        : width_(width), height_(height), pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), fill) {
    }

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    [[nodiscard]] std::size_t size() const { return pixels_.size(); }
    [[nodiscard]] bool empty() const { return pixels_.empty(); }
    [[nodiscard]] bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }

    T& operator()(int x, int y) { return pixels_[index(x, y)]; }
    const T& operator()(int x, int y) const { return pixels_[index(x, y)]; }
    T& operator[](std::size_t i) { return pixels_[i]; }
    const T& operator[](std::size_t i) const { return pixels_[i]; }

    T* data() { return pixels_.data(); }
    const T* data() const { return pixels_.data(); }
    auto begin() { return pixels_.begin(); }
    auto end() { return pixels_.end(); }
    auto begin() const { return pixels_.begin(); }
    auto end() const { return pixels_.end(); }

    template <typename U>
    [[nodiscard]] bool sameSize(const Image<U>& other) const {
        return width_ == other.width() && height_ == other.height();
    }
    friend bool operator==(const Image&, const Image&) = default;

private:
    [[nodiscard]] std::size_t index(int x, int y) const {
        assert(contains(x, y));
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    }

    int width_ = 0;
    int height_ = 0;
    std::vector<T> pixels_;
};

} // namespace shadowbench
