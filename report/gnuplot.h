// Charts by gnuplot: running it, and the pieces of a script that all charts share.
#pragma once

#include <string>
#include <vector>

namespace shadowbench::report {

/// The SVG that gnuplot draws for `script` (which sets no terminal or output) on a canvas of width × height pixels. The same
/// script gives the same bytes. Throws Inconclusive when gnuplot is missing or fails.
std::string svgOf(const std::string& script, int width, int height);

/// Text as a gnuplot string, without any meaning to it; control characters become spaces.
std::string literal(const std::string& text);

/// Okabe and Ito's palette, distinct for colour-blind readers too; repeats after seven.
std::string colour(std::size_t i);
inline constexpr const char* blue = "#0072B2";
inline constexpr const char* vermilion = "#D55E00";
inline constexpr const char* grey = "#767676";

/// How curve `i` is drawn: its colour, and a new dash once the colours are used up.
std::string lineStyle(std::size_t i);

/// A chart's title at its upper left, on a canvas `height` pixels high.
std::string heading(const std::string& title, int height);

/// The margins of a plot on a canvas `height` pixels high: `left` and `right` as shares of the canvas' width, `top` and
/// `bottom` in pixels below its upper edge.
std::string plotArea(double left, double right, double top, double bottom, double height);

/// The names of all curves with their line styles, two a row, below a plot that ends `top` pixels below the canvas' upper
/// edge.
struct Legend {
    const std::vector<std::string>& names;
    int top;

    [[nodiscard]] int bottom() const; // height of the whole canvas, pixels
    [[nodiscard]] std::string script() const;
};

/// A logarithmic axis over values ≥ 0. Zero has no logarithm: it is drawn on a floor, labelled "0", below the smallest other
/// value.
class LogAxis {
public:
    /// Covers `values`; finite, ≥ 0. `zero`: they may contain 0 and the axis then has a floor.
    explicit LogAxis(const std::vector<double>& values);

    [[nodiscard]] double low() const { return low_; }
    [[nodiscard]] double high() const { return high_; }

    /// The value as drawn: itself, or the floor for 0.
    [[nodiscard]] double drawn(double value) const;

    /// Share of the axis' length at which a value lies.
    [[nodiscard]] double position(double value) const;

    /// gnuplot's `set` commands for axis "x" or "y": scale, range and tick labels with `unit` behind the number, values
    /// times `factor`.
    [[nodiscard]] std::string script(const std::string& axis, double factor, const std::string& unit) const;

private:
    bool hasZero_ = false;
    double floor_ = 0, low_ = 0, high_ = 0;
};

} // namespace shadowbench::report
