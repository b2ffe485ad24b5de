#include "site/figure/figure.h"

#include "base/error.h"
#include "base/image_io.h"
#include "base/words.h"
#include "report/summary.h"
#include "site/technique_facts.h"
#include "site/viewer/cell_data.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace shadowbench::site {
namespace {

namespace fs = std::filesystem;

const Record& rowOf(const std::vector<Record>& records, const std::string& scene, const std::string& variant) {
    std::vector<std::string> others;
    for (const Record& record : records) {
        if (record.scene != scene || record.sweep) continue;
        if (record.variant == variant) return record;
        others.push_back(record.variant);
    }
    const std::vector<std::string> scenes = report::scenes(records);
    if (others.empty())
        throw BadInput(fmt::format("the records hold no row of scene {}{}; theirs are: {}", scene, didYouMean(scene, scenes),
                                   fmt::join(scenes, ", ")));
    throw BadInput(
        fmt::format("the records hold no row {} of scene {}{}; theirs are: {}; leave --records out, and it is drawn",
                    variant, scene, didYouMean(variant, others), fmt::join(others, ", ")));
}

void requireShadow(const Record& record) {
    if (!wasScored(record.status))
        throw BadInput(fmt::format("{} on {} has no image ({}); leave it out", record.variant, record.scene, record.reason));
    if (isLevelOfDetail(record) || !headline(record))
        throw BadInput(fmt::format("{} draws levels of detail and no shadow; leave it out", record.variant));
}

/// The one truth that all rows' errors are about.
std::string commonTruth(const std::vector<const Record*>& rows, const fs::path& images) {
    const Record& first = *rows.front();
    const std::vector<std::string> names =
        isFolderName(first.scene) ? keptTruths(images, first.scene) : std::vector<std::string>();
    if (names.empty())
        throw BadInput(fmt::format("{} holds no images of scene {}; name the folder by --images, or leave --records out and "
                                   "the cells are drawn",
                                   images.string(), first.scene));
    const std::string truth = truthOf(first, names);
    for (const Record* row : rows)
        if (truthOf(*row, names) != truth || headline(*row)->metric != headline(first)->metric)
            throw BadInput(fmt::format("{} and {} are scored against different truths, which have no common figure; leave "
                                       "one of them out",
                                       first.variant, row->variant));
    return truth;
}

FigureColumn figureColumn(const Record& row, const fs::path& images, const KeptTruth& truth) {
    const fs::path file = cellFolder(images, row.scene, row.variant) / "visibility.exr";
    FigureColumn column{factsOf(row.technique).title, row.variant, report::errorText(row), false, readChannel(file, "V")};
    if (!column.visibility.sameSize(truth.visibility))
        throw BadInput(fmt::format("{} is no image of {} × {} pixels as the scene's truth is; run its cell again",
                                   file.string(), truth.visibility.width(), truth.visibility.height()));
    return column;
}

void markBest(const std::vector<const Record*>& rows, std::vector<FigureColumn>& columns) {
    if (rows.size() < 2) return;
    const auto errorOf = [](const Record* row) { return headline(*row)->value; };
    const double least = errorOf(*std::ranges::min_element(rows, {}, errorOf));
    for (std::size_t i = 0; i < rows.size(); ++i) columns[i].best = errorOf(rows[i]) == least;
}

/// The narrowest of the viewer's scales that nine wrong pixels of ten lie on.
int gainFor(const std::vector<FigureColumn>& columns, const KeptTruth& truth) {
    constexpr double leastError = 1.0 / 255, mostOff = 0.1;
    for (const int gain : {16, 4}) {
        std::size_t wrong = 0, off = 0;
        for (const FigureColumn& column : columns)
            for (std::size_t i = 0; i < column.visibility.size(); ++i) {
                if (truth.surface[i] != static_cast<float>(groundtruth::Surface::Receiver)) continue;
                const double error = std::abs(static_cast<double>(column.visibility[i]) - truth.visibility[i]);
                wrong += error > leastError;
                off += error > 1.0 / gain;
            }
        if (wrong > 0 && static_cast<double>(off) <= mostOff * static_cast<double>(wrong)) return gain;
    }
    return 1;
}

std::vector<Inset> insetsIn(const FigureRequest& request, const Figure& figure) {
    if (request.insets.empty()) {
        std::vector<Image<float>> images;
        for (const FigureColumn& column : figure.columns) images.push_back(column.visibility);
        return {mostTelling(images, figure.truth)};
    }
    if (request.insets.size() > mostInsets)
        throw BadInput(
            fmt::format("a figure has room for {} insets, not for {}; leave some out", mostInsets, request.insets.size()));
    const int width = figure.truth.surface.width(), height = figure.truth.surface.height();
    for (const Inset& inset : request.insets)
        if (inset.x < 0 || inset.y < 0 || inset.width > width - inset.x || inset.height > height - inset.y)
            throw BadInput(fmt::format("the inset {} does not lie within the image of {} × {} pixels; move or shrink it",
                                       textOf(inset), width, height));
    return request.insets;
}

PictureShading shadingOf(const std::string& scene, const fs::path& images, const KeptTruth& truth) {
    const fs::path file = shadingFile(images, scene);
    auto shading = readShading(file);
    if (!shading || !shading->direct.sameSize(truth.visibility))
        throw BadInput(fmt::format("{} is missing or of another size: the run was of an older program; run it again, or "
                                   "leave --shaded out",
                                   file.string()));
    return std::move(*shading);
}

} // namespace

Figure figureOf(const FigureRequest& request, const std::vector<Record>& records, const fs::path& images) {
    std::vector<const Record*> rows;
    for (const std::string& variant : request.variants) {
        rows.push_back(&rowOf(records, request.scene, variant));
        requireShadow(*rows.back());
    }
    const std::string truth = commonTruth(rows, images);
    Figure figure;
    figure.scene = request.scene;
    figure.metric = headline(*rows.front())->metric;
    figure.truthLabel = truthLabel(truth);
    figure.truth = readTruth(truthFile(images, request.scene, truth));
    for (const Record* row : rows) figure.columns.push_back(figureColumn(*row, images, figure.truth));
    if (request.shaded) figure.shading = shadingOf(request.scene, images, figure.truth);
    markBest(rows, figure.columns);
    figure.insets = insetsIn(request, figure);
    figure.gain = gainFor(figure.columns, figure.truth);
    return figure;
}

} // namespace shadowbench::site
