// The contract of a shadow technique: what it is given, what it must return, and how the catalogue describes it.
// Level-of-detail techniques are in the same catalogue but have a contract of their own.
#pragma once

#include "harness/scene/scene.h"
#include "techniques/gl/gbuffer.h"
#include "techniques/gl/scene_buffers.h"
#include "techniques/gl/texture.h"
#include "techniques/parameters.h"

#include <cstdint>
#include <functional>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace shadowbench::techniques {

/// Everything a technique may know of one frame. The G-buffer has already been drawn.
struct Frame {
    const Snapshot& snapshot;
    const gl::SceneBuffers& scene;
    const gl::GBuffer& gbuffer;
    glm::ivec2 size;                  // of the image, in pixels
    glm::dmat4 clipFromWorld;         // camera: projection · view
    glm::dmat4 previousClipFromWorld; // the same one frame earlier
    int index;                        // frame number from 0
    std::uint32_t seed;               // of pseudo-random choices; 1 is the default

    [[nodiscard]] double aspect() const { return static_cast<double>(size.x) / size.y; }
    [[nodiscard]] bool cameraMoved() const { return clipFromWorld != previousClipFromWorld; }
};

class Technique {
public:
    virtual ~Technique() = default;

    /// Writes the visible fraction of the light at every pixel (R32F in [0, 1], 1 = lit) into `visibility`. Background and
    /// surfaces that face away from the light are masked by the harness: any value will do there.
    virtual void render(const Frame& frame, const gl::Texture& visibility) = 0;

    /// Forgets all history: the next frame is the first.
    virtual void reset() {}

    /// Numbers of the frame last rendered that only the technique knows, by names that its entry declares. Asked for right
    /// after `render`, while that frame's G-buffer and scene are there; what it takes to count them belongs here, not into
    /// the timed frame.
    [[nodiscard]] virtual std::map<std::string, double> figures() const { return {}; }

    /// Where `world` lies in the map that it was tested against in the frame last rendered: in texels of that map,
    /// continuous over the map; several maps may lie anywhere. Nothing where no map holds the point (beside it, behind the
    /// light) and from techniques without a map.
    [[nodiscard]] virtual std::optional<glm::dvec2> mapPoint([[maybe_unused]] const glm::dvec3& world) const { return {}; }
};

class LodTechnique;

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
    Colour,   // a picture of a scene with levels of detail (techniques/lod/lod_technique.h)
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

/// Every technique, in the order tables print them.
std::span<const Entry> catalog();

/// The entry of `id`; throws BadInput with near matches.
const Entry& entryNamed(std::string_view id);

/// The figures of the frame that `technique`, made by `entry`, rendered last; throws InternalError naming one that the entry
/// does not declare or that is not finite.
std::map<std::string, double> declaredFigures(const Entry& entry, const Technique& technique);

/// "pcss:taps=32+32" → variant; throws BadInput naming what is valid.
Variant parseVariant(std::string_view text);

/// Variants matching a pattern: one variant string, or a glob over ids ("sm-*", "*") that gives each match's shown variants.
std::vector<Variant> matchVariants(const std::string& pattern);

/// The variant whose cost `variant` is compared with beside sm-uniform: history over its base map; nothing for the others.
std::string baseVariant(const Variant& variant);

} // namespace shadowbench::techniques
