#include "site/figure/figure_svg.h"

#include "base/base64.h"
#include "base/files.h"
#include "base/image_io.h"
#include "base/temporary_folder.h"
#include "report/summary.h"
#include "site/viewer/cell_data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace shadowbench::site {
namespace {

constexpr double margin = 4, gap = 8, titleSize = 15, smallSize = 11, figureSize = 14, lineHeight = 1.25;
constexpr std::size_t titleLetters = 32, variantLetters = 42, mostLines = 2; // what a column's width has room for
constexpr std::array<const char*, mostInsets> insetColours{"#00A878", "#E83E8C", "#F0E442"}; // none is one of errors

std::size_t linesOf(const Figure& figure, bool titles) {
    std::size_t most = 1;
    for (const FigureColumn& column : figure.columns)
        most = std::max(
            most, wrapped(titles ? column.title : column.variant, titles ? titleLetters : variantLetters, mostLines).size());
    return most;
}

std::string escaped(const std::string& text) {
    std::string result;
    for (const char letter : text) {
        const bool control = static_cast<unsigned char>(letter) < 0x20;
        if (letter == '&')
            result += "&amp;";
        else if (letter == '<')
            result += "&lt;";
        else
            result += control ? ' ' : letter;
    }
    return result;
}

std::string textAt(double x, double y, double size, const std::string& text, const std::string& attributes = "") {
    return fmt::format("<text x=\"{:g}\" y=\"{:g}\" font-size=\"{:g}\"{}>{}</text>\n", x, y, size, attributes,
                       escaped(text));
}

constexpr const char* grey = " fill=\"#555555\"";
constexpr const char* bold = " font-weight=\"bold\"";

std::string imageAt(const Place& place, const Image<glm::vec3>& picture) {
    const TemporaryFolder folder;
    writePng(folder.path() / "picture.png", picture);
    return fmt::format("<image x=\"{:g}\" y=\"{:g}\" width=\"{:g}\" height=\"{:g}\" preserveAspectRatio=\"none\" "
                       "image-rendering=\"optimizeSpeed\" style=\"image-rendering:pixelated\" "
                       "xlink:href=\"data:image/png;base64,{}\"/>\n",
                       place.x, place.y, place.width, place.height, base64(readFile(folder.path() / "picture.png")));
}

std::string frameAround(const Place& place, const char* colour, double thickness) {
    return fmt::format("<rect x=\"{:g}\" y=\"{:g}\" width=\"{:g}\" height=\"{:g}\" fill=\"none\" stroke=\"{}\" "
                       "stroke-width=\"{:g}\"/>\n",
                       place.x, place.y, place.width, place.height, colour, thickness);
}

Image<glm::vec3> pictureOf(const Figure& figure, const Image<float>& v) {
    return figure.shading ? shadedPicture(*figure.shading, v) : visibilityPicture(v, figure.truth);
}

/// Unlike in the viewer, what is not scored has no colour: on paper it would be taken for an error.
Image<glm::vec3> errorsOf(const Figure& figure, const Image<float>& v) {
    Image<glm::vec3> picture = differencePicture(v, figure.truth, figure.gain);
    for (std::size_t i = 0; i < picture.size(); ++i)
        if (figure.truth.surface[i] != static_cast<float>(groundtruth::Surface::Receiver)) picture[i] = glm::vec3(0.42F);
    return picture;
}

/// One line below the other, from `y` on.
std::string lines(double x, double y, double size, const std::vector<std::string>& texts, const char* attributes) {
    std::string svg;
    for (std::size_t i = 0; i < texts.size(); ++i)
        svg += textAt(x, y + static_cast<double>(i) * size * lineHeight, size, texts[i], attributes);
    return svg;
}

std::string bound(int gain) { return gain == 1 ? "1" : fmt::format("1/{}", gain); }

/// The scale of the error pictures, in the truth's place among them.
std::string scale(const Figure& figure, const Place& place) {
    const double middle = place.y + 0.5 * place.height, inner = place.x + 0.5 * gap, width = place.width - gap;
    std::string svg = textAt(inner, middle - 2 * smallSize, smallSize, "technique − truth", grey);
    svg += fmt::format("<rect x=\"{:g}\" y=\"{:g}\" width=\"{:g}\" height=\"12\" fill=\"url(#scale)\"/>\n", inner,
                       middle - 1.4 * smallSize, width);
    const double below = middle + smallSize;
    svg += textAt(inner, below, smallSize, fmt::format("−{} false shadow", bound(figure.gain)), grey);
    svg += textAt(inner, below + 2 * smallSize, smallSize, "grey: not scored", grey);
    svg += textAt(inner + width, below, smallSize, fmt::format("leak +{}", bound(figure.gain)),
                  std::string(grey) + " text-anchor=\"end\"");
    return svg;
}

/// Picture with boxes, and the insets below it.
std::string columnPictures(const Figure& figure, const FigureLayout& layout, std::size_t column, const Image<float>& v) {
    const Image<glm::vec3> picture = pictureOf(figure, v);
    std::string svg = imageAt(layout.picture(column), picture);
    for (std::size_t i = 0; i < figure.insets.size(); ++i) {
        const Inset& inset = figure.insets[i];
        const int times = std::max(1, static_cast<int>(FigureLayout::columnWidth) / inset.width); // some readers blur
        svg += frameAround(layout.box(column, i), "#FFFFFF", 4) + frameAround(layout.box(column, i), insetColours[i], 2);
        svg += imageAt(layout.inset(column, i), enlarged(picture, inset, times));
        svg += frameAround(layout.inset(column, i), insetColours[i], 3);
    }
    return svg;
}

std::string truthColumn(const Figure& figure, const FigureLayout& layout) {
    std::string svg = textAt(layout.left(0), layout.titleBase(), titleSize, "Truth");
    svg += textAt(layout.left(0), layout.titleBase() + titleSize * lineHeight, smallSize, figure.truthLabel, grey);
    svg += columnPictures(figure, layout, 0, figure.truth.visibility);
    svg += scale(figure, layout.error(0));
    return svg + textAt(layout.left(0), layout.figureBase(), figureSize, report::meaning(figure.metric), grey);
}

std::string techniqueColumn(const Figure& figure, const FigureLayout& layout, std::size_t i) {
    const FigureColumn& column = figure.columns[i];
    const std::size_t place = i + 1;
    const double x = layout.left(place);
    const std::vector<std::string> title = wrapped(column.title, titleLetters, mostLines);
    std::string svg = lines(x, layout.titleBase(), titleSize, title, "");
    svg += lines(x, layout.titleBase() + static_cast<double>(title.size()) * titleSize * lineHeight, smallSize,
                 wrapped(column.variant, variantLetters, mostLines), grey);
    svg += columnPictures(figure, layout, place, column.visibility);
    svg += imageAt(layout.error(place), errorsOf(figure, column.visibility));
    return svg + textAt(x, layout.figureBase(), figureSize, column.error, column.best ? bold : "");
}

} // namespace

