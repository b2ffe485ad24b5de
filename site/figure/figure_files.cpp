#include "site/figure/figure_files.h"

#include "base/error.h"
#include "base/files.h"
#include "report/slug.h"
#include "report/summary.h"
#include "site/charts.h"
#include "site/figure/figure_svg.h"
#include "site/table.h"

#include <fmt/format.h>

namespace shadowbench::site {
namespace {

/// "PCF (\texttt{pcf}) errs by \textbf{0.54 \%}"
std::string latexColumn(const FigureColumn& column) {
    const std::string error = latexText(column.error);
    return fmt::format("{} (\\texttt{{{}}}, {})", latexText(column.title), latexText(column.variant),
                       column.best ? "\\textbf{" + error + "}" : error);
}

} // namespace

std::string latexOf(const Figure& figure, const std::filesystem::path& file) {
    std::string columns;
    for (const FigureColumn& column : figure.columns) columns += ", " + latexColumn(column);
    return fmt::format(
        "\\begin{{figure}}\n  \\centering\n  \\includegraphics[width=\\linewidth]{{{}}}\n"
        "  \\caption{{{} on \\texttt{{{}}}, from left to right: the truth ({}){}. In parentheses {}. Coloured boxes are "
        "enlarged below. Last row: technique less truth, orange false shadow, blue leak, full colour at $\\pm{}$, grey what "
        "is not scored.}}\n"
        "  \\label{{fig:{}}}\n\\end{{figure}}\n",
        file.filename().string(), figure.shading ? "Shadows" : "Visibility", latexText(figure.scene),
        latexText(figure.truthLabel), columns, report::meaning(figure.metric),
        figure.gain == 1 ? "1" : fmt::format("1/{}", figure.gain), report::slug(file.stem().string()));
}

void requireFigureFile(const std::filesystem::path& file) {
    const std::string ending = file.extension().string();
    if (ending != ".pdf" && ending != ".png" && ending != ".svg")
        throw BadInput(fmt::format("{} names no kind of figure; let --out end with .pdf, .png or .svg", file.string()));
}

std::vector<std::filesystem::path> writeFigure(const Figure& figure, const std::filesystem::path& file) {
    requireFigureFile(file);
    const std::string svg = svgOf(figure);
    if (file.extension() == ".svg") {
        writeFile(file, svg);
        return {file};
    }
    if (file.extension() == ".png") {
        writeFile(file, pngOf(svg, FigureLayout(figure).pixelsPerUnit()));
        return {file};
    }
    std::filesystem::path latex = file;
    latex.replace_extension(".tex");
    writeFile(file, pdfOf(svg));
    writeFile(latex, latexOf(figure, file));
    return {file, latex};
}

} // namespace shadowbench::site
