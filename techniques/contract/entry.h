// How the catalogue describes a technique, and a technique with its parameters chosen.
#pragma once

#include "scene/scene.h"
#include "techniques/contract/lod_technique.h"
#include "techniques/contract/need.h"
#include "techniques/contract/parameters.h"
#include "techniques/contract/technique.h"

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace shadowbench::techniques {

/// The documents that techniques are implemented from.
enum class Document { Dissertation, PixelCorrectPaper, Course, Zapotocky, Other };

struct Source {
    Document document;
    std::string where; // section, equation, listing; of another document also which it is
};

/// "Scherzer, dissertation, 2.2.1".
std::string citation(const Source& source);

/// What kind of answer a technique gives, hence which ground truth it is scored against.
enum class Answer {
    Hard,     // lit or not, from the light's centre
    Filtered, // a hard shadow with smoothed edges
    Soft,     // the visible fraction of an area light, or of an environment; needs one
    Colour,   // a picture of a scene with levels of detail (techniques/contract/lod_technique.h)
};

/// Whether a technique has an answer for an environment light (scene/sky.h): then it is the share of the sky's irradiance
/// that arrives, and its truth is that of a soft technique, whatever kind of answer it gives for other lights.
enum class EnvironmentAnswer {
    None,
    Also, // beside other lights
    Only, // for no other light
};

/// A number that a technique reports of each frame (`Technique::figures`).
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
    bool temporal = false;     // keeps history: its frames must be rendered in order
    std::string computed = {}; // what is computed when, where a frame does not compute all anew
    std::set<Need> lacks = {}; // what it has no right answer for; NoHistory follows from `temporal`
    EnvironmentAnswer environment = EnvironmentAnswer::None;
    /// Why the technique does not apply to a scene; nothing if it does. Empty: it applies to every scene whose light it has
    /// an answer for.
    std::function<std::optional<std::string>(const Scene&)> notApplicable = {};
    std::vector<Parameter> parameters;
    /// Why these values, each allowed alone, do not go together; nothing if they do. Empty: all go together.
    std::function<std::optional<std::string>(const Parameters&)> contradiction = {};
    std::vector<Figure> figures = {};
    std::vector<std::string> variants; // those that a run of all techniques renders: parameter strings, "" = all defaults
    /// The variant that this one's cost is compared with beside sm-uniform's, such as the map under a history. Empty: none.
    std::function<std::string(const Parameters&)> costBase = {};
    std::function<std::unique_ptr<Technique>(const Parameters&)> make = {};       // of a shadow
    std::function<std::unique_ptr<LodTechnique>(const Parameters&)> makeLod = {}; // of a picture: Answer::Colour
    std::string digest = {}; // hash of the folder's files, of a technique that is one; "" of those that are built in
};

/// Entry::lacks, and NoHistory where the technique keeps a history.
std::set<Need> lacking(const Entry& entry);

/// A technique with all its parameters chosen.
struct Variant {
    const Entry* entry;
    Parameters parameters;
    std::string name; // canonical

    [[nodiscard]] bool isLod() const { return entry->answer == Answer::Colour; }
};

/// `figures`, which a technique of `entry` has reported; throws InternalError naming one that the entry does not declare or
/// that is not finite.
std::map<std::string, double> declaredFigures(const Entry& entry, std::map<std::string, double> figures);

} // namespace shadowbench::techniques
