// How the catalogue describes a technique, and a technique with its parameters chosen.
#pragma once

#include "scene/scene.h"
#include "techniques/contract/lod_technique.h"
#include "techniques/contract/parameters.h"
#include "techniques/contract/technique.h"

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace shadowbench::techniques {

/// The documents that techniques come from.
enum class Seed { Dissertation, PixelCorrectPaper, Course, Zapotocky };
std::string_view title(Seed seed);

struct Source {
    Seed seed;
    std::string where; // section, equation, listing
};

/// What kind of answer a technique gives, hence which truth it is scored against (METRICS.md).
enum class Answer {
    Hard,     // lit or not, from the light's centre
    Filtered, // a hard shadow with smoothed edges
    Soft,     // the visible fraction of an area light; needs one
    Colour,   // a picture of a scene with levels of detail (techniques/contract/lod_technique.h)
};

/// A number that a technique tells of each frame (`Technique::figures`).
struct Figure {
    std::string name;
    std::string meaning; // with its unit
};

/// One line of the catalogue.
struct Entry {
    std::string id;
    std::string title;
    Source source;
    Answer answer = Answer::Hard;
    bool temporal = false; // keeps history: its frames must be rendered in order
    /// Why the technique has nothing to do on a scene; nothing if it has. Empty: it takes every scene with a light that it
    /// can answer for.
    std::function<std::optional<std::string>(const Scene&)> notApplicable = {};
    std::vector<Parameter> parameters;
    std::vector<Figure> figures = {};
    std::vector<std::string> variants; // what a run of all techniques shows: parameter strings, "" = all defaults
    std::function<std::unique_ptr<Technique>(const Parameters&)> make = {};       // of a shadow
    std::function<std::unique_ptr<LodTechnique>(const Parameters&)> makeLod = {}; // of a picture: Answer::Colour
};

/// A technique with all its parameters chosen.
struct Variant {
    const Entry* entry;
    Parameters parameters;
    std::string name; // canonical

    [[nodiscard]] bool isLod() const { return entry->answer == Answer::Colour; }
};

/// The figures of the frame that `technique`, made by `entry`, rendered last; throws InternalError naming one that the entry
/// does not declare or that is not finite.
std::map<std::string, double> declaredFigures(const Entry& entry, const Technique& technique);

} // namespace shadowbench::techniques
