// A figure as a drawing.
#pragma once

#include "site/figure/figure.h"

#include <string>
#include <vector>

namespace shadowbench::site {

/// In SVG's user units, from the upper left corner.
struct Place {
    double x = 0, y = 0, width = 0, height = 0;
};

/// Where things lie: a column for the truth and one for each technique, from the left. The rows are title, picture, insets,
/// error picture (of the truth its scale), error.
class FigureLayout {
public:
    explicit FigureLayout(const Figure& figure);

    static constexpr double columnWidth = 256;

    [[nodiscard]] double width() const;
    [[nodiscard]] double height() const;
    [[nodiscard]] Place picture(std::size_t column) const;
    [[nodiscard]] Place inset(std::size_t column, std::size_t i) const; // of the figure's insets
    [[nodiscard]] Place box(std::size_t column, std::size_t i) const;   // in the picture: the part that is enlarged
    [[nodiscard]] Place error(std::size_t column) const;
    [[nodiscard]] double titleBase() const;  // of its first line
    [[nodiscard]] double figureBase() const; // of the line below the error pictures
    [[nodiscard]] double left(std::size_t column) const;

    /// Of a PNG, at which a pixel of the image is a whole number of the file's: two at least of small images.
    [[nodiscard]] double pixelsPerUnit() const;

private:
    const Figure& figure_;
    std::size_t titleLines_ = 1, variantLines_ = 1;
    double insetHeight_ = 0; // of the highest
};

/// Lines of at most `letters` characters, broken at spaces and behind commas, else anywhere; of more than `most` lines the
/// last ends with "…".
std::vector<std::string> wrapped(const std::string& text, std::size_t letters, std::size_t most);

/// The same figure gives the same bytes.
std::string svgOf(const Figure& figure);

} // namespace shadowbench::site
