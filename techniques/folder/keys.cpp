#include "techniques/folder/keys.h"

#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace shadowbench::techniques {
namespace {

using enum KeyTable;

template <const auto& words>
std::string oneOf() {
    return fmt::format(R"("enum": ["{}"])", fmt::join(words.all(), R"(", ")"));
}
std::string text() { return R"("type": "string", "minLength": 1)"; }
std::string formatOrParameter() { return fmt::format(R"("anyOf": [{{{}}}, {{{}}}])", oneOf<formats>(), text()); }
std::string flag() { return R"("type": "boolean")"; }
std::string texts() { return R"("type": "array", "items": {"type": "string"})"; }
std::string tables() { return R"("type": "object")"; } // of further names
std::string scalar() { return R"("type": ["string", "number"])"; }
std::string numbers(int count) {
    return fmt::format(R"("type": "array", "minItems": {0}, "maxItems": {0}, "items": {{"type": "number"}})", count);
}

constexpr std::array keys{
    FolderKey{Root, "id", "lower-case letters, digits and `-`; the rows are `my:ID`", "needed",
              [] { return std::string(R"("type": "string", "pattern": "^[a-z0-9-]{1,40}$")"); }},
    FolderKey{Root, "title", "for people", "needed", text},
    FolderKey{Root, "source", "the paper, for people", "none", text},
    FolderKey{Root, "answer",
              "`hard` (lit or not, from the light's centre), `filtered` (a hard shadow with smoothed edges), or `soft` (the "
              "visible fraction of an area light): it decides which truth the row is scored against",
              "needed", oneOf<answers>},
    FolderKey{Root, "history",
              "`true`: keeps texels from frame to frame, so frames are drawn in order and ghosts are looked for", "`false`",
              flag},
    FolderKey{
        Root, "view",
        "what the light's view holds: `scene`; `focused`, what the camera sees; `lispsm`, the same, warped; "
        "`light-sample`, the scene from another point of an area light each frame; or several views: `cube`, the scene "
        "through the six sides of a cube, and `cascades`, slices of what the camera sees",
        "`scene`", oneOf<views>},
    FolderKey{Root, "cascades", "`[cascades]`, below: how they are fitted", "needed by `cascades` alone", tables},
    FolderKey{Root, "depth_map",
              "adds the parameters `map`, `bias`, `factor` and `units`, as the depth maps that are built in have them: with "
              "`depth-bias` the bias is one of depths; with `any-bias` it may be `normal-offset` as well, for shaders over "
              "shared/maps/tested_point.glsl",
              "none", oneOf<mapBiases>},
    FolderKey{Root, "variants", "the rows of a run: texts as `\"map=512,kernel=3\"`; `\"\"` has all defaults", "`[\"\"]`",
              texts},
    FolderKey{Root, "lacks",
              "what it has no right answer for, as `list techniques` names it: `recommend` leaves such rows out", "none",
              texts},
    FolderKey{Root, "parameter", "`[parameter.NAME]`, below", "none", tables},
    FolderKey{Root, "parameters_of",
              "a folder that is built in, as `modern/pcss-vogel`, whose parameters it has after its own", "none", text},
    FolderKey{Root, "pattern", "`[pattern.NAME]`, points to sample with, below", "none", tables},
    FolderKey{Root, "target", "`[target.NAME]`, a texture, below", "none", tables},
    FolderKey{Root, "pass", "`[[pass]]`, below: what is drawn, in order; the last one writes `visibility`", "needed",
              [] { return std::string(R"("type": "array", "minItems": 1)"); }},

    FolderKey{Cascades, "count", "how many slices, 1 to 8, or the parameter that says it; 0 is one map of the scene",
              "needed", [] { return std::string(R"("type": ["string", "integer"])"); }},
    FolderKey{Cascades, "lambda",
              "share of geometrical (1) against even (0) steps between slices, or the parameter that says it", "1", scalar},
    FolderKey{Cascades, "blend",
              "share of a slice, at its end, that the next slice's map holds, too, up to 0.5, or the parameter that says it",
              "0", scalar},
    FolderKey{Cascades, "fit",
              "what slices are fitted to: `visible`, the points that the G-buffer shows; `view`, the frustum within the "
              "scene's box; or the parameter that says which",
              "`visible`", text},
    FolderKey{Cascades, "warp", "`none`, `lispsm`, or the parameter that says which; not where the answer is soft", "`none`",
              text},
    FolderKey{
        Cascades, "stable",
        "`none`; `texels`: maps of a directional light as large as the slice's ball, moved by whole texels, which asks "
        "for `fit = \"view\"`; or the parameter that says which",
        "`none`", text},
    FolderKey{
        Cascades, "latency",
        "how many frames old the points are that slices are fitted to, 0 or 1, or the parameter that says it; 1 asks for "
        "`fit = \"visible\"` and `history = true`, and fits the first frame to its frustum",
        "0", [] { return std::string(R"("type": ["string", "integer"])"); }},

    FolderKey{Parameter, "default", "the value without another", "needed", scalar},
    FolderKey{Parameter, "meaning", "one line for people, with the unit", "needed", text},
    FolderKey{Parameter, "range",
              "of a number: `[least, most]`; whole numbers where neither they nor the default have a decimal point, "
              "an `int` in shaders; else a `float`",
              "this or `choices`", [] { return numbers(2); }},
    FolderKey{Parameter, "choices", "of a word: all that there are", "this or `range`", texts},
    FolderKey{Parameter, "source", "where the paper has it", "none", text},

    FolderKey{Pattern, "kind",
              "`poisson-disk`, points of the unit disk, well apart; `poisson-light`, the same over the light's own shape; "
              "`grid`, cell centres of [−1, 1]²; `gaussian`, offset and weight of pairs of taps; or `jitter`, a table for "
              "shared/filters/jitter_table.glsl",
              "needed", oneOf<patternKinds>},
    FolderKey{Pattern, "sigma", "of `gaussian`: the standard deviation in steps, or the parameter that says it",
              "needed there", scalar},
    FolderKey{Pattern, "taps", "of `jitter`: how many a pixel has, or the parameter that says it", "needed there",
              [] { return std::string(R"("type": ["string", "integer"])"); }},
    FolderKey{Pattern, "sectors", "of `jitter`: how many of them are of one ring of the disk", "needed there",
              [] { return std::string(R"("type": "integer")"); }},

    FolderKey{Target, "format",
              "`R8`, `RGBA8`, `R32F`, `RG16F`, `RG32F`, `RGBA16`, `RGBA16F`, `RGBA32F`, `RG32UI`, `Depth32F` or "
              "`Depth32FStencil8`, "
              "or the parameter whose choices are some of them, without the last three",
              "needed", formatOrParameter},
    FolderKey{Target, "size",
              "`\"image\"`, texels per side, or the parameter that has them; with several views they share as many texels",
              "needed", [] { return std::string(R"("type": ["string", "integer"])"); }},
    FolderKey{Target, "filter", "`nearest` or `linear`", "`nearest`", oneOf<filters>},
    FolderKey{Target, "linear_when", "the one choice of a parameter with which the filter is linear, as `\"kernel=2\"`",
              "none", text},
    FolderKey{Target, "compare", "depths are read through `sampler2DShadow`", "`false`", flag},
    FolderKey{Target, "mipmaps", "made after each pass that writes the target", "`false`", flag},
    FolderKey{Target, "history", "its texels of the frame before can be read", "`false`", flag},

    FolderKey{Pass, "name", "for costs and profilers; the field's word, such as \"depth map\", \"blur\", \"resolve\"",
              "needed", text},
    FolderKey{Pass, "draw", "`casters`: the scene, as the light's view sees it; `screen`: each texel of the target once",
              "this or `compute`", oneOf<draws>},
    FolderKey{
        Pass, "compute",
        "in place of `draw` and `fragment`: a compute shader of the folder or one of ours, which stores into the targets",
        "this or `draw`", text},
    FolderKey{Pass, "work_groups",
              "of `compute`: how many along x, y and z, each a number or the target whose texels along that axis it is",
              "an invocation for each texel of the first target",
              [] {
                  return std::string(
                      R"("type": "array", "minItems": 3, "maxItems": 3, "items": {"type": ["string", "integer"]})");
              }},
    FolderKey{Pass, "to", "the target that is written, or a list of them in the order of the shader's outputs", "needed",
              [] { return std::string(R"("type": ["string", "array"], "items": {"type": "string"}, "maxItems": 7)"); }},
    FolderKey{Pass, "fragment", "a file of the folder or one of ours; casters without one write depth alone",
              "of casters none", text},
    FolderKey{Pass, "define", "macros of this pass, as `{ DIRECTION = \"ivec2(1, 0)\" }`: one file may serve several passes",
              "none", tables},
    FolderKey{Pass, "when", "the one choice of a parameter with which it is drawn, as `\"depth=midpoint\"`", "always", text},
    FolderKey{
        Pass, "once",
        "`light`: drawn where light or casters have changed since, and what it has written is kept; of the view `scene`",
        "in each frame", oneOf<changes>},
    FolderKey{Pass, "repeat", "how often it is drawn, 1 to 64, or the parameter that says it; `repetition` counts", "1",
              [] { return std::string(R"("type": ["string", "integer"])"); }},
    FolderKey{Pass, "group",
              "passes one after the other that share this word are repeated in turns, as often as the first of them says",
              "none", text},
    FolderKey{Pass, "blend", "`add`, `min`, `max` or `multiply`: what is drawn with what is there already, in place of it",
              "none", oneOf<blends>},
    FolderKey{Pass, "clear",
              "of casters or with `blend`: what colours are before anything is drawn, four numbers of at most 10¹⁸",
              "of casters zeros", [] { return numbers(4); }},
    FolderKey{
        Pass, "offset",
        "of casters, away from the light: `[of the slope, units]`, numbers or parameters, as glPolygonOffset has them; "
        "units are 2⁻²⁴ of the depth range. Or `\"bias\"`: as the parameters of `depth_map` say; or "
        "`\"bias-of-slope\"`, which leaves the constant part to `metreLinearisation`",
        "`[0, 0]`",
        [] {
            return std::string(
                R"("type": ["array", "string"], "minItems": 2, "maxItems": 2, "items": {"type": ["string", "number"]})");
        }},
    FolderKey{Pass, "cull", "of casters: triangles that are left out, `none`, `front` or `back`", "`none`", oneOf<culls>},
    FolderKey{Pass, "peel", "of casters: only what lies behind its target of depths is drawn, which stays as it is",
              "`false`", flag},
    FolderKey{Pass, "depth_test", "of casters without a target of depths: `false` draws all of them, not the nearest alone",
              "`true`", flag},
    FolderKey{Pass, "stencil", "`[pass.stencil]`, below: of a pass with a target of the format `Depth32FStencil8`", "none",
              tables},

    FolderKey{Stencil, "test",
              "which pixels are drawn: `always` all, `equal` and `not-equal` those whose stencil is, or is not, `ref`",
              "`always`", oneOf<stencilTests>},
    FolderKey{Stencil, "ref", "0 to 255", "0", [] { return std::string(R"("type": "integer")"); }},
    FolderKey{
        Stencil, "pass",
        "what becomes of the stencil where a pixel is drawn: `keep`, `replace` (by `ref`), `increment` or `decrement` (255 "
        "and 0 are neighbours) or `invert` (its bits)",
        "`keep`", oneOf<stencilOperations>},
    FolderKey{Stencil, "depth_fail", "the same of casters where the depth test fails", "`keep`", oneOf<stencilOperations>},
    FolderKey{Stencil, "fail", "the same where `test` fails", "`keep`", oneOf<stencilOperations>},
};

std::string quoted(std::string_view words) {
    std::string escaped;
    for (const char c : words) {
        if (c == '"' || c == '\\') escaped += '\\';
        escaped += c;
    }
    return fmt::format("\"{}\"", escaped);
}

/// Members of the schema of a table: its keys, of those that hold tables of further names what these are.
std::string tableSchema(KeyTable table, const std::string& indent);

std::string keySchema(const FolderKey& key, const std::string& indent) {
    const auto inner = [&](KeyTable of) { return fmt::format("{{{}\n{}}}", tableSchema(of, indent + "  "), indent); };
    std::string schema = fmt::format("{{\"description\": {}, {}", quoted(key.meaning), key.schema());
    if (key.table == Root && key.name == "cascades")
        return fmt::format("{{\"description\": {},{}\n{}}}", quoted(key.meaning), tableSchema(Cascades, indent + "  "),
                           indent);
    if (key.table == Pass && key.name == "stencil")
        return fmt::format("{{\"description\": {},{}\n{}}}", quoted(key.meaning), tableSchema(Stencil, indent + "  "),
                           indent);
    if (key.table == Root && key.name == "parameter") schema += ", \"additionalProperties\": " + inner(Parameter);
    if (key.table == Root && key.name == "pattern") schema += ", \"additionalProperties\": " + inner(Pattern);
    if (key.table == Root && key.name == "target") schema += ", \"additionalProperties\": " + inner(Target);
    if (key.table == Root && key.name == "pass") schema += ", \"items\": " + inner(Pass);
    return schema + "}";
}

std::string tableSchema(KeyTable table, const std::string& indent) {
    std::vector<std::string> properties, needed;
    for (const FolderKey& key : keys) {
        if (key.table != table) continue;
        properties.push_back(fmt::format("\n{}    \"{}\": {}", indent, key.name, keySchema(key, indent + "    ")));
        if (key.standard == "needed") needed.push_back(quoted(key.name));
    }
    return fmt::format(
        "\n{0}  \"type\": \"object\",\n{0}  \"additionalProperties\": false,\n{0}  \"required\": [{1}],\n{0}  "
        "\"properties\": {{{2}\n{0}  }}",
        indent, fmt::join(needed, ", "), fmt::join(properties, ","));
}

} // namespace

std::span<const FolderKey> folderKeys() { return keys; }

std::vector<std::string> keysOf(KeyTable table) {
    std::vector<std::string> names;
    for (const FolderKey& key : keys)
        if (key.table == table) names.emplace_back(key.name);
    return names;
}

std::string folderSchema() {
    return fmt::format("{{\n  \"$schema\": \"http://json-schema.org/draft-07/schema#\",\n  \"title\": \"technique.toml of "
                       "shadowbench\",{}\n}}\n",
                       tableSchema(Root, ""));
}

} // namespace shadowbench::techniques
