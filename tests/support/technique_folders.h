// Technique folders that a test writes.
#pragma once

#include "base/files.h"
#include "base/temporary_folder.h"
#include "techniques/folder/folder_technique.h"
#include "tests/support/stages.h"

#include <string>
#include <vector>

namespace shadowbench {

/// Draws the map of `sm-uniform` and tests it once, as that does.
inline const std::string mapToml = R"(id = "mine"
title = "A map"
answer = "hard"

[parameter.map]
default = 1024
range = [16, 8192]
meaning = "texels per side of the map"

[target.depths]
format = "Depth32F"
size = "map"
compare = true

[[pass]]
name = "depth map"
draw = "casters"
to = "depths"
offset = [2, 64]

[[pass]]
name = "resolve"
draw = "screen"
fragment = "resolve.frag"
to = "visibility"
)";
inline const std::string mapShader = R"(#include "shared/maps/tested_point.glsl"

uniform sampler2DShadow depths;
out float visibility;

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    visibility = receiver.seen ? shadowTest(depths, testedPoint(receiver)) : 1.0;
}
)";

/// `mapShader` with percentage-closer filtering over KERNEL² texels.
inline const std::string filteringShader = R"(#include "shared/filters/pcf.glsl"
#include "shared/maps/tested_point.glsl"
uniform sampler2DShadow depths;
out float visibility;
void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    MapPoint point = testedPoint(receiver);
    vec2 slope = receiverPlaneSlope(receiver.position, normalAt(gl_FragCoord.xy), point.at);
    visibility = receiver.seen ? percentageCloser(depths, point, slope, KERNEL) : 1.0;
}
)";

/// `text` with the first `from` in it replaced.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
}

/// Minutes for an image of any size, in as many rounds as llvmpipe runs of a shader's loops together.
inline const std::string hangingShader =
    "#define SIN sum += sin(sum + float(k));\n#define SIN8 SIN SIN SIN SIN SIN SIN SIN SIN\n" +
    replaced(
        mapShader, "    visibility =",
        "    float sum = gl_FragCoord.x;\n    for (int k = 0; k < 60000; ++k) { SIN8 SIN8 SIN8 SIN8 SIN8 SIN8 SIN8 SIN8 }\n"
        "    visibility = sum > 1e9 ? 0.0 :");

/// Those of docs/technique-folders.md that are marked as of this language, in their order.
inline std::vector<std::string> documentedBlocks(const std::string& language) {
    const std::string page = readFile(std::filesystem::path(SOURCE_FOLDER) / "docs/technique-folders.md"),
                      mark = "```" + language + "\n";
    std::vector<std::string> blocks;
    for (std::size_t at = page.find(mark); at != std::string::npos; at = page.find(mark, at)) {
        at += mark.size();
        blocks.push_back(page.substr(at, page.find("```", at) - at));
    }
    return blocks;
}

class WrittenTechnique {
public:
    explicit WrittenTechnique(const std::string& toml = mapToml, const std::string& shader = mapShader) {
        write("technique.toml", toml);
        write("resolve.frag", shader);
    }

    void write(const std::string& file, const std::string& text) const { writeFile(folder_.path() / file, text); }
    [[nodiscard]] const std::filesystem::path& path() const { return folder_.path(); }
    techniques::Entry entry() const { return techniques::folderEntry(techniques::readTechniqueFolder(folder_.path())); }
    std::unique_ptr<techniques::Technique> made(const std::string& parameters = "") const {
        const techniques::Entry entry = this->entry();
        return entry.make(techniques::parseParameters(parameters, entry.parameters, entry.id));
    }

private:
    TemporaryFolder folder_;
};

} // namespace shadowbench
