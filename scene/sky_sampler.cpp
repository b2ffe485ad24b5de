#include "scene/sky_sampler.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <utility>

namespace shadowbench {

class SkySampler::Part {
public:
    virtual ~Part() = default;
    [[nodiscard]] virtual SkyDirection at(const glm::dvec2& st) const = 0;
};

/// Lambert's cylindrical projection: height and longitude divide the sphere evenly.
class SkySampler::WholeSphere final : public Part {
public:
    explicit WholeSphere(double radiance) : irradiance_(4 * std::numbers::pi * radiance) {}

    [[nodiscard]] SkyDirection at(const glm::dvec2& st) const override {
        const double y = 1 - 2 * st.x, radius = std::sqrt(std::max(0.0, 1 - y * y));
        const double longitude = 2 * std::numbers::pi * st.y;
        return {{radius * std::sin(longitude), y, radius * std::cos(longitude)}, irradiance_};
    }

private:
    double irradiance_;
};

namespace {

/// Sums of what comes before each element, and of all at the end.
std::vector<double> cumulative(const std::vector<double>& values) {
    std::vector<double> sums(values.size() + 1);
    for (std::size_t i = 0; i < values.size(); ++i) sums[i + 1] = sums[i] + values[i];
    return sums;
}

struct Place {
    std::size_t index;
    double within; // share of the element that lies before, in [0, 1)
};

/// Where a share in [0, 1) of all lies; never in an element that is 0.
Place inverse(const std::vector<double>& sums, double share) {
    const double wanted = share * sums.back();
    const auto after = std::upper_bound(sums.begin(), sums.end(), wanted);
    auto index = static_cast<std::size_t>(after - sums.begin());
    index = std::clamp<std::size_t>(index, 1, sums.size() - 1) - 1;
    while (index > 0 && !(sums[index + 1] > sums[index])) --index; // rounding at the end of the last one that is not
    const double size = sums[index + 1] - sums[index];
    return {index, std::clamp((wanted - sums[index]) / size, 0.0, 1 - 0x1p-53)};
}

double sineOfTop(int row, int rows) { return std::sin(std::numbers::pi * (0.5 - static_cast<double>(row) / rows)); }

/// What directions are drawn by where the sky is a sum of harmonics: an image so fine that these hardly change within a
/// pixel, and never so dark that a direction would be too rare for what it brings.
ImageSky densityOf(const HarmonicSky& sky) {
    constexpr int kRows = 128;
    constexpr double kLeast = 0.01; // of the brightest
    ImageSky density{Image<float>(2 * kRows, kRows)};
    float most = 0;
    for (int y = 0; y < kRows; ++y)
        for (int x = 0; x < 2 * kRows; ++x) {
            density.radiance(x, y) = static_cast<float>(radiance(sky, density.direction({x + 0.5, y + 0.5})));
            most = std::max(most, density.radiance(x, y));
        }
    for (float& value : density.radiance) value = std::max(value, static_cast<float>(kLeast) * most);
    return density;
}

} // namespace

/// The inverse of the distribution function of an equirectangular image: first that of its rows, then that of a row's
/// pixels.
class SkySampler::Rows final : public Part {
public:
    /// `sky` is what is drawn, `density` what it is drawn by.
    Rows(Sky sky, ImageSky density) : sky_(std::move(sky)), density_(std::move(density)) {
        const int width = density_.radiance.width(), height = density_.radiance.height();
        std::vector<double> rows, row(static_cast<std::size_t>(width));
        for (int y = 0; y < height; ++y) {
            const double solidAngle =
                2 * std::numbers::pi / width * (sineOfTop(y, height) - sineOfTop(y + 1, height)); // of a pixel
            for (int x = 0; x < width; ++x)
                row[static_cast<std::size_t>(x)] = solidAngle * static_cast<double>(density_.radiance(x, y));
            columns_.push_back(cumulative(row));
            rows.push_back(columns_.back().back());
        }
        rows_ = cumulative(rows);
    }

    [[nodiscard]] SkyDirection at(const glm::dvec2& st) const override {
        const int width = density_.radiance.width(), height = density_.radiance.height();
        const Place row = inverse(rows_, st.x), column = inverse(columns_[row.index], st.y);
        const int x = static_cast<int>(column.index), y = static_cast<int>(row.index);
        const double top = sineOfTop(y, height), bottom = sineOfTop(y + 1, height);
        const double sine = top + row.within * (bottom - top), radius = std::sqrt(std::max(0.0, 1 - sine * sine));
        const double longitude = std::numbers::pi * (1 - 2 * (x + column.within) / width);
        const glm::dvec3 towards(radius * std::sin(longitude), sine, radius * std::cos(longitude));
        return {towards, brightness(towards, x, y) * rows_.back() / static_cast<double>(density_.radiance(x, y))};
    }

private:
    /// Of an image the pixel's own, whatever rounding makes of the direction.
    [[nodiscard]] double brightness(const glm::dvec3& towards, int x, int y) const {
        if (const auto* image = std::get_if<ImageSky>(&sky_)) return static_cast<double>(image->radiance(x, y));
        return radiance(sky_, towards);
    }

    Sky sky_;
    ImageSky density_;
    std::vector<double> rows_;
    std::vector<std::vector<double>> columns_; // of each row
};

/// Equal areas of a cap: the height above its rim and the angle about its axis divide it evenly.
class SkySampler::Disk final : public Part {
public:
    explicit Disk(const Sun& sun) : axis_(sun.direction), irradiance_(sun.radiance * sun.solidAngle()) {
        const double half = std::sin(0.25 * glm::radians(sun.diameter));
        height_ = 2 * half * half;
        const glm::dvec3 off = std::abs(axis_.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
        u_ = glm::normalize(glm::cross(off, axis_));
        v_ = glm::cross(axis_, u_);
    }

    [[nodiscard]] SkyDirection at(const glm::dvec2& st) const override {
        const double drop = st.x * height_,
                     radius = std::sqrt(drop * (2 - drop)); // 1 − cos and sin of the angle to the axis
        const double angle = 2 * std::numbers::pi * st.y;
        return {(1 - drop) * axis_ + radius * (std::cos(angle) * u_ + std::sin(angle) * v_), irradiance_};
    }

private:
    glm::dvec3 axis_, u_, v_;
    double irradiance_, height_;
};

SkySampler::SkySampler(const EnvironmentLight& light) {
    if (const auto* constant = std::get_if<ConstantSky>(&light.sky)) {
        if (constant->radiance > 0) parts_.push_back(std::make_unique<const WholeSphere>(constant->radiance));
    } else if (const auto* smooth = std::get_if<HarmonicSky>(&light.sky)) {
        parts_.push_back(std::make_unique<const Rows>(*smooth, densityOf(*smooth)));
    } else {
        const auto& image = std::get<ImageSky>(light.sky);
        const bool black = std::all_of(image.radiance.begin(), image.radiance.end(), [](float l) { return l == 0; });
        if (!black) parts_.push_back(std::make_unique<const Rows>(image, image));
    }
    hasSky_ = !parts_.empty();
    for (const Sun& sun : light.suns) parts_.push_back(std::make_unique<const Disk>(sun));
}

SkySampler::~SkySampler() = default;

std::size_t SkySampler::parts() const { return parts_.size(); }

bool SkySampler::isSun(std::size_t part) const { return part > 0 || !hasSky_; }

SkyDirection SkySampler::at(std::size_t part, const glm::dvec2& st) const { return parts_[part]->at(st); }

} // namespace shadowbench
