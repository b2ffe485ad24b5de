#include "harness/cells/environment.h"

#include "embedded_commit.h"

#include <ctime>
#include <fmt/format.h>
#include <fstream>
#include <string_view>

namespace shadowbench {
namespace {

std::string cpuModel() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (line.starts_with("model name")) return line.substr(line.find(": ") + 2);
    return "unknown";
}

} // namespace

Environment environmentOf(const gl::ContextInfo& context) {
    Environment environment;
    environment.renderer = context.renderer;
    environment.gl = context.version;
    environment.cpu = cpuModel();
    environment.compiler = std::string("g++ ") + __VERSION__;
    environment.rasterThreads = context.rasterThreads;
    environment.vectorBits = context.vectorBits;
    return environment;
}

Commit builtFrom() { return {embedded::commit, embedded::dirty}; }

std::string programVersion() {
    return fmt::format("{} (commit {}{})", embedded::version, std::string_view(embedded::commit).substr(0, 12),
                       embedded::dirty ? ", with changes" : "");
}

std::string timeNow() {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&now, &utc);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
    return text;
}

} // namespace shadowbench