FigureLayout::FigureLayout(const Figure& figure)
    : figure_(figure), titleLines_(linesOf(figure, true)), variantLines_(linesOf(figure, false)) {
    for (std::size_t i = 0; i < figure.insets.size(); ++i) insetHeight_ = std::max(insetHeight_, inset(0, i).height);
}

double FigureLayout::left(std::size_t column) const { return margin + static_cast<double>(column) * (columnWidth + gap); }
double FigureLayout::width() const { return left(figure_.columns.size()) + columnWidth + margin; }
double FigureLayout::height() const { return figureBase() + 0.4 * figureSize + margin; }
double FigureLayout::titleBase() const { return margin + titleSize; }

Place FigureLayout::picture(std::size_t column) const {
    const double titles = static_cast<double>(titleLines_) * titleSize + static_cast<double>(variantLines_) * smallSize;
    return {left(column), margin + titles * lineHeight + gap, columnWidth,
            columnWidth * figure_.truth.surface.height() / figure_.truth.surface.width()};
}

Place FigureLayout::inset(std::size_t column, std::size_t i) const {
    const Place above = picture(column);
    const auto count = static_cast<double>(figure_.insets.size());
    const double wide = (columnWidth - (count - 1) * gap) / count;
    const Inset& part = figure_.insets[i];
    return {above.x + static_cast<double>(i) * (wide + gap), above.y + above.height + gap, wide,
            wide * part.height / part.width};
}

Place FigureLayout::box(std::size_t column, std::size_t i) const {
    const Place whole = picture(column);
    const double scale = columnWidth / figure_.truth.surface.width();
    const Inset& part = figure_.insets[i];
    return {whole.x + part.x * scale, whole.y + part.y * scale, part.width * scale, part.height * scale};
}

Place FigureLayout::error(std::size_t column) const {
    const Place above = picture(column);
    return {above.x, above.y + above.height + gap + insetHeight_ + gap, above.width, above.height};
}

double FigureLayout::figureBase() const {
    const Place above = error(0);
    return above.y + above.height + lineHeight * figureSize;
}

double FigureLayout::pixelsPerUnit() const {
    constexpr double enough = 2 * columnWidth; // pixels of a file that a column is to have
    const int width = figure_.truth.surface.width();
    return width * std::ceil(std::max(1.0, enough / width)) / columnWidth;
}

std::vector<std::string> wrapped(const std::string& text, std::size_t letters, std::size_t most) {
    std::vector<std::string> result(1);
    std::size_t count = 0, breakAt = 0, counted = 0; // of the last line; a break there, and how many lie before it
    for (const char letter : text) {
        const bool begins = (static_cast<unsigned char>(letter) & 0xC0U) != 0x80U;
        if (begins && count == letters) {
            std::string rest = breakAt > 0 ? result.back().substr(breakAt) : "";
            count = breakAt > 0 ? count - counted : 0;
            if (breakAt > 0) result.back().resize(breakAt);
            if (result.size() == most) {
                result.back() += "…";
                return result;
            }
            result.push_back(std::move(rest));
            breakAt = counted = 0;
        }
        result.back() += letter;
        count += begins;
        if (letter == ' ' || letter == ',') {
            breakAt = result.back().size();
            counted = count;
        }
    }
    return result;
}

std::string svgOf(const Figure& figure) {
    const FigureLayout layout(figure);
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" width=\"{0:g}\" "
        "height=\"{1:g}\" viewBox=\"0 0 {0:g} {1:g}\" font-family=\"Liberation Sans,Arial,Helvetica,sans-serif\">\n"
        "<defs><linearGradient id=\"scale\"><stop offset=\"0\" stop-color=\"#FF9628\"/><stop offset=\"0.5\" "
        "stop-color=\"#181818\"/><stop offset=\"1\" stop-color=\"#50AAFF\"/></linearGradient></defs>\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"#FFFFFF\"/>\n",
        layout.width(), layout.height());
    svg += truthColumn(figure, layout);
    for (std::size_t i = 0; i < figure.columns.size(); ++i) svg += techniqueColumn(figure, layout, i);
    return svg + "</svg>\n";
}

} // namespace shadowbench::site
