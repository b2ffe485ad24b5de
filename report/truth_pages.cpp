// The truth report's Markdown, and what lies beside it.
#include "base/files.h"
#include "base/image_io.h"
#include "report/summary.h"
#include "report/truth_figures.h"

#include <fmt/format.h>
#include <functional>
#include <set>

namespace shadowbench::report {
namespace {

namespace fs = std::filesystem;
using groundtruth::Agreement;

/// A Markdown image or link target: scene ids may hold spaces.
std::string target(const std::string& file) { return "<" + file + ">"; }

std::string shareOf(std::size_t pixels, std::size_t all) {
    return all == 0 ? "–" : percent(static_cast<double>(pixels) / static_cast<double>(all));
}

std::string secondsText(double seconds) { return fmt::format("{:.2g} s", seconds); }

std::string toolsText(const groundtruth::Provenance& provenance) {
    std::string text;
    for (const auto& [tool, version] : provenance.tools)
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", tool, version);
    return text;
}

/// The pictures of one reference, written beside the page, side by side with what they mean.
std::string pictures(const TruthOfScene& scene, const ShownReference& shown, const fs::path& folder) {
    const TruthNumbers numbers = truthNumbers(shown.reference);
    struct Picture {
        std::string name, meaning;
        Image<glm::vec3> image;
    };
    const char* what =
        shown.truth == "pixel-area" ? "C\\*, the mean over the pixel: white = fully lit" : "visibility: white = fully lit";
    std::vector<Picture> all{{"visibility", what, visibilityPicture(shown.reference)}};
    if (numbers.sigmaLargest > 0)
        all.push_back({"sigma", fmt::format("σ\\*: black = 0, white = {:.2g}", numbers.sigmaLargest),
                       sigmaPicture(shown.reference, numbers.sigmaLargest)});
    if (shown.truth == "hard")
        all.push_back({"edge-distance",
                       fmt::format("distance to the nearest shadow edge: black = 0, white = {:g} px or more", farthestEdge),
                       edgeDistancePicture(shown.reference)});
    std::string head = "|", rule = "|", images = "|";
    for (const Picture& picture : all) {
        const std::string file = fmt::format("{}-{}-{}.png", scene.scene, shown.truth, picture.name);
        writePng(folder / file, picture.image);
        head += fmt::format(" {} |", picture.meaning);
        rule += ":---:|";
        images += fmt::format(" ![{} {}]({}) |", shown.truth, picture.name, target(file));
    }
    return fmt::format("{}\n{}\n{}\n\n{}\n\n", head, rule, images, surfaceLegend);
}

/// One row a fact, one column a reference.
std::string factsTable(const TruthOfScene& scene) {
    std::string text = "| |", rule = "|:---|";
    for (const ShownReference& shown : scene.references) {
        text += fmt::format(" {} |", shown.truth);
        rule += ":---|";
    }
    text += "\n" + rule + "\n";
    const auto row = [&](const std::string& fact, const std::function<std::string(const ShownReference&)>& value) {
        text += fmt::format("| {} |", fact);
        for (const ShownReference& shown : scene.references) text += fmt::format(" {} |", markdownText(value(shown)));
        text += "\n";
    };
    const auto numbers = [](const ShownReference& shown) { return truthNumbers(shown.reference); };
    const auto source = [](const ShownReference& shown) -> const groundtruth::Provenance& {
        return shown.reference.provenance;
    };
    row("oracle", [&](const auto& s) { return source(s).oracle; });
    row("light samples", [&](const auto& s) { return source(s).samples > 0 ? fmt::format("{}", source(s).samples) : "–"; });
    row("receiver pixels", [&](const auto& s) { return fmt::format("{}", numbers(s).receivers); });
    row("of them fully shadowed", [&](const auto& s) { return shareOf(numbers(s).shadowed, numbers(s).receivers); });
    row("of them partly lit", [&](const auto& s) { return shareOf(numbers(s).penumbra, numbers(s).receivers); });
    row("of them within ½ px of an edge",
        [&](const auto& s) { return s.truth == "hard" ? shareOf(numbers(s).edgePixels, numbers(s).receivers) : "–"; });
    row("pixels exactly on an edge", [&](const auto& s) { return fmt::format("{}", numbers(s).onEdge); });
    row("σ* where not 0: median, largest", [&](const auto& s) {
        const TruthNumbers n = numbers(s);
        return n.sigmaLargest > 0 ? fmt::format("{:.2g}, {:.2g}", n.sigmaMedian, n.sigmaLargest) : "0 everywhere";
    });
    std::set<std::string> measured;
    for (const ShownReference& shown : scene.references)
        for (const auto& [name, value] : source(shown).measured) measured.insert(name);
    for (const std::string& name : measured)
        row("measured: " + markdownText(name), [&](const auto& s) {
            const auto found = source(s).measured.find(name);
            return found == source(s).measured.end() ? std::string("–") : fmt::format("{:.4g}", found->second);
        });
    row("computed in", [&](const auto& s) { return secondsText(source(s).seconds); });
    row("tools", [&](const auto& s) { return toolsText(source(s)); });
    row("key", [&](const auto& s) { return source(s).key; });
    return text + "\n";
}

std::string agreementTable(const std::vector<Agreement>& agreements) {
    if (agreements.empty()) return "No two oracles apply.\n\n";
    std::string text = "| oracles | compared on | pixels | differing | on an edge for both | for one only | seconds |\n"
                       "|:---|:---|---:|---:|---:|---:|---:|\n";
    for (const Agreement& agreement : agreements)
        text += fmt::format("| {}, {} | {} | {} | {} | {} | {} | {:.2g}, {:.2g} |\n", agreement.a, agreement.b,
                            agreement.pixelsCompared, agreement.pixels, agreement.differing, agreement.onEdge,
                            agreement.onOneEdge, agreement.secondsA, agreement.secondsB);
    return text + "\n";
}

/// The scene's page; returns the chart beside it.
fs::path writeScenePage(const TruthOfScene& scene, const fs::path& folder) {
    const Image<float>& image = scene.references.front().reference.visibility;
    const std::string chart = scene.scene + "-histograms.svg";
    std::string page = fmt::format("# The truth of {}\n\n{}: {}\n\nFrame {} of the {} profile, {} × {} pixels. Back to "
                                   "[all scenes](report.md).\n\n",
                                   markdownText(scene.scene), markdownText(scene.title), markdownText(scene.shows),
                                   scene.frame, scene.profile, image.width(), image.height());
    for (const ShownReference& shown : scene.references)
        page += fmt::format("## The {} truth\n\n", shown.truth) + pictures(scene, shown, folder);
    page +=
        fmt::format("## How it was made\n\n{}![histograms]({})\n\nEdge distances are exact on planar receivers and to "
                    "half a pixel elsewhere, hence the peaks. σ\\* is the standard uncertainty of the visible fraction.\n\n",
                    factsTable(scene), target(chart));
    page += "## Do the oracles agree?\n\n" + agreementTable(scene.agreements);
    writeFile(folder / chart, histograms(scene));
    writeFile(folder / (scene.scene + ".md"), page);
    return folder / chart;
}

std::string agreementText(const std::vector<Agreement>& agreements) {
    std::string text;
    for (const Agreement& agreement : agreements)
        text += fmt::format("{}{}, {}: {} of {} differ", text.empty() ? "" : "; ", agreement.a, agreement.b,
                            agreement.differing, agreement.pixels);
    return text.empty() ? "–" : text;
}

std::string indexRow(const TruthOfScene& scene, const ShownReference& shown) {
    const TruthNumbers numbers = truthNumbers(shown.reference);
    const std::string sigma =
        numbers.sigmaLargest > 0 ? fmt::format("{:.2g}, {:.2g}", numbers.sigmaMedian, numbers.sigmaLargest) : "0";
    return fmt::format("| [{}]({}) | {} | {} | {} | {} | {} | {} | {} |\n", markdownText(scene.scene),
                       target(scene.scene + ".md"), shown.truth, shown.reference.provenance.oracle,
                       shareOf(numbers.shadowed, numbers.receivers), shareOf(numbers.penumbra, numbers.receivers), sigma,
                       secondsText(shown.reference.provenance.seconds),
                       shown.truth == "hard" ? agreementText(scene.agreements) : "");
}

} // namespace

Written writeTruthReport(const std::vector<TruthOfScene>& scenes, const fs::path& folder) {
    Written written{folder / "report.md", {}};
    std::string page = "# The truth\n\nWhat techniques are scored against: the references of the last still frame of every "
                       "scene, how sure they are, and whether oracles that share no code agree.\n\n"
                       "| scene | truth | oracle | shadowed | partly lit | σ\\*: median, largest | computed in | oracles "
                       "compared |\n|:---|:---|:---|---:|---:|---:|---:|:---|\n";
    for (const TruthOfScene& scene : scenes) {
        written.charts.push_back(writeScenePage(scene, folder));
        for (const ShownReference& shown : scene.references) page += indexRow(scene, shown);
    }
    page += "\n![seconds by scene and oracle](seconds.svg)\n\nshadowed, partly lit: shares of the receiver pixels. σ\\*: "
            "where it "
            "is not 0. Made by `./bench reference --report` and a folder.\n";
    writeFile(folder / "seconds.svg", secondsChart(scenes));
    written.charts.push_back(folder / "seconds.svg");
    writeFile(written.page, page);
    return written;
}

} // namespace shadowbench::report
