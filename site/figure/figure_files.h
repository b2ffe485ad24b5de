// A figure as files.
#pragma once

#include "site/figure/figure.h"

#include <filesystem>

namespace shadowbench::site {

/// What LaTeX includes it by, beside a PDF: figure environment, caption and \label{fig:NAME}, where NAME is the file's.
std::string latexOf(const Figure& figure, const std::filesystem::path& file);

/// Throws BadInput unless the file's name ends as one that can be written: .pdf, .png or .svg.
void requireFigureFile(const std::filesystem::path& file);

/// Writes the file, and of a PDF the .tex beside it; returns what it has written. Throws Inconclusive when rsvg-convert is
/// missing or fails.
std::vector<std::filesystem::path> writeFigure(const Figure& figure, const std::filesystem::path& file);

} // namespace shadowbench::site
