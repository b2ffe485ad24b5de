#include "techniques/folder/inputs.h"

#include "techniques/shared/maps/depth_map.h"
#include "techniques/shared/maps/linearised_map.h"

#include <array>
#include <glm/gtc/matrix_transform.hpp>

namespace shadowbench::techniques {
namespace {

using Name = const std::string&;
using State = const FolderState&;

/// From clip space to pixels of the image.
glm::mat4 imageFrom(const glm::dmat4& clipFromWorld, glm::ivec2 size) {
    const glm::dmat4 half = glm::scale(glm::dmat4(1), glm::dvec3(0.5 * glm::dvec2(size), 1));
    return glm::mat4(half * glm::translate(glm::dmat4(1), glm::dvec3(1, 1, 0)) * clipFromWorld);
}

glm::vec4 unitDepth(const LightView& view) {
    return (view.depthFromWorld - glm::dvec4(0, 0, 0, view.near)) / (view.far - view.near);
}

constexpr std::array inputs{
    FolderInput{"positions", "sampler2D",
                "world position of what a pixel sees; w is 0 where that is nothing (gl/receiver.glsl)",
                [](gl::Program& p, Name n, State s) { p.set(n, s.frame.gbuffer.position()); }},
    FolderInput{"normals", "sampler2D", "geometric normal of the side that is seen (gl/normal.glsl)",
                [](gl::Program& p, Name n, State s) { p.set(n, s.frame.gbuffer.normal()); }},
    FolderInput{"surfaces", "usampler2D", "number of the surface",
                [](gl::Program& p, Name n, State s) { p.set(n, s.frame.gbuffer.id()); }},
    FolderInput{"previousPositions", "sampler2D", "where that point was one frame earlier, in the world",
                [](gl::Program& p, Name n, State s) { p.set(n, s.frame.gbuffer.previousPosition()); }},
    FolderInput{"mapFromWorld", "mat4",
                "the light's view: x, y and window depth in [0, 1] after the division by w "
                "(shared/maps/light_space.glsl)",
                [](gl::Program& p, Name n, State s) { p.set(n, mapFromWorld(s.view)); }},
    FolderInput{"depthFromWorld", "vec4", "dot(·, (p, 1)): metres from the light's plane along its axis",
                [](gl::Program& p, Name n, State s) { p.set(n, glm::vec4(s.view.depthFromWorld)); }},
    FolderInput{"unitDepthFromWorld", "vec4", "the same, 0 at the view's near and 1 at its far distance",
                [](gl::Program& p, Name n, State s) { p.set(n, unitDepth(s.view)); }},
    FolderInput{"linearisation", "vec4", "makes unit depth of window depth (filtered/unit_depth.glsl)",
                [](gl::Program& p, Name n, State s) { p.set(n, unitLinearisation(s.view, 0)); }},
    FolderInput{"nearAndFar", "vec2", "distances of the light's view, metres",
                [](gl::Program& p, Name n, State s) { p.set(n, glm::vec2(s.view.near, s.view.far)); }},
    FolderInput{"mapSpan", "vec2",
                "width and height of the light's view at unit distance (point and area lights), or in metres",
                [](gl::Program& p, Name n, State s) { p.set(n, glm::vec2(s.view.span)); }},
    FolderInput{"mapTexels", "vec2", "texels of the first map, along x and y",
                [](gl::Program& p, Name n, State s) { p.set(n, glm::vec2(s.mapSize)); }},
    FolderInput{"normalOffset", "float", "factor of `bias=normal-offset` (shared/maps/tested_point.glsl)",
                [](gl::Program& p, Name n, State s) { p.set(n, s.bias.normalOffset); }},
    FolderInput{"followPlane", "float",
                "1 where filters compare depths beside the receiver with its plane; 0 with `bias=none` and `constant`",
                [](gl::Program& p, Name n, State s) { p.set(n, s.followsPlane ? 1.0F : 0.0F); }},
    FolderInput{"imageFromWorld", "mat4", "pixels of the image, after the division by w",
                [](gl::Program& p, Name n, State s) { p.set(n, imageFrom(s.frame.clipFromWorld, s.frame.size)); }},
    FolderInput{"previousImageFromWorld", "mat4", "the same one frame earlier",
                [](gl::Program& p, Name n, State s) { p.set(n, imageFrom(s.frame.previousClipFromWorld, s.frame.size)); }},
    FolderInput{"eye", "vec3", "the camera's place in the world",
                [](gl::Program& p, Name n, State s) { p.set(n, glm::vec3(s.frame.snapshot.camera.eye)); }},
    FolderInput{"lightPlace", "vec4", "the light's place and 1 (of an area light its centre), or the direction to it and 0",
                [](gl::Program& p, Name n, State s) { p.set(n, glm::vec4(s.frame.snapshot.light.homogeneous())); }},
    FolderInput{"lightU", "vec3", "one side of an area light, metres; 0 of other lights",
                [](gl::Program& p, Name n, State s) { p.set(n, glm::vec3(s.frame.snapshot.light.u)); }},
    FolderInput{"lightV", "vec3", "the other side",
                [](gl::Program& p, Name n, State s) { p.set(n, glm::vec3(s.frame.snapshot.light.v)); }},
    FolderInput{"frame", "int", "number of the frame, from 0",
                [](gl::Program& p, Name n, State s) { p.set(n, s.frame.index); }},
    FolderInput{"historyFrames", "int", "frames since the history was forgotten: 0 in the first",
                [](gl::Program& p, Name n, State s) { p.set(n, s.historyFrames); }},
    FolderInput{"repetition", "int", "how often the pass or its group was drawn in this frame before",
                [](gl::Program& p, Name n, State s) { p.set(n, s.repetition); }},
    FolderInput{"seed", "int", "of pseudo-random choices",
                [](gl::Program& p, Name n, State s) { p.set(n, static_cast<int>(s.frame.seed)); }},
};

} // namespace

std::span<const FolderInput> folderInputs() { return inputs; }

} // namespace shadowbench::techniques
