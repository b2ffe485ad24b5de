#include "harness/report/listing.h"

#include "scene/load/load.h"
#include "techniques/catalog.h"

#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace shadowbench {
namespace {

using Json = nlohmann::ordered_json;

std::string_view meaning(techniques::Answer answer) {
    switch (answer) {
    case techniques::Answer::Hard:
        return "hard shadows, any light";
    case techniques::Answer::Filtered:
        return "filtered hard shadows, any light";
    case techniques::Answer::Soft:
        return "soft shadows, area lights";
    case techniques::Answer::Colour:
        return "pictures of a walk past levels of detail";
    }
    return "";
}

Json techniquesAsJson() {
    Json all = Json::array();
    for (const techniques::Entry& entry : techniques::catalog()) {
        Json parameters = Json::array();
        for (const techniques::Parameter& p : entry.parameters)
            parameters.push_back({{"name", p.name},
                                  {"default", p.defaultValue},
                                  {"values", techniques::describe(p.domain)},
                                  {"meaning", p.meaning},
                                  {"source", p.source}});
        Json figures = Json::array();
        for (const techniques::Figure& figure : entry.figures)
            figures.push_back({{"name", figure.name}, {"meaning", figure.meaning}});
        all.push_back({{"id", entry.id},
                       {"title", entry.title},
                       {"source", fmt::format("{}, {}", techniques::title(entry.source.document), entry.source.where)},
                       {"answer", meaning(entry.answer)},
                       {"history", entry.temporal},
                       {"parameters", parameters},
                       {"figures", figures},
                       {"variants", entry.variants}});
    }
    return all;
}

Json scenesAsJson() {
    Json all = Json::array();
    for (const std::string& id : builtinScenes()) {
        const Scene scene = loadScene(id, Profile::Gate);
        all.push_back({{"id", id},
                       {"title", scene.title},
                       {"shows", scene.shows},
                       {"light", name(scene.light.kind)},
                       {"triangles", snapshot(scene, 0).triangles()},
                       {"frames", scene.timeline.frames()}});
    }
    return all;
}

struct Metric {
    const char* name;
    const char* unit;
    const char* meaning;
};

// In the order of the records.
constexpr std::array metrics{
    Metric{"mismatch", "share", "receiver pixels whose rounded visibility differs from the exact label"},
    Metric{"mismatch_off_edge", "share", "the same more than half a pixel away from an exact shadow edge"},
    Metric{"false_shadow", "share", "lit pixels called shadowed (acne, over-shadow)"},
    Metric{"leak", "share", "shadowed pixels called lit (peter-panning, light leak)"},
    Metric{"edge_error", "pixels",
           "distance from the technique's shadow edge to the exact one; signed: − too small, + too large"},
    Metric{"rmse", "1", "root mean square of V − V*"},
    Metric{"mae", "1", "mean of abs(V − V*)"},
    Metric{"psnr", "dB", "peak signal to noise"},
    Metric{"bad30", "share", "pixels with abs(V − V*) > 30/255 (EGSR 2007)"},
    Metric{"bad8", "share", "pixels with abs(V − V*) > 8/255"},
    Metric{"ssim", "1", "structural similarity, 11×11 Gaussian"},
    Metric{"penumbra_rmse", "1", "rmse over the penumbra dilated by 2 pixels"},
    Metric{"penumbra_width_error", "relative", "error of the penumbra's width along its edge normals"},
    Metric{"umbra_leak", "1", "mean visibility over the umbra eroded by 2 pixels"},
    Metric{"unresolved", "share", "pixels whose error is below three times the truth's own uncertainty"},
    Metric{"primary_mismatch", "share",
           "pixels where rasteriser and truth see different surfaces; above 0.1 % nothing is scored"},
    Metric{"aliasing", "pixels",
           "that one texel of the technique's map covers where it is stretched most: median and p95 over the receivers, and "
           "the share of them that lies in a map"},
    Metric{"figures", "see list techniques", "numbers of the scored frame that only the technique knows"},
    Metric{"flicker", "1", "change between moving frames beyond the truth's own, after exact reprojection"},
    Metric{"flip_rate", "share", "reprojected pixels that change class while the truth does not"},
    Metric{"moving_rmse", "1",
           "root mean square of V − V* over the moving frames: what flicker does not see, a steady trail"},
    Metric{"disocclusion_error", "1", "the same over the pixels in their first frame"},
    Metric{"reuse", "share", "surface pixels of the moving frames that the frame before saw, too"},
    Metric{"convergence", "frames",
           "still frames from an empty history until the error stays within 5 % of its steady state"},
    Metric{"pop", "1", "levels of detail: largest mean change of colour from frame to frame while levels alone change"},
    Metric{"changed_region", "pixels",
           "levels of detail: the same, largest connected region that changes by more than 30/255"},
    Metric{"walk_pop", "1", "levels of detail: largest mean change of colour along the walk beyond lod-full's"},
    Metric{"colour_error", "1", "levels of detail: rms difference from lod-full over the walk"},
    Metric{"noise", "1", "levels of detail: mean distance from the 3×3 median beyond lod-full's, over pixels in transition"},
    Metric{"order_error", "1",
           "levels of detail: rms difference from the same with all triangles drawn the other way round"},
    Metric{"primitive_change", "share", "levels of detail: largest change of the primitives drawn from frame to frame"},
    Metric{"time", "ms, ratio", "wall time of a frame over interleaved rounds, and its ratio to sm-uniform"},
    Metric{"work", "counts", "fragment invocations, vertices, primitives, draws, passes, bytes"},
};

Json metricsAsJson() {
    Json all = Json::array();
    for (const Metric& metric : metrics)
        all.push_back({{"id", metric.name}, {"unit", metric.unit}, {"meaning", metric.meaning}});
    return all;
}

/// A cell of a table: text as it is, parameters with their defaults, figures by name.
std::string asCell(const std::string& key, const Json& value) {
    if (value.is_string()) return value.get<std::string>();
    std::vector<std::string> words;
    if (key == "parameters")
        for (const Json& p : value)
            words.push_back(fmt::format("`{}={}`", p["name"].get<std::string>(), p["default"].get<std::string>()));
    else if (key == "figures")
        for (const Json& figure : value) words.push_back(fmt::format("`{}`", figure["name"].get<std::string>()));
    else
        return value.dump();
    return fmt::format("{}", fmt::join(words, " "));
}

/// A line of text or a table row: id first, then the rest.
std::string asText(const Json& entry) {
    std::string text = fmt::format("{}\n", entry["id"].get<std::string>());
    for (const auto& [key, value] : entry.items()) {
        if (key == "id" || key == "parameters" || key == "figures") continue;
        text += fmt::format("    {}: {}\n", key, value.is_string() ? value.get<std::string>() : value.dump());
    }
    if (!entry.contains("parameters")) return text;
    for (const Json& p : entry["parameters"])
        text +=
            fmt::format("    {:<10} {:<14} {}, default {}\n", p["name"].get<std::string>(), p["values"].get<std::string>(),
                        p["meaning"].get<std::string>(), p["default"].get<std::string>());
    for (const Json& figure : entry["figures"])
        text += fmt::format("    figures.{}: {}\n", figure["name"].get<std::string>(), figure["meaning"].get<std::string>());
    return text;
}

std::string asMarkdown(const Json& all) {
    std::string header = "|", rule = "|", rows;
    for (const auto& [key, value] : all.front().items()) {
        header += fmt::format(" {} |", key);
        rule += "---|";
    }
    for (const Json& entry : all) {
        rows += "|";
        for (const auto& [key, value] : entry.items()) rows += fmt::format(" {} |", asCell(key, value));
        rows += "\n";
    }
    return fmt::format("{}\n{}\n{}", header, rule, rows);
}

} // namespace

std::string catalogue(const std::string& what, const std::string& format) {
    const Json all = what == "scenes" ? scenesAsJson() : what == "metrics" ? metricsAsJson() : techniquesAsJson();
    if (format == "json") return all.dump(2) + "\n";
    if (format == "md") return asMarkdown(all);
    std::string text;
    for (const Json& entry : all) text += asText(entry);
    return text;
}

} // namespace shadowbench
