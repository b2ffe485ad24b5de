// A figure for papers and lectures: the truth and several techniques on a scene, side by side, with their errors.
#pragma once

#include "harness/cells/kept_images.h"
#include "harness/records/record.h"
#include "site/figure/insets.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench::site {

/// What is asked for.
struct FigureRequest {
    std::string scene;                 // as records name it
    std::vector<std::string> variants; // as records name them, in the figure's order
    std::vector<Inset> insets = {};    // none: one is chosen (mostTelling)
    bool shaded = false;               // pictures of the scene in place of visibility
};

struct FigureColumn {
    std::string title;   // of the technique
    std::string variant; // as records name it
    std::string error;   // with its unit: "2.31 %"
    bool best = false;   // no other errs less; with one technique none is
    Image<float> visibility;
};

struct Figure {
    std::string scene;
    std::string metric; // what `error` is: "mismatch"
    std::string truthLabel;
    KeptTruth truth;
    std::optional<PictureShading> shading; // of a shaded figure
    std::vector<FigureColumn> columns;
    std::vector<Inset> insets;
    int gain = 1; // full colour of errors is at ±1/gain: 1, 4 or 16
};

inline constexpr std::size_t mostInsets = 3; // side by side below a picture, and told apart by colour

/// From the records of a run and the images that it has kept. Throws BadInput, naming it and the remedy: no such row, one
/// that was not scored or draws no shadow, rows against different truths or of different sizes, an image that is missing, an
/// inset outside of the image.
Figure figureOf(const FigureRequest& request, const std::vector<Record>& records, const std::filesystem::path& images);

} // namespace shadowbench::site
