// What `score` makes of images that are wrong as a whole, and of right ones that are merely bad: the images that `run
// --images` keeps of all techniques and of other renderers, each as it is and with one fault, as another renderer's.
//
//   build/release/shadowbench run --scene simple --cost none --images --out RUN
//   build/release/benchmarks/whole_image_faults RUN [--technique pcf] [--scene simple] [--fault as-drawn] [--evidence]
#include "base/error.h"
#include "base/image_io.h"
#include "base/srgb.h"
#include "base/temporary_folder.h"
#include "harness/cells/kept_images.h"
#include "harness/foreign/encodings.h"
#include "harness/foreign/foreign_image.h"
#include "harness/foreign/score_images.h"
#include "harness/foreign/shadow_edges.h"
#include "harness/render/shared_shaders.h"
#include "scene/load/load.h"
#include "techniques/catalog.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <limits>
#include <memory>
#include <set>

namespace shadowbench::foreign {
namespace {

using Made = std::function<Image<float>(const Image<float>&)>;

struct Fault {
    std::string name;
    Made made;
};

/// Pixel by pixel; what lies outside takes the nearest pixel.
template <class From>
Image<float> rearranged(const Image<float>& image, From from, int divisor = 1) {
    Image<float> result(image.width() / divisor, image.height() / divisor);
    for (int y = 0; y < result.height(); ++y)
        for (int x = 0; x < result.width(); ++x) {
            const glm::ivec2 p = from(x, y);
            result(x, y) = image(std::clamp(p.x, 0, image.width() - 1), std::clamp(p.y, 0, image.height() - 1));
        }
    return result;
}

Made mapped(float (*value)(float)) {
    return [value](const Image<float>& image) {
        Image<float> result = image;
        std::ranges::transform(result, result.begin(), value);
        return result;
    };
}

Fault shiftedBy(int dx, int dy) {
    return {fmt::format("shift {:+} {:+}", dx, dy), [=](const Image<float>& image) {
                return rearranged(image, [&](int x, int y) { return glm::ivec2(x - dx, y - dy); });
            }};
}

std::vector<Fault> allFaults() {
    return {
        {"as-drawn", [](const Image<float>& v) { return v; }},
        {"flip-y",
         [](const Image<float>& v) {
             return rearranged(v, [&](int x, int y) { return glm::ivec2(x, v.height() - 1 - y); });
         }},
        {"flip-x",
         [](const Image<float>& v) {
             return rearranged(v, [&](int x, int y) { return glm::ivec2(v.width() - 1 - x, y); });
         }},
        shiftedBy(1, 0),
        shiftedBy(-1, 0),
        shiftedBy(0, 1),
        shiftedBy(0, -1),
        {"inverted", mapped([](float v) { return 1 - v; })},
        {"srgb", mapped(srgbFromLinear)},
        {"srgb-undone", mapped(linearFromSrgb)},
        {"half-size",
         [](const Image<float>& v) {
             return rearranged(
                 v, [](int x, int y) { return glm::ivec2(2 * x, 2 * y); }, 2);
         }},
        {"nan",
         [](const Image<float>& v) {
             Image<float> result = v;
             result(v.width() / 2, v.height() / 2) = std::numeric_limits<float>::quiet_NaN();
             return result;
         }},
        {"black", mapped([](float) { return 0.0F; })},
    };
}

/// What was done with an image.
struct Outcome {
    char letter; // R: refused, W: warned, .: nothing was said, =: the fault changes no receiver
    std::string said;
};

class Judge {
public:
    Judge(const std::string& id, Profile profile, const groundtruth::Cache& cache)
        : scene_(loadScene(id, profile)), truths_(scene_, cache), frames_(scene_, truths_) {
        frames_.show(frames_.scored());
    }

    Outcome judge(Definition definition, const Image<float>& drawn, const Fault& fault) {
        const Image<float> v = fault.made(drawn);
        const metrics::Mask& mask = frames_.mask(definition == Definition::Hard ? Truth::Hard : Truth::Soft);
        if (fault.name != "as-drawn" && v.width() == drawn.width()) {
            bool same = true;
            for (std::size_t i = 0; i < v.size() && same; ++i) same = mask.scored[i] == 0 || v[i] == drawn[i];
            if (same) return {'=', ""};
        }
        const std::filesystem::path file = folder_.path() / "image.exr";
        writeExr(file, {{"Y", &v}});
        ForeignRow row{
            .id = "faulty", .definition = definition, .encoding = encodingOf(fault), .frames = {{frames_.scored(), file}}};
        std::vector<std::string> warnings;
        try {
            if (fault.name == "srgb-undone") // the file is right, and read as sRGB
                writeExr(file, {{"Y", &drawn}});
            scoreImages(frames_, row, warnings);
        } catch (const BadInput& error) {
            return {'R', error.what()};
        }
        return warnings.empty() ? Outcome{'.', ""} : Outcome{'W', warnings.front()};
    }

