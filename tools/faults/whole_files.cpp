#include "tools/faults/whole_files.h"

#include "base/error.h"
#include "base/files.h"
#include "base/image_io.h"
#include "groundtruth/store/cache.h"
#include "harness/records/record.h"

#include <nlohmann/json.hpp>
#include <sstream>

namespace shadowbench::faults {
namespace {

bool endsWith(std::string text, std::string_view end) {
    while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
    return text.ends_with(end);
}

bool isJson(const std::string& text) { return nlohmann::json::accept(text); }

bool isJsonLines(const std::string& text) {
    if (text.empty() || text.back() != '\n') return false;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        if (!isJson(line)) return false;
    return true;
}

} // namespace

std::optional<std::string> partial(const std::filesystem::path& file) {
    const std::string extension = file.extension().string();
    const auto require = [](bool whole, const char* what) {
        return whole ? std::optional<std::string>() : std::optional<std::string>(what);
    };
    try {
        if (extension == ".exr" || extension == ".png") {
            (void)readChannel(file, 0);
            return {};
        }
        if (extension == ".ref") return groundtruth::damage({file.stem().string().substr(0, 32), file, 0, {}});
        const std::string text = readFile(file);
        if (extension == ".jsonl") return require(isJsonLines(text), "a line is cut off");
        if (extension == ".json" || extension == ".gltf") return require(isJson(text), "it is no JSON");
        if (extension == ".html") return require(endsWith(text, "</html>"), "it has no </html>");
        if (extension == ".svg") return require(endsWith(text, "</svg>"), "it has no </svg>");
        if (extension == ".pdf") return require(endsWith(text, "%%EOF"), "it has no %%EOF");
        if (extension == ".xml") return require(endsWith(text, ">"), "its last element is not closed");
        return require(!text.empty(), "it is empty");
    } catch (const Error& error) {
        return error.what();
    }
}

} // namespace shadowbench::faults
