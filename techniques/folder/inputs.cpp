#include "techniques/folder/inputs.h"

#include "techniques/contract/resolve.h"
#include "techniques/shared/filters/jitter_table.h"
#include "techniques/shared/maps/depth_map.h"
#include "techniques/shared/maps/linearised_map.h"

#include <array>
#include <glm/geometric.hpp>

namespace shadowbench::techniques {
namespace {

using Name = const std::string&;
using State = const FolderState&;

/// One number a view.
template <class Value>
void setEach(gl::Program& program, Name name, State state, Value (*of)(const LightView&)) {
    std::vector<Value> values;
    for (const LightView& view : state.views) values.push_back(of(view));
    program.set(name, std::span<const Value>(values));
}

/// One number a tile, of what is in it.
template <class Value>
void setTiles(gl::Program& program, Name name, State state, Value (*of)(const LightView&, const Tile&, glm::ivec2)) {
    std::vector<Value> values;
    for (std::size_t i = 0; i < state.tiles.size(); ++i) values.push_back(of(state.views[i], state.tiles[i], state.mapSize));
    if (values.empty()) return; // no pass draws casters
    program.set(name, std::span<const Value>(values));
}

glm::vec4 eyeDepth(const Camera& camera) {
    const glm::dvec3 forward = camera.basis().forward;
    return glm::vec4(glm::dvec4(forward, -glm::dot(forward, camera.eye)));
}

constexpr std::array inputs{
    FolderInput{"positions", "sampler2D",
                "world position of what a pixel sees; w is 0 where that is nothing (gl/receiver.glsl)",
                [](gl::Program& p, Name n, State s) { p.set(n, s.frame.gbuffer.position()); }, InputOf::Frame},
    FolderInput{"normals", "sampler2D", "geometric normal of the side that is seen (gl/normal.glsl)",
                [](gl::Program& p, Name n, State s) { p.set(n, s.frame.gbuffer.normal()); }, InputOf::Frame},
    FolderInput{"surfaces", "usampler2D", "number of the surface",
                [](gl::Program& p, Name n, State s) { p.set(n, s.frame.gbuffer.id()); }, InputOf::Frame},
    FolderInput{"previousPositions", "sampler2D", "where that point was one frame earlier, in the world",
                [](gl::Program& p, Name n, State s) { p.set(n, s.frame.gbuffer.previousPosition()); }, InputOf::Frame},
    FolderInput{"mapFromWorld", "mat4",
                "the light's view: x, y and window depth in [0, 1] after the division by w "
                "(shared/maps/light_space.glsl)",
                [](gl::Program& p, Name n, State s) {
                    setEach<glm::mat4>(p, n, s, [](const LightView& v) { return mapFromWorld(v); });
                },
                InputOf::EachView},
    FolderInput{"depthFromWorld", "vec4", "dot(·, (p, 1)): metres from the light's plane along its axis",
                [](gl::Program& p, Name n, State s) {
                    setEach<glm::vec4>(p, n, s, [](const LightView& v) { return glm::vec4(v.depthFromWorld); });
                },
                InputOf::EachView},
    FolderInput{"unitDepthFromWorld", "vec4", "the same, 0 at the view's near and 1 at its far distance",
                [](gl::Program& p, Name n, State s) {
                    setEach<glm::vec4>(p, n, s, [](const LightView& v) { return glm::vec4(unitDepthFromWorld(v)); });
                },
                InputOf::EachView},
    FolderInput{"linearisation", "vec4", "makes unit depth of window depth (filtered/unit_depth.glsl)",
                [](gl::Program& p, Name n, State s) {
                    setEach<glm::vec4>(p, n, s, [](const LightView& v) { return unitLinearisation(v, 0); });
                },
                InputOf::EachView},
    FolderInput{
        "metreLinearisation", "vec4",
        "makes metres of window depth (shared/maps/linearised_map.glsl calls it linearisation), with the constant part "
        "of a bias that a pass draws as `bias-of-slope`",
        [](gl::Program& p, Name n, State s) {
            std::vector<glm::vec4> values;
            for (const LightView& view : s.views)
                values.push_back(linearisation(view, s.addsUnits ? s.bias.units * depthStep * view.far : 0));
            p.set(n, std::span<const glm::vec4>(values));
        },
        InputOf::EachView},
    FolderInput{"nearDepth", "float", "distance of the first view's near plane, metres (shared/filters/blocker_search.glsl)",
                [](gl::Program& p, Name n, State s) { p.set(n, static_cast<float>(s.views.front().near)); }},
    FolderInput{"nearAndFar", "vec2", "distances of the light's view, metres",
                [](gl::Program& p, Name n, State s) {
                    setEach<glm::vec2>(p, n, s, [](const LightView& v) { return glm::vec2(v.near, v.far); });
                },
                InputOf::EachView},
    FolderInput{"mapSpan", "vec2",
                "width and height of the light's view at unit distance (point and area lights), or in metres",
                [](gl::Program& p, Name n, State s) {
                    setEach<glm::vec2>(p, n, s, [](const LightView& v) { return glm::vec2(v.span); });
                },
                InputOf::EachView},
    FolderInput{"atlasFromWorld", "mat4[]",
                "of each view: from the world into its tile of the first map (shared/maps/depth_atlas.glsl)",
                [](gl::Program& p, Name n, State s) { setTiles<glm::mat4>(p, n, s, atlasFromWorld); }},
    FolderInput{"innerTiles", "vec4[]", "of each view: the outermost texel centres of its tile, low and high",
                [](gl::Program& p, Name n, State s) {
                    setTiles<glm::vec4>(p, n, s,
                                        [](const LightView&, const Tile& t, glm::ivec2 m) { return innerTile(t, m); });
                }},
    FolderInput{"sliceEnds", "vec4[]",
                "of each cascade: where it ends, and where the next one's map begins to take over (shared/maps/slice.glsl)",
                [](gl::Program& p, Name n, State s) { p.set(n, std::span<const glm::vec4>(s.cascades->ends())); },
                InputOf::Frame},
    FolderInput{"eyeDepthFromWorld", "vec4", "dot(·, (p, 1)): metres from the eye along its axis",
                [](gl::Program& p, Name n, State s) { p.set(n, eyeDepth(s.frame.snapshot.camera)); }, InputOf::Frame},
    FolderInput{"mapTexels", "vec2", "texels of the first map, along x and y",
                [](gl::Program& p, Name n, State s) { p.set(n, glm::vec2(s.mapSize)); }},
    FolderInput{"normalOffset", "float", "factor of `bias=normal-offset` (shared/maps/tested_point.glsl)",
                [](gl::Program& p, Name n, State s) { p.set(n, s.bias.normalOffset); }},
    FolderInput{"followPlane", "float",
                "1 where filters compare depths beside the receiver with its plane; 0 with `bias=none` and `constant`",
                [](gl::Program& p, Name n, State s) { p.set(n, s.followsPlane ? 1.0F : 0.0F); }},
    FolderInput{
        "imageFromWorld", "mat4", "pixels of the image, after the division by w",
        [](gl::Program& p, Name n, State s) { p.set(n, glm::mat4(imageFromClip(s.frame.size) * s.frame.clipFromWorld)); },
        InputOf::Frame},
    FolderInput{"previousImageFromWorld", "mat4", "the same one frame earlier",
                [](gl::Program& p, Name n, State s) {
                    p.set(n, glm::mat4(imageFromClip(s.frame.size) * s.frame.previousClipFromWorld));
                },
                InputOf::Frame},
    FolderInput{"eye", "vec3", "the camera's place in the world",
                [](gl::Program& p, Name n, State s) { p.set(n, glm::vec3(s.frame.snapshot.camera.eye)); }, InputOf::Frame},
    FolderInput{"lightPlace", "vec4", "the light's place and 1 (of an area light its centre), or the direction to it and 0",
                [](gl::Program& p, Name n, State s) { p.set(n, glm::vec4(s.frame.snapshot.light.homogeneous())); }},
    FolderInput{"lightHalfSize", "vec2", "half the lengths of an area light's sides (shared/filters/blocker_search.glsl)",
                [](gl::Program& p, Name n, State s) {
                    const Light& light = s.frame.snapshot.light;
                    p.set(n, 0.5F * glm::vec2(glm::length(light.u), glm::length(light.v)));
                }},
    FolderInput{"lightU", "vec3", "one side of an area light, metres; 0 of other lights",
                [](gl::Program& p, Name n, State s) { p.set(n, glm::vec3(s.frame.snapshot.light.u)); }},
    FolderInput{"lightV", "vec3", "the other side",
                [](gl::Program& p, Name n, State s) { p.set(n, glm::vec3(s.frame.snapshot.light.v)); }},
    FolderInput{"frame", "int", "number of the frame, from 0",
                [](gl::Program& p, Name n, State s) { p.set(n, s.frame.index); }, InputOf::Frame},
    FolderInput{"historyFrames", "int", "frames since the history was forgotten: 0 in the first",
                [](gl::Program& p, Name n, State s) { p.set(n, s.historyFrames); }, InputOf::Frame},
    FolderInput{"repetition", "int", "how often the pass or its group was drawn in this frame before",
                [](gl::Program& p, Name n, State s) { p.set(n, s.repetition); }},
    FolderInput{"jitterOrigin", "vec2", "of the blocks of a `jitter` pattern, pixels (shared/filters/jitter_table.glsl)",
                [](gl::Program& p, Name n, State s) { p.set(n, JitterTable::origin(s.frame.seed)); }},
    FolderInput{"seed", "int", "of pseudo-random choices",
                [](gl::Program& p, Name n, State s) { p.set(n, static_cast<int>(s.frame.seed)); }},
};

} // namespace

std::span<const FolderInput> folderInputs() { return inputs; }

} // namespace shadowbench::techniques