    std::string evidence(Definition definition, const Image<float>& drawn, const Fault& fault) {
        const Image<float> v = fault.made(drawn);
        if (v.width() != drawn.width()) return "";
        const bool labels = definition == Definition::Hard;
        const Truth truth = labels ? Truth::Hard : Truth::Soft;
        const metrics::ScoredFrame frame{v, frames_.truth(truth), frames_.mask(truth)};
        const ShiftEvidence e = shiftEvidence(frame, labels);
        std::string text = fmt::format("shift ({}, {}) light {:.1f} shadow {:.1f} agreement {:.1f} half {:.1f} more {:.1f}",
                                       e.by.x, e.by.y, e.towardsLight, e.towardsShadow, e.agreement, e.overHalf, e.overMore);
        if (!labels) return text;
        for (float (*undo)(float) : {linearFromSrgb, srgbFromLinear}) {
            const GreyPixels grey = greyPixels(frame, undo);
            text += fmt::format("; {} grey, evener {:.1f} mean {:.2f}, undone {:.2f}", grey.count, grey.evener, grey.before,
                                grey.after);
        }
        return text;
    }

    [[nodiscard]] Definition definitionOf(const Record& record) const {
        for (const auto& [key, value] : record.parameters)
            if (record.technique.starts_with(externalPrefix) && key == "means") return definitionNamed(value);
        const techniques::Answer answer = techniques::parseVariant(record.variant).entry->answer;
        if (scene_.light.isEnvironment()) return Definition::Irradiance;
        return answer == techniques::Answer::Soft ? Definition::Area : Definition::Hard;
    }

private:
    static Encoding encodingOf(const Fault& fault) {
        return fault.name == "srgb-undone" ? Encoding::Srgb : Encoding::Linear;
    }

    TemporaryFolder folder_;
    Scene scene_;
    Truths truths_;
    SceneFrames frames_;
};

struct Options {
    std::filesystem::path run;
    std::vector<std::string> scenes, techniques, faults;
    bool evidence = false, sentences = false;
};

bool isChosen(const std::vector<std::string>& chosen, const std::string& name) {
    return chosen.empty() || std::ranges::find(chosen, name) != chosen.end();
}

class Table {
public:
    explicit Table(const Options& options) : options_(options) {
        for (Fault& fault : allFaults())
            if (isChosen(options.faults, fault.name)) faults_.push_back(std::move(fault));
    }

    void print() {
        std::set<std::string> done;
        for (const Record& record : readRecords(options_.run / "results.jsonl")) {
            if (!done.insert(record.scene).second || !isChosen(options_.scenes, record.scene)) continue;
            printScene(record.scene, profileNamed(record.profile));
        }
        fmt::print("\nAll:\n  {:12} {:>8} {:>8} {:>8} {:>8}\n", "fault", "refused", "warned", "nothing", "no change");
        for (const Fault& fault : faults_) {
            auto& counts = counts_[fault.name];
            fmt::print("  {:12} {:8} {:8} {:8} {:8}\n", fault.name, counts['R'], counts['W'], counts['.'], counts['=']);
        }
    }

private:
    void printScene(const std::string& id, Profile profile) {
        Judge judge(id, profile, cache_);
        std::string names;
        for (const Fault& fault : faults_) names += " " + fault.name;
        fmt::print("\n{}:{}\n", id, names);
        for (const Record& record : readRecords(options_.run / "results.jsonl")) {
            if (record.scene != id || record.status != Status::Scored || record.technique.starts_with("lod-")) continue;
            if (!isChosen(options_.techniques, record.technique)) continue;
            const auto file = cellFolder(options_.run / "images", id, record.variant) / "visibility.exr";
            if (!std::filesystem::exists(file)) continue;
            printRow(judge, record, readChannel(file, "V"));
        }
    }

    void printRow(Judge& judge, const Record& record, const Image<float>& drawn) {
        const Definition definition = judge.definitionOf(record);
        std::string letters, details;
        for (const Fault& fault : faults_) {
            const Outcome outcome = judge.judge(definition, drawn, fault);
            letters += outcome.letter;
            ++counts_[fault.name][outcome.letter];
            const bool isNews = fault.name == "as-drawn" ? outcome.letter != '.' : outcome.letter == 'W';
            if (!outcome.said.empty() && (options_.sentences || isNews))
                details += fmt::format("      {}: {}\n", fault.name, outcome.said.substr(outcome.said.find("exr ") + 4));
            if (options_.evidence)
                details += fmt::format("      {}: {}\n", fault.name, judge.evidence(definition, drawn, fault));
        }
        fmt::print("  {} {}\n{}", letters, record.variant, details);
        std::fflush(stdout);
    }

    const Options& options_;
    std::vector<Fault> faults_;
    groundtruth::Cache cache_{groundtruth::defaultCacheFolder()};
    std::unique_ptr<gl::Context> context_ = contextOfRun(cache_.folder(), false);
    std::map<std::string, std::map<char, int>> counts_;
};

} // namespace
} // namespace shadowbench::foreign

int main(int argc, char** argv) {
    using namespace shadowbench;
    foreign::Options options;
    CLI::App app("What `score` makes of images that are wrong as a whole");
    app.add_option("RUN", options.run, "Folder of `run --images`")->required()->check(CLI::ExistingDirectory);
    app.add_option("--scene", options.scenes, "Of the run's (default: all)");
    app.add_option("--technique", options.techniques, "Ids (default: all)");
    app.add_option("--fault", options.faults, "By name (default: all)");
    app.add_flag("--evidence", options.evidence, "Print the evidence of each image");
    app.add_flag("--sentences", options.sentences, "Print all that was said");
    CLI11_PARSE(app, argc, argv);
    try {
        foreign::Table(options).print();
        return 0;
    } catch (const Error& error) {
        fmt::print(stderr, "{}\n", error.what());
        return static_cast<int>(error.code());
    }
}
